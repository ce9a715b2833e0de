// The order of calls of an implicit step, and when Newton's method ends.
#include "sim/time/implicit_step.h"

#include <gtest/gtest.h>

#include <optional>

#include "sim/bending/curvature_operator.h"
#include "sim/time/convergence.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

TEST(ImplicitStep, IsAcceptedOnceAndOnlyAfterASolution) {
  Scene scene = test::hanging_square(4);
  scene.integrator = Integrator::implicit;
  const Cloth cloth = make_cloth(scene);
  const CurvatureOperator op =
      make_curvature_operator(scene.element, cloth.mesh, cloth.held_throughout(scene));
  Body<double, Cpu> body(std::make_unique<Cpu>(1), scene, cloth, op);
  ImplicitStep<double, Cpu> step(body);
  EXPECT_THROW(step.accept(), std::bad_optional_access);
  EXPECT_THROW(step.local_error(), std::bad_optional_access);
  body.begin_stage(0, scene.step);
  ASSERT_TRUE(step.solve(scene.step, 1, true).is_accepted());
  EXPECT_GT(step.local_error(), 0);
  const auto before = body.x.download();
  step.accept();
  EXPECT_NE(body.x.download(), before);
  EXPECT_THROW(step.accept(), std::bad_optional_access);
}

// One unit of mass on which forces of 1 N are at work, in a step of 1 s.
struct Minimisation {
  NewtonLimits limits;
  PotentialValue begun{.energy = 1, .size = 1, .residual = 1, .internal = 1, .weight = 1};
  Convergence<double> convergence{limits, begun, 1, 1, 1, false, false};

  // Takes a full step along a correction of this length [m], which leaves an unbalanced force [N].
  void take(double length, double residual) {
    convergence.weigh(begun);
    convergence.measure({.size2 = length * length, .slope = -length, .extent2 = 1, .forces2 = 0}, begun);
    PotentialValue value = begun;
    value.residual = residual;
    convergence.add_step(1, value, true);
    convergence.begin_next(residual);
    convergence.weigh(value);
  }
  std::optional<NewtonEnd> end(int iterations = 1) const {
    return convergence.end_at_iterate(iterations, true);
  }
};

TEST(Convergence, TakesASmallForceOrASmallCorrectionBesideABalance) {
  Minimisation small_force, small_correction, stiff, neither;
  small_force.take(1, 0.5 * small_force.limits.residual);
  EXPECT_EQ(small_force.end(), NewtonEnd::converged);
  small_correction.take(1e-10, 1e-4);
  EXPECT_EQ(small_correction.end(), NewtonEnd::converged);
  stiff.take(1e-10, 1e-2);  // a stiffness far above the true one makes any correction small
  EXPECT_EQ(stiff.end(), std::nullopt);
  neither.take(1, 1e-4);
  EXPECT_EQ(neither.end(), std::nullopt);
}

TEST(Convergence, WaitsForBodiesOnTheirWay) {
  Minimisation still_moving;
  still_moving.take(1, 0);
  EXPECT_EQ(still_moving.convergence.end_at_iterate(1, false), std::nullopt);
  EXPECT_EQ(still_moving.end(), NewtonEnd::converged);
}

TEST(Convergence, EndsAtItsLastIterationAsTheLimitsHaveIt) {
  for (bool take : {false, true}) {
    Minimisation slow;
    slow.limits.take_unconverged = take;
    slow.take(1, 0.5);
    EXPECT_EQ(slow.end(slow.limits.iterations - 1), std::nullopt);
    EXPECT_EQ(slow.end(slow.limits.iterations), take ? NewtonEnd::unbalanced : NewtonEnd::failed);
    EXPECT_EQ(slow.convergence.end_at_standstill(slow.begun, true),
              take ? NewtonEnd::unbalanced : NewtonEnd::failed);
  }
}

}  // namespace
}  // namespace hysteron
