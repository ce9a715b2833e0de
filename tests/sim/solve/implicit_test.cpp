// Implicit steps in motion: order, independence of the solver's details, stiff and long runs, losses.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/solve/scenes.h"

namespace hysteron {
namespace {

using test::Positions;
using test::Trial;

// A soft sheet that swings and shakes: its fastest membrane wave has a period of some 10 ms, so that steps of
// a millisecond resolve everything.
Scene soft_sheet(const std::string& law, const std::string& integrator, double step) {
  Scene scene = test::hanging_square(40);
  scene.law = law;
  scene.integrator = integrator;
  scene.step = step;
  scene.fabric.warp = scene.fabric.weft = 10;
  scene.fabric.shear = 3;
  scene.fabric.b1 *= 10;
  scene.fabric.b2 *= 10;
  scene.fabric.k0 = 5;
  scene.newton_residual = 1e-11;
  scene.newton_velocity = 0;
  return scene;
}

Positions shape_after(const Scene& scene, double seconds) {
  Trial trial(scene);
  test::ripple(trial.cloth, 5e-3);
  return trial.after(static_cast<int>(std::lround(seconds / scene.step)))->positions();
}

struct OrderCase {
  std::string law, integrator;
  double order;
};
class Order : public testing::TestWithParam<OrderCase> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Order,
                         testing::Values(OrderCase{"linear", "implicit", 1}, OrderCase{"linear", "bdf2", 2},
                                         OrderCase{"prandtl", "implicit", 1},
                                         OrderCase{"prandtl", "bdf2", 2}),
                         [](const auto& c) { return c.param.law + "_" + c.param.integrator; });

// Against symplectic steps of 10 us, for a time in which the cloth bends and unbends.
TEST_P(Order, AgreesWithTinyExplicitStepsThroughReversals) {
  constexpr double kSeconds = 0.064, kTiny = 1e-6;
  const OrderCase& c = GetParam();
  const Positions exact = shape_after(soft_sheet(c.law, "explicit", kTiny), kSeconds);
  const auto error = [&](double step) {
    return test::farthest(shape_after(soft_sheet(c.law, c.integrator, step), kSeconds), exact);
  };
  const double step = c.order == 1 ? 0.1e-3 : 0.4e-3;
  const double coarse = error(step), fine = error(step / 2);
  EXPECT_GT(fine, 0);
  EXPECT_GT(std::log2(coarse / fine), c.order - 0.25);
}

}  // namespace
}  // namespace hysteron
