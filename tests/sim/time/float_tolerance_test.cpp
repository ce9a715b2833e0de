// Linear solves in single precision end where rounding decides.
#include <gtest/gtest.h>

#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

// The square of `bench`, in steps as short as those of a far finer mesh.
double iterations(Precision precision) {
  Scene scene = test::free_square(2048);
  scene.cloth.length = 0.5;
  scene.mesh = "aligned";
  scene.pin = {test::pin_at(0, 0.5), test::pin_at(0.5, 0.5)};
  scene.substeps = 40;
  scene.solver_tolerance = Scene{}.solver_tolerance;
  scene.precision = precision;
  const Diagnostics counts = test::Trial(scene).after(5)->counts();
  return counts.per_step(counts.linear);
}

// Iterations beyond this tolerance follow the rounding of positions: they were 1.6 times as many here, and
// more the finer the mesh.
TEST(SemiImplicitIntegrator, TakesNoMoreIterationsInSinglePrecisionThanInDouble) {
  constexpr double kMax = 1.1;
  EXPECT_LT(iterations(Precision::fp32), kMax * iterations(Precision::fp64));
}

}  // namespace
}  // namespace hysteron
