// The triangles that cross, counted at once or behind a GPU's steps.
#include "experiments/workbench/session/intersection_count.h"

#include <gtest/gtest.h>

#include <thread>

#include "sim/base/archive.h"

namespace hysteron::experiments {
namespace {

const std::vector<Eigen::Vector3i> kTwoTriangles = {{0, 1, 2}, {3, 4, 5}};

// The second triangle stands upright, its lower corner at this height over the first.
std::vector<Eigen::Vector3d> standing_at(double height) {
  return {
      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, height}, {0.2, 0.3, height + 1}, {0.3, 0.2, height + 1}};
}

struct Told {
  std::vector<std::string> lines;
  std::thread::id by;

  std::function<void(const std::string&)> listener() {
    return [this](const std::string& line) {
      lines.push_back(line);
      by = std::this_thread::get_id();
    };
  }
};

class CountOfCrossings : public testing::TestWithParam<bool> {};

TEST_P(CountOfCrossings, IsThatOfAllInstantsAndToldByTheCaller) {
  Told told;
  IntersectionCount intersection_count(kTwoTriangles, GetParam(), told.listener());
  EXPECT_EQ(intersection_count.pairs(), 0);
  for (int instant = 0; instant < 4; ++instant)
    intersection_count.see(0.25 * instant, standing_at(1.25 - 0.5 * instant));
  EXPECT_EQ(intersection_count.pairs(), 1);
  EXPECT_EQ(intersection_count.pairs(), 1);  // no instant counts twice
  ASSERT_EQ(told.lines.size(), 1U);
  EXPECT_EQ(told.lines[0],
            "1 pairs of triangles cross at t = 0.7500 s, the first are 0 and 1 near (0.0000, 0.0000, "
            "0.0000) m");
  EXPECT_EQ(told.by, std::this_thread::get_id());
}

// A checkpoint contains what was seen before it, and the count goes on to the end.
TEST_P(CountOfCrossings, GoesOnFromACheckpoint) {
  Told told;
  IntersectionCount before(kTwoTriangles, GetParam(), told.listener()),
      after(kTwoTriangles, GetParam(), told.listener());
  before.see(0, standing_at(-0.25));
  Archive out;
  before.serialise(out);
  const std::string saved = out.take();
  Archive in(saved);
  after.serialise(in);
  after.see(1, standing_at(-0.5));
  EXPECT_EQ(after.pairs(), 2);
}

INSTANTIATE_TEST_SUITE_P(AtOnceAndBehindAGpu, CountOfCrossings, testing::Bool());

}  // namespace
}  // namespace hysteron::experiments
