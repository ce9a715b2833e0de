// Sweeps of named cases: meshes that no builder makes on purpose, and scenes that ask too much.
#include <algorithm>
#include <cmath>

#include "experiments/specimens/clamped_mesh.h"
#include "experiments/stability/stability.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/error.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

// ---- meshes ----

// The mesh with its vertices moved within its plane.
template <class Move>
ClothMesh moved(ClothMesh mesh, const Move& move) {
  for (auto& x : mesh.rest) x = move(x);
  build_topology(mesh, "moved mesh");
  return mesh;
}

// Strip of 0.2 m with 4 x 6 cells, `aspect` times as long as wide.
ClothMesh stretched_cells(double aspect) {
  constexpr double kLength = 0.2;
  return make_grid(kLength, kLength / 4 * 6 / aspect, 4, 6, MeshFamily::aligned, 1);
}

// Square of 0.2 m with 8 x 8 cells, in which every other vertex of every other row comes so close to the next
// one that its two triangles there have 1/1000 of their height.
ClothMesh slivers() {
  constexpr double kLength = 0.2, kCell = kLength / 8, kLeft = 1e-3;
  return moved(make_grid(kLength, kLength, 8, 8, MeshFamily::aligned, 1), [](Eigen::Vector3d x) {
    const long i = std::lround(x.x() / kCell), j = std::lround(x.y() / kCell);
    if (i % 2 == 1 && i < 7 && j % 2 == 1) x.x() += (1 - kLeft) * kCell;
    return x;
  });
}

// Square of 0.2 m with 10 x 10 cells whose sides grow from one corner by a factor of 100.
ClothMesh mixed_sizes() {
  constexpr double kLength = 0.2;
  constexpr int kCells = 10;
  const double ratio = std::pow(100.0, 1.0 / (kCells - 1));
  return moved(make_grid(kLength, kLength, kCells, kCells, MeshFamily::unionjack, 1), [&](Eigen::Vector3d x) {
    for (int c = 0; c < 2; ++c)
      x[c] = kLength * (std::pow(ratio, kCells * x[c] / kLength) - 1) / (std::pow(ratio, kCells) - 1);
    return x;
  });
}

ClothMesh one_triangle() {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}};
  mesh.face = {{0, 1, 2}};
  build_topology(mesh, "one triangle");
  return mesh;
}

// The cloth's left end is held, the rest swings down.
Attempt cantilever(std::function<ClothMesh()> mesh) {
  Attempt attempt{default_scene("cotton-broad-k50"), std::move(mesh), 0.3};
  attempt.scene.pin = {held_between(0, 1e-6)};
  return attempt;
}

const NamedAttempt kMeshes[] = {
    {"aspect 1", [] { return cantilever([] { return stretched_cells(1); }); }},
    {"aspect 10", [] { return cantilever([] { return stretched_cells(10); }); }},
    {"aspect 100", [] { return cantilever([] { return stretched_cells(100); }); }},
    {"aspect 1000", [] { return cantilever([] { return stretched_cells(1000); }); }},
    {"slivers 1:1000", [] { return cantilever(slivers); }},
    {"sizes 1:100", [] { return cantilever(mixed_sizes); }},
};

// ---- scenes ----

constexpr double kHappens = 0.3;  // [s] in which the scenes' motions are over

Attempt square(double height) {
  Attempt attempt{default_scene("cotton-broad-k50"), {}, kHappens};
  attempt.scene.cloth.length = 0.2;
  attempt.scene.cloth.position.z() = height;
  attempt.scene.triangles = 160;
  return attempt;
}

// A strip of 10 cm x 3 cm between two clamps of 4 cm; the right one turns about the middle by `degrees`.
Attempt folded(double degrees) {
  Attempt attempt{default_scene("cotton-broad-k50"), {}, kHappens};
  Scene& scene = attempt.scene;
  scene.cloth.shape = "strip";
  scene.cloth.length = 0.1;
  scene.cloth.width = 0.03;
  scene.triangles = 160;
  scene.pin = {held_between(0, 0.04), held_between(0.06, 0.1)};
  Motion& motion = scene.pin[1].motion;
  motion.axis = {0, -1, 0};
  motion.center = {0.05, 0, 0};
  motion.keys = {{0, {0, 0, 0}, 0}, {0.8 * kHappens, {0, 0, 0}, degrees}};
  return attempt;
}

// The same strip bent to 100 k0: over the 2 cm between the clamps 180 degrees are pi/0.02 m.
Attempt bent_far() {
  Attempt attempt = folded(180);
  Fabric& f = attempt.scene.fabric;
  const double friction = (f.b1 - f.b2) * f.k0;
  f.k0 = 3.14159265358979323846 / 0.02 / 100;
  f.b1 = f.b2 + friction / f.k0;
  return attempt;
}

// The same strip bent slowly to 90 degrees in steps of +15 and -10.
Attempt rippled() {
  Attempt attempt = folded(0);
  auto& keys = attempt.scene.pin[1].motion.keys;
  keys.clear();
  for (int k = 0; k <= 34; ++k) {
    const double angle = k / 2 * 5 + (k % 2 ? 15 : 0);
    keys.push_back({kHappens * k / 35, {0, 0, 0}, angle});
  }
  return attempt;
}

// The right clamp moves by `metres` along the strip, in kHappens/2.
Attempt pulled(double metres) {
  Attempt attempt = folded(0);
  attempt.scene.pin[1].motion.keys = {{0, {0, 0, 0}, 0}, {kHappens / 2, {metres, 0, 0}, 0}};
  return attempt;
}

// A ball of 3 cm comes up through a square held at its corners, at 100 m/s where it meets the cloth.
Attempt hit() {
  Attempt attempt = square(0);
  attempt.scene.pin = {held_between(0, 1e-6), held_between(0.2 - 1e-6, 0.2)};
  Obstacle ball = solid(ObstacleKind::sphere, {0.1, 0.1, -0.531});
  ball.radius = 0.03;
  // The middle of a smooth motion from rest to rest is 3/2 as fast as the mean.
  ball.motion.keys = {{0, {0, 0, 0}, 0}, {0.015, {0, 0, 1}, 0}};
  attempt.scene.obstacle = {ball};
  attempt.most_seconds = 0.05;
  return attempt;
}

// The same in steps in which the ball moves 1 mm.
Attempt hit_in_small_steps() {
  Attempt attempt = hit();
  attempt.scene.step = 1e-5;
  return attempt;
}

Attempt dropped_on_edge() {
  Attempt attempt = square(0.02);
  Obstacle box = solid(ObstacleKind::box, {0.1, 0.1, -0.05});
  box.size = {0.03, 0.2, 0.05};
  box.rim = 1e-4;
  attempt.scene.obstacle = {box};
  return attempt;
}

Attempt hanging() {
  Attempt attempt = square(0);
  attempt.scene.pin = {held_between(0, 1e-6)};
  return attempt;
}

template <class Change>
Attempt hanging_with(const Change& change) {
  Attempt attempt = hanging();
  change(attempt.scene);
  return attempt;
}

const NamedAttempt kScenes[] = {
    {"one triangle",
     [] {
       Attempt attempt{default_scene("cotton-broad-k50"), one_triangle, kHappens};
       attempt.scene.pin = {held_between(0, 1e-6)};
       attempt.scene.pin[0].high.y() = 0;
       return attempt;
     }},
    {"pressed to 1/10", [] { return pulled(-0.018); }},
    {"stretched to 3x", [] { return pulled(0.04); }},
    {"ripples on a bend", rippled},
    {"M0 = 1e4 b2 k0",
     [] { return hanging_with([](Scene& scene) { scene.fabric.b2 = scene.fabric.b1 / 2e4; }); }},
    {"k0 = 1e6/m (elastic)", [] { return hanging_with([](Scene& scene) { scene.fabric.k0 = 1e6; }); }},
    {"k0 = 0.1/m (Coulomb)",
     [] {
       return hanging_with([](Scene& scene) {
         Fabric& f = scene.fabric;
         f.b1 = f.b2 + (f.b1 - f.b2) * f.k0 / 0.1;
         f.k0 = 0.1;
       });
     }},
    {"k0 = 0", [] { return hanging_with([](Scene& scene) { scene.fabric.k0 = 0; }); }},
    {"no bending", [] { return hanging_with([](Scene& scene) { scene.fabric.b1 = scene.fabric.b2 = 0; }); }},
    {"bending 1e-12 N m",
     [] { return hanging_with([](Scene& scene) { scene.fabric.b1 = scene.fabric.b2 = 1e-12; }); }},
    {"no damping", [] { return hanging_with([](Scene& scene) { scene.fabric.damping = 0; }); }},
    {"gravity x 100", [] { return hanging_with([](Scene& scene) { scene.gravity *= 100; }); }},
    {"fall onto an edge", dropped_on_edge},
    {"the same, steps of 10 µs", hit_in_small_steps},
    {"hit at 100 m/s", hit},
    {"bent to 100 k0", bent_far},
    {"folded by 330°", [] { return folded(330); }},
    {"folded by 180°", [] { return folded(180); }},
};

constexpr double kShortStep = 1e-3, kLongStep = 1.0 / 60;  // [s]

}  // namespace

Sweep mesh_sweep(const SweepChoice& choice) {
  return named_sweep("mesh", "Mesh quality: a strip or square held at one end; steps of 1 ms", "mesh",
                     kMeshes, choice.few_laws(), {"shape", "hinge"}, [](Scene& scene, int variant) {
                       scene.element = variant == 0 ? BendingElement::shape : BendingElement::hinge;
                       scene.step = kShortStep;
                     });
}

Sweep scene_sweep(const SweepChoice& choice, Precision precision) {
  const bool all = precision == Precision::fp64 && choice.laws.empty() && !choice.quick;
  return named_sweep(precision == Precision::fp64 ? "scenes" : "scenes-" + enum_name(precision),
                     "Scenes that ask too much, in " + enum_name(precision) + " precision", "scene", kScenes,
                     all ? law_names() : choice.few_laws(), {"step 1 ms", "step 1/60 s"},
                     [precision](Scene& scene, int variant) {
                       scene.precision = precision;
                       if (scene.step >= kShortStep) scene.step = variant == 0 ? kShortStep : kLongStep;
                     });
}

namespace {

struct NamedSweep {
  const char* name;
  Sweep (*make)(const SweepChoice&);
};

const NamedSweep kSweeps[] = {
    {"bending-step", bending_sweep},
    {"membrane-step", membrane_sweep},
    {"density-step", density_sweep},
    {"friction-step", friction_sweep},
    {"mesh", mesh_sweep},
    {"contact", contact_sweep},
    {"scenes", [](const SweepChoice& choice) { return scene_sweep(choice, Precision::fp64); }},
    {"scenes-float", [](const SweepChoice& choice) { return scene_sweep(choice, Precision::fp32); }},
};

}  // namespace

std::vector<std::string> sweep_names() {
  std::vector<std::string> names;
  for (const NamedSweep& sweep : kSweeps) names.push_back(sweep.name);
  return names;
}

std::vector<Sweep> make_sweeps(const std::vector<std::string>& names, const SweepChoice& choice) {
  std::vector<Sweep> sweeps;
  for (const std::string& name : names) {
    const auto found = std::find_if(std::begin(kSweeps), std::end(kSweeps),
                                    [&](const NamedSweep& sweep) { return name == sweep.name; });
    if (found == std::end(kSweeps))
      throw Error::invalid_input("--sweep " + name + " must be of " + join(sweep_names(), ", "))
          .with_key("sweep", name);
    sweeps.push_back(found->make(choice));
  }
  return sweeps;
}

}  // namespace hysteron::experiments
