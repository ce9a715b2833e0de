#include "experiments/workbench/session/record.h"

#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

const std::vector<std::string> kColumns = {"time [s]", "drape_coefficient [%]"};

TEST(Record, ReadsBackTheSameNumbers) {
  const Folder folder;
  const auto file = folder.path() / "metrics.csv";
  Record record(file, kColumns);
  record.row({0.1, std::sqrt(2.0)});
  record.row({1.0 / 3, -1e-300});
  record.finish();
  const Table table = read_csv(file, kColumns, {}, "test");
  EXPECT_EQ(table.numbers("time [s]"), (std::vector<double>{0.1, 1.0 / 3}));
  EXPECT_EQ(table.numbers("drape_coefficient [%]"), (std::vector<double>{std::sqrt(2.0), -1e-300}));
}

TEST(Record, CanBeWatchedWhileItGrows) {
  const Folder folder;
  Record record(folder.path() / "metrics.csv", {"time [s]"});
  record.row({1});
  EXPECT_EQ(file_content(folder.path() / "metrics.csv.part"), "time [s]\n1\n");
  EXPECT_FALSE(fs::exists(folder.path() / "metrics.csv"));
}

TEST(Record, KeepsItsRowsWhenTheRunEndsEarly) {
  const Folder folder;
  try {
    Record record(folder.path() / "metrics.csv", {"time [s]"});
    record.row({1});
    throw Error::simulation("no convergence");
  } catch (const Error&) {
  }
  EXPECT_EQ(file_content(folder.path() / "metrics.csv"), "time [s]\n1\n");
}

TEST(Record, NeverTakesItsNameOnAFullDisk) {
  const Folder folder;
  const auto file = folder.path() / "metrics.csv";
  fs::create_symlink("/dev/full", file.string() + ".part");
  const Error error = test::thrown_error([&] { Record(file, kColumns); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(has(error.what(), "No space left on device"));
  EXPECT_FALSE(fs::exists(fs::symlink_status(file)));
}

TEST(Record, ThatFillsTheDiskLaterNeverTakesItsNameEither) {
  const Folder folder;
  const auto file = folder.path() / "metrics.csv";
  const int exit_code = on_a_disk_with(1000, [&] {
    try {
      Record record(file, kColumns);
      for (int row = 0; row < 1000; ++row) record.row({1.0 * row, 0});
    } catch (const Error& error) {
      return error.exit_code();
    }
    return 0;
  });
  EXPECT_EQ(exit_code, 1);
  EXPECT_FALSE(fs::exists(file));
}

TEST(Record, RefusesARowThatDoesNotFitItsColumns) {
  const Folder folder;
  Record record(folder.path() / "metrics.csv", kColumns);
  EXPECT_THROW(record.row({1}), Error);
}

}  // namespace
}  // namespace hysteron::experiments
