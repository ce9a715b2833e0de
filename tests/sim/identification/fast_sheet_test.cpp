// These tests read sheets of FAST laboratories and of cantilevers alone.
#include "sim/identification/fast_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/scene/fabric_reader.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

constexpr double kGramsPerSquareMetre = 1e-3;
const std::string kSheetHead = "quantity,unit,warp,weft,mean\n";

class FastSheetTest : public testing::Test {
 protected:
  FastSheet read(const std::string& rows) const {
    return read_fast_sheet(folder_.write("wool.csv", kSheetHead + rows));
  }
  std::string refused(const std::string& rows) const {
    return test::refusal([&] { read(rows); });
  }
  Fabric fabric(const FastSheet& sheet) const {
    return read_fabric(folder_.write("fabric.toml", fabric_of_fast_sheet(sheet, {}).text), "a test").fabric;
  }
  test::Folder folder_;
};

// Peirce 1930: without friction the rigidity is w c^3, c half of the overhang at 41.5 degrees, which his
// formula for the heavy elastica has to 1 %.
TEST_F(FastSheetTest, WithoutFrictionTheRigidityIsWeightTimesTheCubeOfTheLength) {
  constexpr double kPeirce = 0.01;
  for (const double c : {0.01, 0.02, 0.04}) {
    const double weight = 2, b = rigidity_of_bending_length(c, weight, [](double) {
                               return StripFriction{0, 8};
                             });
    EXPECT_NEAR(b / (weight * c * c * c), 1, kPeirce) << c;
  }
}

TEST_F(FastSheetTest, FrictionOfFirstBendingCarriesAPartOfTheLength) {
  const double c = 0.02, weight = 1.2, apparent = weight * c * c * c;
  double before = 1.01 * apparent;
  for (const double friction : {10.0, 20.0, 40.0, 80.0}) {  // over the rigidity [1/m]
    const double b = rigidity_of_bending_length(c, weight, [&](double b2) {
      return StripFriction{friction * b2, 8};
    });
    EXPECT_LT(b, before) << friction;
    EXPECT_GT(b * (1 + friction * c), 0.9 * apparent) << friction;  // it carries no more than at the clamp
    before = b;
  }
}

TEST_F(FastSheetTest, BendingLengthsComeBackOfDrawnSheets) {
  constexpr double kComesBack = 0.005;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> part(0, 1);
  for (int draw = 0; draw < 6; ++draw) {
    const double warp = 12 + 28 * part(random), weft = warp * (0.6 + 0.6 * part(random)),
                 weight = 60 + 300 * part(random);
    const FastSheet sheet = read("C,mm," + std::to_string(warp) + "," + std::to_string(weft) +
                                 ",\nW,g/m^2,,," + std::to_string(weight) + "\n");
    const Fabric made = fabric(sheet);
    EXPECT_NEAR(made.density, weight * kGramsPerSquareMetre, 1e-9);
    EXPECT_NEAR(1e3 * virtual_bending_length(made.virgin_curve(), made.density) / warp, 1, kComesBack);
    // Along weft the law's moments are f times, its curvatures of slipping 1/f of those along warp.
    const double f = made.weft_friction, b2 = made.weft_bending * made.b2;
    const VirginCurve weft_curve{b2 + f * f * (made.b1 - made.b2), b2, made.k0 / f};
    EXPECT_NEAR(1e3 * virtual_bending_length(weft_curve, made.density) / weft, 1, kComesBack);
  }
}

TEST_F(FastSheetTest, RepeatsGiveTheRigidityItsError) {
  const FastSheet sheet = read("C,mm,20,,\nC,mm,21,,\nC,mm,22,,\nC,mm,,18,\nW,g/m^2,,,150\n");
  EXPECT_DOUBLE_EQ(sheet.along("C", SheetColumn::warp), 0.021);
  const double error = std::sqrt(2.0 / (3 * 2)) / 21;  // of the mean of three
  EXPECT_NEAR(sheet.row.at("C").relative_error(SheetColumn::warp), error, 1e-12);
  EXPECT_TRUE(std::isnan(sheet.row.at("C").relative_error(SheetColumn::weft)));
  const FabricFile file =
      read_fabric(folder_.write("f.toml", fabric_of_fast_sheet(sheet, {}).text), "a test");
  ASSERT_TRUE(file.published_range.contains("2HB"));
  EXPECT_GT(file.published_range.at("2HB").high, 1.5 * file.published_range.at("2HB").low);
}

// 4.9 N/m extend cloth along the bias by e, which is a shear of 2 e under half of that force.
TEST_F(FastSheetTest, ShearIsTheBiasExtensions) {
  const Fabric made = fabric(read("C,mm,,,20\nW,g/m^2,,,150\nEB5,%,,,4\nE100,%,2,4,\nT2,mm,,,0.5\n"));
  EXPECT_NEAR(made.shear, 122.58 / 4, 0.01);
  EXPECT_NEAR(made.warp * (0.02 + 0.0002) * 1.02, 98.07, 0.01);
  EXPECT_DOUBLE_EQ(made.thickness, 5e-4);
}

TEST_F(FastSheetTest, ADrapeIsComparedWithAndNothingIsMadeOfIt) {
  const std::string rows = "C,mm,,,20\nW,g/m^2,,,150\n";
  const Fabric with = fabric(read(rows + "DC-JIS,%,,,62\n")), without = fabric(read(rows));
  EXPECT_DOUBLE_EQ(with.published.at("drape-coefficient").value, 62);
  EXPECT_EQ(with.published.at("drape-coefficient").tester, DrapeStandard::jis);
  EXPECT_EQ(with.b1, without.b1);
  EXPECT_NE(refused(rows + "DC-JIS,%,,,62\nDC-ISO9073,%,,,60\n").find("not two"), std::string::npos);
}

TEST_F(FastSheetTest, NamesWhatIsMissingAndWhatContradicts) {
  EXPECT_NE(refused("C,mm,,,20\n").find("no row W"), std::string::npos);
  EXPECT_NE(refused("C,cm,,,200\nW,g/m^2,,,150\n").find("times as much would be one"), std::string::npos);
  EXPECT_NE(refused("C,mm,,,20\nW,g/m^2,,,150\nF,mm^2,,,0.2\n").find("unknown quantity F"),
            std::string::npos);
  const FastSheet sheet =
      read("C,mm,20,18,\nW,g/m^2,,,150\nB,uN m,23,8.6,\nE20,%,2,5,\nE100,%,1,6,\nEB5,%,,,4\nG,N/m,,,60\n");
  ASSERT_EQ(sheet.warnings.size(), 3u);
  EXPECT_NE(sheet.warnings[0].find("times W g C^3"), std::string::npos);
  EXPECT_NE(sheet.warnings[1].find("not less than E100"), std::string::npos);
  EXPECT_NE(sheet.warnings[2].find("times 123/EB5"), std::string::npos);
}

TEST_F(FastSheetTest, ItsTemplateIsReadOnceItIsFilledIn) {
  std::string text = fast_sheet_template();
  text.replace(text.find("C,mm,,,"), 7, "C,mm,,,20");
  text.replace(text.find("W,g/m^2,,,"), 10, "W,g/m^2,,,150");
  EXPECT_DOUBLE_EQ(read_fast_sheet(folder_.write("t.csv", text)).mean("C"), 0.02);
}

}  // namespace
}  // namespace hysteron
