// Problem buckle: the heaviness at which strips buckle under their own weight, upright and on edge.
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "experiments/kes/strip.h"
#include "experiments/specimens/buckling.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.1;              // [m]
constexpr double kUpright = 10, kEdge = 20;  // ratio of length to width
constexpr int kTriangles = 320;              // upright: 40 square cells along, 4 across; on edge: 57 and 3

Buckling buckling_kind(const MethodSetting& setting) {
  return setting.load == 0 ? Buckling::upright : Buckling::edge;
}

Found solve(const MethodSetting& setting) {
  const Buckling kind = buckling_kind(setting);
  Scene scene = with(setting, {});
  scene.cloth.width = kLength / (kind == Buckling::upright ? kUpright : kEdge);
  Found found;
  found.reference = reference_gamma(kind, scene) * (1 + fraction_of_width(kind, scene, kLength));
  const BucklingStrip strip = measured_strip(scene, kind, kLength);
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  const auto start = std::chrono::steady_clock::now();
  found.value = approach_threshold(strip, *simulation).critical_gamma;
  note_cost(*simulation, strip.scene, start, found);
  found.triangles = strip.cloth.mesh.faces();
  found.error = std::abs(found.value / found.reference - 1);
  return found;
}

void vary_all(const MethodSetting& base, bool quick, std::vector<MethodSetting>& list) {
  list.push_back(base);
  for (const MeshFamily mesh : every_value<MeshFamily>()) {
    MethodSetting on = base;
    on.mesh = mesh;
    if (mesh != base.mesh) vary(list, base, "mesh", &MethodSetting::mesh, {mesh});
    if (quick && mesh != base.mesh) continue;
    vary(list, on, "size", &MethodSetting::triangles, {kTriangles / 4});
    if (!quick) vary(list, on, "size", &MethodSetting::triangles, {4 * kTriangles});
    vary(list, on, "element", &MethodSetting::element, {BendingElement::hinge});
  }
}

}  // namespace

Problem buckle_problem(const Effort& effort) {
  Problem problem{
      "buckle",
      "Strips that buckle under their own weight, upright (0) and on edge (1)",
      "|critical Gamma over the reference - 1|",
      "Timoshenko & Gere 1961: 7.8373 upright, 12.8538 sqrt2 on edge; there with the clamp's hold on "
      "warping",
      {},
      solve};
  MethodSetting base;
  base.device = effort.device;
  base.triangles = kTriangles;
  for (double kind : {0.0, 1.0}) {
    base.load = kind;
    vary_all(base, effort.quick, problem.settings);
  }
  return problem;
}

}  // namespace hysteron::experiments
