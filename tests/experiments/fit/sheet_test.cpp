// `fit --kes-sheet`: what goes in is what the virtual testers read.
#include <fstream>
#include <random>

#include "experiments/fit/from_sheet.h"
#include "sim/base/csv.h"
#include "sim/identification/fabric_file.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr int kSteps = 300;                     // enough for a tenth of a percent
constexpr double kBending = 0.5, kInPlane = 2;  // percent that entered and read may differ by

double tolerance(const SheetReading& reading) {
  const std::string quantity = reading.quantity;
  if (quantity == "B" || quantity == "2HB") return kBending;
  if (quantity == "G" || quantity == "2HG" || quantity == "EMT") return kInPlane;
  return NAN;  // this model has none of its own
}

Fabric fabric_from(const KesSheet& sheet, const fs::path& folder) {
  const fs::path file = folder / "fabric.toml";
  write_fabric_text(file, fabric_of_sheet(sheet, {}).text);
  return read_fabric(file.string(), "test").fabric;
}

void expect_read_back(const KesSheet& sheet, const fs::path& folder, const std::string& which) {
  int compared = 0;
  for (const SheetReading& reading : read_by_testers(sheet, fabric_from(sheet, folder), kSteps)) {
    if (std::isnan(tolerance(reading))) continue;
    // Shear is one for both directions.
    const double mean = sheet.mean(reading.quantity);
    const bool one = reading.quantity == std::string("G") || reading.quantity == std::string("2HG");
    EXPECT_NEAR(100 * (reading.read / (one ? mean : reading.entered) - 1), 0, tolerance(reading))
        << which << ": " << reading.quantity;
    ++compared;
  }
  EXPECT_GE(compared, 4) << which;
}

// In SI, within what clothing has, log-uniform.
KesSheet drawn_sheet(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low * std::exp(std::uniform_real_distribution<double>(0, 1)(random) * std::log(high / low));
  };
  KesSheet sheet;
  sheet.name = "drawn-" + std::to_string(seed);
  const auto add = [&](const char* name, double warp, double weft) {
    sheet.row[name] = {{warp, weft, kNone}, "", "drawn"};
  };
  const double warp = between(4e-6, 4e-5), b[] = {warp, warp * between(0.2, 5)};
  const double width[] = {b[0] * between(30, 120), b[1] * between(30, 120)};
  add("B", b[0], b[1]);
  add("2HB", width[0], width[1]);
  const double g = between(15, 200);
  add("G", g, g);
  const double friction = g * between(0.01, 0.06);
  add("2HG", friction, friction);
  add("EMT", between(0.01, 0.3), between(0.01, 0.3));
  add("W", between(0.05, 0.6), between(0.05, 0.6));
  add("T0", between(2e-4, 2e-3), between(2e-4, 2e-3));
  return sheet;
}

TEST(KesSheetRoundTrip, ReturnsTwoHundredDrawnSheets) {
  const Folder folder;
  for (unsigned seed = 1; seed <= 200; ++seed)
    expect_read_back(drawn_sheet(seed), folder.path(), std::to_string(seed));
}

// Kumari & Khurana 2016, Table 5, fabrics A to F, means of warp and weft [gf, cm, degree].
struct Denim {
  const char* name;
  double b, two_hb, g, two_hg, two_hg5;
};
constexpr Denim kDenims[] = {
    {"A", 0.172, 0.139, 2.180, 5.012, 7.412}, {"B", 0.144, 0.142, 1.538, 3.575, 5.938},
    {"C", 0.227, 0.105, 3.398, 4.975, 7.400}, {"D", 0.147, 0.141, 1.613, 3.513, 6.412},
    {"E", 0.207, 0.214, 1.538, 3.375, 5.938}, {"F", 0.148, 0.159, 1.500, 3.425, 5.763}};

TEST(KesSheetRoundTrip, ReturnsSixPublishedDenims) {
  const Folder folder;
  for (const Denim& denim : kDenims) {
    const fs::path file = folder.path() / "denim.csv";
    std::ofstream(file) << "quantity,unit,mean\n"
                        << "B,gf cm^2/cm," << denim.b << "\n2HB,gf cm/cm," << denim.two_hb
                        << "\nG,gf/(cm degree)," << denim.g << "\n2HG,gf/cm," << denim.two_hg
                        << "\n2HG5,gf/cm," << denim.two_hg5 << '\n';
    const KesSheet sheet = read_kes_sheet(file);
    EXPECT_TRUE(sheet.warnings.empty()) << denim.name;
    expect_read_back(sheet, folder.path(), denim.name);
  }
}

TEST(FitKesSheet, WritesAFabricTheComparisonAndTheLinesToGoOnWith) {
  const Folder folder;
  const fs::path sheet = folder.path() / "mine.csv", out = folder.path() / "out";
  std::ofstream(sheet) << "quantity,unit,warp,weft,mean\nB,gf cm^2/cm,0.118,0.094,\n2HB,gf cm/cm,0.124,0.1,\n"
                          "EMT,%,4.2,6.1,\nW,mg/cm^2,,,12.4\n";
  testing::internal::CaptureStdout();
  experiment_named("fit").run(
      {"fit", "hysteron fit", {{"kes-sheet", sheet.string()}, {"out", out.string()}}, {}});
  const std::string said = testing::internal::GetCapturedStdout();
  for (const char* text : {"2HB   weft", "assumed, what moves a drape most first", "bias-bending",
                           "shear = 60", "hysteron drape --fabric", "validate --parts spread,budget"})
    EXPECT_TRUE(test::says(said, text));
  const Fabric fabric = read_fabric((out / "fabric.toml").string(), "test").fabric;
  EXPECT_EQ(fabric.name, "mine");
  EXPECT_NEAR(fabric.weft_friction, 0.1 / 0.124, 1e-6);
  EXPECT_EQ(fabric.provenance.at("b2").confidence, "published");
  EXPECT_EQ(fabric.provenance.at("bias-bending").confidence, "assumed");
  const Json metrics = metrics_of(out);
  for (const char* key : {"warp.B_difference_percent", "weft.2HB_difference_percent"})
    EXPECT_LT(std::abs(metrics[key].get<double>()), kBending) << key;
  EXPECT_EQ(read_table(out / "sheet.csv").rows.size(), 2u * 3);
}

}  // namespace
}  // namespace hysteron::experiments
