// The factorisations and the solver that they precondition, against a dense solve of the same small system.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "sim/linear/dissected_factorisation.h"
#include "sim/linear/sparse_factorisation.h"
#include "tests/sim/base/case_name.h"
#include "tests/sim/linear/dense.h"
#include "tests/sim/linear/random_system.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kRounding = 1e-10;  // relative; of systems whose condition is below 1e5

// This struct has springs w^T w between four vertices, as of pairs that touch.
struct Springs {
  std::vector<std::array<int, 4>> vertex;
  double stiffness = 50;
  std::vector<PairStiffness<double>> pair;
  Adjacency of_vertex;

  static double weight(int corner) { return std::array{1.0, -0.5, -0.3, -0.2}[corner]; }
  Matrix3d block() const {
    return stiffness * Vector3d(1, 2, 2).normalized() * Vector3d(1, 2, 2).normalized().transpose();
  }
  void add_to(MatrixXd& dense) const {
    for (const std::array<int, 4>& of : vertex)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
          dense.block<3, 3>(3 * of[a], 3 * of[b]) += weight(a) * weight(b) * block();
  }
  // The same as a device has them.
  PairProduct<double> pairs(int nodes) {
    pair.resize(vertex.size());
    std::vector<std::vector<int>> rows(nodes);
    for (int e = 0; e < static_cast<int>(vertex.size()); ++e) {
      pair[e].block = block();
      for (int k = 0; k < 4; ++k) {
        pair[e].v[k] = vertex[e][k];
        pair[e].weight[k] = weight(k);
        rows[vertex[e][k]].push_back(4 * e + k);
      }
    }
    of_vertex = compressed(rows);
    return {of_vertex.start.data(), of_vertex.item.data(), pair.data(), static_cast<int>(pair.size())};
  }
};

using Factor = std::unique_ptr<Factorisation<double, Cpu>>;

Factor make_factor(const std::string& kind, test::RandomSystem& of) {
  if (kind == "sparse") return std::make_unique<SparseFactorisation<double>>(of.cpu, of.rows, nullptr);
  DissectionShape shape;  // one front
  if (kind == "flat") shape = {2, 2};
  if (kind == "tree") shape = {3, 1};
  return std::make_unique<DissectedFactorisation<double, Cpu>>(
      of.cpu, std::make_unique<RowsAlone<double>>(of.rows.pattern()), shape);
}

// The system has springs between far vertices.
struct System : test::RandomSystem {
  Springs springs;
  std::vector<Vec3<double>> x;
  std::unique_ptr<CholeskySolver<double, Cpu>> solver;

  explicit System(const std::string& kind) : RandomSystem(12), x(n()) {
    solver = std::make_unique<CholeskySolver<double, Cpu>>(cpu, n(), make_factor(kind, *this));
  }

  MatrixXd dense() {
    MatrixXd a = RandomSystem::dense();
    springs.add_to(a);
    return a;
  }
  double error() {
    const test::Field exact = solution_of(dense());
    return test::difference(x, exact) / test::norm(exact);
  }
  PcgOutcome solve(double tolerance = 1e-12) {
    LinearSystem<double, Cpu> system = linear();
    system.pairs = springs.pairs(n());
    return solver->solve(system, held.data(), rhs.data(), x.data(), tolerance);
  }
};

class Cholesky : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Factorisations, Cholesky, testing::Values("sparse", "dense", "flat", "tree"),
                         test::CaseName());

TEST_P(Cholesky, SolvesInAnIterationOrTwoWhatADenseSolveDoes) {
  System system(GetParam());
  system.held[3] = system.held[17] = 1;
  const PcgOutcome outcome = system.solve();
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.iterations, 2);
  EXPECT_LT(system.error(), kRounding);
  EXPECT_EQ(system.x[3], Vector3d(0, 0, 0));
}

TEST_P(Cholesky, FollowsPairsThatComeAndGoAndHandsThatTakeHold) {
  System system(GetParam());
  const int last = system.n() - 1;
  system.springs.vertex = {{0, last, last - 1, last - 2}, {5, 30, 31, 33}};
  EXPECT_LE(system.solve().iterations, 2);
  EXPECT_LT(system.error(), kRounding);
  system.springs.vertex = {{5, 30, 31, 33}};
  EXPECT_TRUE(system.solve().converged);
  EXPECT_LT(system.error(), kRounding);
  system.springs.vertex = {{7, last, last - 4, 40}};
  system.held[7] = 1;  // not as when the factorisation was made: a new one
  EXPECT_LE(system.solve().iterations, 2);
  EXPECT_LT(system.error(), kRounding);
  EXPECT_EQ(system.solver->factorisations(), 2);
}

TEST_P(Cholesky, IsKeptForSystemsThatDifferLittleAndRenewedForOthers) {
  System system(GetParam());
  system.solve();
  for (int i = 0; i < system.n(); ++i) system.rows.view().diagonal[i] *= 1.01;
  EXPECT_TRUE(system.solve().converged);
  EXPECT_LT(system.error(), kRounding);
  EXPECT_EQ(system.solver->factorisations(), 1);
  for (int i = 0; i < system.n(); ++i)
    system.rows.view().diagonal[i] = (10 + 1e4 * (i % 7) * (i % 5)) * Matrix3d::Identity();
  EXPECT_TRUE(system.solve().converged);
  EXPECT_LT(system.error(), kRounding);
  EXPECT_EQ(system.solver->factorisations(), 2);
}

// The factorisation is of the matrix without softening, which makes it indefinite.
TEST_P(Cholesky, LetsConjugateGradientsEndOnNegativeCurvature) {
  System system(GetParam());
  for (double& s : system.softening_diagonal) s = -9;
  const MatrixXd a = system.dense();
  ASSERT_LT(test::eigenvalues(a)[0], 0);
  EXPECT_FALSE(system.solve().converged);
  double descent = 0;
  for (int i = 0; i < system.n(); ++i) descent += system.rhs[i].dot(system.x[i]);
  EXPECT_GT(descent, 0);
}

TEST_P(Cholesky, GoesOnFromAnArchiveWithTheSameBits) {
  System one(GetParam()), two(GetParam());
  one.solve();
  Archive saved;
  one.solver->serialise(saved);
  const std::string bytes = saved.take();
  Archive loaded(bytes);
  two.solver->serialise(loaded);
  ASSERT_TRUE(loaded.at_end());
  for (System* system : {&one, &two}) {
    for (int i = 0; i < system->n(); ++i) system->rows.view().diagonal[i] *= 1.02;
    system->solve(1e-6);
  }
  EXPECT_EQ(std::memcmp(one.x.data(), two.x.data(), one.x.size() * sizeof(Vector3d)), 0);
  EXPECT_EQ(two.solver->factorisations(), 0);
}

// The factor of a chain has no more blocks than the matrix.
TEST(SymbolicFactorization, OfAChainFillsNothingThatIsNotWorthwhile) {
  constexpr int kNodes = 500;
  CouplingList list(kNodes);
  for (int i = 1; i < kNodes; ++i) list.add(std::array{i - 1, i});
  const SymbolicFactorization plan = plan_elimination(list.take());
  EXPECT_EQ(plan.order.size(), static_cast<std::size_t>(kNodes));
  EXPECT_LT(plan.multiplications,
            12 * 3 * 3 * 3 * kNodes);  // fronts of at most four nodes and their neighbours
}

// A pivot without a digit takes the matrix's own diagonal.
TEST(SparseCholesky, ReplacesPivotsOfSingularMatrices) {
  CouplingList list(2);
  list.add(std::array{0, 1});
  SymmetricBlocks matrix(list.take());
  matrix.diagonal[0] = matrix.diagonal[1] = Matrix3d::Identity();
  matrix.below[0] = -Matrix3d::Identity();  // a spring between free nodes
  SparseCholesky factor(matrix.couplings());
  EXPECT_EQ(factor.factorise(matrix), 3);
  std::array<double, 6> x{1, 2, 3, 4, 5, 6};
  factor.solve(x.data());
  EXPECT_GT(x[0] * 1 + x[1] * 2 + x[2] * 3 + x[3] * 4 + x[4] * 5 + x[5] * 6, 0);
}

}  // namespace
}  // namespace hysteron
