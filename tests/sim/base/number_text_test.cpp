// Numbers are written as texts and read back.
#include "sim/base/number_in.h"

#include <gtest/gtest.h>

#include <limits>

namespace hysteron {
namespace {

TEST(NumberText, ReadsBackAsTheSameNumber) {
  using Limits = std::numeric_limits<double>;
  for (const double x : {1. / 3, -2e-300, 6.02214076e23, 0., -0., Limits::max(), Limits::denorm_min()})
    EXPECT_EQ(number_in(number_text(x)), x) << number_text(x);
}

TEST(NumberText, IsTheShortestThatDoesSo) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(-1250), "-1250");
  EXPECT_EQ(number_text(1e-7), "1e-07");
  EXPECT_EQ(number_text(0.1 + 0.2), "0.30000000000000004");
}

}  // namespace
}  // namespace hysteron
