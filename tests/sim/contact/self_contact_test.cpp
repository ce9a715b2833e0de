// Cloth on cloth: pressure, friction, no way through; energies; an exact check of intersections.
#include "sim/contact/self_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "sim/base/error.h"
#include "sim/contact/barrier.h"
#include "sim/contact/compression.h"
#include "sim/contact/self_touch.h"
#include "sim/mesh/intersections.h"
#include "tests/sim/contact/two_sheets.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;
using test::two_sheets;
using test::upper_vertices;

constexpr double kLayerSide = test::kUpperSide;

// Forces on the upper sheet as the barrier's energy and friction's have them.
Vector3d force_on_upper(SelfContact<double, Cpu>& contact, const Trial& trial, const std::vector<Vector3d>& x,
                        const std::vector<Vector3d>& before) {
  std::vector<Vector3d> gradient(x.size(), Vector3d::Zero());
  contact.evaluate(x.data(), before.data(), gradient.data());
  Vector3d force = Vector3d::Zero();
  for (int i : upper_vertices(trial)) force -= gradient[i];
  return force;
}

// The list's areas are chosen such that the layers' force is that of the barrier times the upper one's area,
// on meshes with edges of 4 to 22 thicknesses, pressed together by a tenth to two fifths; in the mean over
// several places of one mesh on the other.
TEST(SelfContact, OfFlatLayersHasTheBarriersPressureOnAnyMesh) {
  const double thickness = Fabric{}.thickness;
  const auto pressure = [](double u) { return 2 * (u - 1) * std::log(u) + (u - 1) * (u - 1) / u; };
  for (int triangles : {100, 200, 800, 3200})
    for (double fraction : {0.6, 0.8, 0.9}) {
      const int places = 3200 / triangles;
      double force = 0;
      for (int place = 0; place < places; ++place) {
        Trial trial = two_sheets(fraction * thickness, triangles);
        const Eigen::Rotation2Dd turn(0.7 * place);
        const Eigen::Vector2d middle(0.7 * kLayerSide, 0.7 * kLayerSide);
        for (int i : upper_vertices(trial)) {
          auto&& x = trial.cloth.start[i].head<2>();
          x = middle + turn * (Eigen::Vector2d(x) - middle);
        }
        Cpu cpu(1);
        SelfContact<double, Cpu> contact(cpu, trial.cloth.mesh, trial.scene);
        const std::vector<Vector3d>& x = trial.cloth.start;
        const std::vector<Vector3d> still(x.size(), Vector3d::Zero());
        const std::vector<char> held(x.size());
        EXPECT_EQ(contact.prepare(x.data(), still.data(), held.data()), 1);
        contact.accept_iterate(x.data());
        force += force_on_upper(contact, trial, x, x).z() / places;
      }
      // At a fifth of the thickness it is 4.9 kPa.
      const double expected = 4903.3 * pressure(2 * fraction - 1) / pressure(0.6) * kLayerSide * kLayerSide;
      EXPECT_NEAR(force / expected, 1, 0.1) << triangles << " triangles, " << fraction << " of the thickness";
    }
}

// A sheet that is held by stretched stops is taken over the other's mesh, two edges far, with no slip of its
// stops: pair by pair the load goes to neighbours, and the stops' force with it.  (Where it was lost with
// each pair, 4 % of it were left.)
TEST(SelfContact, HandsTheStretchOfItsStopsToThePairsThatFollow) {
  const Trial trial = two_sheets(0.8 * Fabric{}.thickness, 400);
  Cpu cpu(1);
  SelfContact<double, Cpu> contact(cpu, trial.cloth.mesh, trial.scene);
  std::vector<Vector3d> x = trial.cloth.start, still(x.size(), Vector3d::Zero());
  const std::vector<char> held(x.size());
  const auto arrive = [&](const std::vector<Vector3d>& before) {
    ASSERT_EQ(contact.prepare(x.data(), still.data(), held.data()), 1);
    contact.accept_iterate(x.data());
    contact.update_lagged_friction(x.data());
    contact.commit(x.data(), before.data());
  };
  arrive(x);
  const double stretch = 0.6 * kElasticSlip * Fabric{}.thickness;
  std::vector<Vector3d> before = x;
  for (int i : upper_vertices(trial)) x[i].x() += stretch;
  arrive(before);
  const Vector3d first = force_on_upper(contact, trial, x, x);
  EXPECT_NEAR(-first.x() / first.z(), 0.6 * trial.scene.fabric.friction, 1e-3 * trial.scene.fabric.friction);
  for (int k = 0; k < 40; ++k) {
    for (int i : upper_vertices(trial)) x[i].y() += 2e-4;
    arrive(x);
  }
  const Vector3d last = force_on_upper(contact, trial, x, x);
  constexpr double kSlanted =
      0.05;  // what pairs beside those right above each other, whose planes differ, add
  EXPECT_NEAR(-last.x() / last.z() / (0.6 * trial.scene.fabric.friction), 1, kSlanted);
}

// Pairs that a path leaves too far apart are not looked at: on all of it the energies of the others are all.
TEST(SelfContact, MissesNoPairThatTouchesOnThePath) {
  const double thickness = Fabric{}.thickness, gap = 3 * thickness, end = 0.7 * thickness;
  const Trial trial = two_sheets(gap, 400);
  Cpu cpu(1);
  SelfContact<double, Cpu> contact(cpu, trial.cloth.mesh, trial.scene);
  std::vector<Vector3d> x = trial.cloth.start, direction(x.size(), Vector3d::Zero());
  for (int i : upper_vertices(trial)) direction[i] = {0.2 * gap, 0, end - gap};
  const std::vector<char> held(x.size());
  ASSERT_EQ(contact.prepare(x.data(), direction.data(), held.data()), 1);
  double last = 0;
  for (double fraction : {0.5, 0.9, 0.95, 1.0}) {
    std::vector<Vector3d> on_path = x, gradient(x.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < x.size(); ++i) on_path[i] += fraction * direction[i];
    contact.evaluate(on_path.data(), x.data(), gradient.data());
    const double energy = std::accumulate(contact.energies(), contact.energies() + contact.pairs(), 0.0);
    EXPECT_NEAR(energy, contact.stored_energy(on_path.data()), 1e-13 * energy) << fraction;
    EXPECT_EQ(energy > 0, fraction * (gap - end) > gap - thickness) << fraction;
    EXPECT_GE(energy, last);
    last = energy;
  }
}

// Below its stiffest gap the barrier goes on as a parabola: energy, slope and stiffness without a jump, and
// each the derivative of the one before it, to central differences' error.
TEST(Barrier, GoesOnSmoothlyWhereNextToNothingOfTheGapIsLeft) {
  const double k = 3, range = 2e-4, edge = kStiffest * range, h = 1e-4 * edge;
  const Barrier<double> above = barrier(k, edge * (1 + 1e-9), range),
                        below = barrier(k, edge * (1 - 1e-9), range);
  EXPECT_NEAR(above.energy / below.energy, 1, 1e-7);
  EXPECT_NEAR(above.slope / below.slope, 1, 1e-7);
  EXPECT_NEAR(above.stiffness / below.stiffness, 1, 1e-7);
  for (double gap : {0.5 * edge, -edge, 3 * edge}) {
    const Barrier<double> at = barrier(k, gap, range), more = barrier(k, gap + h, range),
                          less = barrier(k, gap - h, range);
    EXPECT_LT(at.slope, 0);
    EXPECT_NEAR((more.energy - less.energy) / (2 * h) / at.slope, 1, 1e-6);
    EXPECT_NEAR((more.slope - less.slope) / (2 * h) / at.stiffness, 1, 1e-6);
  }
}

// Half-way to the least distance the second barrier adds K R (ln 2 + 1/2) to the pressure, K and R its
// stiffness and range; it begins without a jump in pressure or stiffness, and above it is none.
TEST(Barrier, OfAPairThatIsCrushedEndsInAnotherBeforeTheLeastDistance) {
  SelfPair<double> pair{};
  pair.activation_distance = 1e-4;
  const double k = 3e7, range = (kLast - kClosest) * pair.activation_distance,
               begins = kLast * pair.activation_distance;
  const auto first = [&](double distance) {
    return barrier(k, distance - kHardest * pair.activation_distance,
                   (1 - kHardest) * pair.activation_distance);
  };
  EXPECT_EQ(pair_barrier(pair, k, begins).slope, first(begins).slope);
  const double just_below = begins - 1e-9 * range, middle = begins - range / 2;
  EXPECT_NEAR(pair_barrier(pair, k, just_below).slope / first(just_below).slope, 1, 1e-9);
  EXPECT_NEAR(pair_barrier(pair, k, just_below).stiffness / first(just_below).stiffness, 1, 1e-6);
  const double added = first(middle).slope - pair_barrier(pair, k, middle).slope;
  EXPECT_NEAR(added / (kLastStiff * k * range * (std::log(2.0) + 0.5)), 1, 1e-12);
  const double h = 1e-4 * range;
  const double fall = pair_barrier(pair, k, middle - h).energy - pair_barrier(pair, k, middle + h).energy;
  EXPECT_NEAR(-fall / (2 * h) / pair_barrier(pair, k, middle).slope, 1, 1e-6);
}

// The gradient is the energy's, through parallel edges as well; sums over all pairs vanish.
TEST(SelfContact, GradientIsTheEnergys) {
  Trial trial = two_sheets(0.8 * Fabric{}.thickness, 60);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-5e-5, 5e-5);
  for (int i : upper_vertices(trial))
    trial.cloth.start[i] += Vector3d(noise(random), noise(random), noise(random));
  Cpu cpu(1);
  SelfContact<double, Cpu> contact(cpu, trial.cloth.mesh, trial.scene);
  auto x = trial.cloth.start;
  const std::vector<Vector3d> still(x.size(), Vector3d::Zero());
  const std::vector<char> held(x.size());
  contact.prepare(x.data(), still.data(), held.data());
  contact.accept_iterate(x.data());
  std::vector<Vector3d> gradient(x.size(), Vector3d::Zero());
  contact.evaluate(x.data(), x.data(), gradient.data());
  Vector3d sum = Vector3d::Zero();
  double largest = 0;
  for (const Vector3d& g : gradient) {
    sum += g;
    largest = std::max(largest, g.norm());
  }
  EXPECT_LT(sum.norm(), 1e-9 * largest);
  constexpr double kTiny = 1e-9;
  for (int i : upper_vertices(trial))
    for (int c = 0; c < 3; ++c) {
      const double at = x[i][c];
      x[i][c] = at + kTiny;
      const double high = contact.stored_energy(x.data());
      x[i][c] = at - kTiny;
      const double low = contact.stored_energy(x.data());
      x[i][c] = at;
      EXPECT_NEAR((high - low) / (2 * kTiny), gradient[i][c], 1e-5 * largest) << i;
    }
}

// Two edges of 1 mm, a small angle from parallel and 0.7 mm apart: turning one about the normal changes
// nothing but the fade, and next to parallel the second derivative of its energy is all positive.
TEST(SelfContact, EdgesThatFadeResistTurningAsTheirEnergySays) {
  constexpr double kSide = 1e-3, kAngle = 1e-3, kTurn = 1e-5;
  SelfPair<double> pair{{0, 1, 2, 3}, 0, 1e-3, 1e-7, 1e-3 * std::pow(kSide, 4)};
  const SelfContactModel<double> model{1e6, 0, 0};
  const auto turned = [&](double angle) {
    const Vector3d half(kSide / 2 * std::cos(angle), kSide / 2 * std::sin(angle), 0), up(0, 0, 0.7e-3);
    return std::array{Vector3d(-kSide / 2, 0, 0), Vector3d(kSide / 2, 0, 0), Vector3d(up - half),
                      Vector3d(up + half)};
  };
  const auto touch = [&](double angle) { return self_touch(pair, model, turned(angle).data()); };
  const double curved =
      touch(kAngle + kTurn).energy - 2 * touch(kAngle).energy + touch(kAngle - kTurn).energy;
  const auto x = turned(kAngle), ahead = turned(kAngle + kTurn), behind = turned(kAngle - kTurn);
  ASSERT_TRUE(are_fading(pair, {x[0], x[1], x[2], x[3]}));
  const PairStiffness<double> stiffness = turning_stiffness(pair, touch(kAngle));
  std::array<Vector3d, 4> displacement;
  for (int k = 0; k < 4; ++k) displacement[k] = (ahead[k] - behind[k]) / 2;
  const Vector3d apart = stiffness.apart(displacement.data());
  const double work = apart.dot(stiffness.block * apart);
  constexpr double kNearParallel = 0.01;  // of the stiffness, at that angle
  EXPECT_NEAR(work / curved, 1, kNearParallel);
}

class SelfContactOf : public ::testing::TestWithParam<const char*> {};

TEST_P(SelfContactOf, CarriesASheetThatLandsOnAnother) {
  Trial trial = two_sheets(2e-3, 200);
  trial.scene.integrator = value_named<Integrator>(GetParam());
  const auto simulation = trial.after(60);
  const auto x = simulation->positions();
  for (int i : upper_vertices(trial)) {
    EXPECT_GT(x[i].z(), Fabric{}.thickness / 2);
    EXPECT_LT(x[i].z(), 1.5 * Fabric{}.thickness);
  }
  EXPECT_TRUE(intersecting_triangles(trial.cloth.mesh.face, x).empty());
  const Ledger ledger = simulation->ledger();
  EXPECT_LT(ledger.remainder_relative, 1e-9);
  EXPECT_GT(ledger.contact_friction, -1e-12);
}

INSTANTIATE_TEST_SUITE_P(Integrators, SelfContactOf, ::testing::Values("implicit", "bdf2", "semi-implicit"),
                         test::CaseName());

TEST(SelfContact, NeedsAnIntegratorThatSolvesForContact) {
  Scene scene = test::free_square(40);
  scene.self_contact = true;
  scene.integrator = Integrator::explicit_euler;
  EXPECT_THROW(Trial(scene).simulation(), Error);
  scene.integrator = Integrator::semi_implicit;
  scene.implicit_every = ImplicitEvery::step;
  EXPECT_THROW(Trial(scene).simulation(), Error);
}

}  // namespace
}  // namespace hysteron
