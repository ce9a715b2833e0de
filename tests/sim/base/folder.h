// This header has a folder of its own for each test, and the error that a call throws.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/base/error.h"

namespace hysteron::test {

// This folder is of this test and process alone, and is removed with all it holds.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::string write(const std::string& name, const std::string& content) const;  // returns the file's path
  std::vector<std::string> names() const;

 private:
  std::string path_;
};

std::string file_content(const std::filesystem::path& file);

// The Error that the call throws; fails the test if there is none.
Error thrown_error(const std::function<void()>& call);

}  // namespace hysteron::test
