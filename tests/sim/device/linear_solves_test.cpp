// Conjugate gradients on either device: exact where they say so, alike, and the same bits whoever repeats
// them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "sim/mesh/cloth_mesh.h"
#include "tests/sim/device/linear_solves.h"
#include "tests/sim/device/on_each_device.h"

namespace hysteron {
namespace {

using test::LinearMethod;
using test::LinearSolve;

constexpr double kTolerance = 1e-11;
// The residual in the preconditioner's norm is below the tolerance; in the plain norm, which is compared, it
// is larger by the root of the preconditioner's condition at most, some hundreds for these springs.
constexpr double kPlain = 1e-8;

// Hierarchies have no level, small levels only, or levels of more than a thousand nodes.
constexpr int kTriangles[] = {2, 3000, 40000};

ClothMesh random_rectangle(int triangles) {
  return make_rectangle(0.5, 0.5, triangles, MeshFamily::random, 1);
}

double farthest(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double farthest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) farthest = std::max(farthest, (a[i] - b[i]).norm());
  return farthest;
}

bool same_bits(const LinearSolve& a, const LinearSolve& b) {
  return std::memcmp(a.x.data(), b.x.data(), a.x.size() * sizeof(Eigen::Vector3d)) == 0;
}

class LinearSolvesOnEachDevice : public test::OnEachDevice {
 protected:
  void SetUp() override {
    OnEachDevice::SetUp();
    if (IsSkipped()) return;
    solves = on_gpu() ? test::gpu_linear_solves() : test::cpu_linear_solves();
    ASSERT_TRUE(solves);
  }
  // On a GPU one more, whose rows and first level are too many for a warp each and for one launch.
  static std::vector<int> triangles_here() {
    std::vector<int> all(std::begin(kTriangles), std::end(kTriangles));
    if (on_gpu()) all.push_back(150000);
    return all;
  }
  std::unique_ptr<test::LinearSolves> solves;
};
INSTANTIATE_TEST_SUITE_P(Devices, LinearSolvesOnEachDevice, testing::Values("cpu", "gpu"), test::CaseName());

TEST_P(LinearSolvesOnEachDevice, LeaveTheResidualThatTheyWereAskedFor) {
  for (const int triangles : triangles_here())
    for (const LinearMethod method : {LinearMethod::block_jacobi, LinearMethod::multigrid}) {
      const LinearSolve solve = solves->solve(random_rectangle(triangles), method, kTolerance);
      EXPECT_TRUE(solve.converged) << triangles;
      EXPECT_LT(solve.residual, kPlain) << triangles;
      EXPECT_EQ(solve.x[0], Eigen::Vector3d::Zero().eval());
    }
}

TEST_P(LinearSolvesOnEachDevice, HaveTheBitsOfBatchesTwiceTheSame) {
  for (const int triangles : triangles_here())
    for (const LinearMethod method : {LinearMethod::block_jacobi, LinearMethod::multigrid}) {
      const ClothMesh mesh = random_rectangle(triangles);
      constexpr double kLoose = 1e-4;
      const LinearSolve once = solves->solve(mesh, method, kLoose),
                        again = solves->solve(mesh, method, kLoose, false, 3),
                        batches = solves->solve(mesh, method, kLoose, true, 3);
      EXPECT_GT(once.x.back().norm(), 0);
      EXPECT_TRUE(same_bits(once, again)) << triangles;
      EXPECT_TRUE(same_bits(once, batches)) << triangles;
      EXPECT_EQ(once.iterations, batches.iterations) << triangles;
    }
}

// Two devices stop at iterates that differ within the tolerance.
TEST_P(LinearSolvesOnEachDevice, AgreeWithTheCpu) {
  if (!on_gpu()) GTEST_SKIP() << "this is the CPU";
  for (const int triangles : kTriangles)
    for (const LinearMethod method : {LinearMethod::block_jacobi, LinearMethod::multigrid}) {
      const ClothMesh mesh = random_rectangle(triangles);
      const LinearSolve here = solves->solve(mesh, method, kTolerance),
                        there = test::cpu_linear_solves()->solve(mesh, method, kTolerance);
      double size = 0;
      for (const Eigen::Vector3d& x : there.x) size = std::max(size, x.norm());
      EXPECT_LT(farthest(here.x, there.x), kPlain * size) << triangles;
      // A GPU inverts a finer level.
      EXPECT_LE(here.iterations, 1 + 1.02 * there.iterations) << triangles;
      EXPECT_GE(here.iterations, method == LinearMethod::multigrid ? 1 : 0.98 * there.iterations - 1)
          << triangles;
    }
}

// 4, 27 and 175 nodes: less than a tile of a GPU, some, and one more than whole tiles hold.
TEST_P(LinearSolvesOnEachDevice, InvertASmallMatrixToRounding) {
  constexpr double kRounding = 1e-12;  // the matrix's condition is below 2000
  for (const int triangles : {2, 40, 300})
    for (const bool without_first : {false, true}) {
      const LinearSolve solve = solves->invert(random_rectangle(triangles), without_first);
      EXPECT_LT(solve.residual, kRounding) << triangles;
      for (const Eigen::Vector3d& x : solve.x) EXPECT_TRUE(x.allFinite()) << triangles;
    }
}

TEST_P(LinearSolvesOnEachDevice, OrderNoLoopForAnIterationThatTheGpuRepeatsItself) {
  if (!on_gpu()) GTEST_SKIP() << "the CPU orders each";
  constexpr int kTimes = 4;
  const ClothMesh mesh = random_rectangle(3000);
  const LinearSolve tight = solves->solve(mesh, LinearMethod::block_jacobi, kTolerance, false, kTimes),
                    loose = solves->solve(mesh, LinearMethod::block_jacobi, 1e-2, false, kTimes);
  EXPECT_GT(tight.iterations, 2 * loose.iterations);
  EXPECT_EQ(tight.loops, loose.loops);
}

// Long strips have one front, one level of fronts below another, or more of both.
TEST_P(LinearSolvesOnEachDevice, FactoriseStripsAndSolveThemInAnIterationOrTwo) {
  for (const int triangles : {2, 300, 2400}) {
    const ClothMesh mesh = make_rectangle(0.5, 0.03, triangles, MeshFamily::random, 1);
    const LinearSolve once = solves->solve(mesh, LinearMethod::dissection, kTolerance),
                      again = solves->solve(mesh, LinearMethod::dissection, kTolerance, false, 3),
                      batches = solves->solve(mesh, LinearMethod::dissection, kTolerance, true, 3);
    EXPECT_TRUE(once.converged) << triangles;
    EXPECT_LE(once.iterations, 2) << triangles;
    EXPECT_LT(once.residual, kPlain) << triangles;
    EXPECT_EQ(once.x[0], Eigen::Vector3d::Zero().eval());
    EXPECT_TRUE(same_bits(once, again)) << triangles;
    EXPECT_TRUE(same_bits(once, batches)) << triangles;
  }
}

}  // namespace
}  // namespace hysteron
