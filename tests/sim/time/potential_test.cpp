// These tests check the incremental potential of a whole cloth, its gradient, its stiffness and its minimum.
#include <gtest/gtest.h>

#include <random>

#include "sim/linear/dissected_factorisation.h"
#include "sim/linear/multigrid_solver.h"
#include "sim/time/newton.h"
#include "tests/sim/bending/coupled_pairs.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Positions;
using test::Trial;

constexpr double kStep = 1.0 / 60;

Positions random_vectors(std::size_t count, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  Positions result;
  for (std::size_t i = 0; i < count; ++i)
    result.emplace_back(uniform(generator), uniform(generator), uniform(generator));
  return result;
}

double dot(const Positions& a, const Positions& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

Positions moved(const Positions& x, double fraction, const Positions& d) {
  Positions result = x;
  for (std::size_t i = 0; i < x.size(); ++i) result[i] += fraction * d[i];
  return result;
}

struct PotentialCase {
  std::string law, element;
  bool stiff = false;  // with strains averaged at nodes
};

// A cloth on an inclined ground with everything a step can have: history, viscosity, drag, friction.
struct Step {
  Trial trial;
  Cpu cpu{1};
  CurvatureOperator op;
  std::vector<char> held;
  BlockRows<double, Cpu> rows;
  Membrane<double, Cpu> membrane;
  Bending<double, Cpu> bending;
  Contact<double, Cpu> contact;
  Buffer<double, Cpu> mass;
  IncrementalPotential<double, Cpu> potential;
  Positions reference, predicted;

  static Scene scene(const PotentialCase& of, double friction) {
    Scene s = test::hanging_square(150);
    s.law = of.law;
    s.element = value_named<BendingElement>(of.element);
    if (of.stiff) s.fabric = stiff(s.fabric);
    s.air_drag = 0.1;
    s.fabric.friction = friction;
    Obstacle ground;
    ground.center = {0.1, 0.1, -0.2e-3};
    ground.axis = {0, 0, 1};
    s.obstacle = {ground};
    return s;
  }

  static Fabric stiff(Fabric fabric) {
    fabric.warp = 3e4;
    fabric.weft = 5e3;
    fabric.coupling = 2e3;
    fabric.in_plane = {{{0.003}, {900}}, {}, {{0.01}, {20}}};
    return fabric;
  }

  explicit Step(const PotentialCase& of, double friction = 0.3, bool bending_lags = false)
      : trial(scene(of, friction)),
        op(make_curvature_operator(value_named<BendingElement>(of.element), trial.cloth.mesh,
                                   trial.cloth.held(trial.scene, 0))),
        held(trial.cloth.held(trial.scene, 0)),
        rows(cpu, membrane_couplings(trial.cloth.mesh, trial.scene.fabric, trial.scene.membrane_element)),
        membrane(cpu, trial.cloth.mesh, trial.scene.fabric, trial.scene.membrane_element, rows),
        bending(cpu, trial.cloth.mesh, op,
                make_law_loop<double>(cpu, choose_law(of.law, trial.scene.fabric.virgin_curve(), {}),
                                      op.dimension, op.elements()),
                ForceConvention::energy, trial.scene.fabric.damping * trial.scene.fabric.b1),
        contact(cpu, trial.cloth.mesh, trial.scene),
        mass(cpu, masses()),
        potential(cpu, rows, membrane, bending, &contact, nullptr, mass, bending_lags),
        reference(trial.cloth.mesh.rest),
        predicted(trial.cloth.mesh.rest) {
    contact.move(0, 0);
    const Positions still(reference.size(), Vector3d::Zero());
    bending.commit(reference.data(), still.data(), 0);
  }

  std::vector<double> masses() const {
    std::vector<double> m;
    for (int i = 0; i < trial.cloth.mesh.vertices(); ++i) m.push_back(trial.mass(i));
    return m;
  }
  // Bends and unbends the cloth so that its history is not virgin.
  void give_it_a_past() {
    const Positions still(reference.size(), Vector3d::Zero());
    for (double size : {2e-3, -1e-3, 0.5e-3}) {
      const Positions x = moved(trial.cloth.mesh.rest, size, random_vectors(reference.size(), 1, 3));
      bending.commit(x.data(), still.data(), 1e-3);
    }
  }
  void begin(double step = kStep) {
    const StepFormula formula = StepFormula::backward_euler(step);
    potential.begin({formula, formula, reference.data(), nullptr, reference.data(), predicted.data(),
                     held.data(), trial.scene.gravity, trial.scene.air_drag / trial.scene.fabric.density, 1});
  }
  PotentialValue at(const Positions& x, const Positions& direction) {
    return potential.evaluate(x.data(), direction.data());
  }
  Positions gradient() const {
    Positions g(potential.gradient(), potential.gradient() + reference.size());
    for (std::size_t i = 0; i < g.size(); ++i)
      if (held[i]) g[i].setZero();
    return g;
  }
  Positions free_direction(unsigned seed) const {
    Positions d = random_vectors(reference.size(), 1, seed);
    for (std::size_t i = 0; i < d.size(); ++i)
      if (held[i]) d[i].setZero();
    return d;
  }
  Positions product(const LinearSystem<double, Cpu>& system, const Positions& p) {
    const GatheredForces<double> bending_force = system.bending(p.data());
    Positions q(p.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!held[i]) {
        const int row = static_cast<int>(i);
        q[i] = (system.softening.off_diagonal ? system.matrix.times(row, p.data(), system.softening)
                                              : system.matrix.times(row, p.data())) -
               bending_force.at(row);
      }
    return q;
  }
};

class OfACloth : public testing::TestWithParam<PotentialCase> {};
const PotentialCase kPotentialCases[] = {
    {"linear", "hinge"}, {"prandtl", "hinge"},     {"prandtl", "shape"},       {"wong", "shape"},
    {"kim", "shape"},    {"terzopoulos", "hinge"}, {"prandtl", "shape", true}, {"linear", "hinge", true}};

INSTANTIATE_TEST_SUITE_P(Laws, OfACloth, testing::ValuesIn(kPotentialCases), [](const auto& c) {
  return c.param.law + "_" + c.param.element + (c.param.stiff ? "_stiff" : "");
});

void expect_gradient_of_second_order(Step& step) {
  step.give_it_a_past();
  step.begin();
  const Positions x = moved(step.reference, 1e-3, random_vectors(step.reference.size(), 1, 5));
  const Positions d = step.free_direction(6);
  step.potential.update_friction_limits(x.data());
  const double slope = step.at(x, d).slope;
  ASSERT_NE(slope, 0);
  const auto error = [&](double h) {
    const double rise = step.at(moved(x, h, d), d).energy - step.at(moved(x, -h, d), d).energy;
    return std::abs(rise / (2 * h) - slope);
  };
  const double coarse = error(2e-5), fine = error(5e-6);
  EXPECT_GT(std::log(coarse / fine) / std::log(4), 1.7);
}

TEST_P(OfACloth, GradientIsTheDerivativeOfThePotentialToSecondOrder) {
  Step step(GetParam());
  expect_gradient_of_second_order(step);
}

// Bending is then a given force, which a past has left.
TEST_P(OfACloth, GradientIsThePotentialsWhereBendingLags) {
  Step step(GetParam(), 0.3, true);
  expect_gradient_of_second_order(step);
}

// How the gradient, `base` at x, changes along p is `linear` to second order.
void expect_derivative_of_second_order(Step& step, const Positions& x, const Positions& p,
                                       const Positions& base, const Positions& linear) {
  const auto error = [&](double h) {
    step.at(moved(x, h, p), p);
    const Positions difference = moved(moved(step.gradient(), -1, base), -h, linear);
    return std::sqrt(dot(difference, difference));
  };
  EXPECT_GT(std::log10(error(1e-6) / error(1e-7)), 1.7);
}

// The Gauss-Newton stiffness is the whole Hessian where there is no stress.
TEST_P(OfACloth, StiffnessIsTheDerivativeOfTheGradientWhereNothingIsStressed) {
  Step step(GetParam());
  step.begin();
  const Positions x = step.reference, p = step.free_direction(7);
  step.potential.update_friction_limits(x.data());
  step.at(x, p);
  const Positions base = step.gradient();
  const Positions linear = step.product(step.potential.linearise(x.data(), 0, false), p);
  ASSERT_GT(dot(linear, p), 0);
  expect_derivative_of_second_order(step, x, p, base, linear);
}

constexpr double kLong = 0.1;    // [s], in which inertia does not hold a pressed sheet flat
constexpr double kLifted = 0.1;  // [m], out of the obstacle

// So is the full one of a flat cloth under compression, which it would leave for either side.
TEST_P(OfACloth, FullStiffnessIsTheDerivativeOfTheGradientOfAPressedSheet) {
  Step step(GetParam());
  step.begin(kLong);
  Positions x = step.reference;
  for (Vector3d& v : x) v = Vector3d(0.9 * v.x(), v.y(), v.z() + kLifted);
  const Positions p = step.free_direction(7);
  step.potential.update_friction_limits(x.data());
  step.at(x, p);
  const Positions base = step.gradient();
  const LinearSystem<double, Cpu> system = step.potential.linearise(x.data(), 0, true);
  const Positions linear = step.product(system, p);
  Positions out_of_plane = p;
  for (Vector3d& v : out_of_plane) v.x() = v.y() = 0;
  EXPECT_LT(dot(out_of_plane, step.product(system, out_of_plane)), 0);
  expect_derivative_of_second_order(step, x, p, base, linear);
}

// Limits of friction change Phi where the cloth touches; membrane and bending are not asked again.
TEST_P(OfACloth, TheAssembledStiffnessIsThatOfTheParts) {
  Step step(GetParam());
  step.give_it_a_past();
  step.begin();
  const Positions x = moved(step.reference, 1e-3, random_vectors(step.reference.size(), 1, 5));
  const Positions d = step.free_direction(6);
  step.potential.update_friction_limits(x.data());
  for (const bool full : {false, true}) {
    step.at(x, d);
    const Positions parts = step.product(step.potential.linearise(x.data(), 1, full), d);
    step.potential.assemble();
    const auto whole = step.potential.linearise(x.data(), 1, full).whole;
    double largest = 0;
    for (const Vector3d& force : parts) largest = std::max(largest, force.norm());
    EXPECT_GT(largest, 0);
    for (int i = 0; i < whole.rows; ++i)
      if (!step.held[i]) {
        EXPECT_LT((whole.times(i, d.data()) - parts[i]).norm(), 1e-12 * largest) << i << " " << full;
      }
    // Nodes couple no more than elements of shape do, and more than hinges.
    EXPECT_EQ(whole.row_ptr[whole.rows],
              std::max(static_cast<int>(test::coupled_pairs(step.trial.cloth.mesh, step.op)),
                       static_cast<int>(step.rows.col().size())));
  }
}

// The fronts are those of the stiffness without softening, four parts and what separates them.
TEST_P(OfACloth, AFactorisationInFrontsSolvesItInAFewIterations) {
  constexpr double kTolerance = 1e-10;
  Step step(GetParam());
  step.give_it_a_past();
  step.begin();
  const Positions x = moved(step.reference, 1e-3, random_vectors(step.reference.size(), 1, 5));
  step.potential.update_friction_limits(x.data());
  step.at(x, step.free_direction(6));
  auto factor = std::make_unique<DissectedFactorisation<double, Cpu>>(
      step.cpu, std::make_unique<AssembledStiffness<double, Cpu>>(step.cpu, step.rows, step.bending),
      DissectionShape{2, 2});
  EXPECT_EQ(factor->plan().level.size(), 2u);
  CholeskySolver<double, Cpu> solver(step.cpu, static_cast<int>(x.size()), std::move(factor));
  const LinearSystem<double, Cpu> system = step.potential.linearise(x.data(), 1, false);
  const Vector3d* force = step.potential.descent();
  Positions solution(x.size());
  const PcgOutcome outcome = solver.solve(system, step.held.data(), force, solution.data(), kTolerance);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.iterations, 3);
  const Positions product = step.product(system, solution);
  double error2 = 0, size2 = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (step.held[i]) continue;
    error2 += (product[i] - force[i]).squaredNorm();
    size2 += force[i].squaredNorm();
  }
  constexpr double kPlain = 1e3 * kTolerance;  // for a residual that was measured in the factorisation's norm
  EXPECT_LT(std::sqrt(error2 / size2), kPlain);
}

TEST_P(OfACloth, RenewedFrictionIsThatOfANewEvaluation) {
  Step renewed(GetParam()), anew(GetParam());
  PotentialValue before, values[2];
  const Positions x = moved(anew.reference, 1e-4, random_vectors(anew.reference.size(), 1, 15));
  for (Step* step : {&renewed, &anew}) {
    step->give_it_a_past();
    step->begin();
    step->potential.update_friction_limits(step->reference.data());
    before = step->potential.evaluate(x.data(), nullptr);
  }
  const long loops = device_counts.loops;
  values[0] = renewed.potential.renew_friction(x.data());
  const long renewing = device_counts.loops - loops;
  anew.potential.update_friction_limits(x.data());
  values[1] = anew.potential.evaluate(x.data(), nullptr);
  EXPECT_LT(renewing, device_counts.loops - loops - renewing);
  EXPECT_NE(values[0].energy, before.energy);
  EXPECT_EQ(values[0].energy, values[1].energy);
  EXPECT_EQ(values[0].residual, values[1].residual);
  EXPECT_EQ(renewed.gradient(), anew.gradient());
}

Positions pressed_almost_flat(const Step& step) {
  Positions x = step.reference;
  for (Vector3d& v : x) v = Vector3d(0.9 * v.x(), v.y(), v.z() + kLifted);
  return moved(x, 1e-7, step.free_direction(12));
}

TEST_P(OfACloth, SolvingWithAnIndefiniteStiffnessLeadsDownhill) {
  Step step(GetParam());
  step.begin(kLong);
  const Positions x = pressed_almost_flat(step);
  step.potential.update_friction_limits(x.data());
  const double here = step.at(x, x).energy;
  Positions load = moved(Positions(x.size(), Vector3d::Zero()), -1, step.gradient());
  for (Vector3d& v : load) v.x() = v.y() = 0;  // only what acts out of the plane
  const LinearSystem<double, Cpu> system = step.potential.linearise(x.data(), 0, true);
  BlockJacobiSolver<double, Cpu> solver(step.cpu, static_cast<int>(x.size()));
  Positions direction(x.size(), Vector3d::Zero());
  EXPECT_FALSE(solver.solve(system, step.held.data(), load.data(), direction.data(), 1e-3).converged);
  EXPECT_GT(dot(direction, load), 0);
  double least = here;
  for (double fraction = 1; fraction > 1e-6; fraction /= 2)
    least = std::min(least, step.at(moved(x, fraction, direction), direction).energy);
  EXPECT_LT(least, here * (1 - 1e-12));
}

TEST_P(OfACloth, StiffnessIsPositiveAndSymmetricAlsoUnderCompression) {
  constexpr double kSymmetric = 1e-11;  // rounding of sums of some hundred terms
  Step step(GetParam());
  step.give_it_a_past();
  step.begin();
  Positions x = moved(step.reference, 5e-4, random_vectors(step.reference.size(), 1, 8));
  for (Vector3d& p : x) p.x() *= 0.9;
  step.potential.update_friction_limits(x.data());
  step.at(x, x);
  const LinearSystem<double, Cpu> system = step.potential.linearise(x.data(), 0, false);
  for (unsigned seed = 10; seed < 20; ++seed) {
    const Positions p = step.free_direction(seed), q = step.free_direction(seed + 100);
    const Positions of_p = step.product(system, p), of_q = step.product(system, q);
    EXPECT_GT(dot(p, of_p), 0);
    EXPECT_NEAR(dot(q, of_p), dot(p, of_q), kSymmetric * std::sqrt(dot(p, of_p) * dot(q, of_q)));
  }
}

// The first iterates are the same however many are allowed, so that their potentials can be compared.
TEST_P(OfACloth, LineSearchNeverAcceptsAnIncrease) {
  double last = 1e30;
  int decreases = 0;
  for (int iterations = 0; iterations <= 8; ++iterations) {
    Step step(GetParam(), 0);  // friction's limits change from iterate to iterate
    step.give_it_a_past();
    step.begin();
    MultigridSolver<double, Cpu> solver(
        step.cpu, step.trial.cloth.mesh,
        make_rest_hierarchy(step.trial.cloth.mesh, neighbours_in(step.trial.cloth.mesh), step.held),
        step.trial.scene.fabric.b1);
    NewtonLimits limits;
    limits.iterations = iterations;
    Newton<double, Cpu> newton(step.cpu, step.mass.size(), step.potential, solver, limits);
    Buffer<Vector3d, Cpu> x(step.cpu, moved(step.reference, 3e-3, step.free_direction(9)));
    step.potential.update_friction_limits(x.data());
    const PotentialValue first = step.potential.evaluate(x.data(), nullptr);
    newton.minimise(x, first, step.held.data(), step.mass.data(), 1, kStep);
    const PotentialValue value = step.potential.evaluate(x.data(), nullptr);
    const double rounding = 1e-14 * value.size;
    EXPECT_LE(value.energy, last + rounding) << iterations;
    decreases += value.energy < last - rounding;
    last = value.energy;
  }
  EXPECT_GE(decreases, 4);
}

}  // namespace
}  // namespace hysteron
