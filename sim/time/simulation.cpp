// Host code: which device, which precision, how many substeps.
#include "sim/time/simulation.h"

#include <cmath>
#include <cstdio>

#include "sim/base/error.h"
#include "sim/bending/bending.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/penalty.h"
#include "sim/contact/start_checks.h"
#include "sim/membrane/membrane.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/back_end.h"

namespace hysteron {
namespace {

// Power iteration approaches the highest frequency from below, folds stiffen a mesh, and near the bound
// bending waves feed on the membrane: at 0.9 a shaken sheet slowly gains energy
// (tests/sim/solve/stability_test.cpp).
constexpr double kStabilityMargin = 0.75;
constexpr int kMostSubsteps = 100000;

// Stiffness of the law over that of `linear` bounds the frequency; the chapter's printed force has 1/2 in
// place of |e|.
double bending_eigenvalue(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op,
                          const std::vector<double>& mass, const std::vector<char>& held, double stiffness) {
  double lambda = bending_spectral_radius(cloth.mesh, op, stiffness, mass, held);
  if (scene.force == "chapter") {
    double largest = 0;
    for (int h = 0; h < cloth.mesh.interior_edges; ++h) {
      const Edge& e = cloth.mesh.edge[h];
      largest = std::max(largest, 0.5 / (cloth.mesh.rest[e.p3] - cloth.mesh.rest[e.p2]).norm());
    }
    lambda *= largest;
  }
  return lambda;
}

// Symplectic Euler with viscosity: lambda dt^2 + 2 nu dt <= 4, lambda the largest eigenvalue of M^-1 K
// [1/s^2] and nu that of the viscous matrix [1/s].
double stable_step(double lambda, double nu) {
  if (lambda <= 0 && nu <= 0) return 1e30;
  return kStabilityMargin * 4 / (nu + std::sqrt(nu * nu + 4 * lambda));
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

StepLimits choose_substeps(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op) {
  const std::vector<char> held = cloth.held_throughout(scene);
  std::vector<double> mass;
  for (double area : cloth.mesh.vertex_area) mass.push_back(scene.fabric.density * area);
  const double unit = bending_eigenvalue(scene, cloth, op, mass, held, 1);
  const double bending = law_largest_stiffness(scene, op) * unit;
  // The viscosity is damping * b1, whatever the law's stiffness (sim/solve/stepper.cpp).
  const double viscous = scene.fabric.damping * scene.fabric.b1 * unit;
  StepLimits limits;
  if (scene.is_implicit()) {
    limits.bending_step = stable_step(bending, viscous);
    limits.substep = scene.step;
    return limits;
  }
  limits.bending_step = stable_step(bending, viscous);
  double largest = limits.bending_step;
  if (scene.integrator == "explicit") {
    double stiff = membrane_spectral_radius(cloth.mesh, scene.fabric, mass, held);
    const double viscous_membrane = scene.fabric.damping * stiff;
    if (!scene.obstacle.empty()) stiff += contact_stiffness_per_area(scene) / scene.fabric.density;
    limits.membrane_step = stable_step(stiff + bending, viscous_membrane + viscous);
    largest = limits.membrane_step;
  }
  const double least = std::ceil(scene.step / largest);
  if (least > kMostSubsteps)
    throw Error::request("step = " + number(scene.step) + " s would take " + number(least) +
                         " explicit substeps of at most " + number(largest) +
                         " s: coarsen the mesh or soften b1");
  limits.substeps = std::max(1, static_cast<int>(least));
  if (scene.substeps > 0) {
    if (scene.substeps < limits.substeps)
      throw Error::request("substeps = " + std::to_string(scene.substeps) + " is unstable: step = " +
                           number(scene.step) + " s needs at least " + std::to_string(limits.substeps) +
                           " substeps of at most " + number(largest) + " s");
    limits.substeps = scene.substeps;
  }
  limits.substep = scene.step / limits.substeps;
  return limits;
}

bool wants_gpu(const Scene& scene) {
  if (scene.device == "cpu") return false;
  std::string reason;
  if (gpu_count(reason) > 0) return true;
  if (scene.device == "cuda") throw Error::machine("device = cuda: " + reason + "; use --device cpu");
  return false;
}

}  // namespace

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Cloth& cloth) {
  if (scene.integrator != "semi-implicit" && scene.integrator != "explicit" && !scene.is_implicit())
    throw Error::request("integrator = " + scene.integrator +
                         " must be semi-implicit | implicit | bdf2 | quasi-static | explicit");
  if (scene.pin.size() > static_cast<std::size_t>(kMostMovingPins))
    throw Error::request("pin: " + std::to_string(scene.pin.size()) + " pins, at most " +
                         std::to_string(kMostMovingPins) + " are possible");
  if (scene.obstacle.size() > static_cast<std::size_t>(kMostObstacles))
    throw Error::request("obstacle: " + std::to_string(scene.obstacle.size()) + " obstacles, at most " +
                         std::to_string(kMostObstacles) + " are possible");
  CurvatureOperator op = make_curvature_operator(scene.element, cloth.mesh, cloth.held_throughout(scene));
  if (!scene.fabric.bends_alike())
    stiffen(op, cloth.mesh, scene.fabric.weft_bending, scene.fabric.bias_bending);
  if (scene.force == "chapter" && op.dimension != 1)
    throw Error::request("force = chapter needs element = hinge");
  if (scene.force == "chapter" && scene.is_implicit())
    throw Error::request("force = chapter has no potential: use semi-implicit or explicit, not " +
                         scene.integrator);
  check_steps(scene);
  check_start(scene, cloth);
  const StepLimits limits = choose_substeps(scene, cloth, op);
  return wants_gpu(scene) ? make_gpu_simulation(scene, cloth, op, limits)
                          : make_cpu_simulation(scene, cloth, op, limits);
}

std::vector<std::string> device_list() {
  std::string reason;
  std::vector<std::string> list{cpu_description()};
  const int count = gpu_count(reason);
  for (int i = 0; i < count; ++i) list.push_back(gpu_description(i));
  if (count == 0) list.push_back("cuda: none (" + reason + ")");
  return list;
}

}  // namespace hysteron
