// These tests check the orthotropic membrane of one triangle, and of a cloth.
#include "sim/membrane/green_lagrange.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <random>

#include "sim/membrane/membrane.h"
#include "tests/sim/linear/dense.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;
using Stiffness = MembraneStiffness<double>;
using Block9 = Eigen::Matrix<double, 9, 9>;

constexpr Stiffness kOrthotropic{1000, 600, 150, 60};
// The result takes a few dozen operations on numbers of order one.
constexpr double kRounding = 1e-13;
constexpr double kOrderSlack = 0.05;

// Returns one skew triangle in the plane, warp along x; lengths are of order one.
ClothMesh triangle() {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1.1, 0.2, 0}, {0.3, 0.9, 0}};
  mesh.face = {{0, 1, 2}};
  build_topology(mesh, "one triangle");
  return mesh;
}
MembraneRest<double> rest() { return membrane_rest(triangle())[0]; }

// Images of the triangle under the plane map (warp, weft) -> m, turned into space.
Corners mapped(const Eigen::Matrix2d& m) {
  const Matrix3d turn = Eigen::AngleAxisd(0.9, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Corners x;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d p = m * triangle().rest[k].head<2>();
    x[k] = turn * Vector3d(p.x(), p.y(), 0) + Vector3d(0.4, -0.3, 0.8);
  }
  return x;
}
Corners stretched() { return mapped((Eigen::Matrix2d() << 1.2, 0.1, 0.05, 1.15).finished()); }
Corners compressed() { return mapped((Eigen::Matrix2d() << 0.8, 0.1, -0.05, 0.7).finished()); }

double energy(const Corners& x) {
  return rest().area * membrane_energy(kOrthotropic, green_strain(deformation(rest(), x[0], x[1], x[2])));
}
Corners forces(const Corners& x) {
  const auto f = deformation(rest(), x[0], x[1], x[2]);
  const auto s = membrane_stress(kOrthotropic, green_strain(f));
  return {membrane_force(rest(), f, s, 0), membrane_force(rest(), f, s, 1), membrane_force(rest(), f, s, 2)};
}
// -df/dx with the geometric part of the stress that `tension` leaves.
Block9 stiffness(const Corners& x) {
  const auto f = deformation(rest(), x[0], x[1], x[2]);
  const auto tension = tensile_part(membrane_stress(kOrthotropic, green_strain(f)));
  Block9 k;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      k.block<3, 3>(3 * i, 3 * j) = membrane_block(rest(), kOrthotropic, 1.0, f, tension, i, j);
  return k;
}
Corners shifted(Corners x, int coordinate, double by) {
  x[coordinate / 3][coordinate % 3] += by;
  return x;
}

double force_error(const Corners& x, double h) {
  double error = 0;
  const Corners f = forces(x);
  for (int c = 0; c < 9; ++c) {
    const double slope = (energy(shifted(x, c, h)) - energy(shifted(x, c, -h))) / (2 * h);
    error += std::pow(slope + f[c / 3][c % 3], 2);
  }
  return std::sqrt(error);
}

double stiffness_error(const Corners& x, double h) {
  Block9 difference;
  for (int c = 0; c < 9; ++c) {
    const Corners plus = forces(shifted(x, c, h)), minus = forces(shifted(x, c, -h));
    for (int i = 0; i < 3; ++i) difference.block<3, 1>(3 * i, c) = -(plus[i] - minus[i]) / (2 * h);
  }
  return (difference - stiffness(x)).norm();
}

TEST(Membrane, ForceIsMinusTheEnergysGradientToSecondOrder) {
  for (const Corners& x : {stretched(), compressed()}) {
    ASSERT_GT(forces(x)[0].norm(), 1);
    EXPECT_NEAR(std::log2(force_error(x, 1e-2) / force_error(x, 5e-3)), 2, kOrderSlack);
  }
}

TEST(Membrane, StretchedStiffnessIsMinusTheForcesDerivativeToSecondOrder) {
  ASSERT_GT(stiffness(stretched()).norm(), 1);
  EXPECT_NEAR(std::log2(stiffness_error(stretched(), 1e-2) / stiffness_error(stretched(), 5e-3)), 2,
              kOrderSlack);
  EXPECT_LT(stiffness_error(stretched(), 1e-4), 1e-6 * stiffness(stretched()).norm());
}

TEST(Membrane, StiffnessIsSymmetricAndPositiveSemidefiniteEvenUnderCompression) {
  for (const Corners& x : {stretched(), compressed()}) {
    const Block9 k = stiffness(x);
    EXPECT_LT((k - k.transpose()).norm(), kRounding * k.norm());
    EXPECT_GE(test::eigenvalues(k)[0], -kRounding * k.norm());
  }
  // The true derivative is not: compression buckles.
  EXPECT_GT(stiffness_error(compressed(), 1e-4), 0.01 * stiffness(compressed()).norm());
}

TEST(Membrane, TensilePartIsTheNearestPositiveSemidefiniteStress) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int mixed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const MembraneStress<double> s{uniform(generator), uniform(generator), uniform(generator)};
    const Eigen::Matrix2d full = (Eigen::Matrix2d() << s.s11, s.s12, s.s12, s.s22).finished();
    mixed += s.s11 * s.s22 < s.s12 * s.s12;
    const Eigen::Matrix2d expected = test::positive_part(full);
    const auto t = tensile_part(s);
    EXPECT_NEAR(t.s11, expected(0, 0), 10 * kRounding);
    EXPECT_NEAR(t.s22, expected(1, 1), 10 * kRounding);
    EXPECT_NEAR(t.s12, expected(0, 1), 10 * kRounding);
  }
  EXPECT_GT(mixed, 20);
}

TEST(Membrane, RigidMotionCostsNothingAndTurnsTheForces) {
  EXPECT_LT(energy(mapped(Eigen::Matrix2d::Identity())), kRounding);
  const Matrix3d turn = Eigen::AngleAxisd(2.5, Vector3d(0.3, -1, 0.7).normalized()).toRotationMatrix();
  const Corners x = stretched();
  Corners moved;
  for (int k = 0; k < 3; ++k) moved[k] = turn * x[k] + Vector3d(1, 2, 3);
  EXPECT_NEAR(energy(moved), energy(x), 100 * kRounding * energy(x));
  for (int k = 0; k < 3; ++k)
    EXPECT_LT((forces(moved)[k] - turn * forces(x)[k]).norm(), 100 * kRounding * forces(x)[k].norm());
}

TEST(Membrane, ForcesHaveNoResultantAndNoTorque) {
  for (const Corners& x : {stretched(), compressed()}) {
    const Corners f = forces(x);
    const double size = f[0].norm() + f[1].norm() + f[2].norm();
    ASSERT_GT(size, 1);
    EXPECT_LT((f[0] + f[1] + f[2]).norm(), kRounding * size);
    EXPECT_LT((x[0].cross(f[0]) + x[1].cross(f[1]) + x[2].cross(f[2])).norm(), 10 * kRounding * size);
  }
}

// F = diag(1 + e, 1) has E11 = e + e^2/2 alone, so that S11 = C11 E11, S22 = C12 E11, S12 = 0; weft likewise.
TEST(Membrane, UniaxialStretchMeetsTheStiffnessOfItsOwnDirection) {
  constexpr double e = 0.1, strain = e + e * e / 2;
  const auto stretch_stress = [](double warp, double weft, double shear) {
    const Corners x = mapped((Eigen::Matrix2d() << warp, shear, 0, weft).finished());
    return membrane_stress(kOrthotropic, green_strain(deformation(rest(), x[0], x[1], x[2])));
  };
  const auto warp = stretch_stress(1 + e, 1, 0), weft = stretch_stress(1, 1 + e, 0),
             shear = stretch_stress(1, 1, e);
  const double slack = kRounding * kOrthotropic.warp;
  EXPECT_NEAR(warp.s11, kOrthotropic.warp * strain, slack);
  EXPECT_NEAR(warp.s22, kOrthotropic.coupling * strain, slack);
  EXPECT_NEAR(warp.s12, 0, slack);
  EXPECT_NEAR(weft.s22, kOrthotropic.weft * strain, slack);
  EXPECT_NEAR(weft.s11, kOrthotropic.coupling * strain, slack);
  // Simple shear x = X + e Y has 2 E12 = e, E22 = e^2/2.
  EXPECT_NEAR(shear.s12, kOrthotropic.shear * e, slack);
  EXPECT_NEAR(shear.s22, kOrthotropic.weft * e * e / 2, slack);
}

TEST(Membrane, WarpDirectionOfTheMeshTurnsTheOrthotropy) {
  ClothMesh mesh = triangle();
  constexpr double kTurn = 0.7, e = 0.05;
  mesh.warp_axis = {std::cos(kTurn), std::sin(kTurn), 0};
  const auto r = membrane_rest(mesh)[0];
  const Matrix3d stretch = Matrix3d::Identity() + e * mesh.warp_axis * mesh.warp_axis.transpose();
  const auto s = membrane_stress(
      kOrthotropic, green_strain(deformation<double>(r, stretch * mesh.rest[0], stretch * mesh.rest[1],
                                                     stretch * mesh.rest[2])));
  EXPECT_NEAR(s.s11, kOrthotropic.warp * (e + e * e / 2), kRounding * kOrthotropic.warp);
  EXPECT_NEAR(s.s12, 0, kRounding * kOrthotropic.warp);
}

// Standing longitudinal waves of a bar of n elements with lumped masses, held at one end: the highest
// frequency tends to omega = (2/h) sqrt(C11/sigma); a sheet of several rows can only be stiffer.
TEST(Membrane, SpectralRadiusBoundsTheHighestFrequencyOfABar) {
  Fabric fabric;
  const ClothMesh mesh = make_grid(1, 1, 10, 10, MeshFamily::aligned, 1);
  std::vector<double> mass;
  for (double area : mesh.vertex_area) mass.push_back(fabric.density * area);
  const double bar = 4 * fabric.warp / fabric.density * 100;  // (2/h)^2 C11/sigma, h = 1/10
  const double radius = membrane_spectral_radius(mesh, fabric, MembraneElement::constant, mass,
                                                 std::vector<char>(mesh.vertices()));
  EXPECT_GT(radius, bar);
  EXPECT_LT(radius, 6 * bar);  // shear and lighter corners add to it, no more
}

}  // namespace
}  // namespace hysteron
