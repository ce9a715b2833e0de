#include "experiments/specimens/cantilever_strip.h"

#include <algorithm>
#include <cmath>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/bending/curvature_operator.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kSlope = 41.5 * kDegree;  // of the chord, ASTM D1388 and ISO 9073-7

double areal_weight(const Scene& scene) { return scene.fabric.density * scene.gravity.norm(); }

// Slope of the chord of a strip with this overhang under its whole weight.
double slope_of_elastica(const Scene& scene, double length) {
  HeavyStrip strip = strip_elastica(scene, length);
  strip.segments = 150;
  return sagging_strips(strip, {1}, 20).back().chord_angle();
}

double slope_of_cloth(const Scene& scene, double length) {
  const CantileverStrip strip = overhang(scene, length);
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  simulation->advance(static_cast<int>(std::lround(scene.ramp / scene.step)));
  const Eigen::Vector2d end = strip.free_end(simulation->positions());
  return std::atan2(end.y(), end.x());
}

// CantileverStrip at which `slope` reaches 41.5 degrees, by the secant method from `first`; slopes grow with
// it.
template <class Slope>
double critical_overhang(double first, double precision, const Slope& slope) {
  double a = first, fa = slope(a) - kSlope, b = a * (1 - fa / 2), fb = slope(b) - kSlope;
  for (int i = 0; i < 20 && std::abs(b - a) > precision * b; ++i) {
    const double next = std::clamp(b - fb * (b - a) / (fb - fa), b / 2, 2 * b);
    a = b, fa = fb;
    b = next, fb = slope(b) - kSlope;
  }
  return b;
}

}  // namespace

Eigen::Vector2d CantileverStrip::free_end(const std::vector<Eigen::Vector3d>& x) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (cloth.mesh.rest[i].x() > scene.cloth.length * (1 - 1e-9)) sum += x[i] - cloth.start[i], ++count;
  return {length + sum.x() / count, -sum.z() / count};
}

CantileverStrip overhang(Scene scene, double length) {
  ClampedMesh clamped = clamped_mesh(scene.mesh, length, scene.cloth.width, scene.triangles, 1, scene.seed);
  scene.cloth.shape = "strip";
  scene.cloth.length = clamped.length;
  scene.triangles = clamped.mesh.faces();
  scene.pin = {held_between(-1, clamped.near())};
  Cloth cloth = place_cloth(scene, std::move(clamped.mesh));
  return {std::move(scene), std::move(cloth), length};
}

HeavyStrip strip_elastica(const Scene& scene, double length) {
  HeavyStrip strip;
  strip.law = {scene.law, scene.fabric.virgin_curve(), scene.param};
  strip.rigidity = rigidity_along(scene);
  strip.weight = areal_weight(scene);
  strip.length = length;
  return strip;
}

double rigidity_along(const Scene& scene) {
  if (scene.fabric.bends_alike()) return 1;
  const double angle = scene.cloth.warp_angle * kDegree;
  return strip_rigidity(scene.fabric.weft_bending, scene.fabric.bias_bending, angle);
}

double load_at(const Scene& scene, double time) {
  if (time < scene.ramp) return time / scene.ramp;
  return scene.unload > 0 ? std::max(0.0, 1 - (time - scene.ramp) / scene.unload) : 1;
}

double elastica_bending_length(const Scene& scene) {
  const double first = 2 * std::cbrt(rigidity_along(scene) * scene.fabric.b2 / areal_weight(scene));
  return critical_overhang(first, 1e-6, [&](double length) { return slope_of_elastica(scene, length); }) / 2;
}

double cloth_bending_length(const Scene& scene, double first) {
  return critical_overhang(2 * first, 1e-4, [&](double length) { return slope_of_cloth(scene, length); }) / 2;
}

}  // namespace hysteron::experiments
