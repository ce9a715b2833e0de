// Iterations of a linear solve level off with the aspect ratio of the cloth.
#include <gtest/gtest.h>

#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

// Returns the linear iterations per Newton iteration of strips so many squares wide and long, held at one
// end, that begin to swing.
double iterations_of_a_solve(int wide, int long_, Preconditioning solver) {
  constexpr double kWidth = 0.02;
  Scene scene = test::free_square(2 * wide * long_);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.width = kWidth;
  scene.cloth.length = kWidth * long_ / wide;
  scene.law = "prandtl";
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 60;
  scene.solver_tolerance = Scene{}.solver_tolerance;
  scene.linear_solver = solver;
  scene.pin = {test::pin_in({-1, -1, -1}, {0.011, 1, 1})};
  const auto simulation = test::Trial(scene).after(3);
  const Diagnostics counts = simulation->counts();
  return static_cast<double>(counts.linear) / static_cast<double>(counts.newton);
}

class SlenderCloth : public testing::TestWithParam<int> {};

TEST_P(SlenderCloth, TakesAtMostFortyIterationsOfMultigridAtFortyToOneAndHalfMoreThanAtTen) {
  constexpr double kMax = 40;
  const double short_strip = iterations_of_a_solve(GetParam(), 10 * GetParam(), Preconditioning::multigrid),
               slender = iterations_of_a_solve(GetParam(), 40 * GetParam(), Preconditioning::multigrid);
  EXPECT_GT(slender, 2);
  EXPECT_LE(slender, kMax);
  EXPECT_LE(slender, 1.5 * short_strip);  // growth with the root of the aspect ratio would be twofold
}

TEST_P(SlenderCloth, TakesAFewIterationsWithAFactorisation) {
  EXPECT_LE(iterations_of_a_solve(GetParam(), 40 * GetParam(), Preconditioning::cholesky), 6);
}

INSTANTIATE_TEST_SUITE_P(SquaresWide, SlenderCloth, testing::Values(3, 6),
                         [](const auto& info) { return std::to_string(info.param); });

}  // namespace
}  // namespace hysteron
