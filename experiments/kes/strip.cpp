#include "experiments/kes/strip.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiments/specimens/cantilever_strip.h"
#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/scene/choice.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {
namespace {

constexpr double kPi = 3.14159265358979323846;
// Returns the clamp's position at the end of a chain of chords, as long as the columns' spacing, that bends
// uniformly through K L: its chords' middles lie on a circle of radius d/(2 tan(K d/2)), a little less than
// 1/K.
Keyframe bent(double curvature, double spacing, double time) {
  const double angle = curvature * kGauge;
  Keyframe key{time, {0, 0, 0}, angle * 180 / kPi};
  if (curvature == 0) return key;
  const double radius = spacing / (2 * std::tan(curvature * spacing / 2));
  key.position = {radius * std::sin(angle) - kGauge, 0, radius * (1 - std::cos(angle))};
  return key;
}

Scene strip_scene(const StripShape& shape, const LawRequest& law, const Fabric& fabric, const KesWalk& walk) {
  Scene scene;
  scene.fabric = fabric;
  scene.fabric.damping = 0;
  scene.law = law.name;
  scene.param = law.parameters;
  scene.element = shape.element;
  scene.mesh = shape.mesh;
  scene.integrator = Integrator::quasi_static;
  scene.gravity.setZero();
  scene.step = walk.rows.back().seconds;
  scene.seconds = scene.step * static_cast<double>(walk.rows.size());
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;  // a strip is too small for more
  return scene;
}

void check_strip(const StripShape& shape, const LawRequest& law, const KesProtocol& protocol) {
  if (!value_if_named<MeshFamily>(shape.mesh))
    throw not_a_choice("mesh", shape.mesh, every_name<MeshFamily>()).with_experiment("kes");
  if (law.name == "grinspun-edit")
    throw Error::invalid_input(
        "grinspun-edit is tested alone (--on law): no edit is ordered on the strip's way, and without "
        "one it is linear")
        .with_key("law", law.name)
        .with_experiment("kes");
  if (protocol.amplitude * kGauge >= 2 * kPi) {
    const std::string amplitude = number_text(protocol.amplitude, 6);
    throw Error::invalid_input(
        fmt::format("amplitude = {} 1/m bends a strip of {:g} m by a whole turn or more: the "
                    "clamps would meet; it must be < {:g} 1/m",
                    amplitude, kGauge, 2 * kPi / kGauge))
        .with_key("amplitude", amplitude)
        .with_experiment("kes");
  }
}

using Clock = std::chrono::steady_clock;

// Returns the moment of the moving clamp's forces about the axis through its middle, per width [N]; it is
// positive if they bend the strip towards +z.
double clamp_moment(const ClampedStrip& strip, std::size_t row, const std::vector<Eigen::Vector3d>& x,
                    const std::vector<Eigen::Vector3d>& force) {
  const Eigen::Vector3d middle = strip.clamp(row)(strip.middle());
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (strip.cloth.pin[i] == 1) torque += (x[i] - middle).cross(force[i]);
  return torque.dot(strip.scene.pin[1].motion.axis) / strip.scene.cloth.width;
}

// Force over the width [N/m].
double clamp_force(const ClampedStrip& strip, const std::vector<Eigen::Vector3d>& force) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < force.size(); ++i)
    if (strip.cloth.pin[i] == 1) sum += force[i];
  return sum.norm() / strip.scene.cloth.width;
}

double free_curvature(const ClampedStrip& strip, const std::vector<double>& curvature) {
  const ClothMesh& mesh = strip.cloth.mesh;
  // This is S_xx if warp lies along the strip, S_yy if weft does.
  const int along = lies_along_weft(strip.scene) ? 1 : 0;
  double sum = 0, area = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    if (!strip.is_free(f)) continue;
    sum += mesh.face_area[f] * curvature[3 * f + along];
    area += mesh.face_area[f];
  }
  return sum / area;
}

// Gives the law the memory that it has in a cloth, unless the user chose one; alone a law has an exact one.
LawRequest as_in_cloth(LawRequest law) {
  if (law.name == "prandtl") law.parameters.try_emplace("memory", "stops");
  return law;
}

}  // namespace

KesWalk strip_walk(const KesProtocol& p, int steps) {
  const int between = 2 * steps - 1;  // in amplitudes
  const double step = 2 * p.amplitude / between, seconds = step / p.rate;
  KesWalk walk{{LawRow{0, seconds, false}}, {0}};
  for (int i = 1; i <= steps; ++i) walk.rows.push_back({p.amplitude * (2 * i - 1) / between, seconds, false});
  walk.start.push_back(walk.rows.size() - 1);
  for (int leg = 0; leg < 2 * p.cycles; ++leg) {
    const double from = leg % 2 ? -p.amplitude : p.amplitude;
    for (int i = 1; i <= between; ++i) walk.rows.push_back({from * (1 - 2.0 * i / between), seconds, false});
    walk.start.push_back(walk.rows.size() - 1);
  }
  return walk;
}

Placement ClampedStrip::clamp(std::size_t row) const {
  return placement(scene.pin[1].motion, static_cast<double>(row) * scene.step);
}

Eigen::Vector3d ClampedStrip::middle() const { return scene.pin[1].motion.center; }

bool ClampedStrip::is_free(int face) const {
  const Eigen::Vector3i& corner = cloth.mesh.face[face];
  return std::all_of(corner.begin(), corner.end(), [&](int vertex) { return cloth.pin[vertex] < 0; });
}

ClampedStrip clamped_strip(const StripShape& shape, const LawRequest& law, const Fabric& fabric,
                           const KesProtocol& protocol) {
  check_strip(shape, law, protocol);
  ClampedStrip strip{{}, {}, strip_walk(protocol, shape.steps), 0};
  ClampedMesh clamped = clamped_mesh(shape.mesh, kGauge, shape.width, shape.triangles, 2, 1);
  const double d = strip.spacing = clamped.spacing;
  Scene& scene = strip.scene = strip_scene(shape, law, fabric, strip.walk);
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = clamped.length;
  scene.cloth.width = shape.width;
  scene.cloth.warp_angle = shape.warp_angle;
  scene.triangles = clamped.mesh.faces();
  scene.pin = {held_between(-1, clamped.near()), held_between(clamped.far(), 1)};
  Motion& motion = scene.pin[1].motion;
  motion.axis = {0, -1, 0};  // bends warp towards +z
  motion.center = {kGauge + d / 2, shape.width / 2, 0};
  for (std::size_t i = 0; i < strip.walk.rows.size(); ++i)
    motion.keys.push_back(bent(strip.walk.rows[i].curvature, d, static_cast<double>(i) * scene.step));
  strip.cloth = place_cloth(scene, std::move(clamped.mesh));
  return strip;
}

StripTest test_strip(const ClampedStrip& strip, const LawRequest& law, const KesProtocol& protocol,
                     const StripWatch& watch) {
  const std::vector<LawRow>& rows = strip.walk.rows;
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  const bool tensors = simulation->dimension() == 3;
  StripTest test;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i == 0) {
      test.moment.push_back(0);
    } else {
      const auto start = Clock::now();
      simulation->advance(1);
      test.seconds += std::chrono::duration<double>(Clock::now() - start).count();
      const std::vector<Eigen::Vector3d> force = simulation->pin_forces();
      test.moment.push_back(clamp_moment(strip, i, simulation->positions(), force));
      test.largest_force = std::max(test.largest_force, clamp_force(strip, force));
    }
    if (tensors) test.free_curvature.push_back(free_curvature(strip, simulation->curvature()));
    if (watch) watch(i, *simulation);
  }
  test.law_moment = run_law(as_in_cloth(law), rows).moment;
  test.reading = read_loop(protocol, strip.walk, test.moment);
  test.law_reading = read_loop(protocol, strip.walk, run_law(law, rows).moment);
  const Diagnostics counts = simulation->counts();
  test.newton_iterations = counts.per_step(counts.newton);
  test.retried_steps = counts.retried;
  test.bytes = counts.bytes;
  return test;
}

double largest_difference(const StripTest& test) {
  double largest = 0, moment = 0;
  for (std::size_t i = 0; i < test.moment.size(); ++i) {
    largest = std::max(largest, std::abs(test.moment[i] - test.law_moment[i]));
    moment = std::max(moment, std::abs(test.law_moment[i]));
  }
  return largest / moment;
}

}  // namespace hysteron::experiments
