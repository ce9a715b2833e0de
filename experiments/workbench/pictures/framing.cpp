#include "experiments/workbench/pictures/framing.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sim/base/error.h"
#include "sim/time/simulation.h"
#include "sim/time/timetable.h"

namespace hysteron::experiments {
namespace {

constexpr int kTriangles = 400;
constexpr double kRate = 30;  // rate of the checked instants [1/s]
// Margin over the box's diagonal: a fine mesh moves a little outside a coarse one's box.
constexpr float kRoom = 0.03f;

render::Box bounding_box(const std::vector<Eigen::Vector3d>& x) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : x) box.extend(p);
  return {box.min().cast<float>(), box.max().cast<float>()};
}

render::Box with_room(render::Box box) {
  const float room = kRoom * (box.high - box.low).norm();
  box.low.array() -= room;
  box.high.array() += room;
  return box;
}

// True if the known box contains the other, within the margin at a picture's border.
bool holds(const render::Box& known, const render::Box& box) {
  constexpr float kSlack = 1e-3f;  // over the diagonal
  const float slack = kSlack * (known.high - known.low).norm();
  return (known.low.array() - slack <= box.low.array()).all() &&
         (box.high.array() <= known.high.array() + slack).all();
}

struct Trial {
  explicit Trial(const Scene& scene) : cloth(make_cloth(scene)), simulation(make_simulation(scene, cloth)) {}
  Cloth cloth;
  std::unique_ptr<Simulation> simulation;
};

// Returns a trial on a coarse mesh, or on the scene's own if a coarse one cannot start, as when pins select
// none of its vertices.
std::unique_ptr<Trial> framing_trial(const Scene& scene) {
  if (scene.triangles <= kTriangles && scene.cloth.subdivisions == 0) return std::make_unique<Trial>(scene);
  Scene coarse = scene;
  coarse.triangles = std::min(scene.triangles, kTriangles);
  coarse.cloth.subdivisions = 0;
  try {
    return std::make_unique<Trial>(coarse);
  } catch (const Error&) {
    return std::make_unique<Trial>(scene);
  }
}

}  // namespace

Framing scene_framing(const Setup& setup, const render::Box& known) {
  const Scene& scene = setup.scene;
  const auto trial = framing_trial(scene);
  Simulation& simulation = *trial->simulation;
  Framing framing{bounding_box(trial->cloth.start), trial->cloth.mesh.faces()};
  const Timetable timetable(scene.seconds, scene.step);
  try {
    for (long n = 0; n < timetable.steps(); n = simulation.steps()) {
      advance_along(timetable, simulation, timetable.next_instant(n, kRate));
      framing.box = framing.box.merged(bounding_box(simulation.positions()));
    }
  } catch (const Error& error) {
    framing.stopped = error.what();
  }
  framing.box = holds(known, framing.box) ? known : with_room(framing.box).merged(known);
  return framing;
}

std::optional<render::Box> planned_framing(const Setup& setup,
                                           render::Box (*known)(const Scene&, const Cloth&)) {
  const Options& options = setup.options;
  if (options.no_images || options.explain || !options.camera_box.empty()) return {};
  return scene_framing(setup, known(setup.scene, make_cloth(setup.scene))).box;
}

}  // namespace hysteron::experiments
