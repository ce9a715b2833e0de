// Scene and fabric files for the tests of reading, in a folder of their own.
#pragma once

#include <string>

#include "sim/scene/scene_reader.h"
#include "tests/sim/base/folder.h"

namespace hysteron {

class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& ending = ".toml")
      : path_(folder_.write("file" + ending, text)) {}

  const std::string& path() const { return path_; }
  // "file.toml:3"
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

}  // namespace hysteron
