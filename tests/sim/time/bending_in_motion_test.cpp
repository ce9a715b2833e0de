// Bending in a whole simulation has the input rigidity, a history, a residual curvature, and only the costs
// of its scene.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/base/error.h"
#include "sim/bending/bending.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using test::Trial;

// A strip clamped at x = 0 under its own weight, dropped and damped by air until it hangs.  The clamp is two
// fixed columns of vertices; the free length starts in their middle.
struct Cantilever {
  static constexpr double kLength = 0.1;
  int cells;
  double omega;  // slowest wave, 3.516 sqrt(B/(sigma L^4)); the air damps it critically
  Trial trial;
  Cantilever(double gamma, const std::string& element, int cells, double step)
      : cells(cells), omega(3.516 * std::sqrt(9.81 / (kLength * gamma))), trial(test::free_square()) {
    constexpr int kRows = 2;
    const double cell = kLength / (cells - 0.5);
    Scene& scene = trial.scene;
    scene.element = value_named<BendingElement>(element);
    scene.step = step;
    scene.solver_tolerance = 1e-4;
    scene.fabric.b2 = scene.fabric.density * 9.81 * std::pow(kLength, 3) / gamma;
    scene.fabric.b1 = scene.fabric.b2;
    scene.air_drag = 2 * omega * scene.fabric.density;
    scene.pin = {test::pin_at(0, 0)};
    trial.cloth.mesh = make_grid(cells * cell, kRows * cell, cells, kRows, MeshFamily::aligned, 1);
    trial.cloth.start = trial.cloth.mesh.rest;
    trial.cloth.pin.assign(trial.cloth.mesh.vertices(), -1);
    for (int i = 0; i < trial.cloth.mesh.vertices(); ++i)
      if (trial.cloth.mesh.rest[i].x() < 1.5 * cell) trial.cloth.pin[i] = 0;
  }
  std::unique_ptr<Simulation> settled() const {
    return trial.after(static_cast<int>(10 / omega / trial.scene.step));
  }
};

double fastest(Simulation& simulation) {
  double result = 0;
  for (const Vector3d& v : simulation.velocities()) result = std::max(result, v.norm());
  return result;
}

constexpr int kCells = 32;

// Whatever the large step: bending waves with a period near it must not feed on the implicit stage.
TEST(Cantilever, ComesToRestForLargeStepsToo) {
  constexpr double kRest = 2e-3;  // of the speed of the fall, length times frequency
  for (const double step : {5e-4, 1e-3, 2e-3}) {
    const Cantilever strip(10, "shape", kCells, step);
    const auto simulation = strip.settled();
    EXPECT_LT(fastest(*simulation), kRest * Cantilever::kLength * strip.omega) << step;
    const Ledger ledger = simulation->ledger();
    EXPECT_GT(ledger.integrator(), -0.01 * -ledger.gravitational) << step;  // feeds nothing in
  }
}

// A strip along x whose clamped ends are turned and brought together, so that it becomes an arc, and taken
// back.
struct Fold {
  static constexpr double kLimit = 10, kCurvature = 2 * kLimit;  // K0 [1/m], and the arc's curvature [1/m]
  static constexpr double kCell = 0.00625, kStrip = 16 * kCell;
  static constexpr double kFree = kStrip - kCell;  // between the middles of the clamps
  static constexpr double kBent = 0.8, kHeld = 1.2, kBack = 2, kEnd = 2.4;  // [s]
  Trial trial;
  explicit Fold(const std::string& law) : trial(scene(law)) {
    trial.scene.pin = {clamp(0, 1), clamp(kStrip, -1)};
    trial.cloth = make_cloth(trial.scene);
  }
  // Two columns of vertices; `side` = +1 at the left end, whose way to the middle and whose turn are
  // positive.
  static Pin clamp(double x, double side) {
    Pin pin;
    pin.low = {std::min(x, x + side * 1.1 * kCell), -1, 0};
    pin.high = {std::max(x, x + side * 1.1 * kCell), 1, 0};
    pin.motion.center = {x + side * kCell / 2, 0, 0};
    pin.motion.axis = {0, 1, 0};
    constexpr int kKeys = 8;
    const auto add = [&](double time, double fraction) {
      const double turn = fraction * kCurvature * kFree / 2;
      const double displacement = fraction > 0 ? kFree / 2 * (1 - std::sin(turn) / turn) : 0;
      pin.motion.keys.push_back({time, {side * displacement, 0, 0}, side * turn * 180 / pi});
    };
    for (int i = 0; i <= kKeys; ++i) add(kBent * i / kKeys, double(i) / kKeys);
    for (int i = kKeys; i >= 0; --i) add(kBack - (kBack - kHeld) * i / kKeys, double(i) / kKeys);
    return pin;
  }
  static Scene scene(const std::string& law) {
    Scene scene = test::free_square();
    scene.cloth.shape = ClothOutline::strip;
    scene.cloth.length = kStrip;
    scene.cloth.width = 4 * kCell;
    scene.mesh = "aligned";
    scene.triangles = 128;
    scene.law = law;
    scene.step = 5e-4;
    scene.solver_tolerance = 1e-6;
    scene.gravity.setZero();
    scene.fabric.k0 = kLimit;
    scene.air_drag = 2;
    return scene;
  }
  std::unique_ptr<Simulation> at(double time) const {
    return trial.after(static_cast<int>(time / trial.scene.step));
  }
  // Returns the mean of the curvature along x over the faces of the strip's middle half.
  double mean(const std::vector<double>& curvature) const {
    double sum = 0, area = 0;
    for (int f = 0; f < trial.cloth.mesh.faces(); ++f) {
      double x = 0;
      for (int k = 0; k < 3; ++k) x += trial.cloth.mesh.rest[trial.cloth.mesh.face[f][k]].x() / 3;
      if (std::abs(x - kStrip / 2) > kStrip / 4) continue;
      sum += trial.cloth.mesh.face_area[f] * curvature[3 * f];
      area += trial.cloth.mesh.face_area[f];
    }
    return sum / area;
  }
};

// Bent to 2 K0 and back to flat: friction has turned over once, F = -M0 at K = 0.  From there on the doubled
// branch M = b2 K - M0 + 2 M0 (2u - u^2), u = K/(2 K0), is zero at the residual curvature.
double masing_residual(const VirginCurve& c) {
  double low = 0, high = 2 * c.k0;
  for (int i = 0; i < 100; ++i) {
    const double k = (low + high) / 2, u = k / (2 * c.k0), m0 = c.friction_moment();
    (c.b2 * k - m0 + 2 * m0 * (2 * u - u * u) < 0 ? low : high) = k;
  }
  return low;
}

TEST(ResidualCurvature, StaysAfterAFoldPastTheElasticLimitAndBack) {
  constexpr double kRound = 0.05;   // the arc between its clamps; the strip's free edges
  constexpr double kSmooth = 0.15;  // the same, and eight stops
  const Fold fold("prandtl");
  const auto simulation = fold.at(Fold::kHeld);
  EXPECT_NEAR(fold.mean(simulation->curvature()) / Fold::kCurvature, 1, kRound);
  simulation->advance(static_cast<int>((Fold::kEnd - Fold::kHeld) / fold.trial.scene.step));
  EXPECT_NEAR(fold.mean(simulation->curvature()) / Fold::kCurvature, 0, kRound);
  const double expected = masing_residual(fold.trial.scene.fabric.virgin_curve());
  ASSERT_GT(expected, 0.1 * Fold::kLimit);
  EXPECT_NEAR(fold.mean(simulation->residual_curvature()) / expected, 1, kSmooth);
  EXPECT_GT(simulation->ledger().bending_friction, 0);
}

TEST(ResidualCurvature, IsZeroForLinearClothAndForAFoldThatNeverWas) {
  for (double k : Fold("linear").at(Fold::kBent)->residual_curvature()) EXPECT_EQ(k, 0);
  for (double k : Fold("prandtl").at(0)->residual_curvature()) EXPECT_EQ(k, 0);
}

// The same positions, given to a second history one by one: had the solver committed another time, or
// elsewhere, friction would have lost something else.
TEST(History, IsCommittedOncePerSubstepAtThePositionsBeforeIt) {
  for (const char* law : {"prandtl", "wong"}) {
    for (const char* integrator : {"semi-implicit", "explicit"}) {
      Scene scene = test::hanging_square(60);
      scene.law = law;
      scene.integrator = value_named<Integrator>(integrator);
      scene.step = 1e-5;
      scene.fabric.damping = 0;
      const Trial trial = test::rippled(scene, 3e-3);
      const auto simulation = trial.simulation();
      ASSERT_EQ(simulation->limits().substeps, 1);
      const CurvatureOperator op =
          make_curvature_operator(BendingElement::shape, trial.cloth.mesh, trial.cloth.held(trial.scene, 0));
      Cpu cpu(1);
      Bending<double, Cpu> replay(cpu, trial.cloth.mesh, op,
                                  make_law_loop<double>(cpu, choose_law(law, scene.fabric.virgin_curve(), {}),
                                                        op.dimension, op.elements()),
                                  ForceConvention::energy, 0);
      const std::vector<Vector3d> still(trial.cloth.start.size(), Vector3d::Zero());
      replay.commit(trial.cloth.start.data(), still.data(),
                    0);  // at the start, which loses nothing of the run
      const double before = replay.dissipated_energy();
      for (int i = 0; i < 200; ++i) {
        replay.commit(simulation->positions().data(), still.data(), 0);
        simulation->advance(1);
      }
      const double lost = simulation->ledger().bending_friction;
      EXPECT_NE(lost, 0);
      EXPECT_EQ(lost, replay.dissipated_energy() - before) << law << " " << integrator;
      EXPECT_EQ(simulation->residual_curvature(), replay.residual_curvature()) << law << " " << integrator;
    }
  }
}

TEST(Scene, PaysForHistoryOnlyWhereTheLawRemembers) {
  for (const char* law : {"linear", "pabst", "prandtl", "wong"}) {
    Trial trial(test::hanging_square());
    trial.scene.law = law;
    const ScenePart history = test::scene_part(*trial.simulation(), "bending history");
    const bool remembers = std::string(law) == "prandtl" || std::string(law) == "wong";
    EXPECT_EQ(history.included, remembers) << law;
    EXPECT_EQ(history.bytes > 0, remembers) << law;
    EXPECT_EQ(history.reason.empty(), remembers) << law;
  }
  // Each face has eight stops of three components.
  Trial trial(test::hanging_square());
  trial.scene.law = "prandtl";
  EXPECT_EQ(test::scene_part(*trial.simulation(), "bending history").bytes,
            8 * 3 * sizeof(double) * trial.cloth.mesh.faces());
}

TEST(Scene, PaysForObstaclesHandlesAndTheImplicitSolveOnlyWhereItHasThem) {
  Scene scene = test::hanging_square();
  const auto bytes = [](const Scene& s, const char* name) {
    return test::scene_part(*Trial(s).simulation(), name).bytes;
  };
  EXPECT_EQ(bytes(scene, "obstacles"), 0u);
  EXPECT_EQ(bytes(scene, "moving pins"), 0u);
  EXPECT_GT(bytes(scene, "implicit solve"), 0u);
  const std::size_t plain = Trial(scene).simulation()->counts().bytes;
  scene.obstacle = {test::ground_at(-1)};
  scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {1, {0, 0, 1}, 0}};
  EXPECT_GT(bytes(scene, "obstacles"), 0u);
  EXPECT_GT(bytes(scene, "moving pins"), 0u);
  EXPECT_GT(Trial(scene).simulation()->counts().bytes, plain);
  scene = test::hanging_square();
  scene.integrator = Integrator::explicit_euler;
  EXPECT_FALSE(test::scene_part(*Trial(scene).simulation(), "implicit solve").included);
}

TEST(Scene, PartsAddUpToTheDevicesMemory) {
  Scene scene = test::hanging_square(1000);
  scene.law = "prandtl";
  scene.obstacle = {test::ground_at(-1)};
  const auto simulation = Trial(scene).simulation();
  std::size_t sum = 0;
  for (const ScenePart& p : simulation->parts()) sum += p.bytes;
  constexpr double kUnlisted = 0.02;  // per-element accounts of friction
  EXPECT_NEAR(static_cast<double>(sum) / static_cast<double>(simulation->counts().bytes), 1, kUnlisted);
}

TEST(ChapterForce, NeedsHinges) {
  Trial trial(test::hanging_square());
  trial.scene.force = ForceConvention::chapter;
  EXPECT_THROW(trial.simulation(), Error);
  trial.scene.element = BendingElement::hinge;
  EXPECT_NO_THROW(trial.after(20)->ledger());
}

}  // namespace
}  // namespace hysteron
