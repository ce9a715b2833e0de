// Systems of double precision solved in single precision, against a dense solve.
#include "sim/linear/float_solver.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/sim/linear/dense.h"
#include "tests/sim/linear/random_system.h"

namespace hysteron {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Field = std::vector<Vector3d>;
using test::difference;
using test::norm;

// A spring connects the first vertex and the last.
struct Spring {
  static constexpr double kStiffness = 30;
  std::vector<int> start, item = {0, 1};
  PairStiffness<double> pair;

  explicit Spring(int vertices) : start(vertices + 1, 1) {
    start.front() = 0;
    start.back() = 2;
    const int last = vertices - 1;
    pair = {{0, last, last, last}, kStiffness * Matrix3d::Identity(), {1, -1, 0, 0}};
  }
  PairProduct<double> product() const { return {start.data(), item.data(), &pair, 1}; }
};

// Softening and the spring, as self-contact has it.
struct FloatSystem : test::RandomSystem {
  FloatSolver<Cpu> solver;
  Spring spring;

  FloatSystem()
      : RandomSystem(14),
        solver(cpu, rows, std::make_unique<BlockJacobiSolver<float, Cpu>>(cpu, n()), nullptr),
        spring(n()) {
    softening.assign(softening.size(), 0.1);
    softening_diagonal.assign(n(), -1);
    held[3] = held[17] = 1;
  }

  Field solution(double tolerance = FloatSolver<Cpu>::kTightest) {
    LinearSystem<double, Cpu> system = linear();
    system.pairs = spring.product();
    Field x(n(), Vector3d::Constant(7));
    EXPECT_TRUE(solver.solve(system, held.data(), rhs.data(), x.data(), tolerance).converged);
    return x;
  }

  MatrixXd dense() {
    MatrixXd a = RandomSystem::dense();
    const int ends[2] = {0, n() - 1};
    for (int i : ends)
      for (int j : ends)
        a.block<3, 3>(3 * i, 3 * j) += (i == j ? 1 : -1) * Spring::kStiffness * Matrix3d::Identity();
    return a;
  }
  double condition() {
    const VectorXd eigenvalues = test::eigenvalues(dense());
    EXPECT_GT(eigenvalues[0], 0);
    return eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
  }
};

TEST(FloatSolver, SolvesToItsToleranceWhatADenseSolveDoes) {
  FloatSystem system;
  const Field exact = system.solution_of(system.dense());
  for (const double tolerance : {1e-2, 1e-5})
    EXPECT_LT(difference(system.solution(tolerance), exact), system.condition() * tolerance * norm(exact));
  EXPECT_GT(difference(system.solution(1e-2), exact), difference(system.solution(1e-5), exact));
}

TEST(FloatSolver, NeedsNoRightHandSideOfHeldRowsAndLeavesThemAtZero) {
  FloatSystem system;
  const Field before = system.solution();
  EXPECT_EQ(before[3], Vector3d(0, 0, 0));
  system.rhs[3].setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(system.solution(), before);
}

// By powers of two, far beyond what single precision holds: nothing is rounded.
TEST(FloatSolver, SolvesAlikeHoweverSmallTheForces) {
  FloatSystem system;
  const Field of_ones = system.solution();
  for (const double size : {0x1p-300, 0x1p300}) {
    for (Vector3d& b : system.rhs) b *= size;
    Field scaled = system.solution();
    for (Vector3d& x : scaled) x /= size;
    EXPECT_EQ(scaled, of_ones);
    for (Vector3d& b : system.rhs) b /= size;
  }
}

TEST(FloatSolver, EndsWhereSinglePrecisionDoesWhenAskedForMore) {
  FloatSystem system;
  EXPECT_EQ(system.solution(1e-15), system.solution(1e-5));
}

TEST(FloatSolver, AnswersNoForcesWithNoDisplacement) {
  FloatSystem system;
  for (Vector3d& b : system.rhs) b.setZero();
  EXPECT_EQ(system.solution(), Field(system.n(), Vector3d::Zero()));
}

}  // namespace
}  // namespace hysteron
