#include "experiments/crease/specimen.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/contact/compression.h"
#include "sim/scene/motion.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kLimbPart = 0.2;  // held length at either end, over the specimen's length
constexpr double kFine = 0.075;    // half width of the fine part, over the specimen's length
constexpr double kFinest = 0.8;    // element size there, in thicknesses, for up to kCoarse triangles
constexpr int kCoarse = 500;       // above this number, triangles are smaller in both directions
constexpr double kGrowth = 1.25;   // ratio of neighbouring columns beyond the fine part
constexpr double kWidest = 0.05;   // widest column there, over the specimen's length
constexpr double kLoop = 0.1;      // radius of the pin's path, over the specimen's length
constexpr double kFold = 0.4, kLower = 0.2, kSettle = 0.1, kPress = 0.3;  // durations [s]
constexpr double kLetGo = 3;     // height at which the pin lets go, in thicknesses
constexpr double kPlate = 2e-3;  // half the plate's thickness [m]
constexpr double kRise = 0.04;   // height by which the plate rises [m]

// Returns the column lines from the crease outwards to half the length, mirrored.
std::vector<double> columns(double length, double thickness, double fine, int triangles) {
  const double finer = std::min(1.0, std::sqrt(static_cast<double>(kCoarse) / triangles));
  std::vector<double> half{0};
  double step = finer * kFinest * thickness;
  while (half.back() < length / 2) {
    if (half.back() >= fine) step = std::min(step * (1 + finer * (kGrowth - 1)), finer * kWidest * length);
    half.push_back(half.back() + step);
  }
  for (double& x : half) x *= length / 2 / half.back();
  std::vector<double> lines;
  for (std::size_t i = half.size() - 1; i > 0; --i) lines.push_back(length / 2 - half[i]);
  for (double x : half) lines.push_back(length / 2 + x);
  return lines;
}

}  // namespace

ClothMesh crease_specimen(const Scene& scene, double fine) {
  const double length = scene.cloth.length, width = scene.cloth.width;
  const std::vector<double> line = columns(length, scene.fabric.thickness, fine, scene.triangles);
  const int nx = static_cast<int>(line.size()) - 1;
  const int ny = 2 * std::max(1, static_cast<int>(std::lround(scene.triangles / (4.0 * nx))));
  ClothMesh mesh = make_grid(length, width, nx, ny, MeshFamily::unionjack, scene.seed);
  for (Eigen::Vector3d& x : mesh.rest) x.x() = line[std::lround(x.x() / length * nx)];
  ClothMesh graded;
  graded.rest = std::move(mesh.rest);
  graded.face = std::move(mesh.face);
  build_topology(graded, "crease specimen");
  return graded;
}

Pin crease_clamp(const Scene& scene) { return held_between(-1, kLimbPart * scene.cloth.length); }

namespace {

// Returns the pin that takes the far limb's end over by 180 degrees, then down; it lets go before the plate
// presses.
Pin moving_pin(const Scene& scene, double ground, double lowered) {
  const double length = scene.cloth.length, radius = kLoop * length;
  Pin pin = held_between((1 - kLimbPart) * length, 2 * length);
  pin.until = lowered;
  pin.motion.axis = {0, -1, 0};
  pin.motion.center = {length / 2, 0, ground + radius};
  const double down = kLetGo * scene.fabric.thickness - 2 * radius;
  pin.motion.keys = {{}, {kFold, {0, 0, 0}, 180}, {lowered, {0, 0, down}, 180}};
  return pin;
}

// Returns the plate above the folded specimen and beyond its crease; `lowest` is where its underside stops
// [m].
Obstacle pressing_plate(const Scene& scene, const CreaseTimes& times, double lowest) {
  const double length = scene.cloth.length;
  const double ready = (2 + kLetGo) * scene.fabric.thickness;
  Obstacle plate;
  plate.kind = ObstacleKind::box;
  plate.size = {0.375 * length, 0.75 * scene.cloth.width, kPlate};
  plate.rim = kPlate / 4;
  plate.center = {0.3 * length, scene.cloth.width / 2, ready + kPlate + kRise};
  plate.motion.keys = {{kFold, {0, 0, 0}},
                       {times.folded, {0, 0, -kRise}},
                       {times.folded + kSettle, {0, 0, -kRise}},
                       {times.pressed, {0, 0, lowest - ready - kRise}},
                       {times.released, {0, 0, lowest - ready - kRise}},
                       {times.lifted, {0, 0, 0}}};
  return plate;
}

}  // namespace

Crease creased(const Scene& given, const CreaseParams& choice, double plate) {
  Crease crease{given, {}, {}};
  Scene& scene = crease.scene;
  CreaseTimes& times = crease.times;
  times.folded = kFold + kLower;
  times.pressed = times.folded + kSettle + kPress;
  times.released = times.pressed + choice.hold;
  times.lifted = times.released + choice.lifting();
  times.end = times.lifted + choice.recovery;
  scene.seconds = times.end;
  scene.cloth.shape = ClothOutline::strip;
  const double ground = scene.fabric.thickness;  // the specimen lies on the plane's shell
  scene.cloth.position = {0, 0, ground};
  Obstacle plane;
  plane.visible = false;
  scene.pin = {crease_clamp(scene), moving_pin(scene, ground, times.folded)};
  scene.obstacle = {plane, pressing_plate(scene, times, plate)};
  ClothMesh mesh = crease_specimen(scene, kFine * scene.cloth.length);
  scene.triangles = mesh.faces();
  crease.cloth = place_cloth(scene, std::move(mesh));
  return crease;
}

double Crease::plate_force(const std::vector<Eigen::Vector3d>& x, double time) const {
  if (scene.obstacle.size() < 2) return 0;
  const Obstacle& plate = scene.obstacle[1];
  const double underside = placement(plate.motion, time)(plate.center).z() - plate.size.z();
  const ObstacleResponse<double> activation_distance = obstacle_response(scene);
  double force = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool under = (x[i] - plate.center).cwiseAbs().x() < plate.size.x();
    const double distance = underside - x[i].z();
    if (under && distance < activation_distance.thickness)
      force -= cloth.mesh.vertex_area[i] * activation_distance.at(distance).slope;
  }
  return force;
}

double Limbs::opening() const {
  return std::acos(std::clamp(far.direction().dot(near.direction()), -1.0, 1.0)) * 180 / std::numbers::pi;
}

double Crease::along(std::size_t vertex) const {
  return cloth.mesh.pattern.empty() ? cloth.mesh.rest[vertex].x() : cloth.mesh.pattern[vertex].x();
}

namespace {

constexpr double kSameColumn = 1e-9;  // [m]

}  // namespace

Limbs Crease::limbs(const std::vector<Eigen::Vector3d>& x) const {
  const double length = scene.cloth.length, reach = limb_part * length;
  // The mean takes the columns between the two, or the nearest one where none is.
  const auto middle = [&](double from, double to) {
    const auto beside = [&](std::size_t i) { return std::max({0.0, from - along(i), along(i) - to}); };
    double nearest = beside(0);
    for (std::size_t i = 1; i < x.size(); ++i) nearest = std::min(nearest, beside(i));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (beside(i) <= nearest + (nearest > 0 ? kSameColumn : 0)) sum += x[i], ++count;
    return Eigen::Vector3d(sum / count);
  };
  return {{middle(0.75 * reach, reach), middle(0, reach / 4)},
          {middle(length - reach, length - 0.75 * reach), middle(length - reach / 4, length)}};
}

std::vector<Eigen::Vector3d> Crease::profile(const std::vector<Eigen::Vector3d>& x) const {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  std::vector<Eigen::Vector3d> middles;
  for (std::size_t i = 0; i < order.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t first = i;
    for (; i < order.size() && along(order[i]) <= along(order[first]) + kSameColumn; ++i) sum += x[order[i]];
    middles.push_back(sum / static_cast<double>(i - first));
  }
  return middles;
}

namespace {

// Reports that the fold already presses harder than the requested force against a plate that has not begun to
// press.
Error too_small_force(double asked, double found, double underside, double thickness) {
  return Error::simulation(
             "crease.force = " + number_text(asked) + " N must be > " + number_text(found, 3) +
             " N: so much the fold itself presses against a plate " + number_text(1e3 * underside, 3) +
             " mm above the plane, " + number_text(underside / thickness, 2) +
             " thicknesses of the cloth, where it waits; a smaller force does not close the fold")
      .with_key("crease.force", number_text(asked))
      .with_experiment("crease");
}

}  // namespace

double loaded_plate(const Scene& scene, const CreaseParams& choice) {
  const double thickness = scene.fabric.thickness, lowest = 2.05 * thickness;
  const Crease crease = creased(scene, choice, lowest);
  const auto simulation = make_simulation(crease.scene, crease.cloth);
  const Obstacle& plate = crease.scene.obstacle[1];
  // Force at the end of the previous step [N], and the underside's height then [m].
  double before = 0, above = 0;
  bool waits = true;  // the plate has not yet moved onto the fold
  while (simulation->time() < crease.times.pressed) {
    simulation->advance(1);
    const double time = simulation->time();
    const double underside = placement(plate.motion, time)(plate.center).z() - plate.size.z();
    const bool settled = time > crease.times.folded + kSettle - crease.scene.step / 2;
    const double force = settled ? crease.plate_force(simulation->positions(), time) : 0;
    if (force >= choice.force && waits) throw too_small_force(choice.force, force, underside, thickness);
    if (force >= choice.force)
      return above + (underside - above) * (choice.force - before) / (force - before);
    waits = !settled;
    before = force, above = underside;
  }
  throw Error::simulation("the plate reaches the plane before it bears " + std::to_string(choice.force) +
                          " N: take a smaller force")
      .with_experiment("crease");
}

}  // namespace hysteron::experiments
