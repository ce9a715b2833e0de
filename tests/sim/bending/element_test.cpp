// The bending elements are linear maps from small deflections to curvature, on every mesh family.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/bending/angle.h"
#include "sim/bending/curvature_operator.h"
#include "tests/sim/linear/dense.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

// Second differences of z over edges of 1/20 of the cloth amplify rounding some thousandfold, and the fit of
// H by the inverse of its smallest singular value.
constexpr double kReproduced = 1e-10;
constexpr int kDirections = 24;

// Returns the rate of the angles by the vertices' height at rest, hinges x vertices [1/m].
MatrixXd angle_rates(const ClothMesh& mesh) {
  MatrixXd rate = MatrixXd::Zero(mesh.interior_edges, mesh.vertices());
  for (int h = 0; h < mesh.interior_edges; ++h) {
    const Edge& e = mesh.edge[h];
    const auto a = dihedral_angle<double>(mesh.rest[e.p0], mesh.rest[e.p1], mesh.rest[e.p2], mesh.rest[e.p3]);
    const double g0 = a.g0.z(), g1 = a.g1.z();
    rate(h, e.p0) += g0;
    rate(h, e.p1) += g1;
    rate(h, e.p2) -= (1 - a.t0) * g0 + (1 - a.t1) * g1;
    rate(h, e.p3) -= a.t0 * g0 + a.t1 * g1;
  }
  return rate;
}

// Returns C, (D x elements) x hinges [1/m].
MatrixXd dense(const CurvatureOperator& op, int hinges) {
  const int d = op.dimension;
  MatrixXd c = MatrixXd::Zero(d * op.elements(), hinges);
  for (int i = 0; i < op.elements(); ++i)
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j)
      for (int k = 0; k < d; ++k) c(d * i + k, op.hinge.item[j]) += op.coefficient[d * j + k];
  return c;
}

// Returns J^T C^T A C J, the stiffness against small deflections for a rigidity of one.
MatrixXd stiffness(const ClothMesh& mesh, const CurvatureOperator& op) {
  const MatrixXd cj = dense(op, mesh.interior_edges) * angle_rates(mesh);
  VectorXd area(cj.rows());
  for (int i = 0; i < area.size(); ++i) area[i] = op.area[i / op.dimension];
  return cj.transpose() * area.asDiagonal() * cj;
}

// Returns heights z = x^T H x/2, H = (H_xx, H_yy, sqrt2 H_xy).
VectorXd uniformly_bent(const ClothMesh& mesh, const Vector3d& h) {
  VectorXd z(mesh.vertices());
  for (int i = 0; i < mesh.vertices(); ++i) {
    const double x = mesh.rest[i].x(), y = mesh.rest[i].y();
    z[i] = (h[0] * x * x + h[1] * y * y) / 2 + h[2] * x * y / std::sqrt(2.0);
  }
  return z;
}

Vector3d cylinder(double direction) {
  const double c = std::cos(direction), s = std::sin(direction);
  return {c * c, s * s, std::sqrt(2.0) * c * s};
}

bool has_free_edge(const ClothMesh& mesh, int face) {
  for (int e : mesh.face_edge[face])
    if (e >= mesh.interior_edges) return true;
  return false;
}

std::vector<char> none_held(const ClothMesh& mesh) { return std::vector<char>(mesh.vertices()); }
std::vector<char> boundary_held(const ClothMesh& mesh) {
  std::vector<char> held(mesh.vertices());
  for (std::size_t e = mesh.interior_edges; e < mesh.edge.size(); ++e)
    held[mesh.edge[e].p2] = held[mesh.edge[e].p3] = 1;
  return held;
}

// S - H over all faces without a free edge, for each of three independent uniform curvatures.
double reproduction_error(const ClothMesh& mesh) {
  const MatrixXd c = dense(make_shape_operator(mesh, none_held(mesh)), mesh.interior_edges);
  const MatrixXd rate = angle_rates(mesh);
  double worst = 0;
  int faces = 0;
  for (int component = 0; component < 3; ++component) {
    const Vector3d h = Vector3d::Unit(component);
    const VectorXd s = c * (rate * uniformly_bent(mesh, h));
    for (int f = 0; f < mesh.faces(); ++f) {
      if (has_free_edge(mesh, f)) continue;
      worst = std::max(worst, (s.segment<3>(3 * f) - h).norm());
      ++faces;
    }
  }
  EXPECT_GT(faces, mesh.faces());  // a third of it for each component
  return worst;
}

class Family : public ::testing::TestWithParam<MeshFamily> {};
INSTANTIATE_TEST_SUITE_P(Meshes, Family, ::testing::ValuesIn(test::kFamilies), test::CaseName());

TEST_P(Family, ShapeReproducesUniformCurvatureOnInteriorFacesOfARectangle) {
  EXPECT_LT(reproduction_error(make_rectangle(1, 0.8, 300, GetParam(), 4)), kReproduced);
}

TEST_P(Family, ShapeReproducesUniformCurvatureOnInteriorFacesOfADisc) {
  EXPECT_LT(reproduction_error(make_disc(0.5, 300, GetParam(), 4)), kReproduced);
}

TEST_P(Family, ShapeCarriesNoMomentAcrossAFreeEdge) {
  const ClothMesh mesh = make_rectangle(1, 0.8, 300, GetParam(), 4);
  const MatrixXd c = dense(make_shape_operator(mesh, boundary_held(mesh)), mesh.interior_edges);
  // Held all around: nothing is projected away.
  const MatrixXd projected = dense(make_shape_operator(mesh, none_held(mesh)), mesh.interior_edges);
  for (int f = 0; f < mesh.faces(); ++f) {
    if (!has_free_edge(mesh, f)) {
      EXPECT_EQ((c.middleRows<3>(3 * f) - projected.middleRows<3>(3 * f)).norm(), 0) << f;
    }
    for (int k = 0; k < 3; ++k) {
      const int e = mesh.face_edge[f][k];
      if (e < mesh.interior_edges) continue;
      const Vector3d along = (mesh.rest[mesh.edge[e].p3] - mesh.rest[mesh.edge[e].p2]).normalized();
      const Vector3d across =
          cylinder(std::atan2(along.x(), -along.y()));  // normal x normal of the free edge
      EXPECT_LT((across.transpose() * projected.middleRows<3>(3 * f)).norm(),
                kReproduced * projected.middleRows<3>(3 * f).norm())
          << f;
    }
  }
}

// Bias, weft and warp are met, and in between nu^T Q nu (CurvatureOperator).
TEST_P(Family, StiffenedShapeGivesEachDirectionItsRigidity) {
  constexpr double kWeft = 0.6, kBias = 0.7;
  const ClothMesh mesh = make_rectangle(1, 0.8, 300, GetParam(), 4);
  CurvatureOperator op = make_shape_operator(mesh, none_held(mesh));
  stiffen(op, mesh, kWeft, kBias);
  const MatrixXd c = dense(op, mesh.interior_edges), rate = angle_rates(mesh);
  const auto rigidity = [&](double direction) {
    const VectorXd s = c * (rate * uniformly_bent(mesh, cylinder(direction)));
    double energy = 0, plate = 0;
    for (int f = 0; f < mesh.faces(); ++f) {
      if (has_free_edge(mesh, f)) continue;
      energy += mesh.face_area[f] * s.segment<3>(3 * f).squaredNorm();
      plate += mesh.face_area[f];
    }
    return energy / plate;
  };
  EXPECT_NEAR(rigidity(0), 1, 2 * kReproduced);
  EXPECT_NEAR(rigidity(pi / 2), kWeft, 2 * kReproduced);
  for (const double bias : {pi / 4, 3 * pi / 4}) EXPECT_NEAR(rigidity(bias), kBias, 2 * kReproduced);
  const Vector3d q(1, kWeft, 2 * kBias - (1 + kWeft) / 2), between = cylinder(0.4);
  EXPECT_NEAR(rigidity(0.4), between.dot(q.cwiseProduct(between)), 2 * kReproduced);
}

TEST(StiffenedHinge, HasTheRigidityAcrossItsEdge) {
  const ClothMesh mesh = make_grid(1, 1, 2, 2, MeshFamily::aligned, 0);  // edges along warp, weft and bias
  const CurvatureOperator plain = make_hinge_operator(mesh);
  CurvatureOperator op = plain;
  stiffen(op, mesh, 0.6, 0.7);
  for (int e = 0; e < mesh.interior_edges; ++e) {
    const Vector3d along = mesh.rest[mesh.edge[e].p3] - mesh.rest[mesh.edge[e].p2];
    const double expected = std::abs(along.y()) < 1e-9 ? 0.6 : std::abs(along.x()) < 1e-9 ? 1 : 0.7;
    const double factor = op.coefficient[e] / plain.coefficient[e];
    EXPECT_NEAR(factor * factor, expected, kReproduced) << along.transpose();
    EXPECT_EQ(op.metric[e], factor);
    EXPECT_EQ(op.transposed[op.element.start[e]], op.coefficient[e]);
  }
}

// The metric is Q = (1, 0.6, 0.6), so that nu = (1/2, 1/2, sqrt(1/2)) on the bias.
TEST(DirectedHinge, HasTheComponentsOfABendAcrossItsEdge) {
  const ClothMesh mesh = make_grid(1, 1, 2, 2, MeshFamily::aligned, 0);  // edges along warp, weft and bias
  CurvatureOperator op = make_hinge_operator(mesh);
  set_directions(op, mesh, 0.6, 0.7);
  ASSERT_EQ(op.direction.size(), 2u * mesh.interior_edges);
  for (int e = 0; e < mesh.interior_edges; ++e) {
    const Vector3d along = mesh.rest[mesh.edge[e].p3] - mesh.rest[mesh.edge[e].p2];
    const bool on_warp = std::abs(along.y()) < 1e-9, on_weft = std::abs(along.x()) < 1e-9;
    EXPECT_NEAR(op.direction[2 * e], on_warp ? 0 : on_weft ? 1 : 0.25 / 0.7, kReproduced);
    EXPECT_NEAR(op.direction[2 * e + 1], on_warp ? 1 : on_weft ? 0 : 0.25 * 0.6 / 0.7, kReproduced);
  }
}

// Deflections that cost no energy, of a free cloth.  Zero among eigenvalues: rounding of the largest one.
TEST_P(Family, ShapeHasNoNullModesBesideTheRigidOnes) {
  constexpr double kZero = 1e-12;
  constexpr int kRigid = 3;  // one translation, two small rotations
  for (const int triangles : {40, 120}) {
    const ClothMesh mesh = make_rectangle(1, 1, triangles, GetParam(), 2);
    const VectorXd free = test::eigenvalues(stiffness(mesh, make_shape_operator(mesh, none_held(mesh))));
    const double largest = free[free.size() - 1];
    EXPECT_LT(free[kRigid - 1], kZero * largest);
    EXPECT_GT(free[kRigid], 1e3 * kZero * largest) << triangles << " " << free.head(8).transpose() / largest;
  }
}

// A square plate supported all around: omega = 2 pi^2 sqrt(B/(sigma L^4)) (Navier 1820; Leissa 1969).  One
// held row of vertices supports without clamping.  A mode that costs less than it should would lie far below.
TEST_P(Family, ShapeSupportedPlateVibratesAtItsLowestFrequency) {
  constexpr double kNavier = 2 * pi * pi;
  constexpr double kCoarse = 0.05;  // eleven cells along a side
  const ClothMesh mesh = make_rectangle(1, 1, 242, GetParam(), 2);
  const std::vector<char> held = boundary_held(mesh);
  const MatrixXd k = stiffness(mesh, make_shape_operator(mesh, held));
  std::vector<int> inner;
  for (int i = 0; i < mesh.vertices(); ++i)
    if (!held[i]) inner.push_back(i);
  const int n = static_cast<int>(inner.size());
  MatrixXd scaled(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      scaled(i, j) =
          k(inner[i], inner[j]) / std::sqrt(mesh.vertex_area[inner[i]] * mesh.vertex_area[inner[j]]);
  const double omega = std::sqrt(test::eigenvalues(scaled)[0]);
  EXPECT_NEAR(omega / kNavier, 1, kCoarse);
}

TEST_P(Family, TransposedRowsAreTheForwardRows) {
  const ClothMesh mesh = make_rectangle(1, 0.8, 100, GetParam(), 4);
  for (const char* element : {"hinge", "shape"}) {
    const CurvatureOperator op =
        make_curvature_operator(value_named<BendingElement>(element), mesh, none_held(mesh));
    const int d = op.dimension;
    MatrixXd back = MatrixXd::Zero(d * op.elements(), mesh.interior_edges);
    for (int h = 0; h < mesh.interior_edges; ++h)
      for (int j = op.element.start[h]; j < op.element.start[h + 1]; ++j)
        for (int k = 0; k < d; ++k) back(d * op.element.item[j] + k, h) += op.transposed[d * j + k];
    ASSERT_GT(back.norm(), 1);
    EXPECT_EQ(back, dense(op, mesh.interior_edges)) << element;
  }
}

TEST_P(Family, RestShapeHasNoCurvatureWhateverItsAngles) {
  ClothMesh mesh = make_rectangle(1, 0.8, 100, GetParam(), 4);
  for (Vector3d& x : mesh.rest) x.z() = 0.1 * std::sin(5 * x.x() + 3 * x.y());
  build_topology(mesh, "curved rest shape");
  const auto angles = hinge_angles(mesh, mesh.rest);
  for (const char* element : {"hinge", "shape"})
    EXPECT_EQ(make_curvature_operator(value_named<BendingElement>(element), mesh, none_held(mesh)).rest_angle,
              angles);
}

// Returns the energy of a cylinder over the plate's on the hinges of a few whole periods of a grid.
double hinge_ratio(const ClothMesh& mesh, double direction, const Vector2d& low, const Vector2d& high) {
  const VectorXd k = dense(make_hinge_operator(mesh), mesh.interior_edges) *
                     (angle_rates(mesh) * uniformly_bent(mesh, cylinder(direction)));
  const CurvatureOperator op = make_hinge_operator(mesh);
  double energy = 0;
  for (int h = 0; h < mesh.interior_edges; ++h) {
    const Vector2d middle = (mesh.rest[mesh.edge[h].p2] + mesh.rest[mesh.edge[h].p3]).head<2>() / 2;
    if ((middle.array() < low.array()).any() || (middle.array() > high.array()).any()) continue;
    energy += op.area[h] * k[h] * k[h] / 2;
  }
  return energy / ((high - low).prod() / 2);
}

// Eight cells of 1/8; the window of 4 x 4 cells ends a quarter of a cell before grid lines.
double grid_ratio(MeshFamily family, double direction) {
  return hinge_ratio(make_grid(1, 1, 8, 8, family, 1), direction, Vector2d::Constant(1.75 / 8),
                     Vector2d::Constant(5.75 / 8));
}

// With theta of z = x^T H x/2 for the edges of a cut square (header of sim/bending/shape_element.cpp):
//   one diagonal:  (H_xx + H_xy)^2 + (H_yy + H_xy)^2 + 4 H_xy^2 = 1 + u + u^2, u = sin 2 phi; .75 to 3
//   union-jack:    H_xx^2 + H_yy^2 + 4 H_xy^2                   = 1 + u^2/2; 1 to 1.5
TEST(Hinge, OverratesACylinderByItsDirectionOnCutSquares) {
  for (int d = 0; d < kDirections; ++d) {
    const double phi = pi * d / kDirections, u = std::sin(2 * phi);
    EXPECT_NEAR(grid_ratio(MeshFamily::aligned, phi), 1 + u + u * u, kReproduced) << d;
    EXPECT_NEAR(grid_ratio(MeshFamily::flipped, phi), 1 - u + u * u, kReproduced) << d;
    EXPECT_NEAR(grid_ratio(MeshFamily::unionjack, phi), 1 + u * u / 2, kReproduced) << d;
  }
}

// Equilateral triangles: every direction alike and exact, which is why they look right in many papers.
TEST(Hinge, IsExactForACylinderOnEquilateralTriangles) {
  const ClothMesh mesh = make_grid(1, 1 * std::sqrt(3.0) / 2, 8, 8, MeshFamily::equilateral, 1);
  const Vector2d cell(1.0 / 8, std::sqrt(3.0) / 16), low = 1.8 * cell, high = low + 4 * cell;
  for (int d = 0; d < kDirections; ++d)
    EXPECT_NEAR(hinge_ratio(mesh, pi * d / kDirections, low, high), 1, kReproduced) << d;
}

TEST(Hinge, OverratesBendingOnRandomTrianglesByASixth) {
  constexpr double kExpected = 1.17, kScatter = 0.06;  // among seeds and mesh generators
  const ClothMesh mesh = make_rectangle(1, 1, 1500, MeshFamily::random, 3);
  double mean = 0;
  for (int d = 0; d < 6; ++d)
    mean += hinge_ratio(mesh, pi * d / 6, Vector2d(0.15, 0.15), Vector2d(0.85, 0.85)) / 6;
  EXPECT_NEAR(mean, kExpected, kScatter);
}

}  // namespace
}  // namespace hysteron
