// The budget tells how much of a drape each unknown of a fabric explains: trials, rows, means and their
// errors.
#include "experiments/validate/budget.h"

#include <cmath>

#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

double told(const Trial& trial, const std::string& key) {
  const std::string text = last_text(trial.drape.further, "fabric." + key, "");
  return text.empty() ? NAN : std::stod(text);
}

// The fabric's file, each range at its low and then its high end, the other tester, a mesh four times as
// fine.
TEST(BudgetTrials, ChangeOneThingEach) {
  ValidateFlags flags;
  const FabricFile file = read_fabric("cotton-broad", "test");
  const std::vector<Trial> trials = budget_trials("cotton-broad", flags);
  const std::map<std::string, Range> ranges = uncertain_numbers(file);
  EXPECT_EQ(ranges.size(), file.range.size() + 2) << "B and 2HB, which were printed with few digits";
  ASSERT_EQ(trials.size(), 1 + 2 * ranges.size() + 2);
  EXPECT_TRUE(trials[0].drape.further.empty());
  std::size_t next = 1;
  for (const auto& [key, range] : ranges)
    for (const double end : {range.low, range.high}) {
      const Trial& trial = trials[next++];
      EXPECT_EQ(trial.number, key);
      EXPECT_EQ(std::stod(trial.value), end);
      EXPECT_EQ(trial.drape.standard, DrapeStandard::jis) << "the published one";
      EXPECT_EQ(trial.drape.triangles, trials[0].drape.triangles);
    }
  const Trial &tester = trials[next], &mesh = trials[next + 1];
  EXPECT_EQ(tester.value, "iso9073");
  EXPECT_EQ(tester.drape.release, DrapeRelease::lowered);
  EXPECT_TRUE(tester.drape.further.empty());
  EXPECT_EQ(mesh.drape.triangles, 4 * flags.triangles);
  EXPECT_EQ(mesh.drape.standard, DrapeStandard::jis);
  EXPECT_TRUE(mesh.drape.further.empty());
}

// B and 2HB, the means of warp and weft, are published and stay the same with every ratio and every k0.
TEST(BudgetTrials, KeepWhatWasMeasured) {
  constexpr double kRounding = 1e-12;
  const FabricFile file = read_fabric("cotton-broad", "test");
  const double b = file.fabric.b2, two_hb = (file.fabric.b1 - b) * file.fabric.k0;
  int bent = 0;
  for (const Trial& trial : budget_trials("cotton-broad", {})) {
    if (trial.number == "weft-bending" || trial.number == "k0" || trial.number == "2HB") {
      const double weft = trial.number == "weft-bending" ? told(trial, "weft-bending") : 1,
                   k0 = trial.number == "k0" ? told(trial, "k0") : file.fabric.k0,
                   width = trial.number == "2HB" ? std::stod(trial.value) : two_hb;
      EXPECT_NEAR((1 + weft) / 2 * told(trial, "b2"), b, kRounding * b);
      EXPECT_NEAR((1 + std::sqrt(weft)) / 2 * (told(trial, "b1") - told(trial, "b2")) * k0, width,
                  kRounding * width);
      ++bent;
    } else if (trial.number == "shear") {
      EXPECT_EQ(trial.drape.further.size(), 1u);
      EXPECT_EQ(told(trial, "shear"), std::stod(trial.value));
    }
  }
  EXPECT_EQ(bent, 6);
}

// A stiff fabric of which only the weight is unknown, from that of a veil to that of a canvas.
constexpr const char* kOneUnknown = R"(name = "one-unknown"
description = "a fabric with one uncertain number"
[sources]
made = "made up for a test"
[published]
drape-coefficient = {value = 60, unit = "%", source = "made", confidence = "published", tester = "iso9073"}
[parameters]
b1 = {value = 6e-5, unit = "N m", source = "made", confidence = "assumed"}
b2 = {value = 6e-5, unit = "N m", source = "made", confidence = "assumed"}
k0 = {value = 50, unit = "1/m", source = "made", confidence = "assumed"}
density = {value = 0.15, unit = "kg/m^2", source = "made", confidence = "assumed", range = [0.01, 0.6]}
thickness = {value = 4e-4, unit = "m", source = "made", confidence = "assumed"}
warp = {value = 1000, unit = "N/m", source = "made", confidence = "assumed"}
weft = {value = 1000, unit = "N/m", source = "made", confidence = "assumed"}
shear = {value = 60, unit = "N/m", source = "made", confidence = "assumed"}
)";

double recorded_drape(const fs::path& out, int trial, int draw) {
  for (const auto& entry : fs::directory_iterator(out))
    if (entry.path().filename().string().ends_with("-budget-" + std::to_string(trial) + "-" +
                                                   std::to_string(draw)))
      return metrics_of(entry.path())["drape_coefficient_percent"];
  return NAN;
}

TEST(Budget, RowsAreMeansOfTheirDrapesAndChangesFromTheFirst) {
  constexpr double kDigits = 1e-4;  // of six in the table [%]
  const Folder folder;
  const auto out = folder.path() / "v";
  folder.write("one-unknown", kOneUnknown);
  const InFolder here(folder.path());  // where the name is a file's
  finished(
      "validate --quick --quiet --no-images --fabrics one-unknown --parts budget --laws linear "
      "--triangles 100 --seconds 0.5 --step 0.0166666666666" +
      out_flag(out));
  const Table table = read_table(out / "budget.csv");
  const auto number = [&](int row, const char* column) {
    return table.number(static_cast<std::size_t>(row), column);
  };
  const auto coefficient = [&](int row) { return number(row, "mean drape coefficient [%]"); };
  const auto error = [&](int row) { return number(row, "standard error [%]"); };
  const auto change = [&](int row) { return number(row, "change [%]"); };
  ASSERT_EQ(table.rows.size(), 5u);  // file, two ends, tester, mesh
  for (int trial = 0; trial < 5; ++trial) {
    const std::string& varied = table.word(static_cast<std::size_t>(trial), "number");
    const double one = recorded_drape(out, trial, 1), two = recorded_drape(out, trial, 2);
    EXPECT_EQ(number(trial, "meshes"), 2) << varied;
    EXPECT_NEAR(coefficient(trial), (one + two) / 2, kDigits) << varied;
    EXPECT_NEAR(error(trial), std::abs(one - two) / 2, kDigits) << varied << ": of the mean of two";
    EXPECT_NEAR(change(trial), coefficient(trial) - coefficient(0), 2 * kDigits) << varied;
    if (varied == "tester")
      EXPECT_TRUE(std::isnan(number(trial, "published [%]"))) << "measured on iso9073, not on jis";
    else
      EXPECT_EQ(number(trial, "published [%]"), 60) << varied;
  }
  EXPECT_EQ(change(0), 0);
  EXPECT_EQ(table.word(3, "value"), "jis");
  EXPECT_EQ(table.word(4, "value"), "400");
  // A drape falls as its weight grows, by more than meshes differ.
  EXPECT_GT(change(1), 2 * (error(1) + error(0))) << "a fifteenth of the weight";
  EXPECT_LT(change(2), -2 * (error(2) + error(0))) << "four times the weight";
  const auto metrics = metrics_of(out);
  EXPECT_NEAR(metrics["one-unknown.density=0.6.change_percent"].get<double>(), change(2), kDigits);
}

}  // namespace
}  // namespace hysteron::experiments
