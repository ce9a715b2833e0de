#include "experiments/workbench/session/record.h"

#include <cmath>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

const std::vector<std::string> kColumns = {"time [s]", "drape_coefficient [%]"};

class RecordFile : public testing::Test {
 protected:
  const Folder folder_;
  const fs::path file_ = folder_.path() / "metrics.csv";
};

TEST_F(RecordFile, ReadsBackTheSameNumbers) {
  TimeSeriesWriter record(file_, kColumns);
  record.row({0.1, std::sqrt(2.0)});
  record.row({1.0 / 3, -1e-300});
  record.finish();
  const Table table = read_csv(file_, kColumns, {}, "test");
  EXPECT_EQ(table.numbers("time [s]"), (std::vector<double>{0.1, 1.0 / 3}));
  EXPECT_EQ(table.numbers("drape_coefficient [%]"), (std::vector<double>{std::sqrt(2.0), -1e-300}));
}

TEST_F(RecordFile, CanBeWatchedWhileItGrows) {
  TimeSeriesWriter record(file_, {"time [s]"});
  record.row({1});
  EXPECT_EQ(file_content(folder_.path() / "metrics.csv.part"), "time [s]\n1\n");
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(RecordFile, KeepsItsRowsWhenTheRunEndsEarly) {
  try {
    TimeSeriesWriter record(file_, {"time [s]"});
    record.row({1});
    throw Error::simulation("no convergence");
  } catch (const Error&) {
  }
  EXPECT_EQ(file_content(file_), "time [s]\n1\n");
}

TEST_F(RecordFile, NeverTakesItsNameOnAFullDisk) {
  fs::create_symlink("/dev/full", file_.string() + ".part");
  const Error error = test::thrown_error([&] { TimeSeriesWriter(file_, kColumns); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "No space left on device"));
  EXPECT_FALSE(fs::exists(fs::symlink_status(file_)));
}

TEST_F(RecordFile, ThatFillsTheDiskLaterNeverTakesItsNameEither) {
  const int exit_code = on_a_disk_with(1000, [&] {
    try {
      TimeSeriesWriter record(file_, kColumns);
      for (int row = 0; row < 1000; ++row) record.row({1.0 * row, 0});
    } catch (const Error& error) {
      return error.exit_code();
    }
    return 0;
  });
  EXPECT_EQ(exit_code, 1);
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(RecordFile, RefusesARowThatDoesNotFitItsColumns) {
  TimeSeriesWriter record(file_, kColumns);
  EXPECT_THROW(record.row({1}), Error);
}

}  // namespace
}  // namespace hysteron::experiments
