// The solver against a direct factorisation, and a run against itself: threads, repetition, precision.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <random>

#include "sim/linear/pcg.h"
#include "sim/membrane/membrane.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using test::Trial;

// This struct has a crumpled and stretched membrane with masses, as the implicit stage assembles it, and a
// random load.
struct ImplicitSystem {
  Trial trial{test::hanging_square(300)};
  Cpu cpu{1};
  BlockRows<double, Cpu> rows{cpu, trial.cloth.mesh};
  std::vector<char> held = trial.cloth.held(trial.scene, 0);
  std::vector<Vector3d> load;

  ImplicitSystem() {
    constexpr double kStep = 5e-3;
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<Vector3d> x = trial.cloth.mesh.rest;
    for (Vector3d& p : x) {
      p = 1.05 * p + 2e-3 * Vector3d(uniform(generator), uniform(generator), uniform(generator));
      load.emplace_back(uniform(generator), uniform(generator), uniform(generator));
    }
    Membrane<double, Cpu> membrane(cpu, trial.cloth.mesh, trial.scene.fabric, MembraneElement::constant,
                                   rows);
    const std::vector<Vector3d> still(x.size(), Vector3d::Zero());
    membrane.update(x.data(), still.data());
    membrane.assemble(kStep * kStep + kStep * membrane.damping(), kStep * kStep, rows.view());
    for (int i = 0; i < trial.cloth.mesh.vertices(); ++i)
      rows.view().diagonal[i].diagonal().array() += trial.mass(i);
  }

  // For `rhs`; the tolerance is relative to rhs + `scale` times the load.
  PcgOutcome solve(const std::vector<Vector3d>& rhs, double scale, double tolerance, int iterations,
                   std::vector<Vector3d>& solution, const Vector3d* guess = nullptr) {
    Pcg<double, Cpu> pcg(cpu, static_cast<int>(held.size()));
    std::vector<Vector3d> known;
    for (const Vector3d& f : load) known.push_back(-scale * f);
    return pcg.solve({rows.view()}, held.data(), rhs.data(), known.data(), guess, solution.data(),
                     {tolerance, iterations});
  }

  // The free part as a sparse matrix.
  Eigen::SparseMatrix<double> free_part(const std::vector<int>& place, int size) const {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int i, int j, const Mat3<double>& block) {
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) entries.emplace_back(3 * place[i] + a, 3 * place[j] + b, block(a, b));
    };
    const auto diagonal = rows.diagonal(), off_diagonal = rows.off_diagonal();
    for (std::size_t i = 0; i < held.size(); ++i) {
      if (held[i]) continue;
      add(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
      for (int j = rows.row_ptr()[i]; j < rows.row_ptr()[i + 1]; ++j)
        if (!held[rows.col()[j]]) add(static_cast<int>(i), rows.col()[j], off_diagonal[j]);
    }
    Eigen::SparseMatrix<double> matrix(3 * size, 3 * size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
};

TEST(ConjugateGradients, SolveWhatADirectFactorisationSolves) {
  constexpr double kTolerance = 1e-12;
  constexpr double kConditioned = 1e-9;  // the residual's tolerance times the root of the condition number
  ImplicitSystem system;
  std::vector<int> place;
  int size = 0;
  for (char h : system.held) place.push_back(h ? -1 : size++);
  const Eigen::SparseMatrix<double> matrix = system.free_part(place, size);
  EXPECT_LT((matrix - Eigen::SparseMatrix<double>(matrix.transpose())).norm(), 1e-14 * matrix.norm());
  VectorXd load(3 * size);
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) load.segment<3>(3 * place[i]) = system.load[i];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  ASSERT_EQ(factors.info(), Eigen::Success);
  ASSERT_GT(factors.vectorD().minCoeff(), 0);  // positive definite
  const VectorXd expected = factors.solve(load);

  std::vector<Vector3d> solution(place.size(), Vector3d::Zero());
  const PcgOutcome outcome = system.solve(system.load, 0, kTolerance, 2000, solution);
  EXPECT_TRUE(outcome.converged);
  EXPECT_GT(outcome.iterations, 10);
  double error = 0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0)
      EXPECT_EQ(solution[i], Vector3d::Zero());
    else
      error = std::max(error, (solution[i] - expected.segment<3>(3 * place[i])).norm());
  }
  EXPECT_LT(error, kConditioned * expected.cwiseAbs().maxCoeff());
}

// The residual is judged against a known impulse where that is given: a correction far smaller is not worth
// solving.
TEST(ConjugateGradients, JudgeASmallCorrectionByTheImpulseThatItCorrects) {
  constexpr double kTolerance = 1e-6;
  ImplicitSystem system;
  std::vector<Vector3d> small, solution(system.held.size());
  for (const Vector3d& f : system.load) small.push_back(1e-3 * kTolerance * f);
  EXPECT_GT(system.solve(small, 0, kTolerance, 2000, solution).iterations, 10);
  const PcgOutcome judged = system.solve(small, 1, kTolerance, 2000, solution);
  EXPECT_EQ(judged.iterations, 0);
  EXPECT_TRUE(judged.converged);
}

// A guess of the right direction but the wrong length is as good as the solution, and an opposite one
// harmless.
TEST(ConjugateGradients, StartFromTheBestMultipleOfAGuess) {
  constexpr double kTolerance = 1e-8;
  ImplicitSystem system;
  std::vector<Vector3d> solution(system.held.size()), again(system.held.size());
  const int cold = system.solve(system.load, 0, kTolerance, 2000, solution).iterations;
  EXPECT_GT(cold, 10);
  std::vector<Vector3d> guess;
  for (const Vector3d& x : solution) guess.push_back(-0.1 * x);
  EXPECT_LE(system.solve(system.load, 0, 1.5 * kTolerance, 2000, again, guess.data()).iterations, 1);
  for (Vector3d& x : guess) x.setZero();
  EXPECT_EQ(system.solve(system.load, 0, kTolerance, 2000, again, guess.data()).iterations, cold);
  EXPECT_EQ(again, solution);
}

TEST(ConjugateGradients, SayWhenTheyDidNotConverge) {
  ImplicitSystem system;
  std::vector<Vector3d> solution(system.held.size());
  EXPECT_FALSE(system.solve(system.load, 0, 1e-12, 3, solution).converged);
}

// Enough vertices, hinges and faces that every loop is shared between the threads.
Trial draping() {
  Scene scene = test::hanging_square(5000);
  scene.law = "prandtl";
  scene.solver_tolerance = 1e-4;
  scene.obstacle = {test::sphere_at({0.1, 0.05, -0.051}, 0.05)};
  return Trial(scene);
}

TEST(Run, HasTheSameBitsOnOneThreadOnTwoAndAgain) {
  Trial trial = draping();
  ASSERT_GT(trial.cloth.mesh.vertices(), kSerialLoop);
  const auto hash = trial.after(10)->state_hash();
  EXPECT_EQ(trial.after(10)->state_hash(), hash);
  trial.scene.threads = 2;
  EXPECT_EQ(trial.after(10)->state_hash(), hash);
  EXPECT_NE(trial.after(11)->state_hash(), hash);
}

TEST(Run, IsNotChangedByHowOftenItIsMeasured) {
  const Trial trial = draping();
  const auto watched = trial.simulation();
  for (int i = 0; i < 10; ++i) {
    watched->advance(1);
    watched->ledger();
    watched->curvature();
    watched->residual_curvature();
    watched->friction_share();
    watched->largest_stretch();
  }
  EXPECT_EQ(watched->state_hash(), trial.after(10)->state_hash());
}

// Rounding of 6e-8 over 100 steps and some thousand substeps, while the cloth falls by cm.
TEST(Run, InSinglePrecisionStaysNearDoublePrecision) {
  constexpr double kNear = 1e-4;  // [m], half a thousandth of the cloth
  for (const char* law : {"linear", "prandtl", "wong"}) {
    Trial trial(test::hanging_square());
    trial.scene.law = law;
    trial.scene.solver_tolerance = 1e-5;
    const auto exact = trial.after(100)->positions();
    trial.scene.precision = Precision::fp32;
    const auto rounded = trial.after(100)->positions();
    EXPECT_GT(test::farthest(exact, trial.cloth.start), 0.01);
    EXPECT_LT(test::farthest(exact, rounded), kNear) << law;
    EXPECT_NE(test::farthest(exact, rounded), 0) << law;
  }
}

}  // namespace
}  // namespace hysteron
