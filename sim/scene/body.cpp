#include "sim/scene/body.h"

#include <Eigen/Geometry>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/body_file.h"
#include "sim/scene/cycles.h"
#include "sim/scene/motion.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

// Nothing that cloth lies on is larger or smaller [m]: a body of 1 m read in a wrong unit is beyond these
// limits.
constexpr double kLargestBody = 100, kSmallestBody = 1e-3;

bool is_plausible(double extent) { return extent >= kSmallestBody && extent <= kLargestBody; }

double extent_of(const BodyMesh& body) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : body.frames.front()) box.extend(x);
  return box.sizes().maxCoeff();
}

// Lists the units in which the body has a plausible extent: "centimetre would make it 1.7 m, inch 4.3 m".
std::string units_that_fit(double extent, LengthUnit unit) {
  std::string fitting;
  for (std::size_t i = 0; i < names(LengthUnit{}).size(); ++i) {
    const auto other = static_cast<LengthUnit>(i);
    const double then = extent * in_metres(1, other) / in_metres(1, unit);
    if (other == unit || !is_plausible(then)) continue;
    fitting += (fitting.empty() ? "" : ", ") + enum_name(other) +
               (fitting.empty() ? " would make it " : " ") + number_text(then, 3) + " m";
  }
  return fitting;
}

void check_extent(const Obstacle& o, const std::string& path, const std::string& origin) {
  const double extent = extent_of(*o.mesh);
  if (is_plausible(extent)) return;
  const std::string fitting = units_that_fit(extent, o.unit);
  throw Error::invalid_input("mesh " + o.file + ", read in " + enum_name(o.unit) + "s, is " +
                             number_text(extent, 3) + " m long, which must be in [" +
                             number_text(kSmallestBody, 3) + ", " + number_text(kLargestBody, 3) + "] m" +
                             (fitting.empty() ? "" : ": " + path + ".unit = " + fitting))
      .with_origin(origin);
}

void load_body(const Scene& scene, Obstacle& o, const std::string& path) {
  const auto origin = [&](const std::string& key) {
    return path + "." + key + ", " + key_origin(scene, path + "." + key, key_origin(scene, path));
  };
  BodyMesh body;
  try {
    body = read_body({o.file, o.sequence, o.unit, o.fps});
  } catch (const Error& error) {  // either key may be to blame, since a sequence is compared with the file
    throw error.with_origin(o.sequence.empty() ? origin("file") : path + ", " + key_origin(scene, path));
  }
  if (body.frames.size() > 1 && !body.moves())
    throw Error::invalid_input("sequence " + o.sequence + " of " + std::to_string(body.frames.size()) +
                               " frames needs " + path + ".fps, how many of them a second has")
        .with_origin(origin("sequence"));
  check_cycles(scene, body, path);
  body.cycles = scene_cycles(scene);
  o.mesh = std::make_shared<const BodyMesh>(std::move(body));
  check_extent(o, path, origin("file"));
}

}  // namespace

void load_bodies(Scene& scene) {
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    Obstacle& o = scene.obstacle[i];
    if (is_body(o) && !o.mesh) load_body(scene, o, "obstacle[" + std::to_string(i) + "]");
  }
}

std::vector<Eigen::Vector3d> body_positions(const Obstacle& o, double time) {
  if (!o.mesh) throw Error::invalid_input("an obstacle of kind mesh has no triangles: they were not loaded");
  const Placement at = placement(o.motion, time);
  std::vector<Eigen::Vector3d> x = o.mesh->positions(time);
  for (Eigen::Vector3d& p : x) p = at(p + o.center);
  return x;
}

}  // namespace hysteron
