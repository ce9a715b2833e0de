// These tests run a small comparison with measurements.
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <set>

#include "experiments/validate/drapes.h"
#include "experiments/validate/effects.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// Samples as drapes are told of them.
std::vector<Sample> fabric_samples(const FabricFile& file, int count, unsigned seed) {
  std::vector<Sample> samples = drawn_samples(file, count, seed);
  for (Sample& sample : samples) keep_what_was_measured(file.fabric, sample);
  return samples;
}

// As if every number were set in the scene itself: 1/120 s is no 0.00833333 s.
TEST(Validate, HandsItsDrapesTheirNumbersBitForBit) {
  ValidateFlags flags;
  flags.tolerance = 1e-5 / 3;
  flags.seconds = 10.0 / 3;
  Drape drape = nominal_drape("cotton-broad", flags);
  const Sample sample = fabric_samples(read_fabric("cotton-broad", "test"), 3, 1).front();
  drape.further = drape_flags(sample);
  std::vector<Flag> told = drape_flags(drape, flags);
  std::erase_if(told, [](const Flag& flag) { return flag.path.starts_with("drape."); });
  const Scene scene =
      set_up({"drape", "hysteron drape", told, {}}, experiment_named("drape").defaults()).scene;
  EXPECT_EQ(scene.step, 1.0 / 120);
  EXPECT_EQ(scene.tolerance, flags.tolerance);
  EXPECT_EQ(scene.seconds, flags.seconds);
  for (const auto& [key, value] : sample)
    EXPECT_EQ(to_json(scene)["fabric"][key].get<double>(), value) << key;
}

// Each number is drawn once in each part of its range, in the logarithm; friction stays as published.
TEST(Validate, DrawsUncertainNumbersFromALatinHypercubeThatKeepsTheFrictionMoment) {
  constexpr int kCount = 7;
  constexpr double kRounding = 1e-12;
  const FabricFile file = read_fabric("cotton-broad-k50", "test");
  const std::vector<Sample> samples = fabric_samples(file, kCount, 1);
  for (const auto& [key, range] : file.range) {
    std::set<int> parts;
    for (const Sample& sample : samples) {
      const double mean =
          key == "bias-bending" ? (1 + sample.at("weft-bending")) / 2 : 1;  // which the range is of
      parts.insert(static_cast<int>(kCount * std::log(sample.at(key) / mean / range.low) /
                                    std::log(range.high / range.low)));
    }
    EXPECT_EQ(parts.size(), kCount) << key;
    EXPECT_EQ(*parts.begin(), 0) << key;
    EXPECT_EQ(*parts.rbegin(), kCount - 1) << key;
  }
  const double moment = file.fabric.virgin_curve().friction_moment();
  for (const Sample& sample : samples)
    EXPECT_NEAR((sample.at("b1") - sample.at("b2")) * sample.at("k0") / 2 *
                    (1 + std::sqrt(sample.at("weft-bending"))) / 2,
                moment, kRounding * moment)
        << "the mean of warp and weft";
  EXPECT_EQ(fabric_samples(file, kCount, 1), samples);
  EXPECT_NE(fabric_samples(file, kCount, 2), samples);
}

// A drape that is linear in the logarithms of two numbers, and feels nothing of the others.
TEST(NumberEffects, ComeBackOfDrawnFabrics) {
  constexpr int kCount = 48;
  constexpr double kOfBias = 7, kOfK0 = -2, kScatter = 0.5;  // for e times the number [%]
  const FabricFile file = read_fabric("cotton-broad", "test");
  Table spread({"fabric", "bias-bending", "weft-bending", "k0", "shear", "b1", "drape coefficient [%]"});
  std::mt19937 random(3);
  std::normal_distribution<double> scatter(0, kScatter);
  for (const Sample& s : fabric_samples(file, kCount, 1)) {
    const double bias = s.at("bias-bending") * 2 / (1 + s.at("weft-bending"));
    const double drape = 70 + kOfBias * std::log(bias) + kOfK0 * std::log(s.at("k0")) + scatter(random);
    spread.row({file.fabric.name, s.at("bias-bending"), s.at("weft-bending"), s.at("k0"), s.at("shear"),
                s.at("b1"), drape});
    spread.row({"another", 1.0, 1.0, 8.0, 60.0, 1e-5, 20.0});
  }
  const NumberEffects found = effects_of_spread(spread, file);
  ASSERT_EQ(found.effects.size(), 4u);
  EXPECT_EQ(found.effects[0].number, "bias-bending");
  EXPECT_EQ(found.effects[1].number, "k0");
  EXPECT_NEAR(found.scatter, kScatter, 0.2 * kScatter);
  for (const NumberEffect& e : found.effects) {
    const double length = std::log(e.high / e.low);
    const double slope = e.number == "bias-bending" ? kOfBias : e.number == "k0" ? kOfK0 : 0;
    EXPECT_LT(std::abs(e.change - slope * length), 3 * e.error) << e.number;
    // Drawn evenly in the logarithm: a slope's error is the scatter over the root of count/12 lengths
    // squared.
    EXPECT_NEAR(e.error, kScatter * std::sqrt(12. / kCount), 0.3 * kScatter * std::sqrt(12. / kCount))
        << e.number;
  }
}

// 2HB is drawn, and drapes are told b1 and b2: the table has it in a column of its own.
TEST(NumberEffects, AreOfNumbersAsTheyWereDrawn) {
  constexpr int kCount = 24;
  constexpr double kOf2HB = 5, kLittle = 0.01;  // for e times the number [%]
  const FabricFile file = read_fabric("cotton-broad", "test");
  Table spread({"fabric", "b1", "drawn 2HB", "bias-bending", "drawn bias-bending", "weft-bending",
                "drape coefficient [%]"});
  for (const Sample& s : drawn_samples(file, kCount, 1)) {
    const double bias = s.at("bias-bending"), weft = s.at("weft-bending");
    spread.row({file.fabric.name, 1e-4, s.at("2HB"), bias * (1 + weft) / 2, bias, weft,
                70 + kOf2HB * std::log(s.at("2HB")) + kLittle * weft});
  }
  const NumberEffects found = effects_of_spread(spread, file);
  ASSERT_EQ(found.effects.size(), 3u);
  for (const NumberEffect& e : found.effects)
    EXPECT_NEAR(e.change, e.number == "2HB" ? kOf2HB * std::log(e.high / e.low) : 0, 2 * kLittle) << e.number;
}

TEST(NumberEffects, AreNotSoughtInTooFewDrapes) {
  const FabricFile file = read_fabric("cotton-broad", "test");
  Table spread({"fabric", "k0", "shear", "drape coefficient [%]"});
  for (const Sample& s : fabric_samples(file, 5, 1))
    spread.row({file.fabric.name, s.at("k0"), s.at("shear"), 70.0});
  const NumberEffects found = effects_of_spread(spread, file);
  EXPECT_TRUE(found.effects.empty());
  EXPECT_EQ(found.drapes, 5u);
  EXPECT_EQ(found.needed, 6u) << "twice the two numbers and the mean";
}

TEST(Validate, SaysWhetherTheMeasuredDrapeLiesAmongTheDrawn) {
  const FinishedRun run(
      "validate --quick --quiet --no-images --fabrics polyester-faille --parts spread "
      "--triangles 150 --seconds 0.2");
  const auto metrics = run.metrics();
  const double low = metrics["polyester-faille.spread_low_percent"],
               high = metrics["polyester-faille.spread_high_percent"];
  EXPECT_LT(low, high);  // two samples differ
  EXPECT_EQ(metrics["polyester-faille.spread_has_measured"].get<bool>(), low <= 28.3 && 28.3 <= high);
  const Table table = read_table(run.out / "predictions.csv");
  ASSERT_EQ(table.rows.size(), 2u) << "drape and folds";
  EXPECT_EQ(table.number(0, "measured"), 28.3);
  EXPECT_EQ(table.number(1, "measured"), 7);
  double sum = 0;
  for (const char* sample : {"1", "2"}) {
    const auto drape = run.out / (std::string("polyester-faille-prandtl-shaken-sample-") + sample);
    sum += metrics_of(drape)["drape_coefficient_percent"].get<double>();
  }
  constexpr double kDigits = 1e-4;  // of six in the table [%]
  EXPECT_NEAR(table.number(0, "predicted"), sum / 2, kDigits);
}

// Student's t at 97.5 % is tan(0.475 pi) of one degree of freedom, and 0.95 (2/(1 - 0.95^2))^1/2 of two; of
// others as printed tables have it.
TEST(Validate, PutsIntervalsAsWideAsStudentsTOfFewValuesAsks) {
  const auto t = [](std::size_t count) {
    return reach_of_next(count) / std::sqrt(1 + 1 / static_cast<double>(count));
  };
  constexpr double kExact = 1e-9, kDigits = 5e-4;  // of t; tables have three decimals
  constexpr double kInside = 0.95;
  EXPECT_NEAR(t(2), std::tan(kInside * std::numbers::pi / 2), kExact);
  EXPECT_NEAR(t(3), kInside * std::sqrt(2 / (1 - kInside * kInside)), kExact);
  for (const auto& [count, table] : {std::pair<std::size_t, double>{2, 12.706},
                                     {3, 4.303},
                                     {4, 3.182},
                                     {5, 2.776},
                                     {12, 2.201},
                                     {31, 2.042},
                                     {1000, 1.962}})
    EXPECT_NEAR(t(count), table, kDigits) << count;
}

TEST(Validate, SaysNothingOfWhatWasNotMeasured) {
  const FinishedRun run(
      "validate --quick --quiet --no-images --fabrics polyester-faille --parts spread --standard iso9073 "
      "--triangles 150 --seconds 0.2");
  EXPECT_TRUE(run.metrics()["polyester-faille.spread_has_measured"].is_null());
  const Table table = read_table(run.out / "predictions.csv");
  ASSERT_EQ(table.head.back(), "measured is between");
  ASSERT_EQ(table.rows.size(), 2u);
  for (const auto& row : table.rows) EXPECT_EQ(row.back(), "");
}

// A fabric whose weft is not as its warp states bias-bending itself, not its ratio to the mean.
TEST(Validate, KeepsTheBiasThatIsDrawnAndTheStopsOfAFabric) {
  Fabric fabric;
  fabric.weft_bending = 2, fabric.bias_bending = 1.5;
  Sample bias = {{"bias-bending", 0.9}};
  keep_what_was_measured(fabric, bias);
  EXPECT_DOUBLE_EQ(bias.at("bias-bending"), 0.9);
  Sample both = {{"bias-bending", 0.9}, {"weft-bending", 5}};
  keep_what_was_measured(fabric, both);
  EXPECT_DOUBLE_EQ(both.at("bias-bending"), 1.8);
  fabric.bending.stops = {{10, 30}, {1e-5, 4e-6}};
  Sample stops = {{"weft-bending", 0.5}};
  keep_what_was_measured(fabric, stops);
  EXPECT_EQ(stops, (Sample{{"weft-bending", 0.5}}));
}

TEST(Validate, KeepsTheMeanOf2HBWhereFrictionAlongWeftAloneIsDrawn) {
  Fabric fabric;
  fabric.weft_friction = 0.9;
  Sample sample = {{"weft-friction", 0.3}};
  keep_what_was_measured(fabric, sample);
  const double two_hb = (fabric.b1 - fabric.b2) * fabric.k0;
  EXPECT_NEAR((sample.at("b1") - sample.at("b2")) * fabric.k0 * 1.3 / 1.9, two_hb, 1e-12 * two_hb);
}

TEST(Validate, DrawsAPairOfKesBesideTheRatioOfWeft) {
  Fabric fabric;
  fabric.kes.read.rigidity = 1e-5, fabric.kes.read.loop_width = 1e-3;
  fabric.kes.shape = {10, 0.5};
  Sample sample = {{"kes-b", 1.2e-5}, {"kes-2hb", 0.8e-3}, {"weft-bending", 0.25}};
  keep_what_was_measured(fabric, sample);
  EXPECT_DOUBLE_EQ(sample.at("kes-b"), 2 / 1.25 * 1.2e-5);
  EXPECT_DOUBLE_EQ(sample.at("kes-2hb"), 2 / 1.5 * 0.8e-3);
}

TEST(Validate, RefusesTwoFabricsOfOneName) {
  const Folder folder;
  const std::string first = folder.file("a.toml"), second = folder.file("b.toml");
  for (const std::string& file : {first, second})
    std::ofstream(file)
        << "name = \"mine\"\n[parameters]\ndensity = 0.12\nthickness = 4e-4\nb2 = 1e-5\nb1 = 6e-5\n"
           "k0 = 8\n";
  EXPECT_TRUE(says(refused("validate --quick --fabrics " + first + "," + second), "are both named mine"));
}

TEST(Validate, RefusesRangesThatWouldChangeNothing) {
  FabricFile file = read_fabric("cotton-broad", "test");
  file.range["b2"] = between(1e-5, 2e-5);
  EXPECT_TRUE(says(test::refusal([&] { uncertain_numbers(file); }), "a range of b1 or b2 beside one of k0"));
  file.range = {{"k0", between(4, 25)}};
  file.fabric.bending.stops = {{10}, {1e-5}};
  EXPECT_TRUE(says(test::refusal([&] { uncertain_numbers(file); }), "has stops of its own"));
}

TEST(Validate, SaysWhereAFabricStatesNoRange) {
  const Folder folder;
  const fs::path file = folder.path() / "plain.toml";
  std::ofstream(file)
      << "[parameters]\ndensity = 0.12\nthickness = 4e-4\nb2 = 1e-5\nb1 = 6e-5\nk0 = 8\n"
         "weft-bending = 1\nwarp = 200\nweft = 200\nshear = 40\ndamping = 1e-3\nfriction = 0.3\n";
  const FinishedRun run(
      "validate --quick --quiet --no-images --parts spread --standard iso9073 --triangles 150 --seconds 0.1 "
      "--fabrics " +
      file.string());
  EXPECT_TRUE(says(run.outcome.err, "plain states no range of any number"));
}

TEST(Validate, TakesPartsThatItHasAndOneLaw) {
  for (const auto& [arguments, reason] :
       {std::pair{"--parts spread,pairs", "parts = pairs must be spread | "},
        std::pair{"--laws prandtl,linear", "must be one law"},
        std::pair{"--parts ''", "parts = \"\" names none"},
        std::pair{"--parts spread,spread", "parts = spread,spread names spread twice"},
        std::pair{"--fabrics polyester-faille,polyester-faille", "names polyester-faille twice"}}) {
    EXPECT_TRUE(says(refused(std::string("validate ") + arguments), reason));
  }
}

}  // namespace
}  // namespace hysteron::experiments
