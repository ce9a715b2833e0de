// These tests check which measured curves are accepted, and how a law is driven through them.
#include "sim/identification/series.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/sim/base/case_name.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/identification/synthetic.h"

namespace hysteron {
namespace {

using test::refusal;
using test::says;

struct BadFile {
  const char* name;
  const char* rows;
  const char* reason;
};

class MeasuredFile : public testing::TestWithParam<BadFile> {};

TEST_P(MeasuredFile, ThatIsNoCurveIsRefusedWithTheReason) {
  const test::Folder folder;
  const std::string file = folder.write("loop.csv", GetParam().rows);
  EXPECT_TRUE(says(refusal([&] { read_series(file, kRipple, "test"); }), GetParam().reason));
}

constexpr const char* kHead = "curvature [1/m],moment [N]\n";
const std::string kNan = std::string(kHead) + "0,0\n10,nan\n";
const std::string kFew = std::string(kHead) + "0,0\n10,1e-4\n20,2e-4\n";
const std::string kConstant = std::string(kHead) + "10,0\n10,0\n10,0\n10,0\n10,0\n10,0\n10,0\n10,1e-4\n";
const std::string kFalling =
    std::string(kHead) + "0,0\n1,-1e-5\n2,-2e-5\n3,-3e-5\n4,-4e-5\n5,-5e-5\n6,-6e-5\n7,-7e-5\n";
// B = 0.118 gf cm^2/cm against 1/cm, and the same in SI converted once too often.
const std::string kGramForce =
    std::string(kHead) + "0,0\n.3,.035\n.6,.07\n.9,.106\n1.2,.14\n1.5,.177\n1.8,.21\n2.1,.25\n";
const std::string kTwice =
    std::string(kHead) + "0,0\n30,3.4e-8\n60,6.8e-8\n90,1e-7\n120,1.4e-7\n150,1.7e-7\n180,2e-7\n210,2.4e-7\n";
const std::string kZero = std::string(kHead) + "0,0\n10,0\n20,0\n30,0\n40,0\n50,0\n60,0\n70,0\n";
const std::string kShuffled =
    std::string(kHead) + "0,0\n70,7e-4\n10,1e-4\n60,6e-4\n20,2e-4\n50,5e-4\n30,3e-4\n40,4e-4\n20,2e-4\n";
const std::string kTime = "curvature [1/m],moment [N],time [s]\n0,0,0\n10,1e-4,2\n20,2e-4,1\n";

const BadFile kBadFiles[] = {
    {"WithNan", kNan.c_str(), "loop.csv:3: moment [N] = 'nan' must be a finite number"},
    {"TooShort", kFew.c_str(), "3 rows, at least 8"},
    {"OfConstantCurvature", kConstant.c_str(), "the curvature is 10 1/m in all rows"},
    {"WithFallingMoments", kFalling.c_str(), "moments fall with curvature"},
    {"InGramForce", kGramForce.c_str(), "times 9.80665e-05 it is"},
    {"ConvertedTwice", kTwice.c_str(), "Divided by 9.80665e-05 it is"},
    {"WithTimeThatRunsBack", kTime.c_str(), "time = 1 s must be >= 2 s"},
    {"WithConstantMoments", kZero.c_str(), "the moment is 0 N in all rows, and must vary"},
    {"WithShuffledRows", kShuffled.c_str(), "turns 7 times in 9 rows, which must stand in the order"},
    {"InUnitsOfKes", "curvature [1/cm],moment [gf cm/cm]\n0,0\n",
     "curvature is in 1/cm and moment in gf cm/cm: give --units kes, which reads these"},
    {"InOtherUnits", "curvature [1/cm],moment [N]\n0,0\n",
     "curvature is in 1/cm and must be in 1/m, 'curvature [1/m]' (--units si reads 1/m and N, "
     "--units kes reads 1/cm and gf cm/cm): convert numbers of other units, not their name"},
    {"WithoutUnits", "curvature [1/m],moment\n0,0\n", "moment names no unit and must be in N"},
    {"WithMinutes", "curvature [1/m],moment [N],time [min]\n0,0,0\n", "time is in min"},
    {"WithTwoMoments", "curvature [1/m],moment [N],moment [N]\n0,0,0\n", "stands twice"},
    {"WithoutMoment", "curvature [1/m],torque [N m]\n0,0\n", "column 'moment' is missing"},
    {"OfAnotherKind", "x [m],y [m]\n0,0\n", "names a column curvature [1/m]"}};

INSTANTIATE_TEST_SUITE_P(Refused, MeasuredFile, testing::ValuesIn(kBadFiles), test::CaseName());

// B = 0.118 gf cm^2/cm, as KES-FB2 prints it.
const std::string kKes = "KES-FB2\nspecimen;warp 1\n\ncurvature [1/cm];moment [gf cm/cm]\n";
constexpr const char* kKesRows =
    "0;0\n0,3;0,0354\n0,6;0,0708\n0,9;0,1062\n1,2;0,1416\n1,5;0,177\n1,8;0,2124\n2,1;0,2478\n";

TEST(MeasuredCurve, InTheUnitsOfKesIsConverted) {
  const test::Folder folder;
  const MomentSeries series = read_kes_series(folder.write("loop.csv", kKes + kKesRows), kRipple, "test");
  ASSERT_EQ(series.rows(), 8);
  EXPECT_NEAR(series.curvature.back(), 210, 1e-9);
  EXPECT_NEAR(series.moment.back() / series.curvature.back(), 0.118 * 9.80665e-5, 1e-12);
}

// Semicolons and tabs with decimal commas, and commas: one curve, whose times go with it.
TEST(MeasuredCurve, InTheUnitsOfKesKeepsItsTimesWhateverSeparatesIt) {
  const test::Folder folder;
  for (const char separator : {';', '\t', ','}) {
    std::string text = "time [s],curvature [1/cm],moment [gf cm/cm]\n";
    for (int i = 0; i < 8; ++i)
      text += std::to_string(i) + ".25,0." + std::to_string(i) + ",0.0" + std::to_string(i) + "\n";
    if (separator != ',') {
      std::replace(text.begin(), text.end(), ',', separator);
      std::replace(text.begin(), text.end(), '.', ',');
    }
    const MomentSeries series = read_kes_series(folder.write("loop.csv", text), kRipple, "test");
    EXPECT_EQ(series.seconds, (std::vector<double>{0, 1, 1, 1, 1, 1, 1, 1})) << separator;
    EXPECT_NEAR(series.curvature[7], 70, 1e-12) << separator;
    EXPECT_NEAR(series.moment[7], 0.07 * 9.80665e-3, 1e-12) << separator;
  }
}

TEST(MeasuredCurve, InSiIsNoneOfTheUnitsOfKes) {
  const test::Folder folder;
  const std::string file = folder.write("loop.csv", kGramForce);
  EXPECT_TRUE(says(refusal([&] { read_kes_series(file, kRipple, "test"); }),
                   "curvature is in 1/m and moment in N: give --units si"));
}

TEST(MeasuredCurve, IsNotGuessedToBeInOtherUnits) {
  const test::Folder folder;
  const std::string kes = folder.write("kes.csv", kKes + kKesRows), si = folder.write("si.csv", kGramForce);
  EXPECT_NE(refusal([&] { read_kes_series(si, kRipple, "test"); }), test::kAccepted);
  EXPECT_NE(refusal([&] { read_series(kes, kRipple, "test"); }), test::kAccepted);
}

// Along a loop the fabric takes work; the same rows from the last to the first give it back.
TEST(MeasuredCurve, WhoseRowsRunBackwardsIsRefused) {
  MomentSeries series = measured("prandtl", kCotton, {250, -250, 250, -250, 250}, 0.02, 1);
  std::reverse(series.curvature.begin(), series.curvature.end());
  std::reverse(series.moment.begin(), series.moment.end());
  EXPECT_TRUE(says(refusal([&] { prepare(series, kRipple); }), "rows run backwards"));
}

TEST(Drive, FollowsTheMeasuredCurvatureWhereThatDoesNotRipple) {
  const MomentSeries series = measured("prandtl", kCotton, {250, -250, 100}, 0, 1);
  EXPECT_EQ(series.drive, series.curvature);
  EXPECT_EQ(series.reversals, 2);
}

// Pooled adjacent violators: of 3 and 2 both become 2.5.
TEST(Drive, RunsOneWayThroughRipple) {
  MomentSeries series;
  series.name = "ripple";
  series.curvature = {0, 1, 3, 2, 4, 50, 60, 70, 80, 90};
  for (double k : series.curvature) series.moment.push_back(1e-5 * k);
  prepare(series, kRipple);
  EXPECT_EQ(series.drive, (std::vector<double>{0, 1, 2.5, 2.5, 4, 50, 60, 70, 80, 90}));
  EXPECT_EQ(series.reversals, 0);
}

TEST(Drive, GivesALawTheMeasuredTimes) {
  MomentSeries series = measured("linear", kCotton, {250}, 0, 1);
  series.seconds.assign(series.moment.size(), 0.25);
  EXPECT_EQ(law_rows(series, false).at(3).seconds, 0.25);
  EXPECT_EQ(law_rows(series, true).size(), 2 * series.moment.size());
}

}  // namespace
}  // namespace hysteron
