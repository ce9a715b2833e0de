#include "sim/base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "sim/base/error.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/base/small_disk.h"

namespace hysteron {
namespace {

using test::Folder;

TEST(AtomicFile, AppearsOnlyOnCommit) {
  const Folder folder;
  AtomicFile file(folder.file("a.txt"));
  file.stream() << "whole";
  EXPECT_NE(folder.names(), std::vector<std::string>{"a.txt"});
  file.commit();
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
  EXPECT_EQ(test::file_content(folder.file("a.txt")), "whole");
}

TEST(AtomicFile, LeavesTheOldContentWithoutCommit) {
  const Folder folder;
  folder.write("a.txt", "old");
  { AtomicFile(folder.file("a.txt")).stream() << "half"; }
  EXPECT_EQ(test::file_content(folder.file("a.txt")), "old");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(AtomicFile, ReplacesWhatALinkLeadsToAndNotTheLink) {
  const Folder folder;
  folder.write("a.txt", "old");
  std::filesystem::create_symlink("a.txt", folder.file("link"));
  AtomicFile file(folder.file("link"));
  file.stream() << "new";
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(test::file_content(folder.file("a.txt")), "new");
}

TEST(AtomicFile, ReplacesNoFileThatIsStandardOutput) {
  EXPECT_THROW(AtomicFile("/dev/stdout"), Error);
  EXPECT_THROW(AtomicFile("/dev/fd/1"), Error);
}

TEST(AtomicFile, ReplacesNoPipe) {
  const Folder folder;
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  EXPECT_EQ(test::refusal([&] { AtomicFile file(folder.file("pipe")); }),
            "cannot write " + folder.file("pipe") + ": it is no plain file; give another name");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"pipe"});
}

TEST(AtomicFile, TwoWritersOfOneTargetDoNotMix) {
  const Folder folder;
  AtomicFile a(folder.file("a.txt")), b(folder.file("a.txt"));
  a.stream() << "first";
  b.stream() << "second";
  a.commit();
  b.commit();
  EXPECT_EQ(test::file_content(folder.file("a.txt")), "second");
}

TEST(AtomicFile, FolderInTheWayIsTheMachinesFailure) {
  const Folder folder;
  folder.write("taken", "");
  EXPECT_EQ(test::refusal([&] { AtomicFile(folder.file("taken/a.txt")); }, 1),
            "cannot create " + folder.file("taken/a.txt") + ": Not a directory");
}

TEST(AtomicFile, FullDiskKeepsTheOldFileAndNothingElse) {
  const Folder folder;
  folder.write("a.txt", "old");
  for (const std::size_t size : {2000, 2000000}) {  // fails when flushed, and while writing
    const auto write = [&] {
      const test::SmallDisk disk(1000);
      AtomicFile file(folder.file("a.txt"));
      file.stream() << std::string(size, 'x');
      file.commit();
    };
    EXPECT_TRUE(test::says(test::refusal(write, 1), "cannot write " + folder.file("a.txt") + ": "));
    EXPECT_EQ(test::file_content(folder.file("a.txt")), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
  }
}

TEST(Folders, BehindALinkToNothingAreRefusedByItsName) {
  const Folder folder;
  std::filesystem::create_symlink("nowhere", folder.file("link"));
  for (const char* name : {"link", "link/inner"})
    EXPECT_EQ(test::thrown_error([&] { make_folders(folder.file(name)); }).what(),
              "cannot create the folder " + folder.file(name) + ": " + folder.file("link") +
                  " is a link to nowhere, which does not exist");
  make_folders(folder.file("a/b"));
  EXPECT_NO_THROW(make_folders(folder.file("a/b")));
}

}  // namespace
}  // namespace hysteron
