#include <cmath>
#include <cstdlib>

#include "sim/base/whole_file.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/keys.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using test::refusal;
using test::says;

// A decimal number in a file is rounded once, and the formulas below round two or three times more.
constexpr double kRounding = 4e-16;

class ShippedFabric : public testing::TestWithParam<std::string> {
 protected:
  const FabricFile file = read_fabric(GetParam(), "test");
  const Fabric& fabric = file.fabric;
  double published(const std::string& name) const { return fabric.published.at(name).value; }
};
class KesFabric : public ShippedFabric {};
class DrapedFabric : public ShippedFabric {};
class FabricMeasuredInThreeDirections : public ShippedFabric {};

// By the text of their files, since every process of these tests makes the lists below.
std::vector<std::string> fabrics_that_publish(const std::string& number) {
  std::vector<std::string> names;
  for (const std::string& name : list_assets("fabrics")) {
    const std::filesystem::path file = find_asset("fabrics", name, "test");
    if (whole_file(file, "cannot read " + file.string()).find("\n" + number + " = {") != std::string::npos)
      names.push_back(name);
  }
  return names;
}

TEST_P(KesFabric, HasTheRigidityThatTheSourcePrintsInGramForce) {
  EXPECT_EQ(fabric.published.at("B").unit, "gf cm^2/cm");
  const double expected = published("B") * kGramForceSquareCentimetrePerCentimetre;
  EXPECT_NEAR(fabric.b2, expected, kRounding * expected);
  EXPECT_EQ(fabric.provenance.at("b2").confidence, "published");
  EXPECT_EQ(fabric.k0, fabric.name.ends_with("-k50") ? 50 : 8);
}

TEST_P(KesFabric, HasTheFrictionMomentHalfOfThePublishedLoopWidth) {
  EXPECT_EQ(fabric.published.at("2HB").unit, "gf cm/cm");
  const double hb = published("2HB") * kGramForceCentimetrePerCentimetre / 2;
  const double cancellation = kRounding * fabric.b1 * fabric.k0;  // b1 - b2 loses b1's last digits
  EXPECT_NEAR(fabric.virgin_curve().friction_moment(), hb, cancellation);
  EXPECT_EQ(fabric.provenance.at("b1").confidence, "derived");
  EXPECT_EQ(fabric.provenance.at("k0").confidence, "assumed");
}

TEST_P(ShippedFabric, StretchesByLessThanATenthPercentUnderHalfAMetreOfItself) {
  const double load = fabric.density * 9.81 * 0.5;  // at the upper edge [N/m]
  EXPECT_LT(load / std::min(fabric.warp, fabric.weft), 1e-3);
}

TEST_P(ShippedFabric, StatesASourceAndAConfidenceForEveryNumber) {
  for (const KeyDescription& key : scene_keys()) {
    if (!key.path.starts_with("fabric.") || key.path == "fabric.name") continue;
    if (key.path.starts_with("fabric.bending.") || key.path.starts_with("fabric.membrane.") ||
        (!fabric.rubs_otherwise() && key.path == "fabric.weft-friction") ||
        (!fabric.bending.faces.on() && key.path.starts_with("fabric.back-")) ||
        (!fabric.kes.on() && (key.path.starts_with("fabric.kes-") || key.path.starts_with("fabric.stops-"))))
      continue;  // of fabrics that have them
    const auto found = fabric.provenance.find(key.path.substr(7));
    ASSERT_NE(found, fabric.provenance.end()) << key.path;
    EXPECT_GT(found->second.source.size(), 20u) << key.path;  // a sentence or a citation, not a short name
    EXPECT_NE(found->second.source, "the program's default") << key.path;
  }
}

// A validation varies the numbers that the source does not give, and none that it does.
TEST_P(DrapedFabric, StatesARangeForWhatIsAssumedOfItAlone) {
  for (const char* key : {"shear", "warp", "weft", "friction", "weft-bending", "bias-bending"})
    EXPECT_TRUE(file.range.count(key)) << key;
  EXPECT_TRUE(file.range.at("k0").contains(fabric.k0));
  for (const auto& [key, range] : file.range)
    EXPECT_EQ(fabric.provenance.at(key).confidence, "assumed") << key;
}

// B and 2HB are printed in thousandths.
TEST_P(DrapedFabric, StatesBetweenWhichNumbersThePrintRounds) {
  if (fabric.name.ends_with("-k50")) GTEST_SKIP() << "kept as it was";
  for (const char* key : {"B", "2HB"}) {
    const Range range = file.published_range.at(key);
    EXPECT_NEAR(range.low, published(key) - 5e-4, kRounding) << key;
    EXPECT_NEAR(range.high, published(key) + 5e-4, kRounding) << key;
  }
}

TEST_P(DrapedFabric, KeepsTheMeasuredDrapeForComparison) {
  EXPECT_EQ(fabric.published.at("drape-coefficient").unit, "%");
  EXPECT_EQ(fabric.published.at("drape-coefficient").tester, DrapeStandard::jis);
  EXPECT_GT(published("drape-coefficient"), 0);
  EXPECT_LT(published("drape-coefficient"), 100);
  EXPECT_GE(published("node-count"), 2);
}

// The rigidity is ke/4 (Wang, O'Brien, Ramamoorthi 2011).
TEST_P(FabricMeasuredInThreeDirections, HasTheirRigiditiesAndNoFriction) {
  const double warp = published("ke-0-small");
  EXPECT_NEAR(fabric.b2, 1e-6 * warp / 4, kRounding * warp);
  constexpr double kPrinted = 1e-5;  // of the ratios in the file
  EXPECT_NEAR(fabric.weft_bending, published("ke-90-small") / warp, kPrinted);
  EXPECT_NEAR(fabric.bias_bending, published("ke-45-small") / warp, kPrinted);
  EXPECT_EQ(fabric.b1, fabric.b2);
  EXPECT_EQ(fabric.provenance.at("b2").confidence, "derived");
  for (const char* unknown : {"b1", "k0", "thickness", "warp"})
    EXPECT_EQ(fabric.provenance.at(unknown).confidence, "assumed") << unknown;
}

INSTANTIATE_TEST_SUITE_P(Assets, ShippedFabric, testing::ValuesIn(list_assets("fabrics")), test::CaseName());
INSTANTIATE_TEST_SUITE_P(Assets, KesFabric, testing::ValuesIn(fabrics_that_publish("2HB")), test::CaseName());
INSTANTIATE_TEST_SUITE_P(Assets, DrapedFabric, testing::ValuesIn(fabrics_that_publish("drape-coefficient")),
                         test::CaseName());
INSTANTIATE_TEST_SUITE_P(Assets, FabricMeasuredInThreeDirections,
                         testing::ValuesIn(fabrics_that_publish("ke-0-small")), test::CaseName());

// All but its bending is that of cotton broad, and both bend alike until one of them sets.
TEST(Fabrics, ThatRelaxAndSetAreCottonBroadOtherwise) {
  const auto numbers = [](const Fabric& f) {
    return std::vector<double>{f.density, f.thickness, f.warp,     f.weft,         f.coupling,
                               f.shear,   f.damping,   f.friction, f.weft_bending, f.bias_bending};
  };
  const Fabric cotton = read_fabric("cotton-broad", "test").fabric,
               relaxing = read_fabric("cotton-broad-relaxing", "test").fabric,
               creasing = read_fabric("cotton-broad-creasing", "test").fabric;
  for (const Fabric& fabric : {relaxing, creasing}) EXPECT_EQ(numbers(fabric), numbers(cotton));
  for (const Fabric& fabric : {relaxing, creasing}) {
    EXPECT_EQ(fabric.k0, cotton.k0);
    EXPECT_LT(fabric.b2, cotton.b2) << "the branches' part is missing";
  }
  EXPECT_EQ(relaxing.b1, creasing.b1);
  EXPECT_EQ(relaxing.b2, creasing.b2);
  EXPECT_EQ(relaxing.bending.branches.times, creasing.bending.branches.times);
  EXPECT_EQ(relaxing.bending.branches.stiffnesses, creasing.bending.branches.stiffnesses);
  EXPECT_FALSE(relaxing.bending.set.on());
  EXPECT_TRUE(creasing.bending.set.on());
}

TEST(Fabrics, AreFoundWithUnderscoresForHyphens) {
  EXPECT_EQ(read_fabric("cotton_broad", "test").fabric.name, "cotton-broad");
}

// (Feng, Huang, Xu, Wang 2022): M = b1 K + c1 K^2, of which the virgin curve is the beginning.
TEST(Fabrics, OfTheMedianHaveTheMeanOfThePublishedCurves) {
  const Fabric fabric = read_fabric("feng2022-median", "test").fabric;
  const auto mean = [&](const std::string& key) {
    const auto at = [&](const char* direction) { return fabric.published.at(key + direction).value; };
    return (at("-warp") + 2 * at("-bias") + at("-weft")) / 4;
  };
  EXPECT_NEAR(fabric.b1, 1e-6 * mean("b1"), kRounding * fabric.b1);
  const double printed_digits = 1e-9;  // k0 is written with ten digits
  EXPECT_NEAR(fabric.virgin_curve().c1(), 1e-9 * mean("c1"), printed_digits * 1e-9 * std::abs(mean("c1")));
}

constexpr const char* kMinimal = R"(name = "mine"
description = "a test"
[parameters]
b1 = {value = 2e-5, unit = "N m", source = "s", confidence = "assumed"}
b2 = {value = 1e-5, unit = "N m", source = "s", confidence = "assumed"}
k0 = {value = 40, unit = "1/m", source = "s", confidence = "assumed"}
density = {value = 0.1, unit = "kg/m^2", source = "s", confidence = "assumed"}
)";
constexpr const char* kThickness =
    "thickness = {value = 4e-4, unit = \"m\", source = \"s\", confidence = \"assumed\"}\n";

TEST(FabricFiles, MayLeaveOutTheMembraneWhichThenSaysThatItIsADefault) {
  const TextFile file(std::string(kMinimal) + kThickness);
  const Fabric fabric = read_fabric(file.path(), "test").fabric;
  EXPECT_EQ(fabric.k0, 40);
  EXPECT_EQ(fabric.warp, Fabric{}.warp);
  EXPECT_EQ(fabric.provenance.at("warp").source, "the program's default");
}

TEST(FabricFiles, KnowThePublishedNumbersThatAreReadByTheirNames) {
  const auto published = [](const std::string& name) {
    const TextFile file(std::string(kMinimal) + kThickness + "[published]\n" + name + " = 5\n");
    return read_fabric(file.path(), "test").fabric.published.at(name).value;
  };
  for (const std::string wrong : {"drape-coeficient", "drape-coefficent", "nodes-count"})
    EXPECT_NE(test::refusal([&] {
                published(wrong);
              }).find("unknown number " + wrong + " in [published], did you mean "),
              std::string::npos)
        << wrong;
  for (const std::string other : {"node-count", "b1-warp", "LT", "cover"})
    EXPECT_EQ(published(other), 5) << other;
}

// A published drape in percent, as it is printed or as a share, of a tester that there is.
TEST(FabricFiles, ReadAPublishedDrapeInPercentOfATesterThatThereIs) {
  const auto drape = [](const std::string& number) {
    const TextFile file(std::string(kMinimal) + kThickness + "[published]\ndrape-coefficient = " + number +
                        "\n");
    return read_fabric(file.path(), "test").fabric.published.at("drape-coefficient").value;
  };
  EXPECT_DOUBLE_EQ(drape("{value = 82.9, unit = \"%\", tester = \"jis\"}"), 82.9);
  EXPECT_DOUBLE_EQ(drape("{value = 0.829, unit = \"1\", tester = \"iso9073\"}"), 82.9);
  EXPECT_DOUBLE_EQ(drape("82.9"), 82.9);
  for (const auto& [number, reason] : {std::pair{"{value = 0.829, unit = \"%\"}", "is no drape's"},
                                       {"{value = 829, unit = \"%\"}", "is no drape's"},
                                       {"{value = 82.9, unit = \"m\"}", "must have \"%\""},
                                       {"{value = 82.9, tester = \"jiss\"}", "must be jis | iso9073"}})
    EXPECT_NE(test::refusal([&, &number = number] { drape(number); }).find(reason), std::string::npos)
        << number;
}

// kMinimal without b1 and k0, which follow from stops.
std::string without_own_friction() {
  std::string text = std::string(kMinimal) + kThickness;
  for (const char* name : {"b1 = ", "k0 = "}) {
    const std::size_t line = text.find(name);
    text.erase(line, text.find('\n', line) + 1 - line);
  }
  return text;
}

constexpr const char* kParts = R"([bending.stops]
thresholds = [5, 20, 60]
stiffnesses = [8e-6, 4e-6, 1e-6]
source = "lab"
confidence = "fitted"
[bending.stops.weft]
thresholds = [4, 10, 30]
stiffnesses = [2e-6, 4e-6, 2e-6]
[bending.branches]
times = [10]
stiffnesses = [3e-6]
[bending.set]
yield = 400
hardening = 5e-6
)";

TEST(FabricFiles, MayStateStopsBranchesAndSet) {
  const TextFile file(without_own_friction() + kParts);
  const FabricFile read = read_fabric(file.path(), "test");
  const BendingParts& parts = read.fabric.bending;
  EXPECT_EQ(parts.stops.thresholds, (std::vector<double>{5, 20, 60}));
  EXPECT_EQ(parts.stops.stiffnesses, (std::vector<double>{8e-6, 4e-6, 1e-6}));
  EXPECT_EQ(parts.weft_stops.thresholds, (std::vector<double>{4, 10, 30}));
  EXPECT_EQ(parts.branches.times, std::vector<double>{10});
  EXPECT_EQ(parts.set.yield, 400);
  EXPECT_EQ(read.fabric.provenance.at("bending.stops.thresholds").source, "lab");
  EXPECT_EQ(read.fabric.provenance.at("bending.stops.thresholds").confidence, "fitted");
  EXPECT_EQ(read.fabric.provenance.at("bending.set.yield").confidence, "given");
  EXPECT_EQ(read.place.at("bending.stops.stiffnesses"), file.line(9));
}

TEST(FabricFiles, MayGiveASourceAShortName) {
  const TextFile file(std::string(kMinimal) + kThickness +
                      "[sources]\ns = {short = \"our lab\", text = \"a KES-FB2, 3 specimens\"}\n");
  const FabricFile read = read_fabric(file.path(), "test");
  EXPECT_EQ(read.fabric.provenance.at("b2").source, "a KES-FB2, 3 specimens");
  EXPECT_EQ(read.shown(read.fabric.provenance.at("b2")), "our lab");
  EXPECT_EQ(read.shown({"another text", "assumed"}), "another text");
}

TEST(FabricFiles, MayStateStopsInThePlane) {
  const TextFile file(std::string(kMinimal) + kThickness + R"([membrane.stops.shear]
thresholds = [0.005, 0.02]
stiffnesses = [200, 50]
source = "lab"
confidence = "fitted"
[membrane.stops.weft]
thresholds = [0.001]
stiffnesses = [3e3]
)");
  const FabricFile read = read_fabric(file.path(), "test");
  const InPlaneStops& stops = read.fabric.in_plane;
  EXPECT_EQ(stops.shear.thresholds, (std::vector<double>{0.005, 0.02}));
  EXPECT_EQ(stops.shear.stiffnesses, (std::vector<double>{200, 50}));
  EXPECT_EQ(stops.weft.stiffnesses, std::vector<double>{3e3});
  EXPECT_TRUE(stops.warp.empty());
  EXPECT_EQ(read.fabric.provenance.at("membrane.stops.shear.thresholds").source, "lab");
  EXPECT_EQ(read.fabric.provenance.at("membrane.stops.weft.thresholds").confidence, "given");
  EXPECT_EQ(read.place.at("membrane.stops.weft.stiffnesses"), file.line(16));
  EXPECT_TRUE(read_fabric("cotton-broad", "test").fabric.in_plane.empty());
}

TEST(FabricFiles, MayStateByHowMuchTheLimitsOfShearGrow) {
  const std::string table = "[membrane.stops.shear]\nthresholds = [0.005]\nstiffnesses = [200]\n";
  for (const std::string growth :
       {"growth = 6", "growth = {value = 6, unit = \"1\", source = \"lab\", confidence = \"derived\"}"}) {
    const TextFile file(std::string(kMinimal) + kThickness + table + growth);
    const FabricFile read = read_fabric(file.path(), "test");
    EXPECT_EQ(read.fabric.in_plane.shear_growth, 6);
    const bool alone = !growth.ends_with("}");
    EXPECT_EQ(read.fabric.provenance.at("membrane.stops.shear.growth").confidence,
              alone ? "given" : "derived");
    EXPECT_EQ(read.place.at("membrane.stops.shear.growth"), file.line(12));
  }
}

// g sum_j p_j r_j is at most `shear`, 60 N/m where the file does not state it.
TEST(FabricFiles, RefuseGrowthThatMakesClothUnstable) {
  const std::string table = "[membrane.stops.shear]\nthresholds = [0.005, 0.03]\nstiffnesses = [200, 50]\n";
  const auto refusal = [&](const std::string& growth) {
    const TextFile file(std::string(kMinimal) + kThickness + table + "growth = " + growth);
    return test::refusal([&] { read_fabric(file.path(), "test"); });
  };
  EXPECT_EQ(refusal("24"), test::kAccepted) << "60/(200 * 0.005 + 50 * 0.03)";
  EXPECT_TRUE(test::says(refusal("24.1"), "fabric.membrane.stops.shear.growth = 24.1", "must be <= 24",
                         "fabric.shear = 60 N/m"));
  EXPECT_TRUE(test::says(refusal("34"), "growth = 34", "must be < 33.33"));
}

TEST(FabricFiles, WithStopsLeaveTheThreeNumbersOfOtherLawsToThem) {
  const TextFile file(without_own_friction() + kParts);
  const Fabric fabric = read_fabric(file.path(), "test").fabric;
  const double hb = 5 * 8e-6 + 20 * 4e-6 + 60 * 1e-6;
  EXPECT_NEAR(fabric.b1, 1e-5 + 13e-6, kRounding * 1e-5);
  EXPECT_NEAR(fabric.virgin_curve().friction_moment(), hb, 10 * kRounding * hb);
  EXPECT_EQ(fabric.provenance.at("b1").confidence, "derived");
}

// The metric has multiplied the curvature of a bend along weft by its root before the law sees it.
TEST(FabricFiles, WithStopsAlongWeftRubAsTheySayBehindTheMetric) {
  const TextFile file(without_own_friction() + kParts);
  Fabric fabric = read_fabric(file.path(), "test").fabric;
  fabric.weft_bending = 4;
  const Spectrum& stops = fabric.bending.weft_stops;
  const Spectrum seen = fabric.virgin_curve().parts.weft_stops;
  for (double k : {3.0, 20.0, 100.0})
    EXPECT_NEAR(2 * seen.friction_at(2 * k), stops.friction_at(k), kRounding * stops.friction_moment());
}

TEST(FabricFiles, MayStateTheFrictionOfTheirStopsButNoOther) {
  const auto with = [](const char* b1, const char* k0) {
    return TextFile(without_own_friction() + "b1 = {value = " + b1 +
                    ", unit = \"N m\", source = \"s\", confidence = \"given\"}\nk0 = {value = " + k0 +
                    ", unit = \"1/m\", source = \"s\", confidence = \"given\"}\n" + kParts);
  };
  const double hb = 5 * 8e-6 + 20 * 4e-6 + 60 * 1e-6, k0 = 2 * hb / 13e-6;  // 27.69/m
  const TextFile same = with("2.3e-5", "27.7");
  EXPECT_EQ(read_fabric(same.path(), "test").fabric.k0, 27.7);
  EXPECT_NEAR(27.7, k0, 0.01 * k0);
  const TextFile other = with("2.3e-5", "40");
  EXPECT_TRUE(says(refusal([&] { read_fabric(other.path(), "test"); }),
                   "fabric.k0 = 40 1/m (" + other.line(8), "must be 27.6923 1/m, as fabric.bending.stops say",
                   "leave b1 and k0 out"));
}

TEST(FabricFiles, WithoutABiasHaveTheMeanOfWarpAndWeft) {
  const char* weft = "weft-bending = {value = 0.5, unit = \"1\", source = \"s\", confidence = \"given\"}\n";
  const TextFile file(std::string(kMinimal) + kThickness + weft);
  EXPECT_EQ(read_fabric(file.path(), "test").fabric.bias_bending, 0.75);
  EXPECT_EQ(read_fabric("navy-sparkle-sweat", "test").fabric.bias_bending, 0.673819)
      << "which the file states";
}

// As a student writes a file: numbers alone, or with the unit that is printed; no name, no description.
TEST(FabricFiles, TakeNumbersAloneAndInPrintedUnits) {
  const TextFile file(
      "[parameters]\n"
      "b1 = {value = 0.5, unit = \"gf·cm²/cm\", range = [0.4, 0.6], stderr = 0.05}\n"
      "b2 = 1.2e-5\n"
      "k0 = {value = 0.08, unit = \"1/cm\", confidence = \"assumed\"}\n"
      "density = {value = 12.4, unit = \"mg/cm^2\"}\n"
      "thickness = {value = 0.5, unit = \"mm\"}\n"
      "shear = {value = 1, unit = \"gf/(cm degree)\"}\n");
  const FabricFile read = read_fabric(file.path(), "test");
  const Fabric& fabric = read.fabric;
  EXPECT_EQ(fabric.name, std::filesystem::path(file.path()).stem().string());
  EXPECT_EQ(read.description, "");
  constexpr double kRounding = 1e-12;
  const auto expect = [&](double value, double expected) { EXPECT_NEAR(value / expected, 1, kRounding); };
  expect(fabric.b1, 0.5 * 9.80665e-5);
  expect(read.range.at("b1").low, 0.4 * 9.80665e-5);
  expect(*fabric.provenance.at("b1").standard_error, 0.05 * 9.80665e-5);
  EXPECT_EQ(fabric.b2, 1.2e-5);
  EXPECT_EQ(fabric.provenance.at("b2").confidence, "given");
  EXPECT_EQ(fabric.provenance.at("b2").source, file.line(3));
  expect(fabric.k0, 8);
  EXPECT_EQ(fabric.provenance.at("k0").confidence, "assumed");
  expect(fabric.density, 0.124);
  expect(fabric.thickness, 5e-4);
  expect(fabric.shear, 0.980665 * 180 / 3.14159265358979323846);
}

struct BadFabric {
  const char* name;
  const char* tail;  // after kMinimal, from line 8
  int line;
  const char* naming;
};
class BadFabricFile : public testing::TestWithParam<BadFabric> {};

TEST_P(BadFabricFile, IsRefusedInOneLineThatNamesFileAndLine) {
  const TextFile file(std::string(kMinimal) + GetParam().tail);
  EXPECT_TRUE(says(refusal([&] { read_fabric(file.path(), "test"); }), GetParam().naming,
                   file.line(GetParam().line)));
}

const BadFabric kBadFabrics[] = {
    {"MissingNumber", "", 3, "parameters needs thickness"},
    {"WrongUnit", "thickness = {value = 0.4, unit = \"g\", source = \"s\", confidence = \"assumed\"}", 8,
     "fabric.thickness has unit \"g\" and must have \"m\" or one of cm, mm, um, micron"},
    {"BareText", "thickness = \"4e-4\"", 8, "a number or a table {value, unit, source, confidence}"},
    {"OwnConfidence", "thickness = {value = 4e-4, unit = \"m\", source = \"s\", confidence = \"sure\"}", 8,
     "published | fitted | derived | given | assumed"},
    {"OutOfRange", "thickness = {value = 0, unit = \"m\", source = \"s\", confidence = \"assumed\"}", 8,
     "fabric.thickness = 0 m must be > 0"},
    {"ValueOutsideItsRange",
     "thickness = {value = 4e-4, unit = \"m\", source = \"s\", confidence = \"assumed\", "
     "range = [5e-4, 6e-4]}",
     8, "thickness = 4e-04 must lie in its range [5e-04, 6e-04]"},
    {"RangeOfOneEnd",
     "thickness = {value = 4e-4, unit = \"m\", source = \"s\", confidence = \"assumed\", range "
     "= [4e-4]}",
     8, "thickness: range must be [low, high]"},
    {"RangeThatTheModelRefuses",
     "thickness = {value = 4e-4, unit = \"m\", source = \"s\", confidence = \"assumed\", range "
     "= [-1.0, 1.0]}",
     8, "fabric.thickness = -1 m must be > 0"},
    {"FewerStiffnesses", "[bending.stops]\nthresholds = [5, 20]\nstiffnesses = [1e-6]\n", 9,
     "fabric.bending.stops.thresholds has 2 numbers and must have as many as "
     "fabric.bending.stops.stiffnesses, 1"},
    {"StopsInDisorder", "[bending.stops]\nthresholds = [20, 5]\nstiffnesses = [1e-6, 1e-6]\n", 9,
     "fabric.bending.stops.thresholds must be ascending: 5 follows 20"},
    {"NegativeStop", "[bending.stops]\nthresholds = [-1]\nstiffnesses = [1e-6]\n", 9,
     "fabric.bending.stops.thresholds = [-1] 1/m must be > 0"},
    {"StopsThatAreNoList", "[bending.stops]\nthresholds = 5\nstiffnesses = [1e-6]\n", 9,
     "must be numbers > 0 [1/m]"},
    {"OtherNumberOfStopsAlongWeft",
     "[bending.stops]\nthresholds = [5, 6]\nstiffnesses = [1e-6, 1e-6]\n"
     "[bending.stops.weft]\nthresholds = [5]\nstiffnesses = [1e-6]\n",
     12, "fabric.bending.stops.weft.thresholds has 1 numbers and must have as many as"},
    {"TooManyBranches", "[bending.branches]\ntimes = [1, 2, 3, 4, 5]\nstiffnesses = [1, 1, 1, 1, 1]\n", 9,
     "fabric.bending.branches.times has 5 numbers and must have at most 4"},
    {"SetWithoutHardening", "[bending.set]\nyield = 100\n", 9, "must both be > 0"},
    {"UnknownPart", "[bending.stop]\nthresholds = [1]\n", 9, "unknown key fabric.bending.stop.thresholds"},
    {"FewerStiffnessesInThePlane", "[membrane.stops.shear]\nthresholds = [0.01, 0.02]\nstiffnesses = [100]\n",
     9,
     "fabric.membrane.stops.shear.thresholds has 2 numbers and must have as many as "
     "fabric.membrane.stops.shear.stiffnesses, 1"},
    {"GrowthWithoutStops", "[membrane.stops.shear]\ngrowth = 2\n", 9,
     "fabric.membrane.stops.shear.growth = 2"},
    {"GrowthOfStretch", "[membrane.stops.warp]\ngrowth = 2\n", 9,
     "unknown key fabric.membrane.stops.warp.growth"},
    {"StrainsInDisorder", "[membrane.stops.warp]\nthresholds = [0.02, 0.01]\nstiffnesses = [1, 1]\n", 9,
     "fabric.membrane.stops.warp.thresholds must be ascending: 0.01 follows 0.02"},
    {"UnknownComponent", "[membrane.stops.bias]\nthresholds = [1]\n", 9,
     "unknown key fabric.membrane.stops.bias.thresholds"},
    {"ParameterAtTheTop", "[sources]\ns = \"s\"\n[membrane]\n[density]\n", 11,
     "density is one of the fabric's parameters and must stand below [parameters]"},
    {"UnknownParameter", "b3 = {value = 0, unit = \"m\", source = \"s\", confidence = \"assumed\"}", 8,
     "unknown key fabric.b3"}};

INSTANTIATE_TEST_SUITE_P(Fabrics, BadFabricFile, testing::ValuesIn(kBadFabrics), test::CaseName());

TEST(Assets, AreTakenFromTheNamedFolderFirst) {
  const test::Folder folder;
  std::filesystem::create_directories(folder.path() / "fabrics");
  folder.write("fabrics/mine.toml", std::string(kMinimal) + kThickness);
  setenv("HYSTERON_ASSETS", folder.path().c_str(), 1);
  const std::vector<std::string> names = list_assets("fabrics");
  const Fabric fabric = read_fabric("mine", "test").fabric;
  unsetenv("HYSTERON_ASSETS");
  EXPECT_EQ(names, std::vector<std::string>{"mine"});
  EXPECT_EQ(fabric.name, "mine");
}

// A record made on one machine is read on another, where the folder lies elsewhere.
TEST(Assets, AreNamedWithoutTheFolderTheyLieIn) {
  const FabricFile file = read_fabric("cotton-broad", "test");
  for (const auto& [key, place] : file.place)
    EXPECT_EQ(place.find("assets/fabrics/cotton-broad.toml:"), 0) << key;
  EXPECT_EQ(asset_name(assets_folder() / "scenes" / ".." / "fabrics" / "a.toml"), "assets/fabrics/a.toml");
  EXPECT_EQ(asset_name("/elsewhere/a.toml"), "/elsewhere/a.toml");
}

TEST(Assets, AreFoundByTheirNamesInRecords) {
  const std::string name = "assets/fabrics/cotton-broad.toml";
  EXPECT_EQ(asset_name(asset_place(name)), name);
  EXPECT_EQ(find_asset("fabrics", name, "test"), asset_place(name));
  EXPECT_EQ(asset_place("assetsless/a.toml"), "assetsless/a.toml");
}

TEST(Assets, ThatAreNotThereLeaveNamesAsTheyAre) {
  setenv("HYSTERON_ASSETS", "/nowhere", 1);
  EXPECT_EQ(asset_name("/nowhere/a.obj"), "/nowhere/a.obj");
  EXPECT_EQ(asset_place("assets/a.obj"), "assets/a.obj");
  unsetenv("HYSTERON_ASSETS");
}

TEST(Assets, InAFolderThatIsNotThereAreAMachineError) {
  setenv("HYSTERON_ASSETS", "/nowhere", 1);
  EXPECT_TRUE(says(refusal([] { list_assets("fabrics"); }, 1), "HYSTERON_ASSETS = /nowhere"));
  unsetenv("HYSTERON_ASSETS");
}

}  // namespace
}  // namespace hysteron
