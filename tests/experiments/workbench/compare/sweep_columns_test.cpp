// Which columns share a process.
#include "experiments/workbench/compare/sweep_columns.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

ChildRun column(const std::vector<Flag>& flags) {
  ChildRun result{"", {"swing", "", flags, {}}, "out"};
  result.line.flags.push_back({"no-images", true});
  return result;
}

TEST(Chunks, HaveColumnsInTheirOrderAndNoMoreThanIsAsked) {
  const std::vector<ChildRun> columns(5, column({}));
  EXPECT_EQ(batch_chunks(columns, 2, -1), (std::vector<Chunk>{{0, 1}, {2, 3}, {4}}));
  EXPECT_EQ(batch_chunks(columns, 8, -1), (std::vector<Chunk>{{0, 1, 2, 3, 4}}));
  EXPECT_EQ(batch_chunks(columns, 1, -1), (std::vector<Chunk>{{0}, {1}, {2}, {3}, {4}}));
  EXPECT_EQ(batch_chunks(columns, 8, 2), (std::vector<Chunk>{{0, 1, 3, 4}, {2}}));
}

// A process sees the GPUs that its first line leaves, and keeps signals for all of its runs.
TEST(Chunks, AreOfOneDeviceAndOfOneKindOfEndBySignals) {
  const std::vector<ChildRun> columns = {column({{"device", "cuda:0"}}), column({{"device", "cuda:1"}}),
                                         column({{"device", "cuda:0"}}), column({{"checkpoint", 60}}),
                                         column({{"device", "cuda:1"}}), column({{"checkpoint", 30}})};
  EXPECT_EQ(batch_chunks(columns, 8, -1), (std::vector<Chunk>{{0, 2}, {1, 4}, {3, 5}}));
}

std::string refusal(const ChildRun& of) {
  return test::refusal([&] { check_batch({of}, 8); });
}

TEST(Chunks, AreOfRunsWithoutPicturesThatStepACloth) {
  EXPECT_EQ(refusal(column({})), "(accepted)");
  ChildRun other = column({});
  other.line.experiment = "kes";
  EXPECT_EQ(refusal(other), "batch = 8 is of runs that step a cloth, not of kes (--batch)");
  other.line.experiment = "bench";
  EXPECT_EQ(refusal(other), "batch = 8 is of runs that step a cloth, not of bench (--batch)");
  EXPECT_TRUE(says(refusal(column({{"errors", true}})), "errors.batch"));
  ChildRun drawn = column({});
  drawn.line.flags.clear();
  EXPECT_TRUE(says(refusal(drawn), "no-images"));
  EXPECT_NO_THROW(check_batch({drawn}, 1));
}

}  // namespace
}  // namespace hysteron::experiments
