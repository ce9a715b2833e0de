// The sheet of a KES-F laboratory, as it is exported and as it is mistyped.
#include "sim/identification/kes_sheet.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::refusal;
using test::says;

std::filesystem::path sheet_file(const test::Folder& folder, const std::string& text,
                                 const std::string& ending = ".csv") {
  const std::filesystem::path file = folder.path() / ("sheet" + ending);
  std::ofstream(file) << text;
  return file;
}

KesSheet sheet_of(const std::string& text, const std::string& ending = ".csv") {
  const test::Folder folder;
  return read_kes_sheet(sheet_file(folder, text, ending));
}

const std::string kHead = "quantity,unit,warp,weft,mean\n";
const std::string kPair = "B,gf cm^2/cm,0.118,0.094,\n2HB,gf cm/cm,0.124,0.1,\n";

TEST(KesSheet, IsReadInPrintedUnitsAndInSi) {
  const KesSheet printed =
      sheet_of(kHead + kPair + "G,gf/(cm degree),0.8,0.7,\nEMT,%,4.2,6.1,\nW,mg/cm^2,,,12.4\n");
  const KesSheet si = sheet_of(kHead +
                               "B,uN m,11.571847,9.218251,\n2HB,mN,1.2160246,0.980665,\n"
                               "G,N/m,44.9505,39.3317,\nEMT,1,0.042,0.061,\nW,kg/m^2,,,0.124\n");
  for (const char* quantity : {"B", "2HB", "G", "EMT", "W"})
    for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft})
      EXPECT_NEAR(printed.along(quantity, column) / si.along(quantity, column), 1, 1e-5) << quantity;
  EXPECT_NEAR(printed.along("B", SheetColumn::warp), 0.118 * 9.80665e-5, 1e-12);
  EXPECT_NEAR(printed.mean("EMT"), 0.0515, 1e-12);
  EXPECT_TRUE(printed.warnings.empty());
}

TEST(KesSheet, IsTheSameInTomlAndWithDecimalCommas) {
  const KesSheet toml = sheet_of(
      "name = \"mine\"\n[B]\nunit = \"gf cm^2/cm\"\nwarp = 0.118\nweft = 0.094\n[2HB]\nunit = \"gf cm/cm\"\n"
      "warp = 0.124\nweft = 0.1\n",
      ".toml");
  EXPECT_EQ(toml.name, "mine");
  const KesSheet commas =
      sheet_of("quantity;unit;warp;weft\nB;gf·cm²/cm;0,118;0,094\n2HB;gf·cm/cm;0,124;0,1\n");
  for (const KesSheet& sheet : {toml, commas})
    for (const char* quantity : {"B", "2HB"})
      for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft})
        EXPECT_NEAR(sheet.along(quantity, column) / sheet_of(kHead + kPair).along(quantity, column), 1,
                    1e-12);
}

// A share in a column of percent, kilograms in one of grams: 98 times as much would be possible, too.
TEST(KesSheet, NamesTheFactorThatLeadsToTheMiddleOfWhatIsUsual) {
  for (const auto& [row, factor] : {std::pair{"EMT,%,0.047,0.05,\n", "; 100 times as much"},
                                    {"W,g/m^2,,,0.18\n", "; 1000 times as much"}})
    EXPECT_TRUE(says(refusal([&, row = row] { sheet_of(kHead + kPair + row); }), factor)) << row;
}

TEST(KesSheet, HasNoRowThatWasNotFilledInInToml) {
  const KesSheet sheet = sheet_of(
      "[B]\nwarp = 0.118\nweft = 0.094\n[2HB]\nwarp = 0.124\nweft = 0.1\n[G]\nunit = \"N/m\"\n", ".toml");
  EXPECT_TRUE(sheet.has("B"));
  EXPECT_FALSE(sheet.has("G"));
}

TEST(KesSheet, HasTheOtherDirectionBesideAMeanAndOne) {
  const std::string rest = "2HB,gf cm/cm,,,0.1\n";
  for (const auto& [row, known] : {std::pair{"B,gf cm^2/cm,0.1,,0.15\n", SheetColumn::weft},
                                   {"B,gf cm^2/cm,,0.1,0.15\n", SheetColumn::warp}})
    EXPECT_NEAR(sheet_of(kHead + row + rest).along("B", known) / (0.2 * 9.80665e-5), 1, 1e-12) << row;
  EXPECT_TRUE(says(refusal([&] { sheet_of(kHead + "B,gf cm^2/cm,0.227,,0.11375\n" + rest); }),
                   "is no fabric's", "column weft, as the mean tells it"));
  EXPECT_TRUE(says(refusal([&] { sheet_of(kHead + "B,gf cm^2/cm,0.4,,0.15\n" + rest); }),
                   "a mean that is less than half of its warp"));
}

TEST(KesSheet, OfTheTemplateIsReadWhereItIsFilledIn) {
  std::string text = kes_sheet_template();
  EXPECT_TRUE(says(refusal([&] { sheet_of(text); }), "the sheet has no row B"));
  for (const auto& [row, filled] : {std::pair{"B,gf cm^2/cm,,,", "B,gf cm^2/cm,0.118,0.094,"},
                                    {"2HB,gf cm/cm,,,", "2HB,gf cm/cm,0.124,0.1,"}})
    text.replace(text.find(row), std::string(row).size(), filled);
  EXPECT_NEAR(sheet_of(text).along("B", SheetColumn::weft), 0.094 * 9.80665e-5, 1e-12);
}

TEST(KesSheet, WithAColumnTwiceIsRefused) {
  EXPECT_TRUE(says(refusal([&] {
                     sheet_of(
                         "quantity,unit,warp,weft,warp\nB,gf cm^2/cm,0.1,0.1,0.3\n"
                         "2HB,gf cm/cm,0.1,0.1,0.3\n");
                   }),
                   "column 'warp' stands twice", "sheet.csv:1"));
  EXPECT_TRUE(says(
      refusal([&] { sheet_of("quantity,unit,mean,Average\nB,gf cm^2/cm,0.1,0.3\n2HB,gf cm/cm,0.1,0.3\n"); }),
      "columns 'mean' and 'average' are one column twice", "sheet.csv:1"));
}

struct Fault {
  const char* name;
  std::string text;  // behind the head
  const char *says, *where;
};
class FaultySheet : public testing::TestWithParam<Fault> {};

TEST_P(FaultySheet, IsRefusedByRowAndColumn) {
  const std::string message = refusal([&] { sheet_of(kHead + GetParam().text); });
  EXPECT_TRUE(says(message, GetParam().says, GetParam().where));
}

INSTANTIATE_TEST_SUITE_P(
    Sheets, FaultySheet,
    testing::Values(
        Fault{"MissingRow", "B,gf cm^2/cm,0.118,0.094,\n", "no row 2HB", "sheet.csv"},
        Fault{"UnknownQuantity", kPair + "2HBB,gf cm/cm,0.1,0.1,\n",
              "unknown quantity 2HBB, did you mean 2HB?", "sheet.csv:4"},
        Fault{"UnknownUnit", "B,gf cm^3/cm,0.118,0.094,\n", "has unit \"gf cm^3/cm\"", "sheet.csv:2"},
        Fault{"NinetyEightfold", "B,gf cm^2/cm,0.118,9.2,\n2HB,gf cm/cm,0.1,0.1,\n", "in another unit?",
              "sheet.csv:2, column weft"},
        Fault{"SiUnderPrintedUnit", "B,gf cm^2/cm,1.157e-5,9e-6,\n", "is no fabric's",
              "sheet.csv:2, column warp"},
        Fault{"Text", "B,gf cm^2/cm,a lot,0.1,\n", "a lot", "2"},
        Fault{"Twice", kPair + "B,gf cm^2/cm,0.118,0.094,\n", "B stands twice", "sheet.csv:4"},
        Fault{"MergedName", kPair + ",gf cm/cm,0.1,0.1,\n", "names no quantity", "sheet.csv:4"},
        Fault{"ThinnerUnpressed", kPair + "T0,mm,,,0.4\nTM,mm,,,0.6\n", "T0 must be >= TM", "sheet.csv:4"}),
    [](const auto& test) { return std::string(test.param.name); });

struct Warning {
  const char* name;
  std::string text;
  const char *says, *where;
};
class ImplausibleSheet : public testing::TestWithParam<Warning> {};

TEST_P(ImplausibleSheet, IsWarnedOf) {
  const std::vector<std::string> warnings = sheet_of(kHead + GetParam().text).warnings;
  ASSERT_FALSE(warnings.empty());
  EXPECT_TRUE(says(warnings[0], GetParam().says, GetParam().where)) << warnings[0];
}

// LT T EMT/2 is 0.78 * 500 * 0.04 / 2 = 7.8 gf cm/cm^2 along warp and 0.6 * 500 * 0.08 / 2 = 12 along weft.
const std::string kTension = kPair + "LT,1,0.78,0.6,\nEMT,%,4,8,\n";
INSTANTIATE_TEST_SUITE_P(
    Sheets, ImplausibleSheet,
    testing::Values(
        Warning{"TenfoldBending", "B,gf cm^2/cm,1.18,0.94,\n2HB,gf cm/cm,0.124,0.1,\n",
                "is one of them in another unit", "sheet.csv:3"},
        Warning{"BackUnlikeTheFace", kPair + "B-back,gf cm^2/cm,0.4,0.1,\n", "times of B, and",
                "sheet.csv:4"},
        Warning{"WeightOfTwoDirections", kPair + "W,mg/cm^2,15,30,\n", "has no direction", "sheet.csv:4"},
        Warning{"TenfoldShear", kPair + "G,gf/(cm degree),7,7,\n2HG,gf/cm,1.5,1.5,\n", "degree of G",
                "sheet.csv:5"},
        Warning{"ExchangedColumns", kTension + "WT,gf cm/cm^2,12,7.8,\n", "exchanged", "sheet.csv:6"},
        Warning{"AnotherUnitOfWork", kTension + "WT,gf cm/cm^2,76,76,\n", "in another unit", "sheet.csv:6"},
        Warning{"MeanOfNeither", kPair + "G,gf/(cm degree),1,2,9\n", "a mean that is 6 times", "sheet.csv:4"},
        Warning{"BlankOfAMergedCell", "B,gf cm^2/cm,0.118,,\n2HB,gf cm/cm,0.124,0.1,\n",
                "no number in the column weft", "sheet.csv:2"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(KesSheet, ThatAgreesWithItselfIsNotDoubted) {
  EXPECT_TRUE(sheet_of(kHead + kTension + "WT,gf cm/cm^2,7.8,12,\n").warnings.empty());
}

}  // namespace
}  // namespace hysteron
