// Scene and fabric files for the tests of reading, in a folder of their own.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "gtest/gtest.h"
#include "sim/scene/scene_reader.h"

namespace hysteron {

class TextFile {
 public:
  explicit TextFile(const std::string& text, const std::string& ending = ".toml") {
    static int count = 0;
    path_ = std::filesystem::path(testing::TempDir()) /
            ("hysteron-" + std::to_string(getpid()) + "-" + std::to_string(count++) + ending);
    std::ofstream(path_) << text;
  }
  ~TextFile() { std::filesystem::remove(path_); }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  std::string path() const { return path_.string(); }
  // "file.toml:3"
  std::string line(int number) const { return path() + ":" + std::to_string(number); }

 private:
  std::filesystem::path path_;
};

// The default scene with what a file of this text says.
inline Scene scene_of(const std::string& text) {
  const TextFile file(text);
  Scene scene = default_scene();
  apply_scene_file(scene, file.path());
  return scene;
}

}  // namespace hysteron
