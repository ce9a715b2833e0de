#include "experiments/kes/strip.h"

#include <chrono>
#include <cmath>

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

// Of the forces of the moving clamp about the axis through its middle, per width [N]; positive where they
// bend the strip towards +z.
double clamp_moment(const ClampedStrip& strip, std::size_t row, const std::vector<Eigen::Vector3d>& x,
                    const std::vector<Eigen::Vector3d>& force) {
  const Eigen::Vector3d middle = strip.clamp(row)(strip.middle());
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (strip.cloth.pin[i] == 1) torque += (x[i] - middle).cross(force[i]);
  return torque.dot(strip.scene.pin[1].motion.axis) / strip.scene.cloth.width;
}

double clamp_force(const ClampedStrip& strip, const std::vector<Eigen::Vector3d>& force) {  // [N/m]
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < force.size(); ++i)
    if (strip.cloth.pin[i] == 1) sum += force[i];
  return sum.norm() / strip.scene.cloth.width;
}

double free_curvature(const ClampedStrip& strip, const std::vector<double>& curvature) {
  const ClothMesh& mesh = strip.cloth.mesh;
  double sum = 0, area = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    if (!strip.is_free(f)) continue;
    sum += mesh.face_area[f] * curvature[3 * f];  // S_xx: warp lies along the strip
    area += mesh.face_area[f];
  }
  return sum / area;
}

// The memory that a cloth has, if none is asked for; alone a law has an exact one.
LawRequest as_in_cloth(LawRequest law) {
  if (law.name == "prandtl") law.parameters.try_emplace("memory", "stops");
  return law;
}

}  // namespace

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
      const std::vector<Eigen::Vector3d> force = simulation->handle_forces();
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
