// These tests compare the sagging strip with the elastica.
#include "experiments/specimens/cantilever_strip.h"
#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/session/recoveries.h"
#include "sim/scene/motion.h"
#include "sim/scene/scene_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Json recorded_metrics(const std::vector<Flag>& flags) { return metrics_with("cantilever", flags); }

constexpr double kDropOfTen = 0.7001997;  // over the length, heaviness 10: the elastica by shooting
constexpr double kWithin = 5e-3;          // of 256 triangles at most 0.22 %, of aligned-45 on 512 0.49 %

// Statics without friction do not remember their steps: a few put the weight on, and none takes it off.
const std::vector<Flag> kSoonLoaded = {{"law", "linear"}, {"ramp", 0.2}, {"unload", 0}};

struct Meshed {
  const char* mesh;
  int triangles;
};

class OnAMesh : public testing::TestWithParam<Meshed> {};
// The cells of aligned-45 are the longest, so that it takes more of them.
INSTANTIATE_TEST_SUITE_P(Meshes, OnAMesh,
                         testing::Values(Meshed{"aligned", 256}, Meshed{"aligned-45", 512},
                                         Meshed{"flipped", 256}, Meshed{"unionjack", 256},
                                         Meshed{"equilateral", 256}, Meshed{"random", 256}),
                         [](const auto& of) {
                           std::string name = of.param.mesh;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(OnAMesh, DropsAsTheElastica) {
  std::vector<Flag> flags = kSoonLoaded;
  flags.insert(flags.end(), {{"gamma", 10}, {"mesh", GetParam().mesh}, {"triangles", GetParam().triangles}});
  const auto metrics = recorded_metrics(flags);
  EXPECT_NEAR(metrics["tip_drop_over_length"].get<double>() / kDropOfTen, 1, kWithin);
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 100 * kWithin);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / (0.1 / std::cbrt(10)), 1, kWithin);
}

// Rounded in-plane forces hide the weight of a strip that is next to weightless.
TEST(Cantilever, RefusesAStripWhoseWeightRoundingHides) {
  const Folder folder;
  const auto said = [&](double gamma) {
    return test::refusal([&] {
      run_into(folder.path() / "out", "cantilever", {{"gamma", gamma}, {"explain", true}});
    });
  };
  EXPECT_EQ(said(1e-2), test::kAccepted);
  EXPECT_TRUE(says(said(1e-5), "gamma 1e-05) and must weigh at least", "it sags by gamma/8 of its length"));
}

// The same weight on a rigidity that is 5 % too large.
TEST(Cantilever, ShowsAWrongRigidity) {
  constexpr double kB = 1e-5, kLength = 0.1, kGravity = 9.81;
  const double density = 10 * kB / (kGravity * kLength * kLength * kLength);
  constexpr double b = 1.05 * kB;
  std::vector<Flag> flags = kSoonLoaded;
  flags.insert(flags.end(),
               {{"triangles", 256}, {"fabric.b1", b}, {"fabric.b2", b}, {"fabric.density", density}});
  const auto metrics = recorded_metrics(flags);
  EXPECT_LT(metrics["tip_drop_over_length"].get<double>() / kDropOfTen, 1 - 2 * kWithin);
  EXPECT_GT(metrics["bending_length_m"].get<double>() / (kLength / std::cbrt(10)), 1 + 2 * kWithin);
}

TEST(Cantilever, FollowsTheElasticaWithFrictionAndKeepsItsDroop) {
  const auto metrics =
      recorded_metrics({{"triangles", 512}, {"law", "prandtl"}, {"gamma", 10}, {"mesh", "random"}});
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 0.3);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / metrics["elastica_bending_length_m"].get<double>(),
              1, kWithin);
  const double left = metrics["elastica_residual_drop_over_length"];
  EXPECT_GT(left, 0.01) << "friction holds a part of the sag";
  EXPECT_NEAR(metrics["residual_drop_over_length"].get<double>() / left, 1, 0.01);
}

// The droop that stays, when the fabric's bending, friction with it, is 5 % off under the same weight.
TEST(Cantilever, ShowsAWrongRigidityInItsDroopAsWell) {
  const auto metrics_with = [](double wrong) {
    return recorded_metrics({{"law", "prandtl"},
                             {"triangles", 128},
                             {"fabric.b1", 36e-6 * wrong},
                             {"fabric.b2", 12e-6 * wrong},
                             {"fabric.density", 0.0122}});
  };
  const auto right = metrics_with(1);
  const double elastica = right["elastica_residual_drop_over_length"];
  EXPECT_NEAR(right["residual_drop_over_length"].get<double>() / elastica, 1, 0.01);
  EXPECT_LT(metrics_with(1.05)["residual_drop_over_length"].get<double>() / elastica, 1 - 0.02);
}

// Weft half as stiff as warp: half the weight bends it as far, and the reference is the strip's own.
TEST(Cantilever, ComparesWithTheElasticaOfItsOwnDirection) {
  for (const char* law : {"linear", "prandtl"}) {
    const auto metrics = recorded_metrics({{"law", law},
                                           {"gamma", 5},
                                           {"triangles", 128},
                                           {"fabric.weft-bending", 0.5},
                                           {"fabric.bias-bending", 0.7},
                                           {"cloth.warp-angle", 90}});
    EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 100 * kWithin) << law;
    EXPECT_NEAR(
        metrics["bending_length_m"].get<double>() / metrics["elastica_bending_length_m"].get<double>(), 1,
        kWithin);
    if (law == std::string("linear")) {
      EXPECT_NEAR(metrics["elastica_drop_over_length"].get<double>() / kDropOfTen, 1, 1e-4);
    }
  }
}

// A hanging strip makes its face convex: the back's B and 2HB carry it.
TEST(Cantilever, ComparesWithTheElasticaOfTheSideThatItBendsTo) {
  constexpr double kNear = 1.5, kRounding = 1e-12;  // percent; relative
  Scene scene = default_scene();
  scene.fabric.bending.faces = {1.5, 1.6};
  const VirginCurve back = strip_elastica(scene, 0.1).law.curve, face = scene.fabric.virgin_curve();
  EXPECT_NEAR(back.b2 / face.b2, 1.5, kRounding);
  EXPECT_NEAR(back.friction_moment() / face.friction_moment(), 1.6, kRounding);
  const auto metrics = recorded_metrics({{"law", "prandtl"},
                                         {"gamma", 5},
                                         {"triangles", 64},
                                         {"fabric.back-bending", 1.5},
                                         {"fabric.back-friction", 1.6}});
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), kNear);
}

// A strip that is too long for its weight hangs straight down: 8 times as stiff a back allows for twice the
// length.
TEST(Cantilever, IsAsLongAsTheSideThatItBendsToCarries) {
  Scene scene = default_scene();
  scene.law = "linear";
  scene.ramp = 1;
  scene.cloth.length = 1000;  // [m]
  const auto longest = [](const Scene& of) {
    const std::string said = test::refusal([&] { check_cantilever(of); }), before = "must be <= ";
    const std::size_t at = said.find(before);
    return at == std::string::npos ? 0.0 : std::stod(said.substr(at + before.size()));
  };
  const double face = longest(scene);
  scene.fabric.bending.faces.bending = 8;
  constexpr double kThreeDigits = 5e-3;  // relative, of each length as it is said
  EXPECT_NEAR(longest(scene) / face, 2, 2 * kThreeDigits);
}

// A long strip cut on the bias twists as it bends: softer than a plate bent to a cylinder, whose rigidity is
// 0.7 there.
TEST(Cantilever, OnTheBiasFollowsAFreeStrip) {
  const auto metrics = recorded_metrics({{"law", "linear"},
                                         {"gamma", 1},
                                         {"triangles", 256},
                                         {"cloth.width", 0.01},
                                         {"fabric.weft-bending", 0.5},
                                         {"fabric.bias-bending", 0.7},
                                         {"cloth.warp-angle", 45}});
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 2) << "a cylinder's rigidity is 6 % more";
}

// Bent far past 2 Ma at the clamp and relieved of its weight, it rests under no moment.
TEST(Cantilever, CountsWhatWasBentPastTwiceTheElasticLimitAsFullSlip) {
  const auto cases = [](double k0) {
    const auto metrics = recorded_metrics({{"law", "prandtl"},
                                           {"gamma", 10},
                                           {"triangles", 128},
                                           {"fabric", "cotton-broad-k50"},
                                           {"fabric.k0", k0}});
    return std::array<long, 3>{metrics["recovery_elastic_count"], metrics["recovery_partial_count"],
                               metrics["recovery_full_slip_count"]};
  };
  const auto soft = cases(2), hard = cases(50);
  EXPECT_GT(soft[2], soft[0]);
  EXPECT_GT(soft[1], 0);
  EXPECT_GT(soft[0], 0) << "at the free end";
  EXPECT_EQ(hard[1] + hard[2], 0) << "never past Ma";
}

// Along weft of ratio q a fabric bends as one of b1 q, b2 q and k0/sqrt(q) does along warp.
TEST(Cantilever, CountsRecoveriesOfAFabricThatBendsOtherwiseAlongWeft) {
  const std::vector<Flag> common = {{"law", "prandtl"}, {"triangles", 48}, {"mesh", "aligned"}};
  const auto with = [&](std::vector<Flag> further) {
    further.insert(further.end(), common.begin(), common.end());
    return recorded_metrics(std::move(further));
  };
  auto weft = with({{"fabric.b1", 4e-5},
                    {"fabric.b2", 8e-6},
                    {"fabric.k0", 4},
                    {"fabric.weft-bending", 0.25},
                    {"fabric.bias-bending", 0.4375},
                    {"cloth.warp-angle", 90},
                    {"gamma", 10}});
  auto alike = with({{"fabric.b1", 1e-5}, {"fabric.b2", 2e-6}, {"fabric.k0", 8}, {"gamma", 40}});
  ASSERT_GT(alike["recovery_partial_count"], 0);
  ASSERT_GT(alike["recovery_full_slip_count"], 0);
  for (const char* key : {"recovery_elastic_count", "recovery_partial_count", "recovery_full_slip_count"})
    EXPECT_EQ(weft[key], alike[key]) << key;
  constexpr double kTransverse = 1e-3;  // along warp, where the strip hardly bends, the fabrics differ
  for (const char* key : {"residual_curvature_rms_per_m", "residual_curvature_formula_rms_per_m"})
    EXPECT_NEAR(weft[key].get<double>() / alike[key].get<double>(), 1, kTransverse) << key;
}

TEST(Recoveries, GoByTheLastReversalFromPastTheElasticLimit) {
  Scene scene;
  const double limit = scene.fabric.virgin_curve().elastic_limit_moment();
  const auto of = [&](const std::vector<double>& moments) {
    Recoveries recoveries(scene);
    for (double m : moments) recoveries.see({m * limit, 0, 0}, 3);
    const auto cases = recoveries.cases();
    return cases[0] ? 1 : cases[1] ? 2 : 3;
  };
  EXPECT_EQ(of({0.5, 0.9, 0}), 1);
  EXPECT_EQ(of({0.5, 1.9, 1.2, 0}), 2);
  EXPECT_EQ(of({1.5, 2.5, 1.2, 0, -0.1, 0.1, 0}), 3);  // trembles at rest
  EXPECT_EQ(of({2.5, 0, -1.5, 0}), 2);
  EXPECT_EQ(of({2.5, -1.5, 0}), 2);
}

// A law that bends both ways alike has M = Ma by the means of B and 2HB.
TEST(Recoveries, OfALawWithoutSidesGoByTheMeansOfBoth) {
  Scene scene;
  scene.law = "wong";
  scene.fabric.bending.faces = {5, 3};
  const double face = scene.fabric.virgin_curve().elastic_limit_moment();
  const double mean = mean_of_faces(scene.fabric.virgin_curve()).elastic_limit_moment();
  ASSERT_GT(mean, 2 * face);
  const auto full_slips = [&](double moment) {
    Recoveries recoveries(scene);
    recoveries.see({moment, 0, 0}, 3);
    recoveries.see({0, 0, 0}, 3);
    return recoveries.cases()[2];
  };
  EXPECT_EQ(full_slips(1.99 * mean), 0);
  EXPECT_EQ(full_slips(2.01 * mean), 1);
}

// Statics without friction do not remember their steps: the whole weight is on when its drop is read.
TEST(Cantilever, IsReadUnderItsWholeWeightWhateverStepsAndPicturesThereAre) {
  constexpr double kSearched = 2e-4;  // twice the precision of the search for an overhang
  const std::vector<Flag> common = {{"gamma", 10}, {"triangles", 32}};
  const auto with = [&](std::vector<Flag> further) {
    further.insert(further.end(), common.begin(), common.end());
    return recorded_metrics(std::move(further));
  };
  const auto usual = with({});
  const std::vector<std::vector<Flag>> cases = {{{"ramp", 0.12}, {"fps", 7}},
                                                {{"step", 0.3}, {"fps", 0}, {"unload", 0}}};
  for (const std::vector<Flag>& further : cases) {
    const std::string what = further.front().path + " " + further.front().text();
    const auto metrics = with(further);
    for (const char* key : {"tip_drop_over_length", "elastica_drop_over_length", "bending_length_m"})
      EXPECT_NEAR(metrics[key].get<double>() / usual[key].get<double>(), 1, kSearched) << what << ", " << key;
    EXPECT_EQ(metrics.contains("residual_drop_over_length"), further.back().path != "unload") << what;
  }
}

std::string cantilever_refusal(const std::vector<Flag>& flags) {
  const Folder folder;
  return test::refusal([&] { run_into(folder.path() / "out", "cantilever", flags); });
}

TEST(Cantilever, RefusesWhatHasNoAnswer) {
  const std::pair<std::vector<Flag>, const char*> cases[] = {
      {{{"ramp", 0}}, "ramp = 0 s"},
      {{{"ramp", 1e9}}, "makes more than a million steps of ramp = 1e+09 s"},
      {{{"integrator", "implicit"}}, "cantilever sets integrator itself"},
      {{{"gravity", Numbers{0, 0, 0}}}, "makes no strip sag"},
      {{{"gravity", Numbers{0, 0, 9.81}}}, "pulls 180 degree away"},
      {{{"gravity", Numbers{9.81, 0, 0}}}, "pulls 90 degree away"},
      {{{"gravity", Numbers{0, 4, -9}}}, "pulls the strip sideways"},
      {{{"cloth.rotation", Numbers{0, 90, 0}}}, "with cloth.rotation = 0 90 0 degree"},
      {{{"cloth.length", 100}}, "cloth.length = 100 m"}};
  for (const auto& [flags, message] : cases)
    EXPECT_TRUE(says(cantilever_refusal(flags), message)) << message << ": " << cantilever_refusal(flags);
}

TEST(Cantilever, ComparesATiltedWeightWithTheElasticaUnderIt) {
  const auto metrics =
      recorded_metrics({{"gamma", 10}, {"triangles", 128}, {"gravity", Numbers{3.355, 0, -9.218}}});
  EXPECT_NEAR(metrics["elastica_drop_over_length"].get<double>() / 0.5890758, 1, 4e-4)
      << "20 degree, by shooting";
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 100 * kWithin);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / metrics["elastica_bending_length_m"].get<double>(),
              1, kWithin);
}

// Turned about y, the free end goes down, and the weight pulls towards it.
TEST(Cantilever, MeasuresInTheAxesOfAStripThatIsTurned) {
  constexpr double kDegrees = 3.14159265358979323846 / 180, kRounding = 1e-12;
  Scene scene = default_scene();
  scene.cloth.rotation = {0, 20, 50};
  EXPECT_NEAR(strip_elastica(scene, 0.1).tilt, 20 * kDegrees, kRounding);
  const CantileverStrip strip = overhang(scene, 0.1);
  EXPECT_NEAR(strip.free_end(strip.cloth.start).x(), 0.1, kRounding);
  std::vector<Eigen::Vector3d> moved = strip.cloth.start;
  for (Eigen::Vector3d& x : moved) x += start_rotation(scene.cloth) * Eigen::Vector3d(-0.01, 0.3, -0.02);
  EXPECT_NEAR(strip.free_end(moved).x(), 0.09, kRounding);
  EXPECT_NEAR(strip.free_end(moved).y(), 0.02, kRounding);
}

// Stops along weft are not those along warp: the strip's reference has those of its own direction.
TEST(Cantilever, AlongWeftFollowsTheStopsOfWeft) {
  const auto metrics = recorded_metrics({{"law", "prandtl"},
                                         {"triangles", 128},
                                         {"fabric.density", 0.0122},
                                         {"fabric.weft-bending", 0.5},
                                         {"fabric.bias-bending", 0.7},
                                         {"fabric.bending.stops.thresholds", Numbers{10, 40}},
                                         {"fabric.bending.stops.stiffnesses", Numbers{3e-5, 2e-5}},
                                         {"fabric.bending.stops.weft.thresholds", Numbers{5, 20}},
                                         {"fabric.bending.stops.weft.stiffnesses", Numbers{1e-5, 4e-6}},
                                         {"cloth.warp-angle", 90}});
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 100 * kWithin);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / metrics["elastica_bending_length_m"].get<double>(),
              1, kWithin);
}

// There are two columns at least, and the clamp's.
TEST(Cantilever, HasNotManyMoreCellsThanAreAskedForHoweverLongOrShortItIs) {
  constexpr int kTriangles = 128;
  for (const double length : {1e-8, 1e-4, 0.1, 10.0, 1e6}) {
    const ClampedMesh clamped = clamped_mesh("unionjack", length, 0.025, kTriangles, 1, 1);
    EXPECT_LE(clamped.mesh.faces(), 2 * 3 * kTriangles) << length;
  }
}

TEST(Cantilever, ComesBackWithoutFriction) {
  const auto metrics = recorded_metrics({{"triangles", 128}, {"gamma", 10}});
  EXPECT_NEAR(metrics["residual_drop_over_length"].get<double>(), 0, 1e-4);
}

// Its edges lie along its fold, so that bending is right however sharp that is.
TEST(Cantilever, CountsSharpEdgesAndNoTriangleThatTiltsAlongTheFold) {
  EXPECT_EQ(recorded_metrics({{"gamma", 1}, {"triangles", 128}})["sharp_edges_percent"], 0);
  const auto heavy = recorded_metrics({{"gamma", 1000}, {"triangles", 32}});
  EXPECT_GT(heavy["sharp_edges_percent"], 1);
  EXPECT_EQ(heavy["tilted_triangles_percent"], 0);
}

}  // namespace
}  // namespace hysteron::experiments
