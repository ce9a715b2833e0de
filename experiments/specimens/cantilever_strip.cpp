#include "experiments/specimens/cantilever_strip.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/compare/matching.h"
#include "sim/base/error.h"
#include "sim/bending/curvature_operator.h"
#include "sim/scene/motion.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kSlope = 41.5 * kDegree;  // angle of the chord, ASTM D1388 and ISO 9073-7
// Largest tilt of the weight along the strip: one of 48.5 degrees towards the free end pulls no chord to
// 41.5.
constexpr double kMostTilt = 30 * kDegree;
constexpr double kSideways = 1e-6;  // share of the weight across the strip that is rounding
// Overhang over the bending length, at which 10 segments of the elastica bend.
constexpr double kMostLengths = 100;
constexpr double kWhole = 1e-4;     // tolerance of the weight: a timetable ends so near to the requested time
constexpr double kMostSteps = 1e6;  // steps in which the weight grows, or goes
// Largest rounding error of in-plane forces over the weight of a step.  Strips at 1.3e-3 are solved; from
// 2e-3 on some are searched for minutes without an end, and at 6e-2 no equilibrium is found.
constexpr double kMostRounding = 1.5e-3;
constexpr int kMaxTrials = 30;        // most overhangs in a search
constexpr double kSlopeFound = 0.01;  // tolerance of the chord's angle at the found overhang [rad]

double areal_weight(const Scene& scene) { return scene.fabric.density * scene.gravity.norm(); }

// Returns the weight's direction in the strip's axes: x along it, z up from its face.
Eigen::Vector3d direction_of_weight(const Scene& scene) {
  return start_rotation(scene.cloth).transpose() * scene.gravity.normalized();
}

// Returns the weight's angle from straight down towards the free end [rad].
double tilt_of_weight(const Scene& scene) {
  const Eigen::Vector3d down = direction_of_weight(scene);
  return std::atan2(down.x(), -down.z());
}

// Returns the curve of the same fabric with face and back exchanged.
VirginCurve turned_over(VirginCurve curve) {
  const Faces faces = curve.parts.faces;
  const double friction = faces.friction * (curve.b1 - curve.b2);
  curve.b2 *= faces.bending;
  curve.b1 = curve.b2 + friction;
  for (double& stiffness : curve.parts.stops.stiffnesses) stiffness *= faces.friction;
  curve.parts.faces.bending = 1 / faces.bending;
  curve.parts.faces.friction = 1 / faces.friction;
  return curve;
}

// Returns the curve for the direction in which the strip sags, downwards to its back.
VirginCurve sagging_curve(const Scene& scene) {
  const VirginCurve curve = scene.fabric.virgin_curve();
  if (!scene.fabric.bending.faces.on()) return curve;
  return has_faces(scene.law) ? turned_over(curve) : mean_of_faces(curve);
}

// Returns (B/w)^(1/3) [m], half the overhang of the test without friction (Peirce 1930).
double natural_length(const Scene& scene) {
  const VirginCurve curve = sagging_curve(scene);
  const double rigidity = rigidity_along(scene) * (curve.b2 > 0 ? curve.b2 : curve.b1);
  return std::cbrt(rigidity / areal_weight(scene));
}

// Returns the chord's angle [rad] of a strip with this overhang under its whole weight.
double slope_of_elastica(const Scene& scene, double length) {
  HeavyStrip strip = strip_elastica(scene, length);
  strip.segments = 150;
  return sagging_strips(strip, {1}, 20).back().chord_angle();
}

double slope_of_cloth(const Scene& scene, double length) {
  const CantileverStrip strip = overhang(scene, length);
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  load_wholly(scene, *simulation);
  const Eigen::Vector2d end = strip.free_end(simulation->positions());
  return std::atan2(end.y(), end.x());
}

// Finds the overhang [m] at which `slope`, which grows with it, reaches 41.5 degrees, by the secant method
// from `first`, kept between the longest known too short and the shortest known too long.
template <class Slope>
double critical_overhang(double first, double precision, const Slope& slope) {
  double low = 0, high = std::numeric_limits<double>::infinity();
  const auto excess = [&](double length) {
    const double found = slope(length) - kSlope;
    if (found < 0)
      low = std::max(low, length);
    else
      high = std::min(high, length);
    return found;
  };
  double a = first, fa = excess(a), b = a * std::clamp(1 - fa / 2, 0.5, 2.0), fb = excess(b);
  for (int trials = 2; std::abs(b - a) > precision * b; ++trials) {
    double next = std::clamp(b - fb * (b - a) / (fb - fa), b / 2, 2 * b);
    if (!(next > low && next < high)) next = low == 0 ? high / 2 : std::min(2 * low, std::sqrt(low * high));
    if (trials >= kMaxTrials || !(low < high)) break;
    a = b;
    fa = fb;
    b = next;
    fb = excess(b);
  }
  if (std::abs(fb) < kSlopeFound) return b;
  throw Error::simulation(fmt::format(
      "no bending length was found: the chord of a strip that hangs over by {:.4g} m falls by {:.1f} "
      "degree, and must by {:.1f}",
      b, (fb + kSlope) / kDegree, kSlope / kDegree));
}

void check_weight(const Scene& scene) {
  const Eigen::Vector3d& g = scene.gravity;
  std::string gravity = shown(scene, "gravity", fmt::format("{:g} {:g} {:g}", g.x(), g.y(), g.z()), "m/s^2");
  const Eigen::Vector3d& turn = scene.cloth.rotation;
  if (!turn.isZero(0))
    gravity += " with " + shown(scene, "cloth.rotation",
                                fmt::format("{:g} {:g} {:g}", turn.x(), turn.y(), turn.z()), "degree");
  const auto refusal = [&](const std::string& fault) {
    return Error::invalid_input(gravity + " " + fault).with_key("gravity", number_text(g.norm()));
  };
  if (!(g.norm() > 0)) throw refusal("makes no strip sag: it must be more than 0");
  if (std::abs(direction_of_weight(scene).y()) > kSideways)
    throw refusal(
        "pulls the strip sideways: it must lie in the plane of its length and its normal, where the elastica "
        "bends");
  const double tilt = tilt_of_weight(scene);
  if (std::abs(tilt) > kMostTilt)
    throw refusal(
        fmt::format("pulls {:.0f} degree away from straight down out of the strip, which must be <= "
                    "{:.0f}: beyond, no overhang need fall to {:.1f} degree",
                    std::abs(tilt) / kDegree, kMostTilt / kDegree, kSlope / kDegree));
}

// Returns weight over stiffness, w L^3/B.
double gamma_of(const Scene& scene) { return std::pow(scene.cloth.length / natural_length(scene), 3); }

// Throws if the weight of a step is lost in the in-plane forces that rounding of positions makes.
void check_weight_is_resolved(const Scene& scene) {
  const Fabric& fabric = scene.fabric;
  const double length = scene.cloth.length, width = scene.cloth.width;
  const double cell = std::sqrt(2 * length * width / scene.triangles);  // [m]
  const double rounding = std::max({fabric.warp, fabric.weft, fabric.shear}) * width *
                          std::numeric_limits<double>::epsilon() * length / cell;  // [N]
  const double weight = areal_weight(scene) * length * width;                      // [N]
  const double least = rounding / kMostRounding * std::max(1.0, scene.ramp / scene.step);
  if (weight >= least) return;
  throw Error::invalid_input(
      fmt::format("the strip weighs {:.3g} N (density {:.3g} kg/m^2, gamma {:.3g}) and must weigh at least "
                  "{:.3g} N (gamma "
                  "{:.3g}): in-plane stiffnesses up to {:.4g} N/m make forces of {:.1g} N of the rounding of "
                  "positions; it "
                  "sags by gamma/8 of its length",
                  weight, fabric.density, gamma_of(scene), least, gamma_of(scene) * least / weight,
                  std::max({fabric.warp, fabric.weft, fabric.shear}), rounding));
}

}  // namespace

Eigen::Vector2d CantileverStrip::free_end(const std::vector<Eigen::Vector3d>& x) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.mesh.rest[i].x() > scene.cloth.length * (1 - 1e-9)) sum += x[i] - cloth.start[i], ++count;
  const Eigen::Vector3d own = start_rotation(scene.cloth).transpose() * sum;
  return {length + own.x() / count, -own.z() / count};
}

CantileverStrip overhang(Scene scene, double length) {
  ClampedMesh clamped = clamped_mesh(scene.mesh, length, scene.cloth.width, scene.triangles, 1, scene.seed);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = clamped.length;
  scene.triangles = clamped.mesh.faces();
  scene.pin = {held_between(-1, clamped.near())};
  Cloth cloth = place_cloth(scene, std::move(clamped.mesh));
  return {std::move(scene), std::move(cloth), length};
}

namespace {

bool follows_weft_stops(const Scene& scene) {
  return !scene.fabric.bending.weft_stops.empty() && (scene.law == "prandtl" || scene.law == "chapman");
}

// True if friction differs from the rigidity in its anisotropy; between warp and weft such a strip has no
// scalar law.
bool rubs_otherwise(const Scene& scene) {
  return scene.fabric.rubs_otherwise() && has_friction_beside_b2(scene.law);
}

}  // namespace

bool lies_along_weft(const Scene& scene) { return std::lround(scene.cloth.warp_angle / 90) % 2 != 0; }

bool has_strip_curve(const Scene& scene) {
  return !(follows_weft_stops(scene) || rubs_otherwise(scene)) ||
         std::abs(std::remainder(scene.cloth.warp_angle, 90)) <= 1e-9;
}

VirginCurve strip_curve(const Scene& scene) {
  VirginCurve curve = scene.fabric.virgin_curve();
  if (!has_strip_curve(scene))
    throw Error::invalid_input(
        shown(scene, "cloth.warp-angle", scene.cloth.warp_angle, "degree") +
        " must be a multiple of 90: a strip between warp and weft of a fabric with friction of its own along "
        "both (fabric.bending.stops.weft, fabric.weft-friction) has no reference")
        .with_key("cloth.warp-angle", number_text(scene.cloth.warp_angle));
  if (!lies_along_weft(scene)) return curve;
  if (follows_weft_stops(scene)) curve.parts.stops = curve.parts.weft_stops;
  if (rubs_otherwise(scene)) {
    const double moments = scene.fabric.weft_friction / std::sqrt(scene.fabric.weft_bending);
    curve.b1 = curve.b2 + moments * moments * (curve.b1 - curve.b2);
    curve.k0 /= moments;
    curve.parts.faces.weft_elastic = 1;
    for (double& threshold : curve.parts.stops.thresholds) threshold /= moments;
    for (std::vector<double>* all : {&curve.parts.stops.stiffnesses, &curve.parts.branches.stiffnesses})
      for (double& stiffness : *all) stiffness *= moments * moments;
  }
  return curve;
}

VirginCurve curve_along(const Scene& scene) {
  VirginCurve curve = strip_curve(scene);
  const double q = rigidity_along(scene), root = std::sqrt(q);  // M = q^1/2 M_law(q^1/2 K)
  curve.b1 *= q;
  curve.b2 *= q;
  curve.k0 /= root;
  curve.parts = stiffened(curve.parts, q);
  for (double& threshold : curve.parts.stops.thresholds) threshold /= root;
  curve.parts.set.yield /= root;
  return curve;
}

VirginCurve curve_along(const Fabric& fabric, Along along, const std::string& law) {
  Scene scene;
  scene.fabric = fabric;
  scene.law = law;
  scene.cloth.warp_angle = along == Along::weft ? 90 : 0;
  return curve_along(scene);
}

HeavyStrip strip_elastica(const Scene& scene, double length) {
  HeavyStrip strip;
  strip.law = {scene.law, strip_curve(scene), scene.param};
  // A downward bend is K > 0 in the elastica and K < 0 in the cloth, whose face becomes convex.
  if (scene.fabric.bending.faces.on()) strip.law.curve = turned_over(strip.law.curve);
  strip.rigidity = rigidity_along(scene);
  strip.weight = areal_weight(scene);
  strip.tilt = tilt_of_weight(scene);
  strip.length = length;
  return strip;
}

double rigidity_along(const Scene& scene) {
  if (scene.fabric.bends_alike()) return 1;
  const double angle = scene.cloth.warp_angle * kDegree;
  return strip_rigidity(scene.fabric.weft_bending, scene.fabric.bias_bending, angle);
}

void check_cantilever(const Scene& scene) {
  check_weight(scene);
  strip_curve(scene);
  if (!(scene.ramp > 0))
    throw Error::invalid_input(shown(scene, "ramp", scene.ramp, "s") + " must be > 0: the weight grows in it")
        .with_key("ramp", number_text(scene.ramp));
  if (std::max(scene.ramp, scene.unload) > kMostSteps * scene.step)
    throw Error::invalid_input(
        shown(scene, "step", scene.step, "s") + " makes more than a million steps of " +
        shown(scene, "ramp", scene.ramp, "s") + " or " + shown(scene, "unload", scene.unload, "s"))
        .with_key("step", number_text(scene.step));
  check_weight_is_resolved(scene);
  const double longest = kMostLengths * natural_length(scene);
  if (scene.cloth.length > longest)
    throw Error::invalid_input(
        fmt::format(
            "{} must be <= {:.3g} m, {:g} times the length (B/weight)^(1/3) over which this fabric bends: "
            "a longer strip hangs straight down",
            shown(scene, "cloth.length", scene.cloth.length, "m"), longest, kMostLengths))
        .with_key("cloth.length", number_text(scene.cloth.length));
}

double load_at(const Scene& scene, double time) {
  if (time < scene.ramp) return time / scene.ramp;
  return scene.unload > 0 ? std::max(0.0, 1 - (time - scene.ramp) / scene.unload) : 1;
}

Timetable loading(const Scene& scene) { return {scene.ramp, scene.step}; }

void load_wholly(const Scene& scene, Simulation& simulation) {
  const Timetable steps = loading(scene);
  advance_along(steps, simulation, steps.steps());
  if (std::abs(load_at(scene, simulation.time()) - 1) > kWhole)
    throw Error::simulation(
        fmt::format("at t = {:.6g} s, the end of the ramp, only {:.6g} of the weight is on",
                    simulation.time(), load_at(scene, simulation.time())));
}

double elastica_bending_length(const Scene& scene) {
  const double first = 2 * natural_length(scene);
  return critical_overhang(first, 1e-6, [&](double length) { return slope_of_elastica(scene, length); }) / 2;
}

double cloth_bending_length(const Scene& scene, double first) {
  return critical_overhang(2 * first, 1e-4, [&](double length) { return slope_of_cloth(scene, length); }) / 2;
}

}  // namespace hysteron::experiments
