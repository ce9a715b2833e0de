// Host code that chooses the device, the precision and the number of substeps.
#include "sim/time/simulation.h"

#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/bending/bending.h"
#include "sim/bending/laws/law_run.h"
#include "sim/contact/compression.h"
#include "sim/contact/obstacle_set.h"
#include "sim/contact/start_checks.h"
#include "sim/device/visible_gpus.h"
#include "sim/membrane/membrane.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/back_end.h"

namespace hysteron {
namespace {

// Power iteration approaches the highest frequency from below, folds stiffen a mesh, and near the bound
// bending waves feed on the membrane: at 0.9 a shaken sheet slowly gains energy
// (tests/sim/solve/stability_test.cpp).
constexpr double kStabilityMargin = 0.75;
constexpr int kMaxSubsteps = 100000;

// Returns the bound on the frequency's square [1/s^2], scaled by the law's stiffness over that of `linear`;
// the chapter's printed force has 1/2 in place of |e|.
double bending_eigenvalue(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op,
                          const std::vector<double>& mass, const std::vector<char>& held, double stiffness) {
  double lambda = bending_spectral_radius(cloth.mesh, op, stiffness, mass, held);
  if (scene.force == ForceConvention::chapter) {
    double largest = 0;
    for (int h = 0; h < cloth.mesh.interior_edges; ++h)
      largest = std::max(largest, 0.5 / cloth.mesh.edge_length(h));
    lambda *= largest;
  }
  return lambda;
}

// Returns the stable step [s] of symplectic Euler with viscosity: lambda dt^2 + 2 nu dt <= 4, lambda the
// largest eigenvalue of M^-1 K [1/s^2] and nu that of the viscous matrix [1/s].
double stable_step(double lambda, double nu) {
  if (lambda <= 0 && nu <= 0) return 1e30;
  return kStabilityMargin * 4 / (nu + std::sqrt(nu * nu + 4 * lambda));
}

// Returns the largest stable steps for the forces that the integrator takes explicitly.
StepLimits stable_steps(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op) {
  const std::vector<char> held = cloth.held_throughout(scene);
  std::vector<double> mass;
  for (double area : cloth.mesh.vertex_area) mass.push_back(scene.fabric.density * area);
  const double unit = bending_eigenvalue(scene, cloth, op, mass, held, 1);
  const double bending = law_largest_stiffness(scene, op) * unit;
  // The viscosity is damping * b1, whatever the law's stiffness (sim/time/body.cpp).
  const double viscous = scene.fabric.damping * scene.fabric.b1 * unit;
  StepLimits limits;
  limits.bending_step = stable_step(bending, viscous);
  if (scene.integrator != Integrator::explicit_euler) return limits;
  double stiff = membrane_spectral_radius(cloth.mesh, scene.fabric, scene.membrane_element, mass, held);
  const double viscous_membrane = scene.fabric.damping * stiff;
  if (!scene.obstacle.empty()) stiff += obstacle_response(scene).stiffest() / scene.fabric.density;
  limits.membrane_step = stable_step(stiff + bending, viscous_membrane + viscous);
  return limits;
}

StepLimits choose_substeps(const Scene& scene, const Cloth& cloth, const CurvatureOperator& op) {
  StepLimits limits;
  limits.substep = scene.step;
  if (scene.is_implicit()) return limits;  // no step is too long
  limits = stable_steps(scene, cloth, op);
  const double largest =
      scene.integrator == Integrator::explicit_euler ? limits.membrane_step : limits.bending_step;
  const double least = std::ceil(scene.step / largest);
  if (least > kMaxSubsteps)
    throw Error::invalid_input("step = " + number_text(scene.step, 4) + " s would take " +
                               number_text(least, 4) + " explicit substeps of at most " +
                               number_text(largest, 4) + " s: coarsen the mesh or soften b1");
  limits.substeps = std::max(1, static_cast<int>(least));
  if (scene.substeps > 0) {
    if (scene.substeps < limits.substeps)
      throw Error::invalid_input("substeps = " + std::to_string(scene.substeps) +
                                 " is unstable: step = " + number_text(scene.step, 4) + " s needs at least " +
                                 std::to_string(limits.substeps) + " substeps of at most " +
                                 number_text(largest, 4) + " s");
    limits.substeps = scene.substeps;
  }
  limits.substep = scene.step / limits.substeps;
  return limits;
}

// Returns the number of GPUs that the scene may run on.
int usable_gpus(const Scene& scene) {
  if (scene.device == DeviceChoice::cpu) return 0;
  std::string reason;
  const int count = gpu_count(reason);
  if (count == 0 && scene.device == DeviceChoice::cuda)
    throw Error::system("device = cuda: " + no_gpu_message(reason) + "; use --device cpu");
  return count;
}

void throw_if_more_than(std::size_t count, int most, const std::string& what) {
  if (count > static_cast<std::size_t>(most))
    throw Error::invalid_input(what + ": " + std::to_string(count) + " " + what + "s, at most " +
                               std::to_string(most) + " are possible");
}

void check(const Scene& scene, const Cloth& cloth) {
  throw_if_more_than(scene.pin.size(), kMaxMovingPins, "pin");
  throw_if_more_than(scene.obstacle.size(), kMaxObstacles, "obstacle");
  if (scene.force == ForceConvention::chapter && scene.element != BendingElement::hinge)
    throw Error::invalid_input("force = chapter needs element = hinge");
  if (scene.force == ForceConvention::chapter && scene.is_implicit())
    throw Error::invalid_input("force = chapter has no potential: use semi-implicit or explicit, not " +
                               enum_name(scene.integrator));
  check_steps(scene);
  check_start(scene, cloth);
}

// Returns b2 of the elements along warp [N m].
double own_rigidity(const Scene& scene) {
  const LawParams law = choose_law(scene.law, scene.fabric.virgin_curve(), scene.param, LawUse::cloth);
  const double of_both_sides = law.curve.b2 * std::min(1.0, law.curve.parts.faces.bending);
  return scene.element == BendingElement::hinge ? of_both_sides : of_both_sides * rigidity_on_the_tensor(law);
}

CurvatureOperator bending_operator(const Scene& scene, const Cloth& cloth) {
  CurvatureOperator op = make_curvature_operator(scene.element, cloth.mesh, cloth.held_throughout(scene));
  const Fabric& fabric = scene.fabric;
  const bool apart = fabric.rubs_otherwise() && has_friction_beside_b2(scene.law);
  const DirectionRatios rigidity = fabric.rigidity_ratios(),
                        law = apart ? fabric.friction_ratios() : rigidity;
  if (!fabric.bends_alike()) stiffen(op, cloth.mesh, law.weft, law.bias);
  if (apart) set_rigidity(op, cloth.mesh, own_rigidity(scene), rigidity, law);
  if (apart && fabric.bending.faces.on() && scene.element == BendingElement::hinge)
    set_directions(op, cloth.mesh, law.weft, law.bias);
  if (scene.element == BendingElement::hinge && !scene.fabric.bending.weft_stops.empty())
    set_directions(op, cloth.mesh, scene.fabric.weft_bending, scene.fabric.bias_bending);
  return op;
}

}  // namespace

std::unique_ptr<Simulation> make_simulation(const Scene& scene, const Cloth& cloth) {
  check(scene, cloth);
  const CurvatureOperator op = bending_operator(scene, cloth);
  const StepLimits limits = choose_substeps(scene, cloth, op);
  const MethodChoice method = choose_method(scene, cloth, op, usable_gpus(scene));
  Scene chosen = scene;
  if (method.linear_solver != Preconditioning::automatic) chosen.linear_solver = method.linear_solver;
  auto simulation = method.gpu ? make_gpu_simulation(chosen, cloth, op, limits)
                               : make_cpu_simulation(chosen, cloth, op, limits);
  simulation->method = method;
  return simulation;
}

std::vector<std::string> device_list() {
  std::string reason;
  std::vector<std::string> list{cpu_description()};
  const int count = gpu_count(reason);
  for (int i = 0; i < count; ++i) list.push_back(gpu_description(i));
  if (count == 0) list.push_back("cuda: none (" + no_gpu_message(reason) + ")");
  return list;
}

}  // namespace hysteron
