#include "tests/sim/base/folder.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace hysteron::test {

Folder::Folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  std::replace(name.begin(), name.end(), '/', '_');
  path_ = testing::TempDir() + "hysteron-" + name + "-XXXXXX";
  if (!::mkdtemp(path_.data())) throw Error::system("making the folder " + path_ + " for a test");
}

Folder::~Folder() { std::filesystem::remove_all(path_); }

std::string Folder::write(const std::string& name, const std::string& content) const {
  namespace fs = std::filesystem;
  // File systems write a file that is cut short to the disk at once, and a new one when they have time.
  if (fs::is_regular_file(fs::symlink_status(file(name)))) fs::remove(file(name));
  std::ofstream(file(name), std::ios::binary) << content;
  return file(name);
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

std::string file_content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

Error thrown_error(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error was thrown";
  return Error::simulation("none");
}

}  // namespace hysteron::test
