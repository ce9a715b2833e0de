// A job has what a command line has read, and what is settled when it ends.
#include "sim/base/job.h"

#include <fstream>

#include "gtest/gtest.h"
#include "sim/base/fnv1a.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"
#include "tests/sim/base/folder.h"

namespace hysteron {
namespace {
namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(Job, KnowsEveryFileThatItHasReadByTheBytesOfTheFirstTime) {
  const test::Folder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  write(a, "one");
  write(b, "two");
  const Job job;
  whole_file(a, "");
  write(a, "another");
  whole_file(a, "");
  whole_file(b, "");
  const std::vector<FileRead> read = job.files_read();
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].file, a);
  EXPECT_EQ(read[0].hash, fnv1a("one", 3));
  EXPECT_EQ(read[1].hash, fnv1a("two", 3));
}

TEST(Job, IsThatOfItsThreadsAndNotOfAJobInside) {
  const test::Folder folder;
  for (const char* name : {"0", "1", "2", "3"}) write(folder.path() / name, name);
  const Job outer;
  in_parallel(3, 2, [&](std::size_t i) { whole_file(folder.path() / std::to_string(i), ""); });
  {
    const Job inner;
    whole_file(folder.path() / "3", "");
    EXPECT_EQ(inner.files_read().size(), 1u);
  }
  EXPECT_EQ(outer.files_read().size(), 3u);
  EXPECT_EQ(Job::current(), &outer);
}

TEST(Job, SettlesWhatCameLastFirstAndOnce) {
  Job job;
  std::vector<int> settled;
  for (int i : {10, 20}) job.at_end([&settled, i](int exit_code) { settled.push_back(i + exit_code); });
  job.end(2);
  job.end(3);
  EXPECT_EQ(settled, (std::vector{22, 12}));
}

}  // namespace
}  // namespace hysteron
