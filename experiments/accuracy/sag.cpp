// Problems sag and droop: heavy strips are compared with the elastica, in how far they sag and in what
// remains when the weight is taken away.
#include <cmath>
#include <map>
#include <memory>

#include "experiments/accuracy/accuracy.h"
#include "experiments/kes/strip.h"
#include "experiments/specimens/cantilever_strip.h"

namespace hysteron::experiments {
namespace {

constexpr double kLength = 0.1, kWidth = 0.025;  // [m]
constexpr int kAlong64 = 2048;                   // 64 square cells along the strip, 16 across
constexpr double kGamma = 10;                    // heaviness: density g L^3/b2

Scene sag_scene(const MethodSetting& setting, bool unloaded) {
  Scene scene = with(setting, {});
  scene.cloth.width = kWidth;
  scene.fabric.density = setting.load * scene.fabric.b2 / (scene.gravity.norm() * std::pow(kLength, 3));
  // The membrane is so stiff that the own weight of even the heaviest strip stretches it by less than 1e-5 of
  // its length.
  const double tension = scene.fabric.density * scene.gravity.norm() * kLength;
  scene.fabric.warp = scene.fabric.weft = std::max(1000.0, 1e4 * tension);
  scene.fabric.shear = 0.3 * scene.fabric.warp;
  scene.ramp = 1;
  scene.unload = unloaded ? 1 : 0;
  scene.seconds = unloaded ? 2 : 1;
  return scene;
}

// The drops of the free end over the length, under the whole weight and at the end.
struct Sag {
  double loaded = 0, last = 0;
};

// Returns the elastica's sag, extrapolated from two numbers of segments, as its error falls with their
// square.
Sag sag_of_curve(const Scene& scene) {
  constexpr int kSegments = 60;
  const auto with_segments = [&](int segments) {
    HeavyStrip strip = strip_elastica(scene, kLength);
    strip.segments = segments;
    std::vector<double> loads;
    for (int k = 1; k <= 20; ++k) loads.push_back(load_at(scene, k * scene.seconds / 20));
    const auto states = sagging_strips(strip, loads);
    Sag sag;
    for (const auto& s : states) sag.loaded = std::max(sag.loaded, s.drop() / kLength);
    sag.last = states.back().drop() / kLength;
    return sag;
  };
  const Sag coarse = with_segments(kSegments), fine = with_segments(2 * kSegments);
  return {(4 * fine.loaded - coarse.loaded) / 3, (4 * fine.last - coarse.last) / 3};
}

// The curves by law and load: one reference serves many settings.
using Curves = std::map<std::pair<std::string, double>, Sag>;
const Sag& curve_of(Curves& known, const Scene& scene, const MethodSetting& setting) {
  const auto [at, is_new] = known.try_emplace({setting.law, setting.load});
  if (is_new) at->second = sag_of_curve(scene);
  return at->second;
}

Sag sag_of_cloth(const Scene& scene, Found& found) {
  const CantileverStrip strip = overhang(scene, kLength);
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  const auto start = std::chrono::steady_clock::now();
  const auto drop = [&] { return strip.free_end(simulation->positions()).y() / kLength; };
  Sag sag;
  simulation->advance(static_cast<int>(std::lround(scene.ramp / scene.step)));
  sag.loaded = sag.last = drop();
  if (scene.unload > 0) {
    simulation->advance(static_cast<int>(std::lround(scene.unload / scene.step)));
    sag.last = drop();
  }
  note_cost(*simulation, scene, start, found);
  found.triangles = strip.cloth.mesh.faces();
  return sag;
}

MethodSetting base_setting(const Effort& effort) {
  MethodSetting base;
  base.device = effort.device;
  base.triangles = effort.quick ? kAlong64 / 4 : kAlong64;
  base.step = 0.05;
  base.tolerance = 1e-6;
  base.load = kGamma;
  return base;
}

void vary_meshes_and_sizes(const MethodSetting& base, bool quick, std::vector<MethodSetting>& list) {
  for (const MeshFamily mesh : every_value<MeshFamily>()) {
    if (mesh != base.mesh) vary(list, base, "mesh", &MethodSetting::mesh, {mesh});
    if (quick && mesh != MeshFamily::unionjack && mesh != MeshFamily::random) continue;
    for (int triangles : {kAlong64 / 64, kAlong64 / 16, kAlong64 / 4, kAlong64, 4 * kAlong64}) {
      if (triangles == base.triangles || (quick && triangles > base.triangles)) continue;
      if (triangles > kAlong64 && mesh != MeshFamily::unionjack) continue;
      list.push_back(varied(base, "size", [&](MethodSetting& s) { s.mesh = mesh, s.triangles = triangles; }));
    }
  }
}

void vary_elements(const MethodSetting& base, bool quick, std::vector<MethodSetting>& list) {
  for (const MeshFamily mesh : every_value<MeshFamily>())
    for (int triangles : {kAlong64 / 16, kAlong64 / 4, kAlong64}) {
      if (quick && triangles != kAlong64 / 16) continue;
      list.push_back(varied(base, "element", [&](MethodSetting& s) {
        s.element = BendingElement::hinge, s.mesh = mesh, s.triangles = triangles;
      }));
    }
}

}  // namespace

Problem sag_problem(const Effort& effort) {
  Problem problem{"sag",
                  "Heavy strip (Gamma = 10): drop of the free end",
                  "|drop over that of the elastica - 1|",
                  "the heavy elastica with the same law, extrapolated from 60 and 120 segments",
                  {},
                  {}};
  const MethodSetting base = base_setting(effort);
  std::vector<MethodSetting>& list = problem.settings;
  list.push_back(base);
  vary_meshes_and_sizes(base, effort.quick, list);
  vary_elements(base, effort.quick, list);
  for (const MeshFamily mesh : every_value<MeshFamily>())
    for (double gamma : {0.1, 1.0, 100.0, 1000.0}) {
      if (effort.quick && (gamma == 0.1 || gamma == 1000 || mesh != base.mesh)) continue;
      list.push_back(varied(base, "heaviness", [&](MethodSetting& s) { s.mesh = mesh, s.load = gamma; }));
    }
  vary(list, base, "law", &MethodSetting::law, {"prandtl"});
  if (!effort.quick) {
    vary(list, base, "law", &MethodSetting::law, {"bilinear", "dahl", "wong", "pabst", "obrien"});
    vary(list, base, "step", &MethodSetting::step, {1, 0.2, 0.0125});
    vary(list, base, "tolerance", &MethodSetting::tolerance, {1e-2, 1e-4, 1e-8});
  }
  list.push_back(varied(base, "precision",
                        [&](MethodSetting& s) { s.precision = Precision::fp32, s.tolerance = 1e-4; }));
  problem.load = "Gamma";
  problem.solve = [curves = std::make_shared<Curves>()](const MethodSetting& setting) {
    Found found;
    const Scene scene = sag_scene(setting, false);
    found.reference = curve_of(*curves, scene, setting).loaded;
    found.value = sag_of_cloth(scene, found).loaded;
    found.error = std::abs(found.value / found.reference - 1);
    return found;
  };
  return problem;
}

Problem droop_problem(const Effort& effort) {
  Problem problem{"droop",
                  "What remains of the sag with bending friction, weight taken away",
                  "|remaining drop - that of the elastica| over its drop when loaded",
                  "the heavy elastica with the same law and history, extrapolated from 60 and 120 segments",
                  {},
                  {}};
  MethodSetting base = base_setting(effort);
  base.law = "prandtl";
  base.triangles = kAlong64 / 4;
  std::vector<MethodSetting>& list = problem.settings;
  list.push_back(base);
  const auto families = every_value<MeshFamily>();
  std::vector<MeshFamily> meshes(families.begin(), families.end());
  std::erase(meshes, base.mesh);
  if (!effort.quick) vary(list, base, "mesh", &MethodSetting::mesh, meshes);
  vary(list, base, "size", &MethodSetting::triangles, {kAlong64 / 64, kAlong64 / 16});
  if (!effort.quick) vary(list, base, "size", &MethodSetting::triangles, {kAlong64});
  vary(list, base, "element", &MethodSetting::element, {BendingElement::hinge});
  if (!effort.quick) {
    vary(list, base, "law", &MethodSetting::law, {"bilinear", "dahl", "obrien", "wong"});
    vary(list, base, "step", &MethodSetting::step, {0.2, 0.0125});
  }
  problem.load = "Gamma";
  problem.solve = [curves = std::make_shared<Curves>()](const MethodSetting& setting) {
    Found found;
    const Scene scene = sag_scene(setting, true);
    const Sag& curve = curve_of(*curves, scene, setting);
    found.reference = curve.last;
    found.value = sag_of_cloth(scene, found).last;
    found.error = std::abs(found.value - curve.last) / curve.loaded;
    return found;
  };
  return problem;
}

}  // namespace hysteron::experiments
