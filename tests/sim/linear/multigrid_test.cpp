// The multigrid preconditioner on the matrix of an implicit step: what it must be, and how much it saves.
#include "sim/linear/multigrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>

#include "sim/bending/angle.h"
#include "sim/bending/curvature_operator.h"
#include "sim/membrane/membrane.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Field = std::vector<Vector3d>;

constexpr double kStep = 1.0 / 60;

double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

// Arc-length parametrised folds, sheared, stretched and compressed by up to a third.
Field folded(const ClothMesh& mesh, double side) {
  constexpr double kWave = 0.1, kSlope = 1.2;
  Field x;
  for (const Vector3d& p : mesh.rest) {
    Vector3d q(0, p.y(), 0);
    constexpr int kPieces = 400;
    for (int i = 0; i < kPieces; ++i) {
      const double ds = p.x() / kPieces, slope = kSlope * std::sin(2 * M_PI * (i + 0.5) * ds / kWave);
      q += ds * Vector3d(std::cos(slope), 0, std::sin(slope));
    }
    q.x() += 0.3 * p.y() * p.y() / side;
    q.y() += 0.004 * std::sin(25 * p.x()) * std::cos(20 * p.y());
    x.push_back(q);
  }
  return x;
}

// mass + step^2 (membrane + Gauss-Newton bending) of the default fabric, the upper corners held.
struct ImplicitMatrix {
  static constexpr double kSide = 0.5;
  Cpu cpu{1};
  Fabric fabric;
  ClothMesh mesh;
  std::vector<char> held;
  BlockRows<double, Cpu> rows;
  std::vector<std::array<Vector3d, 4>> gradient;  // of the hinges' angles
  CurvatureOperator op;
  std::vector<Matrix3d> bending_diagonal;
  Field load;  // gravity, with a rough part

  ImplicitMatrix(MeshFamily family, int triangles, bool flat)
      : ImplicitMatrix(make_rectangle(kSide, kSide, triangles, family, 1), flat) {}
  ImplicitMatrix(const ClothMesh& cloth, bool flat) : mesh(cloth), rows(cpu, mesh) {
    held.assign(mesh.vertices(), 0);
    for (int i = 0; i < mesh.vertices(); ++i)
      held[i] = mesh.rest[i].y() > kSide - 1e-6 && std::abs(mesh.rest[i].x() - kSide / 2) > kSide / 2 - 1e-6;
    const Field x = flat ? mesh.rest : folded(mesh, kSide), rest(mesh.vertices(), Vector3d::Zero());
    Membrane<double, Cpu> membrane(cpu, mesh, fabric, MembraneElement::constant, rows);
    membrane.update(x.data(), rest.data());
    membrane.assemble(kStep * kStep, kStep * kStep, rows.view());
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-5, 5);
    for (int i = 0; i < mesh.vertices(); ++i) {
      const double mass = fabric.density * mesh.vertex_area[i];
      rows.view().diagonal[i] += mass * Matrix3d::Identity();
      load.push_back(
          mass * (Vector3d(3, -8, 5) + Vector3d(uniform(generator), uniform(generator), uniform(generator))));
      if (held[i]) load[i].setZero();
    }
    linearise_bending(x);
  }

  double bending() const { return kStep * kStep * fabric.b1; }

  void linearise_bending(const Field& x) {
    op = make_shape_operator(mesh, held);
    for (int i = 0; i < mesh.interior_edges; ++i) {
      const Edge& e = mesh.edge[i];
      const Angle<double> a = dihedral_angle<double>(x[e.p0], x[e.p1], x[e.p2], x[e.p3]);
      gradient.push_back({a.g0, a.g1, -(1 - a.t0) * a.g0 - (1 - a.t1) * a.g1, -a.t0 * a.g0 - a.t1 * a.g1});
    }
    bending_diagonal.assign(mesh.vertices(), Matrix3d::Zero());
    for (int f = 0; f < mesh.faces(); ++f) {
      std::vector<std::pair<int, Matrix3d>> column;  // d S_f / d x of each vertex
      for (int j = op.hinge.start[f]; j < op.hinge.start[f + 1]; ++j)
        for (int k = 0; k < 4; ++k) {
          const int v = corners(op.hinge.item[j])[k];
          auto at = std::find_if(column.begin(), column.end(), [&](const auto& c) { return c.first == v; });
          if (at == column.end()) at = column.insert(at, {v, Matrix3d::Zero()});
          at->second +=
              Eigen::Map<const Vector3d>(&op.coefficient[3 * j]) * gradient[op.hinge.item[j]][k].transpose();
        }
      for (const auto& [v, c] : column) bending_diagonal[v] += bending() * op.area[f] * c.transpose() * c;
    }
  }

  std::array<int, 4> corners(int hinge) const {
    const Edge& e = mesh.edge[hinge];
    return {e.p0, e.p1, e.p2, e.p3};
  }

  Field times(const Field& v) {
    Field result(v.size(), Vector3d::Zero());
    std::vector<double> angle(mesh.interior_edges, 0), torque(mesh.interior_edges, 0);
    for (int i = 0; i < mesh.interior_edges; ++i)
      for (int k = 0; k < 4; ++k) angle[i] += gradient[i][k].dot(v[corners(i)[k]]);
    for (int f = 0; f < mesh.faces(); ++f) {
      Vector3d s = Vector3d::Zero();
      for (int j = op.hinge.start[f]; j < op.hinge.start[f + 1]; ++j)
        s += angle[op.hinge.item[j]] * Eigen::Map<const Vector3d>(&op.coefficient[3 * j]);
      for (int j = op.hinge.start[f]; j < op.hinge.start[f + 1]; ++j)
        torque[op.hinge.item[j]] +=
            bending() * op.area[f] * s.dot(Eigen::Map<const Vector3d>(&op.coefficient[3 * j]));
    }
    for (int i = 0; i < mesh.interior_edges; ++i)
      for (int k = 0; k < 4; ++k) result[corners(i)[k]] += torque[i] * gradient[i][k];
    for (int i = 0; i < mesh.vertices(); ++i) {
      result[i] += rows.view().times(i, v.data());
      if (held[i]) result[i].setZero();
    }
    return result;
  }

  // Iterations of conjugate gradients until the residual, weighed by the inverted diagonal blocks, is 1e-4 of
  // the load.
  template <class Apply>
  int iterations(Apply&& apply) {
    constexpr double kTolerance = 1e-4;
    constexpr int kMax = 5000;
    const auto weighed = [&](const Field& r) {
      double sum = 0;
      for (int i = 0; i < mesh.vertices(); ++i)
        sum += r[i].dot((rows.view().diagonal[i] + bending_diagonal[i]).ldlt().solve(r[i]));
      return sum;
    };
    Field r = load, z = apply(r), p = z;
    const double target = kTolerance * kTolerance * weighed(r);
    double residual = dot(r, z);
    for (int iteration = 1; iteration < kMax; ++iteration) {
      const Field q = times(p);
      const double alpha = residual / dot(p, q);
      for (std::size_t i = 0; i < r.size(); ++i) r[i] -= alpha * q[i];
      if (weighed(r) <= target) return iteration;
      z = apply(r);
      const double next = dot(r, z);
      for (std::size_t i = 0; i < r.size(); ++i) p[i] = z[i] + next / residual * p[i];
      residual = next;
    }
    return kMax;
  }
};

// Returns the preconditioner of such a matrix, in the precision of its device code.
template <class Real>
struct Preconditioned {
  Cpu cpu;
  std::vector<Mat3<Real>> off, diagonal, bending_diagonal;
  Multigrid<Real, Cpu> multigrid;

  explicit Preconditioned(ImplicitMatrix& a, int threads = 1)
      : cpu(threads), multigrid(cpu, a.mesh, make_rest_hierarchy(a.mesh, neighbours_in(a.mesh), a.held)) {
    const BlockRowsView<double> view = a.rows.view();
    for (int i = 0; i < view.rows; ++i) {
      diagonal.push_back(view.diagonal[i].cast<Real>());
      bending_diagonal.push_back(a.bending_diagonal[i].template cast<Real>());
    }
    for (int j = 0; j < view.row_ptr[view.rows]; ++j) off.push_back(view.off_diagonal[j].cast<Real>());
    multigrid.rebuild({view.rows, view.row_ptr, view.col, off.data(), diagonal.data()},
                      bending_diagonal.data(), static_cast<Real>(a.bending()), a.held.data());
  }

  Field operator()(const Field& r) {
    std::vector<Vec3<Real>> from, to(r.size());
    for (const Vector3d& v : r) from.push_back(v.cast<Real>());
    multigrid.apply(from.data(), to.data());
    Field z;
    for (const auto& v : to) z.push_back(v.template cast<double>());
    return z;
  }
};

Field rough_field(const ImplicitMatrix& a, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Field v;
  for (int i = 0; i < a.mesh.vertices(); ++i)
    v.push_back(a.held[i] ? Vector3d(0, 0, 0)
                          : Vector3d(uniform(generator), uniform(generator), uniform(generator)));
  return v;
}

int block_jacobi_iterations(ImplicitMatrix& a) {
  return a.iterations([&](const Field& r) {
    Field z;
    for (std::size_t i = 0; i < r.size(); ++i)
      z.push_back(a.held[i]
                      ? Vector3d(0, 0, 0)
                      : Vector3d((a.rows.view().diagonal[i] + a.bending_diagonal[i]).ldlt().solve(r[i])));
    return z;
  });
}

TEST(Multigrid, IsSymmetricAndPositiveDefiniteAndLeavesHeldRowsZero) {
  constexpr double kRounding = 1e-9;  // of double, times the spread of the levels' stiffness
  for (bool flat : {true, false}) {
    ImplicitMatrix a(MeshFamily::random, 3000, flat);
    Preconditioned<double> apply(a);
    ASSERT_GE(apply.multigrid.levels(), 3);
    const Field u = rough_field(a, 1), v = rough_field(a, 2), pu = apply(u), pv = apply(v);
    EXPECT_GT(dot(u, pu), 0);
    EXPECT_GT(dot(v, pv), 0);
    EXPECT_NEAR(dot(u, pv), dot(v, pu), kRounding * std::sqrt(dot(u, pu) * dot(v, pv)));
    for (int i = 0; i < a.mesh.vertices(); ++i) EXPECT_TRUE(!a.held[i] || pu[i] == Vector3d(0, 0, 0)) << i;
    EXPECT_GT(dot(a.load, apply(a.load)), 0);  // smooth: what the coarse levels are for
  }
}

struct Sheet {
  MeshFamily family;
  bool flat;
  // How much fewer iterations than block-Jacobi's are expected at 3,000 triangles.  Measured: 9 ... 11 flat,
  // 3.8 ... 4.5 folded, where two edges make a fold's radius; 29 at 18,000 triangles.
  double saving;
};
class Saving : public testing::TestWithParam<Sheet> {};
INSTANTIATE_TEST_SUITE_P(Sheets, Saving,
                         testing::Values(Sheet{MeshFamily::random, true, 7},
                                         Sheet{MeshFamily::random, false, 3},
                                         Sheet{MeshFamily::aligned, true, 7},
                                         Sheet{MeshFamily::unionjack, false, 3}),
                         [](const auto& sheet) {
                           return enum_name(sheet.param.family) + (sheet.param.flat ? "_flat" : "_folded");
                         });

// Block-Jacobi's iterations grow with the vertices along a side: by two for four times the triangles.
TEST_P(Saving, GrowsWithTheMeshBecauseItsOwnIterationsHardlyDo) {
  constexpr double kGrowth = 1.3;  // measured: 0.75 ... 1.15
  ImplicitMatrix coarse(GetParam().family, 3000, GetParam().flat),
      fine(GetParam().family, 12000, GetParam().flat);
  const int few = coarse.iterations(Preconditioned<double>(coarse)),
            more = fine.iterations(Preconditioned<double>(fine));
  EXPECT_LT(GetParam().saving * few, block_jacobi_iterations(coarse));
  EXPECT_LT(more, kGrowth * few);
}

// Cells ten times as long as wide: the short edges couple most and are coarsened first.
TEST(Multigrid, SavesOnSlenderTriangles) {
  constexpr double kSaving = 5;
  ImplicitMatrix a(make_grid(ImplicitMatrix::kSide, ImplicitMatrix::kSide, 8, 80, MeshFamily::aligned, 1),
                   true);
  EXPECT_LT(kSaving * a.iterations(Preconditioned<double>(a)), block_jacobi_iterations(a));
}

TEST(Multigrid, SavesAsMuchInSinglePrecision) {
  constexpr double kRounding = 1.05;
  ImplicitMatrix a(MeshFamily::random, 3000, false);
  EXPECT_LE(a.iterations(Preconditioned<float>(a)), kRounding * a.iterations(Preconditioned<double>(a)));
}

TEST(Multigrid, HasTheSameBitsOnAnyNumberOfThreadsAndAfterAnotherRebuild) {
  ImplicitMatrix a(MeshFamily::random, 12000, false);
  Preconditioned<float> one(a, 1), two(a, 2);
  const Field first = one(a.load), second = two(a.load);
  EXPECT_EQ(std::memcmp(first.data(), second.data(), first.size() * sizeof(Vector3d)), 0);
  const BlockRowsView<double> view = a.rows.view();
  two.multigrid.rebuild({view.rows, view.row_ptr, view.col, two.off.data(), two.diagonal.data()},
                        two.bending_diagonal.data(), static_cast<float>(a.bending()), a.held.data());
  const Field third = two(a.load);
  EXPECT_EQ(std::memcmp(first.data(), third.data(), first.size() * sizeof(Vector3d)), 0);
}

TEST(Multigrid, OfOneTriangleInvertsTheDiagonalBlocks) {
  ImplicitMatrix a(MeshFamily::aligned, 2, true);
  Preconditioned<double> apply(a);
  ASSERT_EQ(apply.multigrid.levels(), 1);
  const Field r = rough_field(a, 3), z = apply(r);
  constexpr double kRounding = 1e-12;
  for (int i = 0; i < a.mesh.vertices(); ++i) {
    const Vector3d back = (a.rows.view().diagonal[i] + a.bending_diagonal[i]) * z[i];
    EXPECT_LT(a.held[i] ? z[i].norm() : (back - r[i]).norm(), kRounding) << i;
  }
}

TEST(Multigrid, StaysFiniteWhereWholePiecesOfClothAreHeld) {
  ClothMesh mesh, piece = make_rectangle(0.1, 0.1, 50, MeshFamily::random, 1);
  for (int k = 0; k < 12; ++k) {
    for (const auto& f : piece.face)
      mesh.face.push_back(f + Eigen::Vector3i::Constant(static_cast<int>(mesh.rest.size())));
    for (const Vector3d& x : piece.rest) mesh.rest.push_back(x + Vector3d(0.2 * k, 0, 0.1 * k));
  }
  build_topology(mesh, "pieces");
  ImplicitMatrix a(mesh, true);
  for (int i = 0; i < a.mesh.vertices(); ++i) a.held[i] = a.mesh.rest[i].x() > 1;
  Preconditioned<float> apply(a);
  ASSERT_GT(apply.multigrid.levels(), 1);
  const Field r = rough_field(a, 4);
  const double energy = dot(r, apply(r));
  EXPECT_TRUE(std::isfinite(energy)) << energy;
  EXPECT_GT(energy, 0);
}

}  // namespace
}  // namespace hysteron
