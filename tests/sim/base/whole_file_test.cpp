// Every reader of files goes through here.
#include "sim/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/toml_file.h"
#include "tests/sim/base/folder.h"

namespace hysteron {
namespace {

using test::Folder;
using test::thrown_error;

TEST(WholeFile, HasAllBytes) {
  const Folder folder;
  std::string bytes(200001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 31);
  EXPECT_EQ(whole_file(folder.write("a", bytes), "reading a"), bytes);
  EXPECT_EQ(whole_file(folder.write("b", ""), "reading b"), "");
}

// Reading from a pipe that no one writes to would wait for ever.
TEST(WholeFile, IsNeitherAFolderNorAPipeNorADevice) {
  const Folder folder;
  const std::string pipe = folder.file("pipe.toml");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const auto refusal = [&](const std::string& file) {
    const Error error = thrown_error([&] { whole_file(file, "cannot read it"); });
    EXPECT_EQ(error.exit_code(), 1);
    return std::string(error.what());
  };
  EXPECT_EQ(refusal(pipe), "cannot read it: it is a pipe or a device; write it to a file first");
  EXPECT_EQ(refusal("/dev/zero"), refusal(pipe));
  EXPECT_EQ(refusal(folder.file(".")), "cannot read it: it is a folder");
  EXPECT_EQ(refusal(folder.file("none")), "cannot read it: No such file or directory");
  EXPECT_EQ(thrown_error([&] { read_toml(pipe); }).exit_code(), 1);
  EXPECT_EQ(thrown_error([&] { read_obj(pipe, 0); }).exit_code(), 1);
}

// A file with a hole: nothing of its size is on the disk.
TEST(WholeFile, LargerThanTheLimitIsRefusedBeforeItIsRead) {
  const Folder folder;
  const std::string file = folder.write("large", "a");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);
  const Error error = thrown_error([&] { whole_file(file, "cannot read it"); });
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_EQ(std::string(error.what()), "cannot read it: it is larger than 2047 MiB");
}

TEST(WholeFile, ThatARequestNamesIsPartOfTheRequest) {
  const Error error = thrown_error([] { file_named("/nowhere/a.png", "reading a.png"); });
  EXPECT_EQ(error.exit_code(), 2);
  EXPECT_EQ(std::string(error.what()), "reading a.png: No such file or directory");
}

}  // namespace
}  // namespace hysteron
