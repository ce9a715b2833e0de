// Scene and fabric files for the tests of reading, in a folder of their own.
#pragma once

#include <Eigen/Core>
#include <string>

#include "sim/scene/key_table.h"
#include "sim/scene/scene_reader.h"
#include "tests/sim/base/folder.h"

namespace hysteron {

class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& ending = ".toml")
      : path_(folder_.write("file" + ending, text)) {}

  const std::string& path() const { return path_; }
  // Returns "file.toml:3".
  std::string line(int number) const { return path() + ":" + std::to_string(number); }

 private:
  test::Folder folder_;
  std::string path_;
};

// The default scene with what a file of this text says.
inline Scene scene_of(const std::string& text) {
  const TextFile file(text);
  Scene scene = default_scene();
  apply_scene_file(scene, file.path());
  return scene;
}

namespace test {

// Shipped scenes set these keys of their pictures, which the simulation does not know.
struct Pictures {
  std::string size;
  Eigen::Vector3d direction;
  Numbers box;
};

// Returns a shipped scene without what experiments add to it.
inline Scene shipped_scene(const std::string& name) {
  static const KeyRow<Pictures> kRows[] = {{"size", at<&Pictures::size>, "", any(), ""},
                                           {"camera.direction", at<&Pictures::direction>, "", any(), ""},
                                           {"camera.box", at<&Pictures::box>, "m", any(), ""}};
  Pictures pictures;
  Scene scene = default_scene();
  apply_scene_file(scene, name, bind(kRows, pictures), {"metric"});
  return scene;
}

}  // namespace test
}  // namespace hysteron
