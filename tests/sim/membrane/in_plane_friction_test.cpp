// These tests check in-plane friction of a few triangles: loops, losses, derivatives.
#include "sim/membrane/in_plane_friction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/sim/linear/dense.h"
#include "tests/sim/membrane/sheet.h"

namespace hysteron {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Positions = test::Sheet::Positions;

constexpr double kSide = 0.1;                // [m]
constexpr double kFrictionRounding = 1e-12;  // of some hundred operations, relative
constexpr double kFrictionOrderSlack = 0.05;

Fabric rubbing() {
  Fabric fabric;
  fabric.coupling = 150;
  fabric.in_plane = {{{0.004, 0.02}, {300, 80}}, {{0.003}, {200}}, {{0.005, 0.02, 0.05}, {90, 40, 20}}};
  return fabric;
}

// The same with limits of shear that grow, by less than would make the sheet unstable; differences below keep
// clear of where a stop begins to slip.
Fabric rubbing_more_with_shear() {
  Fabric fabric = rubbing();
  fabric.in_plane.shear_growth = 10;
  return fabric;
}

// The square has two triangles, warp along x.
struct Square : test::Sheet {
  explicit Square(const Fabric& fabric = rubbing())
      : Sheet(make_grid(kSide, kSide, 1, 1, MeshFamily::aligned, 1), fabric, MembraneElement::constant) {}

  // Images under the plane map (warp, weft) -> m, turned into space.
  Positions mapped(const Matrix2d& m, double turn = 0) const {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(turn, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    Positions x;
    for (const Vector3d& p : mesh.rest) {
      const Eigen::Vector2d q = m * p.head<2>();
      x.push_back(rotation * Vector3d(q.x(), q.y(), 0));
    }
    return x;
  }
  Positions sheared(double gamma) const { return mapped((Matrix2d() << 1, gamma, 0, 1).finished()); }

  void accept(const Positions& x) { membrane.commit_friction(x.data()); }
  double potential(const Positions& x) {
    try_at(x);
    return energy();
  }
  Positions forces(const Positions& x) {
    try_at(x);
    return Sheet::forces();
  }
  // Returns the force on the upper edge along x, over its length; of the lateral stress 2 E12 alone at x = X
  // + gamma Y.
  double shear_force(double gamma) {
    const Positions x = sheared(gamma), f = forces(x);
    double force = 0;
    for (int i = 0; i < mesh.vertices(); ++i)
      if (mesh.rest[i].y() > kSide / 2) force -= f[i].x();
    // The force is S12 + gamma S22, the latter of E22 = gamma^2/2: elastic and of its stop.
    const double e22 = gamma * gamma / 2;
    const double s22 = fabric.weft * e22 + fabric.in_plane.weft.friction_at(e22);
    return force / kSide - gamma * s22;
  }
  MatrixXd matrix(const Positions& x) {
    try_at(x);
    return Sheet::matrix();
  }
};

Positions moved(Positions x, int coordinate, double by) {
  x[coordinate / 3][coordinate % 3] += by;
  return x;
}

// Masing (1926): the virgin curve f, then twice f of half the way from the last reversal; a full loop loses
// 4 sum p r (A - r).  The weft's stop does not slip: E22 = gamma^2/2 stays below its threshold.
TEST(InPlaneFriction, OfASquareInShearIsTheMasingLoopOfItsStops) {
  Square square;
  const Spectrum& stops = square.fabric.in_plane.shear;
  constexpr double kAmplitude = 0.07;
  constexpr int kRows = 29;  // of each branch
  double reversal = 0, at_reversal = 0, loss_before_last_loop = 0;
  const double turns[] = {kAmplitude, -kAmplitude, kAmplitude, -kAmplitude, kAmplitude};
  for (int branch = 0; branch < 5; ++branch) {
    for (int row = 1; row <= kRows; ++row) {
      const double gamma = reversal + (turns[branch] - reversal) * row / kRows;
      const double increment = std::abs(gamma - reversal), sign = branch % 2 ? -1 : 1;
      const double expected = branch == 0 ? stops.friction_at(increment)
                                          : at_reversal + sign * 2 * stops.friction_at(increment / 2);
      EXPECT_NEAR(square.shear_force(gamma), square.fabric.shear * gamma + expected,
                  kFrictionRounding * stops.friction_moment())
          << branch << " " << row;
      square.accept(square.sheared(gamma));
      if (row < kRows) continue;
      reversal = gamma;
      at_reversal = expected;
    }
    if (branch == 2) loss_before_last_loop = square.membrane.friction_loss();
  }
  const double loop = square.membrane.friction_loss() - loss_before_last_loop;
  const double area = kSide * kSide * stops.loop_area(kAmplitude);
  EXPECT_GT(area, 1e-4 * kSide * kSide);
  EXPECT_NEAR(loop, area, kFrictionRounding * area);
}

// Loading, a smaller loop, and on: the force is as if there had been no smaller loop.
TEST(InPlaneFriction, RemembersWhereItTurnedAfterASmallerLoop) {
  Square once, twice;
  for (double gamma : {0.04, 0.02, 0.04, 0.05}) twice.accept(twice.sheared(gamma));
  once.accept(once.sheared(0.05));
  const double expected = once.shear_force(0.03);
  EXPECT_NEAR(twice.shear_force(0.03), expected, kFrictionRounding * std::abs(expected));
  EXPECT_GT(twice.membrane.friction_loss(), once.membrane.friction_loss());
}

// Work of the stress over a step is what is stored and lost more: the potential of a step from an accepted
// state starts at what is stored there, and ends at what is stored and lost.
class SquareInPlaneFriction : public testing::TestWithParam<bool> {
 protected:
  Fabric fabric() const { return GetParam() ? rubbing_more_with_shear() : rubbing(); }
};
INSTANTIATE_TEST_SUITE_P(Limits, SquareInPlaneFriction, testing::Bool(),
                         [](const auto& test) { return test.param ? "Growing" : "Constant"; });

TEST_P(SquareInPlaneFriction, LosesOnAnyWayWhatItsPotentialSaysAndNeverGivesBack) {
  Square square(fabric());
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-0.06, 0.06);
  double lost = 0;
  for (int step = 0; step < 40; ++step) {
    const Matrix2d m = Matrix2d::Identity() + (Matrix2d() << uniform(generator), uniform(generator),
                                               uniform(generator), uniform(generator))
                                                  .finished();
    const Positions x = square.mapped(m);
    const double potential = square.potential(x);
    square.accept(x);
    const double now = square.membrane.friction_loss();
    EXPECT_GE(now, lost);
    const double stored = square.membrane.stored_energy(x.data());
    EXPECT_NEAR(potential, stored + now - lost, kFrictionRounding * potential);
    lost = now;
  }
  EXPECT_GT(lost, 0);
}

TEST(InPlaneFriction, TurnsWithTheClothAndLosesNothingByThat) {
  Square still, turned;
  for (double scale : {1.0, -0.6, 0.3}) {
    const Matrix2d m = Matrix2d::Identity() + scale * (Matrix2d() << 0.03, 0.05, 0.01, -0.02).finished();
    still.accept(still.mapped(m));
    turned.accept(turned.mapped(m, 0.4));
    turned.accept(turned.mapped(m, 2.5));
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(2.5, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    const Positions a = still.forces(still.mapped(m)), b = turned.forces(turned.mapped(m, 2.5));
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LT((b[i] - rotation * a[i]).norm(), 100 * kFrictionRounding * a[i].norm());
  }
  EXPECT_GT(still.membrane.friction_loss(), 0);
  EXPECT_NEAR(turned.membrane.friction_loss(), still.membrane.friction_loss(),
              100 * kFrictionRounding * still.membrane.friction_loss());
}

// Steps begin from a history in which some stops slip and some hold.
struct Dragged : Square {
  Positions x;
  explicit Dragged(const Fabric& fabric) : Square(fabric) {
    accept(mapped((Matrix2d() << 1.03, 0.06, 0.0, 1.01).finished()));
    x = mapped((Matrix2d() << 1.06, 0.03, 0.01, 1.05).finished(), 0.7);
  }
  double force_error(double h) {
    const Positions f = forces(x);
    double error = 0;
    for (int c = 0; c < 3 * mesh.vertices(); ++c) {
      const double slope = (potential(moved(x, c, h)) - potential(moved(x, c, -h))) / (2 * h);
      error += std::pow(slope + f[c / 3][c % 3], 2);
    }
    return std::sqrt(error);
  }
  double matrix_error(double h) {
    const int n = mesh.vertices();
    MatrixXd difference(3 * n, 3 * n);
    for (int c = 0; c < 3 * n; ++c) {
      const Positions plus = forces(moved(x, c, h)), minus = forces(moved(x, c, -h));
      for (int i = 0; i < n; ++i) difference.block<3, 1>(3 * i, c) = -(plus[i] - minus[i]) / (2 * h);
    }
    return (difference - matrix(x)).norm();
  }
};

TEST_P(SquareInPlaneFriction, ForceIsMinusThePotentialsGradientToSecondOrder) {
  Dragged cloth(fabric());
  ASSERT_GT(cloth.forces(cloth.x)[0].norm(), 0.1);
  EXPECT_NEAR(std::log2(cloth.force_error(2e-4) / cloth.force_error(1e-4)), 2, kFrictionOrderSlack);
}

TEST_P(SquareInPlaneFriction, MatrixIsMinusTheForcesDerivativeToSecondOrderInTension) {
  Dragged cloth(fabric());
  ASSERT_GT(cloth.matrix(cloth.x).norm(), 1);
  EXPECT_NEAR(std::log2(cloth.matrix_error(2e-4) / cloth.matrix_error(1e-4)), 2, kFrictionOrderSlack);
}

TEST_P(SquareInPlaneFriction, MatrixIsSymmetricAndPositiveSemidefiniteEvenUnderCompression) {
  Dragged cloth(fabric());
  for (const Positions& x : {cloth.x, cloth.mapped((Matrix2d() << 0.9, 0.05, -0.02, 0.85).finished())}) {
    const MatrixXd k = cloth.matrix(x);
    EXPECT_LT((k - k.transpose()).norm(), kFrictionRounding * k.norm());
    EXPECT_GE(test::eigenvalues(k)[0], -kFrictionRounding * k.norm());
  }
}

// Stops that hold are springs: the explicit limit is that of the stiffness with all of them.
TEST(InPlaneFriction, StiffensTheHighestFrequencyAsSpringsDo) {
  const Fabric fabric = rubbing();
  Fabric springs = fabric;
  springs.in_plane = {};
  springs.warp += fabric.in_plane.warp.stiffness();
  springs.weft += fabric.in_plane.weft.stiffness();
  springs.shear += fabric.in_plane.shear.stiffness();
  const ClothMesh mesh = make_grid(kSide, kSide, 3, 3, MeshFamily::aligned, 1);
  const std::vector<double> mass(mesh.vertices(), 1e-4);
  const std::vector<char> held(mesh.vertices());
  EXPECT_EQ(membrane_spectral_radius(mesh, fabric, MembraneElement::constant, mass, held),
            membrane_spectral_radius(mesh, springs, MembraneElement::constant, mass, held));
}

}  // namespace
}  // namespace hysteron
