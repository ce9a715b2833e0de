// These tests check what is chosen for scenes that leave device and linear solver open.
#include "sim/time/method_choice.h"

#include <gtest/gtest.h>

#include "sim/linear/block_rows.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

Scene sheet(double length, double width, int triangles) {
  Scene scene;
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = length;
  scene.cloth.width = width;
  scene.triangles = triangles;
  scene.integrator = Integrator::implicit;
  return scene;
}

MethodChoice choice_for(const Scene& scene, int gpus) {
  const Cloth cloth = make_cloth(scene);
  return choose_method(scene, cloth, make_curvature_operator(scene.element, cloth.mesh, cloth.held(scene, 0)),
                       gpus);
}

TEST(MethodChoice, FactorisesSmallClothsAndStripsOnTheCpu) {
  EXPECT_EQ(choice_for(sheet(0.2, 0.2, 300), 0).linear_solver, Preconditioning::cholesky);
  EXPECT_EQ(choice_for(sheet(1, 0.025, 4000), 0).linear_solver, Preconditioning::cholesky);
  EXPECT_EQ(choice_for(sheet(0.5, 0.5, 30000), 0).linear_solver, Preconditioning::multigrid);
}

TEST(MethodChoice, FactorisesLargerClothsOfStiffThreads) {
  Scene scene = sheet(0.2, 0.2, 2000);
  EXPECT_EQ(choice_for(scene, 0).linear_solver, Preconditioning::multigrid);
  scene.fabric.weft = 1e5;
  EXPECT_EQ(choice_for(scene, 0).linear_solver, Preconditioning::cholesky);
}

TEST(MethodChoice, TakesTheCpuForATinyStripAndSaysSoButAGpuForAnythingElse) {
  const MethodChoice tiny = choice_for(sheet(0.5, 0.025, 300), 1),
                     strip = choice_for(sheet(1, 0.05, 2000), 1),
                     square = choice_for(sheet(0.5, 0.5, 6000), 1);
  EXPECT_FALSE(tiny.gpu);
  EXPECT_FALSE(tiny.reason.empty());
  EXPECT_EQ(tiny.linear_solver, Preconditioning::cholesky);
  EXPECT_TRUE(strip.gpu);
  EXPECT_TRUE(strip.reason.empty());
  EXPECT_EQ(strip.linear_solver, Preconditioning::cholesky);
  EXPECT_TRUE(square.gpu);
  EXPECT_TRUE(square.reason.empty());
  EXPECT_EQ(square.linear_solver, Preconditioning::multigrid);
}

// Multigrid is the faster on a GPU for squares from some 2,000 triangles on, whatever their threads.
TEST(MethodChoice, FactorisesStripsButNoSquaresOnAGpu) {
  for (const double threads : {1e3, 1e4}) {
    Scene strip = sheet(0.2, 0.05, 1600), square = sheet(0.5, 0.5, 2000);
    for (Scene* scene : {&strip, &square}) {
      scene->device = DeviceChoice::cuda;
      scene->fabric.warp = scene->fabric.weft = threads;
    }
    EXPECT_EQ(choice_for(strip, 1).linear_solver, Preconditioning::cholesky) << threads;
    EXPECT_EQ(choice_for(square, 1).linear_solver, Preconditioning::multigrid) << threads;
  }
}

TEST(MethodChoice, LeavesWhatTheSceneNames) {
  Scene scene = sheet(1, 0.025, 500);
  scene.device = DeviceChoice::cuda;
  EXPECT_TRUE(choice_for(scene, 1).gpu);
  EXPECT_EQ(choice_for(scene, 1).linear_solver, Preconditioning::cholesky);
  scene.linear_solver = Preconditioning::multigrid;
  EXPECT_EQ(choice_for(scene, 1).linear_solver, Preconditioning::multigrid);
  scene.device = DeviceChoice::automatic;
  scene.linear_solver = Preconditioning::block_jacobi;
  EXPECT_TRUE(choice_for(scene, 1).gpu);
  EXPECT_EQ(choice_for(scene, 1).linear_solver, Preconditioning::block_jacobi);
}

TEST(MethodChoice, OfIntegratorsWithoutNewtonsMethodIsTheDeviceAlone) {
  Scene scene = sheet(1, 0.025, 500);
  scene.integrator = Integrator::semi_implicit;
  EXPECT_TRUE(choice_for(scene, 1).gpu);
  EXPECT_EQ(choice_for(scene, 1).linear_solver, Preconditioning::automatic);
}

TEST(MethodChoice, FactorisesOnAGpuWhateverTheSizeWhereTheSceneAsksForIt) {
  Scene scene = sheet(0.5, 0.5, 6000);
  scene.linear_solver = Preconditioning::cholesky;
  EXPECT_TRUE(choice_for(scene, 1).gpu);
  EXPECT_EQ(choice_for(scene, 1).linear_solver, Preconditioning::cholesky);
}

TEST(MethodChoice, SolvesInFloatByConjugateGradients) {
  Scene scene = sheet(0.2, 0.2, 300);
  scene.linear_precision = Precision::fp32;
  EXPECT_EQ(choice_for(scene, 0).linear_solver, Preconditioning::multigrid);
  EXPECT_TRUE(choice_for(scene, 0).in_float);
  scene.linear_solver = Preconditioning::cholesky;
  EXPECT_TRUE(test::says(test::refusal([&] { choice_for(scene, 0); }), "linear-precision = float"));
}

TEST(MethodChoice, HasNothingToDoInFloatWhereAllIsOrNewtonsMethodIsNotUsed) {
  Scene scene = sheet(0.2, 0.2, 300);
  scene.linear_precision = Precision::fp32;
  scene.precision = Precision::fp32;
  EXPECT_EQ(choice_for(scene, 0).linear_solver, Preconditioning::cholesky);
  EXPECT_FALSE(choice_for(scene, 0).in_float);
  scene.precision = Precision::fp64;
  scene.integrator = Integrator::semi_implicit;
  EXPECT_FALSE(choice_for(scene, 0).in_float);
}

// A band of half width w nodes has about n w^2/2 blocks' products, 27 multiplications each; a square's
// separators grow with its side.
TEST(MethodChoice, CountsWorkThatGrowsWithTheLengthOfAStripButWithTheSquareOfASheet) {
  const auto work = [](const Scene& scene) {
    const Cloth cloth = make_cloth(scene);
    return factorisation_work(cloth.mesh, neighbours_in(cloth.mesh),
                              make_curvature_operator(scene.element, cloth.mesh, cloth.held(scene, 0)));
  };
  EXPECT_LT(work(sheet(2, 0.02, 2000)), 2.3 * work(sheet(1, 0.02, 1000)));
  EXPECT_GT(work(sheet(0.4, 0.4, 4000)), 2.3 * work(sheet(0.4, 0.4, 2000)));
}

}  // namespace
}  // namespace hysteron
