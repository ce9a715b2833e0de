#include "experiments/fab/sheet.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "experiments/specimens/clamped_mesh.h"
#include "sim/base/error.h"
#include "sim/identification/fab_fabric.h"

namespace hysteron::experiments {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kHardly = 1e-6;  // of the fabric's thresholds: friction that slips at once carries nothing
constexpr int kPieces = 256;      // of a slope that is summed up

double warp_angle_of(StripDirection direction) {  // [degree]
  switch (direction) {
    case StripDirection::warp:
      return 0;
    case StripDirection::weft:
      return 90;
    case StripDirection::bias:
      break;
  }
  return 45;
}

// The fabric with friction that carries nothing and remembers where the cloth is.
Fabric laid_slack(Fabric fabric) {
  fabric.k0 *= kHardly;
  for (Spectrum* stops : {&fabric.bending.stops, &fabric.bending.weft_stops})
    for (double& threshold : stops->thresholds) threshold *= kHardly;
  return fabric;
}

// Where the middle line of a strip of `length` is at `s` along it whose slope angle is A sin(2 pi s/length).
Eigen::Vector2d on_sine(double amplitude, double length, double s) {
  Eigen::Vector2d point(0, 0);
  for (int i = 0; i < kPieces; ++i) {
    const double at = (i + 0.5) / kPieces * s;
    const double slope = amplitude * std::sin(2 * std::numbers::pi * at / length);
    point += s / kPieces * Eigen::Vector2d(std::cos(slope), std::sin(slope));
  }
  return point;
}

// Buckled to its side by a sine of the slope, from clamp to clamp, which brings them closer by `slack` to
// second order in the slope: A^2/4 of the length.  Returns by how much it does [m].
double buckle(Cloth& cloth, const ClampedMesh& clamped, double slack, double side) {
  const double length = clamped.far() - clamped.near();
  const double amplitude = 2 * std::sqrt(slack / length);
  for (std::size_t i = 0; i < cloth.start.size(); ++i) {
    const Eigen::Vector3d& flat = cloth.mesh.rest[i];
    const double s = std::clamp(flat.x() - clamped.near(), 0.0, length);
    const Eigen::Vector2d point = on_sine(amplitude, length, s);
    cloth.start[i] = {flat.x() - s + point.x(), flat.y(), side * point.y()};
  }
  return length - on_sine(amplitude, length, length).x();
}

Keyframe at_distance(double time, double moved) {
  Keyframe key;
  key.time = time;
  key.position.x() = moved;
  return key;
}

// The far clamp's way through all rows from where the sheet starts, `first` between the clamps [m].
std::vector<Keyframe> way_of(const FabLoops& loops, double first) {
  std::vector<Keyframe> keys = {at_distance(0, 0)};
  double time = kLayingSteps;
  for (const FabBranch& branch : loops.branches)
    for (const double distance : branch.distance) keys.push_back(at_distance(time++, distance - first));
  return keys;
}

Scene scene_of(const FabLoops& loops, const Fabric& fabric, const SheetShape& shape) {
  Scene scene;
  scene.fabric = fabric;
  scene.fabric.damping = 0;
  scene.fabric.bending.set = {};
  scene.law = "prandtl";
  scene.param = {{"memory", "stops"}, {"stops", std::to_string(kMostStops)}};
  scene.cloth.shape = "strip";
  scene.cloth.width = shape.width > 0 ? shape.width : loops.width;
  scene.cloth.warp_angle = warp_angle_of(strip_direction(loops.direction));
  scene.mesh = shape.mesh;
  scene.integrator = Integrator::quasi_static;
  scene.linear_solver = Preconditioning::cholesky;
  scene.gravity = {0, 0, -kStandardGravity};
  scene.ramp = kLayingSteps;
  scene.step = 1;
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  return scene;
}

// Of the far clamp, per width of the sheet [N/m].
double clamp_force(const FabSheet& sheet, Simulation& simulation) {
  const std::vector<Eigen::Vector3d> force = simulation.handle_forces();
  double sum = 0;
  for (const int vertex : sheet.cloth.pin_vertices[1]) sum += force[vertex].x();
  return sum / sheet.scene.cloth.width;
}

double lost(const Ledger& ledger) { return ledger.bending_friction + ledger.membrane_friction; }

// Along the edge y = 0, between the clamps' inner columns, from the near clamp's middle on.
std::vector<Eigen::Vector2d> edge_line(const FabSheet& sheet, const std::vector<Eigen::Vector3d>& x) {
  constexpr double kOnTheEdge = 1e-9;  // [m]
  const std::vector<Eigen::Vector3d>& rest = sheet.cloth.mesh.rest;
  const double outer = sheet.scene.cloth.length - sheet.spacing / 2;
  std::vector<int> edge;
  for (int i = 0; i < sheet.cloth.mesh.vertices(); ++i)
    if (std::abs(rest[i].y()) < kOnTheEdge && rest[i].x() > sheet.spacing / 2 && rest[i].x() < outer)
      edge.push_back(i);
  std::sort(edge.begin(), edge.end(), [&](int a, int b) { return rest[a].x() < rest[b].x(); });
  std::vector<Eigen::Vector2d> line;
  for (const int i : edge) line.emplace_back(x[i].x() - sheet.spacing / 2, sheet.side * x[i].z());
  return line;
}

}  // namespace

FabSheet fab_sheet(const FabLoops& loops, const Fabric& fabric, const SheetShape& shape) {
  if (!loops.bends())
    throw Error::request("fab.test = " + loops.test + " stretches: a sheet is bent, by U.. or D..")
        .of("fab.test", loops.test);
  FabSheet sheet;
  Scene& scene = sheet.scene = scene_of(loops, fabric, shape);
  ClampedMesh clamped =
      clamped_mesh(shape.mesh, loops.gauge, scene.cloth.width, shape.triangles, 2, scene.seed);
  sheet.spacing = clamped.spacing;
  sheet.side = loops.bends_up() ? 1 : -1;
  scene.cloth.length = clamped.length;
  scene.triangles = clamped.mesh.faces();
  scene.pin = {held_between(-1, clamped.near()), held_between(clamped.far(), 1)};
  sheet.cloth = place_cloth(scene, clamped.mesh);
  const double slack = loops.gauge - loops.branches[0].distance[0];
  const double shortened = buckle(sheet.cloth, clamped, slack, sheet.side);
  scene.pin[1].motion.keys = way_of(loops, loops.gauge - shortened);
  scene.seconds = scene.pin[1].motion.keys.back().time;
  return sheet;
}

// The state in which a fabric without friction comes to rest, friction's memory of it included, is where the
// fabric itself starts from.
SheetRun test_sheet(const FabSheet& sheet, const FabLoops& loops, const SheetWatch& watch) {
  const auto start = Clock::now();
  Scene slack = sheet.scene;
  slack.fabric = laid_slack(slack.fabric);
  const auto laid = make_simulation(slack, sheet.cloth);
  laid->advance(kLayingSteps);
  const auto simulation = make_simulation(sheet.scene, sheet.cloth);
  simulation->load(laid->save());
  const Ledger before = simulation->ledger();
  SheetRun run;
  run.shapes.push_back(edge_line(sheet, simulation->positions()));
  for (std::size_t b = 0; b < loops.branches.size(); ++b) {
    run.force.emplace_back();
    const std::vector<double>& distance = loops.branches[b].distance;
    for (std::size_t i = 0; i < distance.size(); ++i) {
      const bool first = b == 0 && i == 0;
      if (!first) simulation->advance(1);
      run.force[b].push_back(clamp_force(sheet, first ? *laid : *simulation));
      if (watch) watch({b, i, distance[i], run.force[b][i]}, *simulation);
    }
    run.shapes.push_back(edge_line(sheet, simulation->positions()));
  }
  const Ledger after = simulation->ledger();
  run.work = (after.handle_work - before.handle_work) / sheet.scene.cloth.width;
  run.dissipated = (lost(after) - lost(before)) / sheet.scene.cloth.width;
  run.triangles = sheet.cloth.mesh.faces();
  run.newton_iterations = simulation->newton_iterations();
  run.retried_steps = simulation->retried_steps();
  run.state_hash = simulation->state_hash();
  run.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return run;
}

}  // namespace hysteron::experiments
