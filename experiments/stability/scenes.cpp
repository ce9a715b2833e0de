// Sweeps of named cases: meshes that no builder makes on purpose, and scenes that overload bending, the
// membrane and contact.
#include <cmath>
#include <numbers>

#include "experiments/specimens/clamped_mesh.h"
#include "experiments/stability/stability.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr double kSide = 0.2;                              // side of squares [m]
constexpr double kHappens = 0.3;                           // time in which the scenes' motions end [s]
constexpr double kShortStep = 1e-3, kLongStep = 1.0 / 60;  // [s]

// A row of a map.
struct NamedAttempt {
  std::string name;
  Attempt attempt;
};

// ---- meshes ----

// Returns the mesh with its vertices moved within its plane.
template <class Move>
ClothMesh moved(ClothMesh mesh, const Move& move) {
  for (auto& x : mesh.rest) x = move(x);
  build_topology(mesh, "moved mesh");
  return mesh;
}

// Returns a strip of 0.2 m with 4 x 6 cells, each `aspect` times as long as wide.
ClothMesh stretched_cells(double aspect) {
  constexpr double kLength = 0.2;
  return make_grid(kLength, kLength / 4 * 6 / aspect, 4, 6, MeshFamily::aligned, 1);
}

// Returns a square of 0.2 m with 8 x 8 cells, in which every other vertex of every other row comes so close
// to the next one that its two triangles there have 1/1000 of their height.
ClothMesh slivers() {
  constexpr double kLength = 0.2, kCell = kLength / 8, kLeft = 1e-3;
  return moved(make_grid(kLength, kLength, 8, 8, MeshFamily::aligned, 1), [](Eigen::Vector3d x) {
    const long i = std::lround(x.x() / kCell), j = std::lround(x.y() / kCell);
    if (i % 2 == 1 && i < 7 && j % 2 == 1) x.x() += (1 - kLeft) * kCell;
    return x;
  });
}

// Returns a square of 0.2 m with 10 x 10 cells whose sides grow from one corner by a factor of 100.
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

// ---- scenes ----

Scene scene_of(ClothOutline shape, double length, int triangles) {
  Scene scene = default_scene("cotton-broad-k50");
  scene.seconds = kHappens;
  scene.cloth.shape = shape;
  scene.cloth.length = length;
  scene.triangles = triangles;
  return scene;
}

// Returns a square whose left edge is held while the rest swings down.
Scene hanging(void (*change)(Scene&)) {
  Scene scene = scene_of(ClothOutline::square, kSide, 160);
  scene.pin = {held_between(0, 1e-6)};
  change(scene);
  return scene;
}

void leave(Scene&) {}

void hold_along_x(Scene& scene) { scene.pin[0].high.y() = 0; }

void soften_to_coulomb(Scene& scene) {
  constexpr double kCurvature = 0.1;  // [1/m]
  Fabric& f = scene.fabric;
  f.b1 = f.b2 + (f.b1 - f.b2) * f.k0 / kCurvature;
  f.k0 = kCurvature;
}

// Returns a strip of 10 cm x 3 cm, held up to x = `near` and from x = `far` on [m], where the pin moves by
// `keys`.
Scene clamped(double near, double far, const std::vector<Keyframe>& keys) {
  Scene scene = scene_of(ClothOutline::strip, 0.1, 160);
  scene.cloth.width = 0.03;
  scene.pin = {held_between(0, near), held_between(far, 0.1)};
  scene.pin[1].motion = {keys, {0, -1, 0}, {0.05, 0, 0}};
  return scene;
}

// Returns a strip between two clamps of 4 cm, the right one of which rotates about the middle by `degrees`.
Scene folded(double degrees) {
  return clamped(0.04, 0.06, {{0, {0, 0, 0}, 0}, {0.8 * kHappens, {0, 0, 0}, degrees}});
}

// Returns the same strip bent to 100 k0: over the 2 cm between the clamps 180 degrees are pi/0.02 m.
Scene bent_far() {
  Scene scene = folded(180);
  Fabric& f = scene.fabric;
  const double friction = (f.b1 - f.b2) * f.k0;
  f.k0 = std::numbers::pi / 0.02 / 100;
  f.b1 = f.b2 + friction / f.k0;
  return scene;
}

// Returns the same strip bent slowly to 90 degrees in steps of +15 and -10.
Scene rippled() {
  std::vector<Keyframe> keys;
  for (int k = 0; k <= 34; ++k)
    keys.push_back({kHappens * k / 35, {0, 0, 0}, k / 2 * 5.0 + (k % 2 ? 15 : 0)});
  return clamped(0.04, 0.06, keys);
}

// Returns a strip whose right clamp moves by `metres` along it, in kHappens/2.
Scene pulled(double metres) {
  return clamped(0.04, 0.06, {{0, {0, 0, 0}, 0}, {kHappens / 2, {metres, 0, 0}, 0}});
}

Obstacle solid(ObstacleKind kind, const Eigen::Vector3d& center, double radius = 0) {
  Obstacle obstacle;
  obstacle.kind = kind;
  obstacle.center = center;
  if (radius > 0) obstacle.radius = radius;
  return obstacle;
}

// Returns a square held at its corners through which a ball of 3 cm comes up, at 100 m/s when it meets the
// cloth: the middle of a smooth motion from rest to rest is 3/2 as fast as the mean.  In steps of 10 µs it
// moves 1 mm.
Scene hit(double step) {
  Scene scene = scene_of(ClothOutline::square, kSide, 160);
  scene.step = step;
  scene.seconds = 0.05;
  scene.pin = {held_between(0, 1e-6), held_between(kSide - 1e-6, kSide)};
  scene.obstacle = {solid(ObstacleKind::sphere, {0.1, 0.1, -0.531}, 0.03)};
  scene.obstacle[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.015, {0, 0, 1}, 0}};
  return scene;
}

// Returns a wall whose upper edges are sharp.
Obstacle sharp_wall(double x, double y) {
  Obstacle box = solid(ObstacleKind::box, {x, y, -0.05});
  box.size = {0.03, kSide, 0.05};
  box.rim = 1e-4;
  return box;
}

Scene dropped_on_edge() {
  Scene scene = scene_of(ClothOutline::square, kSide, 160);
  scene.cloth.position.z() = 0.02;
  scene.obstacle = {sharp_wall(0.1, 0.1)};
  return scene;
}

std::vector<NamedAttempt> extreme_meshes() {
  const Scene scene = hanging(leave);
  return {{"aspect 1", {scene, stretched_cells(1)}},     {"aspect 10", {scene, stretched_cells(10)}},
          {"aspect 100", {scene, stretched_cells(100)}}, {"aspect 1000", {scene, stretched_cells(1000)}},
          {"slivers 1:1000", {scene, slivers()}},        {"sizes 1:100", {scene, mixed_sizes()}}};
}

std::vector<NamedAttempt> extreme_scenes() {
  return {
      {"one triangle", {hanging(hold_along_x), one_triangle()}},
      {"pressed to 1/10", {pulled(-0.018)}},
      {"stretched to 3x", {pulled(0.04)}},
      {"ripples on a bend", {rippled()}},
      {"M0 = 1e4 b2 k0", {hanging([](Scene& scene) { scene.fabric.b2 = scene.fabric.b1 / 2e4; })}},
      {"k0 = 1e6/m (elastic)", {hanging([](Scene& scene) { scene.fabric.k0 = 1e6; })}},
      {"k0 = 0.1/m (Coulomb)", {hanging(soften_to_coulomb)}},
      {"k0 = 0", {hanging([](Scene& scene) { scene.fabric.k0 = 0; })}},
      {"no bending", {hanging([](Scene& scene) { scene.fabric.b1 = scene.fabric.b2 = 0; })}},
      {"bending 1e-12 N m", {hanging([](Scene& scene) { scene.fabric.b1 = scene.fabric.b2 = 1e-12; })}},
      {"no damping", {hanging([](Scene& scene) { scene.fabric.damping = 0; })}},
      {"gravity x 100", {hanging([](Scene& scene) { scene.gravity *= 100; })}},
      {"fall onto an edge", {dropped_on_edge()}},
      {"the same, steps of 10 µs", {hit(1e-5)}},
      {"hit at 100 m/s", {hit(kShortStep)}},
      {"bent to 100 k0", {bent_far()}},
      {"folded by 330°", {folded(330)}},
      {"folded by 180°", {folded(180)}},
  };
}

// ---- contact ----

// Enables self-contact with Newton's criteria of the crumpling scenes, without their limit of iterations.
Scene with_self_contact(Scene scene) {
  scene.self_contact = true;
  scene.newton_residual = 1e-3;
  scene.newton_velocity = 1e-4;
  return scene;
}

Scene closing_sphere(double friction) {
  Scene scene = with_self_contact(scene_of(ClothOutline::square, kSide, 300));
  scene.fabric.friction = friction;
  scene.cloth.position = {-kSide / 2, 0, -kSide / 2};
  scene.cloth.rotation = {90, 0, 0};
  scene.obstacle = {solid(ObstacleKind::hollow, {0, 0, 0}, 0.15)};
  scene.obstacle[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.8 * kHappens, {0, 0, 0}, 0, 0.3}};
  return scene;
}

// Returns six layers under a plate that stops at this many thicknesses a layer.
Scene pressed(double thicknesses) {
  constexpr double kHeight = 0.026;  // initial height of the plate's lower side [m]
  Scene scene = with_self_contact(scene_of(ClothOutline::strip, kSide, 400));
  scene.cloth.start = "pleats";
  scene.cloth.pleats = 6;
  scene.cloth.width = 0.03;
  scene.cloth.radius = 2e-3;
  scene.cloth.position = {-0.015, -0.015, 2e-3};
  Obstacle plate = solid(ObstacleKind::box, {0, 0, kHeight + 0.005});
  plate.size = {0.06, 0.04, 0.005};
  const double end = 6 * thicknesses * scene.fabric.thickness;
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {0.8 * kHappens, {0, 0, end - kHeight}, 0}};
  scene.obstacle = {solid(ObstacleKind::ground, {0, 0, 0}), plate};
  return scene;
}

// Returns sheets one above the other, the lowest 1 cm above z = 0.
Scene sheets(int copies, const Obstacle& obstacle) {
  Scene scene = with_self_contact(scene_of(ClothOutline::square, kSide, 100 * copies));
  scene.cloth.copies = copies;
  scene.cloth.copy_offset = {0, 0, 0.01};
  scene.cloth.position = {-kSide / 2, -kSide / 2, 0.01};
  scene.obstacle = {obstacle};
  return scene;
}

// Returns a ball that comes up at 1 m/s.
Obstacle slow_ball() {
  Obstacle ball = solid(ObstacleKind::sphere, {0, 0, -0.06}, 0.03);
  ball.motion.keys = {{0, {0, 0, 0}, 0}, {0.15, {0, 0, 0.1}, 0}};
  return ball;
}

// Returns a strip whose right clamp is led over the left one and through it, by a pin of this strength.
Scene led_through_itself(double strength) {
  Scene scene = with_self_contact(clamped(0.02, 0.08,
                                          {{0, {0, 0, 0}, 0},
                                           {0.1, {-0.04, 0, 0.04}, 0},
                                           {0.15, {-0.08, 0, 0.02}, 0},
                                           {0.25, {-0.08, 0, -0.02}, 0}}));
  scene.pin[1].strength = strength;
  return scene;
}

std::vector<NamedAttempt> contact_scenes() {
  return {
      {"through itself, pin of 1 N", {led_through_itself(1)}},
      {"four sheets hit at 1 m/s", {sheets(4, slow_ball())}},
      {"three sheets onto an edge", {sheets(3, sharp_wall(0, 0))}},
      {"six layers to 1.2 thicknesses", {pressed(1.2)}},
      {"sphere, friction 1", {closing_sphere(1)}},
      {"sphere, friction 0.3", {closing_sphere(0.3)}},
      {"sphere, no friction", {closing_sphere(0)}},
  };
}

// ---- sweeps ----

// Returns a sweep of the rows under some laws; `set` makes the variant of a scene.
Sweep sweep_of(const std::string& name, const std::string& title, const std::string& label,
               const std::vector<NamedAttempt>& rows, const std::vector<std::string>& laws,
               const std::vector<std::string>& variants, void (*set)(Scene&, int variant)) {
  Sweep sweep{name, title, {"law", laws}, {label, {}}, variants, {}};
  for (const NamedAttempt& row : rows) sweep.y.ticks.push_back(row.name);
  sweep.at = [rows, laws, set](int variant, int column, int row) {
    Attempt attempt = rows[row].attempt;
    attempt.scene.law = laws[column];
    set(attempt.scene, variant);
    return attempt;
  };
  return sweep;
}

void set_element(Scene& scene, int variant) {
  scene.element = variant == 0 ? BendingElement::shape : BendingElement::hinge;
  scene.step = kShortStep;
}

void set_step(Scene& scene, int variant) {
  if (scene.step >= kShortStep) scene.step = variant == 0 ? kShortStep : kLongStep;
}

void set_step_of_floats(Scene& scene, int variant) {
  scene.precision = Precision::fp32;
  set_step(scene, variant);
}

void set_step_of_contact(Scene& scene, int variant) { scene.step = variant == 0 ? 1.0 / 240 : kLongStep; }

}  // namespace

std::vector<Sweep> scene_sweeps(const SweepParams& choice) {
  const std::vector<std::string> few = choice.few_laws(), steps = {"step 1 ms", "step 1/60 s"};
  const bool all = choice.laws.empty() && !choice.quick;
  return {
      sweep_of("mesh", "Mesh quality: a strip or square held at one end; steps of 1 ms", "mesh",
               extreme_meshes(), few, {"shape", "hinge"}, set_element),
      sweep_of("contact", "Layers, solids and pins", "scene", contact_scenes(), few,
               {"step 1/240 s", "step 1/60 s"}, set_step_of_contact),
      sweep_of("scenes", "Scenes that ask too much, in double precision", "scene", extreme_scenes(),
               all ? law_names() : few, steps, set_step),
      sweep_of("scenes-float", "Scenes that ask too much, in float precision", "scene", extreme_scenes(), few,
               steps, set_step_of_floats),
  };
}

}  // namespace hysteron::experiments
