// Every reader of files goes through here.
#include "sim/base/whole_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "sim/mesh/cloth_mesh.h"
#include "sim/scene/toml_file.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::Folder;
using test::refusal;

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
  const auto reason = [&](const std::string& file) {
    return refusal([&] { whole_file(file, "cannot read it"); }, 1);
  };
  EXPECT_EQ(reason(pipe), "cannot read it: it is a pipe or a device; write it to a file first");
  EXPECT_EQ(reason("/dev/zero"), reason(pipe));
  EXPECT_EQ(reason(folder.file(".")), "cannot read it: it is a folder");
  EXPECT_EQ(reason(folder.file("none")), "cannot read it: No such file or directory");
  EXPECT_NE(refusal([&] { read_toml(pipe); }, 1), test::kAccepted);
  EXPECT_NE(refusal([&] { read_obj(pipe, 0); }, 1), test::kAccepted);
}

// A file with a hole: nothing of its size is on the disk.
TEST(WholeFile, LargerThanTheLimitIsRefusedBeforeItIsRead) {
  const Folder folder;
  const std::string file = folder.write("large", "a");
  std::filesystem::resize_file(file, std::uintmax_t{1} << 40);
  EXPECT_EQ(refusal([&] { whole_file(file, "cannot read it"); }),
            "cannot read it: it is larger than 2047 MiB");
}

TEST(WholeFile, ThatARequestNamesIsPartOfTheRequest) {
  EXPECT_EQ(refusal([] { file_named("/nowhere/a.png", "reading a.png"); }),
            "reading a.png: No such file or directory");
}

}  // namespace
}  // namespace hysteron
