#include "experiments/specimens/buckling.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/bending/laws/law_run.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

constexpr double kUpright = 7.837347, kEdge = 12.853763;

// Twist stretches cloth, bending does not: on edge Newton's method needs the smaller tilt.
double initial_tilt(Buckling kind) { return kind == Buckling::upright ? 1e-3 : 1e-5; }  // [rad]
constexpr double kMax = 2.5;       // largest weight over the reference's
constexpr double kStep = 0.1;      // increment of the weight over the reference's
constexpr double kNear = 0.8;      // load of the last state over the threshold
constexpr double kAgreed = 0.01;   // relative difference allowed between the last two estimates
constexpr double kPrecise = 1e-5;  // precision of the last state, over tilt times length
constexpr double kAlike = 1e-6;    // relative tolerance of slopes at rest to face and back
constexpr double kSag = 2e-3;      // bending rigidity out of the plane over that in it, on edge

enum class Side { face, back };

// Returns the slope of the law at rest over b2, for bends to that side.
double stiffness_to(Side side, const Scene& scene) {
  const double small = side == Side::face ? 1e-6 : -1e-6;  // curvature [1/m]
  const LawRun run = run_law({scene.law, strip_curve(scene), scene.param}, {{0}, {small}});
  return run.moment[1] / (small * scene.fabric.b2);
}

// Returns the side to which the strip buckles, the face if both sides are alike.
Side softer_side(const Scene& scene) {
  if (!scene.fabric.bending.faces.on()) return Side::face;
  const double face = stiffness_to(Side::face, scene), back = stiffness_to(Side::back, scene);
  return back < (1 - kAlike) * face ? Side::back : Side::face;
}

double stiffness_at_rest(const Scene& scene) { return stiffness_to(softer_side(scene), scene); }

// Returns GJ over the width and the rigidity along warp; a strip along weft has the same.
double torsion(const Fabric& fabric) { return 4 * fabric.bias_bending - 1 - fabric.weft_bending; }

// Throws for a strip cut between warp and weft, which twists as it bends.
void check_axis(const Scene& scene) {
  const double angle = scene.cloth.warp_angle;
  if (scene.fabric.bends_alike() || std::abs(std::remainder(angle, 90)) < 1e-9) return;
  throw Error::invalid_input(
      fmt::format(
          "buckle.kind = edge has no reference for a strip that twists as it bends: cloth.warp-angle = "
          "{:g} degree must be a multiple of 90, or fabric.weft-bending and fabric.bias-bending 1",
          angle))
      .with_key("cloth.warp-angle", number_text(angle, 6));
}

// Throws for unequal sides: a twist bends one diagonal to the face and the other to the back, and which of
// them is the stiffer one changes along the strip with the bend beside it.
void check_sides(const Scene& scene) {
  if (!scene.fabric.bending.faces.on()) return;
  const double ratio = stiffness_to(Side::back, scene) / stiffness_to(Side::face, scene);
  if (!(std::abs(ratio - 1) > kAlike)) return;
  throw Error::invalid_input(
      fmt::format(
          "buckle.kind = edge has no reference for a strip that twists with one rigidity to its face and "
          "another to its back: fabric.back-bending = {:g} must be 1, or buckle.kind = upright",
          scene.fabric.bending.faces.bending))
      .with_key("fabric.back-bending", number_text(scene.fabric.bending.faces.bending, 6));
}

double weight_number(const Scene& scene, double length) {
  return scene.fabric.density * scene.gravity.norm() * std::pow(length, 3) / scene.fabric.b2;
}

// Returns the second divided difference of y over the last three x.
double second_difference(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  const double before = (y[n - 2] - y[n - 3]) / (x[n - 2] - x[n - 3]);
  const double after = (y[n - 1] - y[n - 2]) / (x[n - 1] - x[n - 2]);
  return (after - before) / (x[n - 1] - x[n - 3]);
}

// Extrapolates the threshold from the last three states: with x = Gamma^power, deflection/Gamma = (a + b
// x)/(1 - x/critical).
double extrapolated_threshold(const Southwell& plot, int power) {
  std::vector<double> x, compliance, product;
  for (std::size_t k = 0; k < plot.gamma.size(); ++k) {
    x.push_back(std::pow(plot.gamma[k], power));
    compliance.push_back(plot.deflection[k] / plot.gamma[k]);
    product.push_back(x[k] * compliance[k]);
  }
  return std::pow(second_difference(x, product) / second_difference(x, compliance), 1.0 / power);
}

}  // namespace

int power_of_load(Buckling kind) { return kind == Buckling::upright ? 1 : 2; }

double reference_gamma(Buckling kind, const Scene& scene) {
  const double slope = stiffness_at_rest(scene), along = rigidity_along(scene);
  if (kind == Buckling::upright) return kUpright * slope * along;
  check_axis(scene);
  check_sides(scene);
  return kEdge * slope * std::sqrt(along * torsion(scene.fabric));
}

double fraction_of_width(Buckling kind, const Scene& scene, double length) {
  if (kind == Buckling::upright) return 0;
  const double stays_flat =
      scene.cloth.width * std::sqrt(rigidity_along(scene) / (12 * torsion(scene.fabric)));
  return std::pow(1 - stays_flat / length, -3) - 1;
}

double BucklingStrip::deflection(const std::vector<Eigen::Vector3d>& x) const {
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.mesh.rest[i].x() > scene.cloth.length * (1 - 1e-9)) {
      sum += (x[i] - cloth.start[i]).dot(side);
      ++count;
    }
  return sum / count;
}

BucklingStrip buckling_strip(Scene scene, Buckling kind, double length, double tilt, double most) {
  const double g = scene.gravity.norm();
  scene.cloth.rotation = kind == Buckling::upright ? Eigen::Vector3d(0, -90, 0) : Eigen::Vector3d(90, 0, 0);
  const Eigen::Vector3d face =
      kind == Buckling::upright ? -Eigen::Vector3d::UnitX() : -Eigen::Vector3d::UnitY();
  const Eigen::Vector3d side = softer_side(scene) == Side::face ? face : Eigen::Vector3d(-face);
  scene.gravity = g * (std::sin(tilt) * side - std::cos(tilt) * Eigen::Vector3d::UnitZ());
  scene.fabric.density = most * reference_gamma(kind, scene) * scene.fabric.b2 / (g * std::pow(length, 3));
  scene.origin["fabric.density"] = kSetBy + std::string("buckle: its weight makes the strip buckle");
  scene.integrator = Integrator::quasi_static;
  scene.ramp = scene.seconds = most;
  scene.unload = 0;
  if (!(scene.fabric.density > 0 && std::isfinite(scene.fabric.density)))
    throw Error::invalid_input("a strip of law " + scene.law +
                               " with fabric.b2 = " + std::to_string(scene.fabric.b2) +
                               " N m has no threshold: its weight there would be " +
                               std::to_string(scene.fabric.density) + " kg/m^2")
        .with_key("law", scene.law)
        .with_experiment("buckle");
  return {overhang(std::move(scene), length), kind, side};
}

BucklingStrip measured_strip(Scene scene, Buckling kind, double length) {
  const double tilt = initial_tilt(kind);
  scene.step = kStep;
  // Relative to all forces, most of them in the plane, so the velocity decides.
  scene.newton_residual = 1e-11;
  scene.newton_velocity = kPrecise * tilt * length;
  if (kind == Buckling::edge) {
    Fabric& f = scene.fabric;
    const double stiff = 12 * f.b2 * rigidity_along(scene) * stiffness_at_rest(scene) /
                         (kSag * std::pow(scene.cloth.width, 2));
    f.warp = std::max(f.warp, stiff);
    f.weft = std::max(f.weft, stiff);
    f.shear = std::max(f.shear, 0.3 * stiff);
    // Nodal averages would leave a strip of a cell or two too soft to bend in its plane.
    scene.membrane_element = MembraneElement::constant;
  }
  return buckling_strip(std::move(scene), kind, length, tilt, kMax);
}

Southwell approach_threshold(const BucklingStrip& strip, Simulation& simulation) {
  const Scene& scene = strip.scene;
  const double full = weight_number(scene, strip.length);
  Southwell plot;
  while (simulation.time() < scene.ramp - scene.step / 2) {
    simulation.advance(1);
    plot.gamma.push_back(full * simulation.time() / scene.ramp);
    plot.deflection.push_back(strip.deflection(simulation.positions()) / strip.length);
    if (plot.gamma.size() < 3) continue;
    const double before = plot.critical_gamma;
    plot.critical_gamma = extrapolated_threshold(plot, power_of_load(strip.kind));
    const bool near = plot.gamma.back() > kNear * plot.critical_gamma;
    if (near && std::abs(plot.critical_gamma - before) < kAgreed * plot.critical_gamma) return plot;
  }
  throw Error::simulation("no threshold was found up to Gamma = " + std::to_string(plot.gamma.back()) +
                          ", where the free end has moved by " + std::to_string(plot.deflection.back()) +
                          " of the length")
      .with_experiment("buckle");
}

}  // namespace hysteron::experiments
