// Sweep of contact: layers, solids and hands that ask too much.
#include "experiments/specimens/clamped_mesh.h"
#include "experiments/stability/stability.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr double kContactLasts = 0.3;  // [s] in which the scenes' motions are over
constexpr double kSheetSide = 0.2;     // of squares [m]

// Newton's criteria are those of the crumpling scenes, without their limit of iterations.
Attempt with_self_contact(int triangles) {
  Attempt attempt{default_scene("cotton-broad-k50"), {}, kContactLasts};
  Scene& scene = attempt.scene;
  scene.self_contact = true;
  scene.newton_residual = 1e-3;
  scene.newton_velocity = 1e-4;
  scene.triangles = triangles;
  scene.cloth.length = kSheetSide;
  return attempt;
}

Attempt closing_sphere(double friction) {
  Attempt attempt = with_self_contact(300);
  Scene& scene = attempt.scene;
  scene.fabric.friction = friction;
  scene.cloth.position = {-kSheetSide / 2, 0, -kSheetSide / 2};
  scene.cloth.rotation = {90, 0, 0};
  Obstacle sphere = solid(ObstacleKind::hollow, {0, 0, 0});
  sphere.radius = 0.15;
  sphere.motion.keys = {{0, {0, 0, 0}, 0}, {0.8 * kContactLasts, {0, 0, 0}, 0}};
  sphere.motion.keys[1].scale = 0.3;
  scene.obstacle = {sphere};
  return attempt;
}

// Six layers under a plate that stops at this many thicknesses a layer.
Attempt pressed(double thicknesses) {
  constexpr double kHeight = 0.026;  // of the plate's lower side at the start [m]
  Attempt attempt = with_self_contact(400);
  Scene& scene = attempt.scene;
  scene.cloth.shape = "strip";
  scene.cloth.start = "pleats";
  scene.cloth.pleats = 6;
  scene.cloth.length = 0.2;
  scene.cloth.width = 0.03;
  scene.cloth.radius = 2e-3;
  scene.cloth.position = {-0.015, -0.015, 2e-3};
  Obstacle plate = solid(ObstacleKind::box, {0, 0, kHeight + 0.005});
  plate.size = {0.06, 0.04, 0.005};
  const double end = 6 * thicknesses * scene.fabric.thickness;
  plate.motion.keys = {{0, {0, 0, 0}, 0}, {0.8 * kContactLasts, {0, 0, end - kHeight}, 0}};
  scene.obstacle = {solid(ObstacleKind::ground, {0, 0, 0}), plate};
  return attempt;
}

// Sheets one above the other, the lowest 1 cm above z = 0.
Attempt sheets(int copies) {
  Attempt attempt = with_self_contact(100 * copies);
  ClothShape& cloth = attempt.scene.cloth;
  cloth.copies = copies;
  cloth.copy_offset = {0, 0, 0.01};
  cloth.position = {-kSheetSide / 2, -kSheetSide / 2, 0.01};
  return attempt;
}

Attempt on_a_sharp_edge() {
  Attempt attempt = sheets(3);
  Obstacle box = solid(ObstacleKind::box, {0, 0, -0.05});
  box.size = {0.03, kSheetSide, 0.05};
  box.rim = 1e-4;
  attempt.scene.obstacle = {box};
  return attempt;
}

// A ball comes up through four sheets at 1 m/s.
Attempt hit_from_below() {
  Attempt attempt = sheets(4);
  Obstacle ball = solid(ObstacleKind::sphere, {0, 0, -0.06});
  ball.radius = 0.03;
  ball.motion.keys = {{0, {0, 0, 0}, 0}, {0.15, {0, 0, 0.1}, 0}};
  attempt.scene.obstacle = {ball};
  return attempt;
}

// The right clamp of a strip is led over the left one and through it, by a hand of this strength.
Attempt led_through_itself(double strength) {
  Attempt attempt = with_self_contact(160);
  Scene& scene = attempt.scene;
  scene.cloth.shape = "strip";
  scene.cloth.length = 0.1;
  scene.cloth.width = 0.03;
  scene.pin = {held_between(0, 0.02), held_between(0.08, 0.1)};
  scene.pin[1].strength = strength;
  scene.pin[1].motion.keys = {{0, {0, 0, 0}, 0},
                              {0.1, {-0.04, 0, 0.04}, 0},
                              {0.15, {-0.08, 0, 0.02}, 0},
                              {0.25, {-0.08, 0, -0.02}, 0}};
  return attempt;
}

const NamedAttempt kContacts[] = {
    {"through itself, hand of 1 N", [] { return led_through_itself(1); }},
    {"four sheets hit at 1 m/s", hit_from_below},
    {"three sheets onto an edge", on_a_sharp_edge},
    {"six layers to 1.2 thicknesses", [] { return pressed(1.2); }},
    {"sphere, friction 1", [] { return closing_sphere(1); }},
    {"sphere, friction 0.3", [] { return closing_sphere(0.3); }},
    {"sphere, no friction", [] { return closing_sphere(0); }},
};

}  // namespace

Sweep contact_sweep(const SweepChoice& choice) {
  return named_sweep("contact", "Layers, solids and hands", "scene", kContacts, choice.few_laws(),
                     {"step 1/240 s", "step 1/60 s"},
                     [](Scene& scene, int variant) { scene.step = variant == 0 ? 1.0 / 240 : 1.0 / 60; });
}

}  // namespace hysteron::experiments
