#include "experiments/workbench/session/run_warnings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "experiments/workbench/session/idle_keys.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/membrane/locking.h"
#include "sim/scene/cloth.h"
#include "sim/scene/cycles.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

// Woven cloth tears at strains of some 10 to 40 %, and the membrane's stiffness is valid for small ones.
constexpr double kExtremeStretch = 0.5;
// Positions rounded to a larger share of the thickness cause strains, and forces, of their own.
constexpr double kCoarsest = 0.01;
// Smallest reported speed that the energy stored by contact at the start would give the cloth [m/s].
constexpr double kNoticed = 0.1;

// Warns of pressed layers, which push each other off as soon as they may.
std::string pressed_text(const Scene& scene, const Cloth& cloth, Simulation& simulation) {
  const double stored = simulation.ledger().contact;
  const auto& areas = cloth.mesh.vertex_area;
  const double mass = scene.fabric.density * std::accumulate(areas.begin(), areas.end(), 0.0);
  const double speed = std::sqrt(2 * stored / mass);
  if (!(speed > kNoticed)) return "";
  return fmt::format(
      "contact stores {:.2g} J at the start, which would throw the whole cloth at {:.2g} m/s: parts that are "
      "nearer than fabric.thickness = {:.4g} mm press each other off; start farther apart, or with a thinner "
      "fabric",
      stored, speed, 1e3 * scene.fabric.thickness);
}

std::string stretch_text(double stretched) {
  if (!(stretched > kExtremeStretch)) return "";
  return fmt::format(
      "the cloth was stretched by up to {:.0f} %, where woven cloth tears at some 10 to 40 %, and "
      "fabric.warp, fabric.weft and fabric.shear are stiffnesses of small strains",
      100 * stretched);
}

std::string resolution_text(const Scene& scene, const Cloth& cloth, const std::vector<Eigen::Vector3d>& x) {
  const double step = resolution(scene, cloth, x);
  if (!(step > kCoarsest * scene.fabric.thickness)) return "";
  return fmt::format(
      "positions are rounded to {:.2g} m so far from where the cloth starts, more than {:.0f} % of "
      "fabric.thickness = {:.4g} m: {}",
      step, 100 * kCoarsest, scene.fabric.thickness,
      scene.precision == Precision::fp32 ? "take precision = double" : "let it start nearer");
}

// Warns of commands without an element: a command acts on those whose centres lie in its box.
std::string command_warning(const Scene& scene, const Cloth& cloth, int dimension) {
  if (scene.command.empty()) return "";
  const std::vector<Eigen::Vector3d> centers = cloth.element_centers(dimension);
  for (std::size_t c = 0; c < scene.command.size(); ++c) {
    const SceneEvent& command = scene.command[c];
    const auto is_inside = [&](const Eigen::Vector3d& x) { return is_in_box(x, command.low, command.high); };
    if (std::none_of(centers.begin(), centers.end(), is_inside))
      return "[[command]] " + std::to_string(c + 1) +
             " acts on nothing: no element of the flat cloth lies between its low and high";
  }
  return "";
}

// Warns of pins that hold something else than they seem to.
std::vector<std::string> pin_warnings(const Scene& scene, const Cloth& cloth) {
  std::vector<std::string> warnings;
  for (std::size_t p = 0; p < scene.pin.size() && p < cloth.pin_vertices.size(); ++p) {
    const Pin& pin = scene.pin[p];
    const std::string name = "[[pin]] " + std::to_string(p + 1);
    const double beside =
        pin.select == PinSelection::nearest ? nearest_vertex(cloth.mesh, pin.point).beside : 0;
    if (beside > 0)
      warnings.push_back(name + " holds the vertex that is nearest to its point, which lies " +
                         number_text(beside, 3) + " m beside the flat cloth: is it in metres?");
    if (const std::vector<Keyframe>& keys = pin.motion.keys; !(pin.from > 0) && !keys.empty()) {
      const Keyframe& first = keys.front();
      if (!first.position.isZero(0) || first.angle != 0 || first.scale != 1)
        warnings.push_back(name + " jumps within the first step to where its first key is (" +
                           number_text(first.position.norm(), 3) + " m, " + number_text(first.angle, 3) +
                           " degree): let it begin with a key at time = 0 that moves nothing");
    }
    const auto is_own = [&](int vertex) { return cloth.pin[vertex] == static_cast<int>(p); };
    if (!(pin.from > 0) && std::ranges::none_of(cloth.pin_vertices[p], is_own))
      warnings.push_back(name + " holds nothing at the start: later pins take all of its vertices");
  }
  return warnings;
}

// Warns of a subdivided bent start: new vertices lie on the chords of a bend, so that an even bend becomes
// facets with twice the bend at their edges.
std::string facets_warning(const Scene& scene, Simulation& simulation) {
  // A pattern is sewn flat, so its initial layout is no bend that it had.
  const bool is_sewn = scene.cloth.shape == ClothOutline::pattern;
  if (scene.cloth.subdivisions == 0 || is_sewn || !(simulation.ledger().bending > 0)) return "";
  return shown(scene, "cloth.subdivisions", scene.cloth.subdivisions, "") +
         " cuts a start that is bent into facets: its bends gather at the old edges, twice as sharp, and the "
         "cloth "
         "remembers them so";
}

// Warns of limits at which a step has ended before it begins, so that Newton's method moves nothing.
std::string loose_newton_warning(const Scene& scene) {
  constexpr double kLoose = 0.05;  // share of the load, or of the motion by the load in a step
  if (!scene.is_implicit()) return "";
  if (scene.newton_residual > kLoose)
    return shown(scene, "newton-residual", scene.newton_residual, "") +
           " leaves so much of the load out of balance in every step: cloth may not move at all";
  const double fall = scene.gravity.norm() * scene.step;
  if (scene.integrator == Integrator::quasi_static || !(fall > 0) || scene.newton_velocity <= kLoose * fall)
    return "";
  return shown(scene, "newton-velocity", scene.newton_velocity, "m/s") + " is more than a twentieth of the " +
         number_text(fall, 3) + " m/s that gravity gives in a step: cloth may not move at all";
}

// Warns that pins, obstacles and commands act only from the start of a step on.
std::vector<std::string> instant_warnings(const Scene& scene) {
  constexpr double kRounding = 1e-4;  // in steps, as a run's length may miss a whole number of them
  std::vector<std::string> warnings;
  const auto check = [&](const std::string& key, double time) {
    const double steps = time / scene.step;
    if (!is_given(scene, key) || !(time < scene.seconds) || std::abs(steps - std::round(steps)) <= kRounding)
      return;
    warnings.push_back(shown(scene, key, time, "s") + " lies within a step of " + number_text(scene.step, 4) +
                       " s: it counts from the next one on, at " +
                       number_text(std::ceil(steps) * scene.step, 6) + " s");
  };
  const auto check_all = [&](const auto& tables, const std::string& list) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      check(list + "[" + std::to_string(i) + "].from", tables[i].from);
      check(list + "[" + std::to_string(i) + "].until", tables[i].until);
    }
  };
  check_all(scene.pin, "pin");
  check_all(scene.obstacle, "obstacle");
  for (std::size_t i = 0; i < scene.command.size(); ++i)
    check("command[" + std::to_string(i) + "].time", scene.command[i].time);
  return warnings;
}

// Warns of statics that end while the weight still grows, or has not yet gone again.
std::string partial_load_warning(const Scene& scene) {
  if (scene.integrator != Integrator::quasi_static || !(scene.seconds > 0)) return "";
  const double end = scene.seconds, left = 1 - 1e-6;
  const bool grows = end < scene.ramp * left, falls = !grows && scene.unload > 0 &&
                                                      end < (scene.ramp + scene.unload) * left &&
                                                      end > scene.ramp;
  if (!grows && !falls) return "";
  const double load = grows ? end / scene.ramp : 1 - (end - scene.ramp) / scene.unload;
  return shown(scene, "seconds", end, "s") + " ends with " + number_text(100 * load, 3) +
         " % of the weight: " +
         (grows ? shown(scene, "ramp", scene.ramp, "s") + " is how long it grows"
                : "from ramp = " + number_text(scene.ramp) + " s it falls for " +
                      shown(scene, "unload", scene.unload, "s"));
}

std::string phases_warning(const Scene& scene) {
  const double phases = phases_end(scene);
  if (scene.phase.empty() || std::abs(phases - scene.seconds) <= scene.step / 2) return "";
  return shown(scene, "seconds", scene.seconds, "s") +
         " is how long the scene is simulated, and its phases take " + number_text(phases, 4) + " s";
}

std::vector<std::string> said(std::vector<std::string> texts) {
  std::erase(texts, "");
  return texts;
}

}  // namespace

std::string weft_friction_warning(const Fabric& fabric, const std::string& law) {
  if (!fabric.rubs_otherwise() || has_friction_beside_b2(law)) return "";
  return "fabric.weft-friction = " + number_text(fabric.weft_friction) + " changes nothing: law " + law +
         " has no friction beside b2, and bends along weft as fabric.weft-bending says";
}

std::vector<std::string> warnings_at_start(const Scene& scene, const Cloth& cloth, Simulation& simulation) {
  std::vector<std::string> warnings = fabric_warnings(scene);
  const std::vector<std::string> of_parameters = unused_parameter_warnings(
      scene.law, scene.fabric.virgin_curve(), scene.param, LawUse::cloth, scene.fabric.name);
  warnings.insert(warnings.end(), of_parameters.begin(), of_parameters.end());
  warnings.insert(warnings.end(),
                  {locking_warning(scene, cloth.mesh), pressed_text(scene, cloth, simulation),
                   command_warning(scene, cloth, simulation.dimension()), phases_warning(scene),
                   facets_warning(scene, simulation), loose_newton_warning(scene),
                   weft_friction_warning(scene.fabric, scene.law), partial_load_warning(scene)});
  for (const std::vector<std::string>& more :
       {pin_warnings(scene, cloth), instant_warnings(scene), idle_key_warnings(scene)})
    warnings.insert(warnings.end(), more.begin(), more.end());
  return said(warnings);
}

std::string triangle_count_warning(int asked, const std::string& origin, int triangles) {
  constexpr double kNoticeable = 0.1;
  if (std::abs(triangles - asked) <= kNoticeable * asked) return "";
  return fmt::format(
      "triangles = {} ({}) is not what the mesh has: whole rows and columns of its kind make {} triangles",
      asked, origin, triangles);
}

std::vector<std::string> warnings_at_end(const Scene& scene, const Cloth& cloth,
                                         const std::vector<Eigen::Vector3d>& x, double stretched) {
  return said({stretch_text(stretched), resolution_text(scene, cloth, x)});
}

std::string drawing_text(const Scene& scene, const Cloth& cloth) {
  constexpr double kSeen = 0.1;  // share of the thickness
  double farthest = 0;           // [m]
  for (const Eigen::Vector3d& x : cloth.start) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  const double step = farthest * std::numeric_limits<float>::epsilon();
  if (!(step > kSeen * scene.fabric.thickness)) return "";
  return fmt::format(
      "pictures and point caches round positions to {:.2g} m so far from the origin: move the scene nearer "
      "to "
      "it; other numbers and files are not concerned",
      step);
}

}  // namespace hysteron::experiments
