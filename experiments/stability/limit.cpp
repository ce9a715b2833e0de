#include "experiments/stability/limit.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/base/parallel.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.2;  // [m]
// Ratios of the steps that are tried first: bent cloth resonates at isolated steps, in narrow ranges.
constexpr double kCoarse = 1.41421356, kFine = 1.08;
constexpr double kResolution = 1.01;  // ratio to which the limit is measured
constexpr double kGrowing = 2;        // energy of the second half over the first
// Below the limit the true energy is at most 1/(1 - r^2) times the one that symplectic Euler conserves, with
// r the step over the limit: 100 at r = 0.995.  Beyond it waves grow until the implicit membrane holds them.
constexpr double kLargest = 100;
constexpr int kEnergyLooks = 200;  // times that the energy is measured: what blows up makes the solver slow

const std::vector<double> kLinear = {1e-9}, kCoupled = {1e-9, 2e-4};  // [m] see LimitCondition::amplitudes
const LimitCondition kConditions[] = {
    {"linear, undamped", "linear", 0, kLinear},
    {"linear, shipped damping 0.1 ms", "linear", 1e-4, kLinear},
    {"linear, damping 10 ms", "linear", 1e-2, kLinear},
    {"prandtl, damping 10 ms", "prandtl", 1e-2, kLinear},
    {"prandtl, undamped", "prandtl", 0, kLinear},
    {"linear, shipped damping, waves up to 0.2 mm", "linear", 1e-4, kCoupled},
    {"prandtl, shipped damping, waves up to 0.2 mm", "prandtl", 1e-4, kCoupled},
    {"linear, undamped, waves up to 0.2 mm", "linear", 0, kCoupled},
    {"prandtl, undamped, waves up to 0.2 mm", "prandtl", 0, kCoupled},
};
constexpr int kHeldConditions = 2;  // the first ones, in which cloth is also held

Scene limit_scene(const LimitCase& of) {
  Scene scene = default_scene("cotton-broad-k50");
  scene.integrator = Integrator::semi_implicit;
  scene.cloth.length = kLength;
  scene.triangles = 128;
  scene.mesh = of.mesh;
  scene.element = of.element;
  scene.law = of.condition.law;
  scene.fabric.damping = of.condition.damping;
  scene.gravity.setZero();
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  if (of.held) scene.pin = {held_between(0, 1e-6)};
  return scene;
}

// Random, so that every mode has a share.
Cloth shaken_cloth(const Scene& scene, double amplitude) {
  Cloth cloth = make_cloth(scene);
  std::mt19937 generator(12);
  for (std::size_t i = 0; i < cloth.start.size(); ++i) {
    const double fraction = 2.0 * generator() / std::mt19937::max() - 1;
    if (cloth.pin[i] < 0) cloth.start[i].z() += amplitude * fraction;
  }
  return cloth;
}

double energy(Simulation& simulation) {
  const Ledger l = simulation.ledger();
  return l.kinetic + l.membrane + l.bending;
}

double time_step_bound(const LimitCase& of) {
  Scene scene = limit_scene(of);
  scene.step = 1e-9;  // any step is allowed that is short enough
  return make_simulation(scene, make_cloth(scene))->limits().bending_step;
}

// The program refuses steps beyond its bound, so that its back end is asked directly.
bool is_bounded(const LimitCase& of, double amplitude, double step, int substeps) {
  Scene scene = limit_scene(of);
  scene.step = step;
  StepLimits limits;
  limits.substep = step;
  const Cloth cloth = shaken_cloth(scene, amplitude);
  const CurvatureOperator op = make_curvature_operator(scene.element, cloth.mesh, cloth.held(scene, 0));
  const auto simulation = make_cpu_simulation(scene, cloth, op, limits);
  const double initial = energy(*simulation);
  double half[2] = {initial, 0};
  try {
    for (int look = 0; look < kEnergyLooks; ++look) {
      simulation->advance(substeps / kEnergyLooks);
      double& most = half[2 * look / kEnergyLooks];
      most = std::max(most, energy(*simulation));
      if (!(most < kLargest * initial) || half[1] > kGrowing * half[0]) return false;
    }
  } catch (const Error&) {
    return false;  // no longer finite
  }
  return true;
}

}  // namespace

bool is_bounded(const LimitCase& of, double step, int substeps) {
  const auto& amplitudes = of.condition.amplitudes;
  return std::all_of(amplitudes.begin(), amplitudes.end(),
                     [&](double amplitude) { return is_bounded(of, amplitude, step, substeps); });
}

MeasuredLimit measure_limit(const LimitCase& of, int substeps) {
  MeasuredLimit result{of, time_step_bound(of)};
  const double next = of.condition.resonates() ? kFine : kCoarse;
  double bounded = 0, ratio = kMinRatio;
  while (ratio <= kMaxRatio && is_bounded(of, ratio * result.bound, substeps)) {
    bounded = ratio;
    ratio *= next;
  }
  const bool bracketed = bounded > 0 && ratio <= kMaxRatio;
  while (bracketed && ratio / bounded > kResolution) {
    const double middle = std::sqrt(ratio * bounded);
    (is_bounded(of, middle * result.bound, substeps) ? bounded : ratio) = middle;
  }
  result.measured = (ratio > kMaxRatio ? kMaxRatio : bounded) * result.bound;
  return result;
}

std::vector<LimitCase> limit_cases(bool quick) {
  std::vector<LimitCase> cases;
  for (const LimitCondition& condition : kConditions) {
    for (const char* mesh : {"aligned", "flipped", "unionjack", "equilateral", "random"}) {
      for (BendingElement element : {BendingElement::shape, BendingElement::hinge}) {
        for (const bool held : {false, true}) {
          const auto index = &condition - kConditions;
          if ((held && index >= kHeldConditions) || (quick && (held || index > 0))) continue;
          cases.push_back({mesh, element, held, condition});
        }
      }
    }
  }
  return cases;
}

std::vector<MeasuredLimit> measure_limits(const std::vector<LimitCase>& cases, int substeps, int threads) {
  std::vector<MeasuredLimit> limits(cases.size());
  in_parallel(cases.size(), threads, [&](std::size_t i) { limits[i] = measure_limit(cases[i], substeps); });
  return limits;
}

}  // namespace hysteron::experiments
