// A fabric is made from b1 and c1, and from B and 2HB.
#include "sim/identification/published.h"

#include <gtest/gtest.h>

#include <fstream>

#include "sim/base/error.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

using test::refusal;
using test::says;
using Names = std::vector<std::string>;
constexpr double kRounding = 1e-12;

TEST(Kes, WithK0GivesTheFabricBack) {
  const double two_hb = 2 * kCotton.friction_moment();
  const Identification found = identify_kes({{kCotton.b2}, {two_hb}, {kCotton.k0}}, {});
  EXPECT_EQ(found.undetermined(), Names{});
  EXPECT_NEAR(found.b1.value / kCotton.b1, 1, kRounding);
  EXPECT_EQ(found.b2.value, kCotton.b2);
  EXPECT_NEAR(found.residual_rms(), 0, kRounding * two_hb);
}

TEST(Kes, WithoutK0LeavesB1AndK0OpenAndSaysWhatIsAssumed) {
  const double two_hb = 2 * kCotton.friction_moment();
  const Identification found = identify_kes({{kCotton.b2}, {two_hb}, {}}, {});
  EXPECT_EQ(found.undetermined(), (Names{"b1", "k0"}));
  EXPECT_EQ(found.k0.value, 8);
  EXPECT_EQ(found.k0.low, 4);
  EXPECT_EQ(found.k0.high, 25);
  EXPECT_NEAR(found.curve().friction_moment(), two_hb / 2, kRounding);
  EXPECT_TRUE(says(found.statements.at(0), "k0 = 8/m"));
  EXPECT_EQ(found.k0.confidence, "assumed");
}

TEST(Kes, WithoutALoopLeavesOnlyK0Open) {
  EXPECT_EQ(identify_kes({{1e-5}, {0}, {}}, {}).undetermined(), Names{"k0"});
}

// b1 = B + 2HB/k0: errors of both add in squares.
TEST(Kes, CarriesStandardErrorsOver) {
  const Identification found = identify_kes({{1e-5, 3e-7}, {1e-3, 2e-5}, {50}}, {});
  EXPECT_EQ(found.b2.standard_error, 3e-7);
  EXPECT_NEAR(found.b1.standard_error, std::hypot(3e-7, 2e-5 / 50), kRounding);
}

TEST(Kes, ShowsThatAK0InsideTheWindowContradictsStraightBranches) {
  const Identification found = identify_kes({{1e-5}, {1e-3}, {120}}, {});
  EXPECT_GT(found.residual_rms(), 0.01 * found.largest_moment());
  EXPECT_TRUE(says(found.statements.at(0), "window"));
}

TEST(Kes, RefusesNonsenseWithItsReason) {
  EXPECT_TRUE(says(refusal([] { identify_kes({{0}, {1e-3}, {}}, {}); }), "kes.b = 0 N m must be > 0"));
  EXPECT_TRUE(says(refusal([] { identify_kes({{1e-5}, {-1e-3}, {}}, {}); }), "must be >= 0"));
}

// 0.118 gf cm^2/cm and 0.124 gf cm/cm of cotton broad cloth, not converted, or converted twice.
TEST(Kes, NamesTheFactorBetweenItsUnitsAndSi) {
  const std::string as_printed = refusal([] { identify_kes({{0.118}, {0.124}, {}}, {}); });
  EXPECT_TRUE(says(as_printed, "times 9.80665e-05 it is 1.157e-05 N m"));
  const std::string twice = refusal([] { identify_kes({{1.135e-9}, {1e-7}, {}}, {}); });
  EXPECT_TRUE(says(twice, "Divided by 9.80665e-05 it is 1.157e-05 N m"));
  const std::string width = refusal([] { identify_kes({{1.157e-5}, {0.124}, {}}, {}); });
  EXPECT_TRUE(says(width, "times 0.00980665 it is 0.001216 N"));
}

TEST(VirginCurve, OfAKnownRatioGivesTheFabricBack) {
  Assumptions assumptions;
  assumptions.ratio = kCotton.b2 / kCotton.b1;
  const Identification found = identify_virgin({{kCotton.b1}, {kCotton.c1()}}, assumptions);
  EXPECT_NEAR(found.b2.value / kCotton.b2, 1, kRounding);
  EXPECT_NEAR(found.k0.value / kCotton.k0, 1, kRounding);
  EXPECT_NEAR(found.residual_rms(), 0, kRounding * found.largest_moment());
  EXPECT_EQ(found.undetermined(), (Names{"b2", "k0"}));
  EXPECT_TRUE(says(found.statements.at(0), "b2/b1 = 0.32"));
}

// k0 in 1/cm: b1 would be that of a board.
// 2HB times 9.80665e-5, which is B's factor, in place of 9.80665e-3: a hundredth of 105/m.
TEST(Kes, DoubtsAWidthThatNoWovenClothHas) {
  EXPECT_EQ(kes_warning({{1.157e-5}, {1.216e-3}, {}}), "");
  EXPECT_EQ(kes_warning({{1.157e-5}, {1.216e-5}, {}}),
            "kes.2hb is 1.05 1/m of kes.b, and woven cloth has 16 to 300: is one of them in another unit?");
  EXPECT_TRUE(says(kes_warning({{1e-5}, {3.1e-3}, {}}), "is 310 1/m of kes.b"));
  EXPECT_EQ(kes_warning({{1e-5}, {0}, {}}), "") << "elastic";
}

TEST(Kes, RefusesAK0ThatMakesNoFabric) {
  const std::string reason = refusal([] { identify_kes({{1e-5}, {1e-3}, {0.5}}, {}); });
  EXPECT_TRUE(says(reason, "k0 = 0.5 1/m makes b1 = B + 2HB/k0 = 0.00201 N m, must be <= 0.001"));
}

// c1 in gf cm^3/cm.
TEST(VirginCurve, WhoseBendSaturatesNowhereIsRefused) {
  const std::string reason = refusal([] { identify_virgin({{3.6e-5}, {-0.24}}, {}); });
  EXPECT_TRUE(says(reason, "makes k0 = (b2 - b1)/(2 c1) = 3.75e-05 1/m, must be in [0.1, 1e+05] 1/m"));
}

TEST(VirginCurve, ThatStiffensIsRefusedWithTheReason) {
  for (const double c1 : {0.0, 2e-9}) {
    const std::string reason = refusal([&] { identify_virgin({{1e-5}, {c1}}, {}); });
    EXPECT_TRUE(says(reason, "must be < 0"));
    EXPECT_TRUE(says(reason, "stiffens"));
  }
}

// The mean of 1, 2, 3 and its standard error are 2 and 1/sqrt(3).
TEST(VirginCurve, OfSeveralSpecimensIsTheirMeanWithItsError) {
  const test::Folder folder;
  const VirginNumbers numbers =
      read_virgin(folder.write("v.csv", "b1 [N m],c1 [N m2]\n1e-5,-1e-8\n2e-5,-2e-8\n3e-5,-3e-8\n"), "test");
  EXPECT_NEAR(numbers.b1.value, 2e-5, kRounding);
  EXPECT_NEAR(numbers.b1.standard_error, 1e-5 / std::sqrt(3), kRounding);
  const Identification found = identify_virgin(numbers, {});
  EXPECT_EQ(found.b1.standard_error, numbers.b1.standard_error);
}

TEST(VirginCurve, OfAFileNamesTheRowThatIsRefused) {
  const test::Folder folder;
  const std::string file = folder.write("v.csv", "b1 [N m],c1 [N m2]\n1e-5,-1e-8\n2e-5,2e-8\n");
  EXPECT_TRUE(says(refusal([&] { read_virgin(file, "test"); }), "v.csv:3: c1 = 2e-08"));
}

}  // namespace
}  // namespace hysteron
