// The crease recovery specimen, and what opens it.
#include "experiments/crease/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/workbench/compare/variants.h"
#include "sim/base/csv.h"
#include "sim/contact/compression.h"
#include "sim/reference/kes.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

Scene small_scene() {
  Scene scene;
  scene.cloth.length = 0.04;
  scene.cloth.width = 0.015;
  scene.triangles = 200;
  scene.contact_stiffness = 1e9;
  return scene;
}

TEST(CreaseSpecimen, HasElementsNoLongerThanAThicknessAcrossTheCrease) {
  const Crease crease = creased(small_scene(), {}, 1.4e-3);
  const ClothMesh& mesh = crease.cloth.mesh;
  int near = 0;
  for (const Edge& e : mesh.edge) {
    const double middle = (mesh.rest[e.p2].x() + mesh.rest[e.p3].x()) / 2;
    if (std::abs(middle - 0.02) > 2e-3) continue;
    ++near;
    EXPECT_LE(std::abs(mesh.rest[e.p2].x() - mesh.rest[e.p3].x()), crease.scene.fabric.thickness);
  }
  EXPECT_GT(near, 20);
  EXPECT_NEAR(crease.opening(crease.cloth.start), 180, 1e-6);
}

TEST(CreaseSpecimen, FeelsThePlateByItsShell) {
  const Crease crease = creased(small_scene(), {}, 1.4e-3);
  auto x = crease.cloth.start;
  const double pressure = 1000, covered = 0.015 * (0.3 + 0.375) * 0.04;
  for (auto& p : x) p.z() = 1.4e-3 - distance_under(obstacle_response(crease.scene), pressure);
  EXPECT_NEAR(crease.plate_force(x, crease.times.pressed) / (pressure * covered), 1, 0.1);
}

// The fold springs up against the plate before that moves: what it presses there is the least that a plate
// can bear.
TEST(CreaseSpecimen, IsNotPressedByLessThanItBearsOpen) {
  const Folder folder;
  const Outcome outcome = ended(
      3, "crease --quick --triangles 60 --crease.force 1e-5 --no-images --device cpu --threads 1 --quiet" +
             out_flag(folder.path() / "out"));
  EXPECT_TRUE(says(outcome.err, "crease.force = 1e-05 N must be > "));
  EXPECT_TRUE(says(outcome.err, "a smaller force does not close the fold"));
}

// Bent to a curvature K over all its length and let go, a law keeps M0/b2 at most.
TEST(CreaseSpecimen, KnowsWhatTheLawAloneKeeps) {
  Crease crease = creased(small_scene(), {}, 1.4e-3);
  const Fabric& f = crease.scene.fabric;
  const double kept = (f.b1 - f.b2) * f.k0 / 2 / f.b2 * 0.04 * 180 / std::numbers::pi;
  const auto opening = [&](const std::vector<double>& bends) {
    LawOfCrease law(crease);
    for (const double bend : bends) law.bend(std::vector<double>(crease.cloth.mesh.faces(), bend), 0.1);
    law.let_go(0.1);
    return law.opening();
  };
  EXPECT_NEAR(opening({1000}), 180 - kept, 0.01 * kept);
  EXPECT_NEAR(opening({1000, -1000}), 180 + kept, 0.01 * kept) << "bent the other way last";
  crease.scene.law = "linear";
  EXPECT_NEAR(opening({1000}), 180, 1e-9);
}

// A strip along weft bends by the rigidity of weft, q: that is M = q^1/2 M_law(q^1/2 K), the law of other
// numbers.
TEST(CreaseSpecimen, AlongWeftKeepsWhatTheLawOfWeftKeeps) {
  constexpr double kRounding = 1e-9;
  const auto opening = [](const Scene& scene) {
    const Crease crease = creased(scene, {}, 1.4e-3);
    LawOfCrease law(crease);
    law.bend(std::vector<double>(crease.cloth.mesh.faces(), 30), 0.1);
    return law.opening();
  };
  Scene across = small_scene(), numbers = small_scene();
  const double q = across.fabric.weft_bending = 0.4;
  across.cloth.warp_angle = 90;
  numbers.fabric.b1 *= q;
  numbers.fabric.b2 *= q;
  numbers.fabric.k0 /= std::sqrt(q);
  EXPECT_NEAR(opening(across), opening(numbers), kRounding);
  EXPECT_GT(std::abs(opening(across) - opening(small_scene())), 1);
}

// The windows at the ends of the limbs are narrower than the columns of a long limb.
TEST(CreaseSpecimen, HasAnOpeningWhereNoColumnLiesInAWindow) {
  Scene scene = small_scene();
  scene.cloth.length = 0.12;
  scene.triangles = 60;
  const Crease crease = creased(scene, {}, 1.4e-3);
  EXPECT_NEAR(crease.opening(crease.cloth.start), 180, 1e-6);
}

// One command runs both laws.
TEST(Crease, OpensWithoutAnIntersectionAndKeepsWhatTheLawKeeps) {
  const FinishedRun run(
      "crease --law linear,prandtl --triangles 120 --crease.hold 0.05 --crease.recovery 0.3 "
      "--crease.force 5 --no-images --quiet");
  EXPECT_EQ(read_table(run.out / "table.csv").rows.size(), 2u);
  const auto elastic = metrics_of(run.out / "linear"), hysteretic = metrics_of(run.out / "prandtl");
  EXPECT_EQ(elastic["intersections"], 0);
  EXPECT_EQ(hysteretic["intersections"], 0);
  EXPECT_GT(elastic["recovery_angle_deg"], 178);
  EXPECT_NEAR(elastic["law_recovery_angle_deg"].get<double>(), 180, 1e-6);
  EXPECT_LT(hysteretic["recovery_angle_deg"], 165);
  EXPECT_GT(hysteretic["recovery_angle_deg"], 90);
  EXPECT_NEAR(elastic["plate_force_N"].get<double>(), 5, 1.5);
  EXPECT_LT(elastic["energy_remainder_relative"], 1e-4);
}

// Under this force edges of the fold are pressed along each other: their full steps turn them too far, and
// the shortest parts of a step need the stiffness against that.
TEST(Crease, FindsTheEquilibriumOfAFoldThatIsPressedEdgeAlongEdge) {
  const FinishedRun run(
      "crease --law prandtl --triangles 200 --crease.hold 0.05 --crease.recovery 0.3 --crease.force 4.98 "
      "--no-images --quiet");
  const auto metrics = run.metrics();
  EXPECT_EQ(metrics["intersections"], 0);
  EXPECT_LT(metrics["energy_remainder_relative"], 1e-4);
}

Json soft_fold(const char* fold, std::vector<Flag> flags = {}) {
  flags.insert(
      flags.end(),
      {{"crease.fold", fold}, {"fabric", "cotton-broad-k50"}, {"triangles", 200}, {"crease.recovery", 1}});
  return metrics_with("crease", std::move(flags));
}

// The crease opens to within `tolerance` of the law alone and between the limits [degree].
void expect_opening(const char* fold, double tolerance, double least, double most) {
  const auto metrics = soft_fold(fold);
  EXPECT_EQ(metrics["intersections"], 0);
  const double opening = metrics["recovery_angle_deg"];
  EXPECT_NEAR(opening, metrics["law_recovery_angle_deg"].get<double>(), tolerance);
  EXPECT_GT(opening, least);
  EXPECT_LT(opening, most);
}

// Bent to 1/r everywhere, well beyond K0, a strip keeps at most M0/b2 over the arc; it opens as the law does.
TEST(SoftFold, AroundARodOpensAsTheLawAlone) { expect_opening("rod", 3, 45, 130); }

// Let go slowly, it passes through equilibria: what stays does not depend on the step.
TEST(SoftFold, LetGoSlowlyKeepsTheSameWithHalfTheStep) {
  const auto kept = [](double step) {
    const auto metrics = soft_fold("rod", {{"step", step}});
    return std::pair<double, double>(metrics["recovery_angle_deg"], metrics["residual_curvature_per_m"]);
  };
  const auto [angle, residual] = kept(0.016666666666666666);
  const auto [finer_angle, finer_residual] = kept(0.008333333333333333);
  EXPECT_NEAR(angle, finer_angle, 1);
  EXPECT_NEAR(residual / finer_residual, 1, 0.05);
}

TEST(CreaseSpecimen, HasFinerColumnsWhereMoreTrianglesAreAskedFor) {
  const auto shortest = [](int triangles) {
    Scene scene = small_scene();
    scene.triangles = triangles;
    const ClothMesh mesh = creased(scene, {}, 1.4e-3).cloth.mesh;
    double least = 1;
    for (const Edge& e : mesh.edge) {
      const double along = std::abs(mesh.rest[e.p2].x() - mesh.rest[e.p3].x());
      if (along > 1e-9) least = std::min(least, along);
    }
    return least;
  };
  EXPECT_NEAR(shortest(2000) / shortest(500), 0.5, 0.05);
}

// The ends of all phases are ends of steps, and a step that begins after a rest of grow_after is twice as
// long.
TEST(GrowingSteps, MeetTheEndOfEveryPhase) {
  const CreaseTimes times{0.6, 1, 301, 302, 602};
  const double step = 1.0 / 120, grow_after = 0.1, rounding = 1e-9;
  const std::vector<double> lengths = growing_steps(times, step, grow_after);
  std::vector<double> ends;
  for (double length : lengths) ends.push_back((ends.empty() ? 0 : ends.back()) + length);
  for (double end : {times.folded, times.pressed, times.released, times.lifted, times.end}) {
    const auto is_end = [&](double t) { return std::abs(t - end) < rounding; };
    EXPECT_TRUE(std::any_of(ends.begin(), ends.end(), is_end)) << end;
  }
  EXPECT_NEAR(ends.back(), times.end, rounding);
  EXPECT_EQ(std::count(lengths.begin(), lengths.end(), step), 120 + 120 + 2);  // moving; first of both rests
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double begun = ends[i] - lengths[i] - times.pressed;
    if (begun < rounding || begun > 100) continue;
    EXPECT_NEAR(lengths[i], step * (1 + begun / grow_after), rounding);
  }
}

// Elastic with one branch: held at K1 for T it opens to K1 c (1 - e^(-T/tau))/(b + c) at once, and recovers
// as e^(-t b/((b + c) tau)) (docs/laws.md); bent to K1 within r, what has relaxed is 1 - e^(-T/tau) (1 -
// e^(-r/tau)) tau/r.
TEST(CreaseInTime, KeepsWhatTheClosedFormOfOneBranchKeeps) {
  const auto kept = [](double step) {
    Crease crease = creased(small_scene(), {}, 1.4e-3);
    Fabric& f = crease.scene.fabric;
    f.b1 = f.b2;  // no friction
    f.bending.branches = {{20}, {0.8 * f.b2}};
    crease.scene.law = "chapman";
    crease.times = {0.6, 1, 41, 41, 71};
    crease.time_steps = growing_steps(crease.times, step, 1.0 / 30);
    LawOfCrease law(crease);
    constexpr int kSteps = 40;  // of the way to the curvature
    const auto bend = [&](double curvature, double seconds) {
      law.bend(std::vector<double>(crease.cloth.mesh.faces(), curvature), seconds);
    };
    for (int k = 1; k <= kSteps; ++k) bend(100.0 * k / kSteps, crease.times.folded / kSteps);
    double time = 0;
    for (const double length : crease.time_steps) {
      time += length;
      if (time <= crease.times.folded + 1e-9) continue;
      if (time <= crease.times.released + 1e-9)
        bend(100, length);
      else
        law.let_go(length);
    }
    return (180 - law.opening()) * std::numbers::pi / 180 / crease.scene.cloth.length;
  };
  const double fraction = 0.8, bend = 0.6, hold = 40.4, tau = 20, recovery = 30;
  const double relaxed = 1 - std::exp(-hold / tau) * (1 - std::exp(-bend / tau)) * tau / bend;
  const double expected =
      100 * fraction / (1 + fraction) * relaxed * std::exp(-recovery / ((1 + fraction) * tau));
  const double error = std::abs(kept(1.0 / 120) / expected - 1),
               half = std::abs(kept(1.0 / 240) / expected - 1);
  EXPECT_LT(error, 0.02);
  EXPECT_NEAR(half / error, 0.5, 0.1);  // of first order
}

// The tester reads of it what it reads of cotton broad without branches or set: B and 2HB as published.
TEST(CreaseInTime, OfCottonBroadHasItsPublishedPair) {
  constexpr double kPrinted = 1e-6;  // of the numbers in the files
  KesProtocol protocol;
  protocol.cycles = 1;
  protocol.minor_loops = false;
  const KesWalk walk = walk_to({250, -250, 250}, protocol);
  const KesPair published = kes_pair(read_fabric("cotton-broad", "test").fabric.virgin_curve());
  for (const char* name : {"cotton-broad-relaxing", "cotton-broad-creasing"}) {
    const LawRequest law{"chapman", read_fabric(name, "test").fabric.virgin_curve(), {}};
    const KesReading read = read_loop(protocol, walk, run_law(law, walk.rows).moment);
    EXPECT_NEAR(read.rigidity, published.rigidity, kPrinted * published.rigidity) << name;
    EXPECT_NEAR(read.loop_width, published.loop_width, kPrinted * published.loop_width) << name;
  }
}

// Friction alone keeps what it keeps; with a branch the angle comes back in time.
TEST(CreaseInTime, RecoversOverMinutesWithARelaxingBranchOnly) {
  const auto recovered = [](std::vector<Flag> flags) {
    flags.insert(flags.end(), {{"crease.standard", "iso2313"}, {"law", "chapman"}, {"triangles", 200}});
    return metrics_with("crease", std::move(flags));
  };
  const auto friction = recovered({}),
             relaxing = recovered({{"fabric.bending.branches.times", Numbers{30}},
                                   {"fabric.bending.branches.stiffnesses", Numbers{1.2e-5}}});
  const auto angle = [](const Json& m, const char* key) { return m[key].get<double>(); };
  constexpr double kAtRest = 0.05;  // degrees
  EXPECT_NEAR(angle(friction, "recovery_angle_deg"), angle(friction, "release_angle_deg"), kAtRest);
  EXPECT_LT(angle(relaxing, "release_angle_deg"), angle(friction, "release_angle_deg") - 10);
  EXPECT_GT(angle(relaxing, "recovery_angle_15_s_deg"), angle(relaxing, "release_angle_deg"));
  EXPECT_GT(angle(relaxing, "recovery_angle_deg"), angle(relaxing, "recovery_angle_15_s_deg") + 5);
}

// Pulled straight, it does not return to the angle that it was made with.
TEST(SoftFold, OfAPleatKeepsSomeOfBeingStraight) { expect_opening("pleat", 5, 65, 120); }

TEST(SoftFold, OfAPleatBeginsAtItsAngle) {
  CreaseParams choice;
  choice.pleat = 60;
  const Crease crease = pleated(small_scene(), choice);
  EXPECT_NEAR(crease.opening(crease.cloth.start), 60, 1e-6);
}

CommandLine naming(std::vector<Flag> flags) { return {"crease", "hysteron crease", std::move(flags), {}}; }

TEST(Variants, AreThePairsOfFabricAndLaw) {
  const auto names = [](const CommandLine& line) {
    std::vector<std::string> result;
    for (const Variant& variant : named_variants(line)) result.push_back(variant.name);
    return result;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(naming({})).size(), 1u);
  EXPECT_EQ(names(naming({{"law", "dahl"}, {"fabric", "wool-tropical"}})), Names{"dahl"});
  EXPECT_EQ(names(naming({{"law", "linear,prandtl"}})), (Names{"linear", "prandtl"}));
  EXPECT_EQ(names(naming({{"fabric", "cotton-broad,wool-tropical"}, {"law", "dahl"}})),
            (Names{"cotton-broad", "wool-tropical"}));
  EXPECT_EQ(
      names(naming({{"fabric", "cotton-broad,wool-tropical"}, {"law", "linear,dahl"}})),
      (Names{"cotton-broad-linear", "cotton-broad-dahl", "wool-tropical-linear", "wool-tropical-dahl"}));
  EXPECT_GT(names(naming({{"fabric", "all"}})).size(), 10u);
  EXPECT_EQ(without_lists(naming({{"law", "all"}, {"fabric", "wool-tropical"}})).flags.size(), 1u);
}

}  // namespace
}  // namespace hysteron::experiments
