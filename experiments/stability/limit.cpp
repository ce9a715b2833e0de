#include "experiments/stability/stability.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.2;  // [m]
// Ratios of the steps that are tried first: bent cloth resonates at isolated steps, in narrow ranges.
constexpr double kCoarse = 1.41421356, kFine = 1.08;
constexpr double kResolution = 1.01;  // relative precision of the limit
constexpr double kGrowing = 2;        // ratio of the energy in the second half to the first
// Below the limit the true energy is at most 1/(1 - r^2) times the one that symplectic Euler conserves, with
// r the step over the limit: 100 at r = 0.995.  Beyond it waves grow until the implicit membrane holds them.
constexpr double kLargest = 100;
constexpr int kEnergyLooks = 200;  // number of energy samples; a diverging run makes the solver slow

constexpr double kCoupledWave = 2e-4;  // [m], see LimitCase::amplitude
// The properties of the waves; 0.1 ms is the damping of shipped fabrics.
struct Waves {
  const char* law;
  double damping, amplitude;
  bool also_held;
};
constexpr Waves kWaves[] = {
    {"linear", 0, kLinearWave, true},       {"linear", 1e-4, kLinearWave, true},
    {"linear", 1e-2, kLinearWave, false},   {"prandtl", 1e-2, kLinearWave, false},
    {"prandtl", 0, kLinearWave, false},     {"linear", 1e-4, kCoupledWave, false},
    {"prandtl", 1e-4, kCoupledWave, false}, {"linear", 0, kCoupledWave, false},
    {"prandtl", 0, kCoupledWave, false},
};

Scene limit_scene(const LimitCase& of) {
  Scene scene = default_scene("cotton-broad-k50");
  scene.integrator = Integrator::semi_implicit;
  scene.cloth.length = kLength;
  scene.triangles = 128;
  scene.mesh = enum_name(of.mesh);
  scene.element = of.element;
  scene.law = of.law;
  scene.fabric.damping = of.damping;
  scene.gravity.setZero();
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  if (of.held) scene.pin = {held_between(0, 1e-6)};
  return scene;
}

// Shakes the vertices at random, so that every mode has a share.
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
  scene.step = 1e-9;  // so that any shorter step is allowed
  return make_simulation(scene, make_cloth(scene))->limits().bending_step;
}

// Asks the back end directly, as the program refuses steps beyond its bound.
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
    long done = 0;
    for (int look = 0; look < kEnergyLooks; ++look) {
      const long until = static_cast<long>(substeps) * (look + 1) / kEnergyLooks;
      if (until == done) continue;  // fewer steps than samples
      simulation->advance(static_cast<int>(until - done));
      done = until;
      double& most = half[2 * look / kEnergyLooks];
      most = std::max(most, energy(*simulation));
      if (!(most < kLargest * initial) || half[1] > kGrowing * half[0]) return false;
    }
  } catch (const Error&) {
    return false;  // not finite
  }
  return true;
}

bool is_bounded(const LimitCase& of, double step, int substeps) {
  return is_bounded(of, kLinearWave, step, substeps) &&
         (!of.resonates() || is_bounded(of, of.amplitude, step, substeps));
}

}  // namespace

MeasuredLimit measure_limit(const LimitCase& of, int substeps) {
  MeasuredLimit result{of, time_step_bound(of)};
  const double next = of.resonates() ? kFine : kCoarse;
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
  result.is_beyond_search = ratio > kMaxRatio;
  result.measured = (result.is_beyond_search ? kMaxRatio : bounded) * result.bound;
  return result;
}

std::vector<LimitCase> limit_cases(bool quick) {
  std::vector<LimitCase> cases;
  for (const Waves& waves : kWaves) {
    for (const MeshFamily mesh : every_value<MeshFamily>()) {
      if (mesh == MeshFamily::aligned45) continue;
      for (const BendingElement element : {BendingElement::shape, BendingElement::hinge}) {
        cases.push_back({mesh, element, false, waves.law, waves.damping, waves.amplitude});
        if (!waves.also_held || quick) continue;
        cases.push_back(cases.back());
        cases.back().held = true;
      }
    }
    if (quick) break;
  }
  return cases;
}

}  // namespace hysteron::experiments
