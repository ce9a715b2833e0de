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

TEST(NumberText, HasSignificantDigitsAsPrintfWritesThem) {
  EXPECT_EQ(number_text(0.000940678, 3), "0.000941");
  EXPECT_EQ(number_text(1e6, 6), "1e+06");
  EXPECT_EQ(number_text(1250, 17), "1250");
  EXPECT_EQ(number_text(0.1, 17), "0.10000000000000001");
  EXPECT_EQ(number_text(std::numeric_limits<double>::infinity(), 6), "inf");
}

TEST(NumberText, HasDigitsBehindThePoint) {
  EXPECT_EQ(number_text(2.005, {.decimals = 1}), "2.0");
  EXPECT_EQ(number_text(-0.4, {.decimals = 0}), "-0");
  EXPECT_EQ(number_text(std::numeric_limits<double>::max(), {.decimals = 2}).size(), 312);
}

TEST(NumberText, HasAUnitBehindASpace) {
  EXPECT_EQ(number_text(0.25, {.unit = "N m"}), "0.25 N m");
  EXPECT_EQ(number_text(2. / 3, 2, "mN"), "0.67 mN");
  EXPECT_EQ(number_text(2. / 3, 2, ""), "0.67");
}

TEST(NumberText, GroupsTheThousandsOfACount) {
  EXPECT_EQ(number_text(999, kCount), "999");
  EXPECT_EQ(number_text(1e6, kCount), "1,000,000");
  EXPECT_EQ(number_text(-1234567, kCount), "-1,234,567");
  EXPECT_EQ(number_text(-123, kCount), "-123");
  EXPECT_EQ(number_text(1234.5, {.decimals = 1, .thousands = true}), "1,234.5");
}

}  // namespace
}  // namespace hysteron
