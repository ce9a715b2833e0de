// Nothing of a cloth passes through a body of triangles, nor the body through the cloth: whatever meets
// whatever, however fast, from either side.
#include <gtest/gtest.h>

#include "sim/mesh/intersections.h"
#include "tests/sim/contact/mesh_bodies.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::body_of;
using test::Trial;

int body_crossings(const Trial& trial, Simulation& simulation, double time) {
  std::size_t count = 0;
  for (const Obstacle& o : trial.scene.obstacle)
    count += crossing_triangles({trial.cloth.mesh.face, simulation.positions()},
                                {o.mesh->face, body_positions(o, time)})
                 .size();
  return static_cast<int>(count);
}

// Returns a free sheet without weight in z = 0, near the origin.
Scene floating_sheet(int triangles) {
  Scene scene = test::free_square(triangles);
  scene.cloth.length = 0.1;
  scene.cloth.position = {-0.05, -0.05, 0};
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 240;
  scene.gravity.setZero();
  return scene;
}

// Its first key is at 0, and it goes by `way` [m] in `steps` steps.
Obstacle moving(Obstacle body, const Vector3d& way, int steps, double step) {
  body.motion.keys = {{0, {0, 0, 0}, 0}, {steps * step, way, 0}};
  return body;
}

// Returns a tetrahedron with a vertex, an edge or a face towards the sheet, above `at`, its lowest point 5 mm
// up.
Obstacle tetrahedron_with(int lowest, const Vector3d& at) {
  constexpr double kUp = 0.005, kHigh = 0.02;
  std::vector<Vector3d> x;
  if (lowest == 1) x = {{0, 0, 0}, {0.01, 0, kHigh}, {-0.005, 0.01, kHigh}, {-0.005, -0.01, kHigh}};
  if (lowest == 2) x = {{-0.01, 0, 0}, {0.01, 0, 0}, {0, 0.01, kHigh}, {0, -0.01, kHigh}};
  if (lowest == 3) x = {{0.01, 0, 0}, {-0.005, 0.01, 0}, {-0.005, -0.01, 0}, {0, 0, kHigh}};
  for (Vector3d& v : x) v += at + Vector3d(0, 0, kUp);
  return body_of(x, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

TEST(BodyCrossing, NoVertexEdgeOrFaceOfABodyGoesThroughOnesOfTheCloth) {
  const Trial free(floating_sheet(30));
  const auto& f = free.cloth.mesh.face[free.cloth.mesh.face.size() / 2];
  const auto& x = free.cloth.start;
  for (const int lowest : {1, 2, 3})
    for (const Vector3d& at :
         {x[f[0]], Vector3d((x[f[0]] + x[f[1]]) / 2), Vector3d((x[f[0]] + x[f[1]] + x[f[2]]) / 3)})
      for (const int steps : {1, 6}) {  // of 30 mm, 60 thicknesses
        Trial trial = free;
        trial.scene.obstacle = {moving(tetrahedron_with(lowest, at), {0, 0, -0.03}, steps, trial.scene.step)};
        const auto simulation = trial.after(steps + 2);
        EXPECT_EQ(body_crossings(trial, *simulation, simulation->time()), 0)
            << lowest << " " << at.transpose();
        double lowest_vertex = 0;
        for (const Vector3d& v : simulation->positions()) lowest_vertex = std::min(lowest_vertex, v.z());
        EXPECT_LT(lowest_vertex, -0.0249) << "it pushes the sheet before it";
      }
}

TEST(BodyCrossing, ABodyOfOneTriangleIsEnough) {
  Trial trial(floating_sheet(100));
  const Obstacle triangle =
      body_of({{0.02, 0, 0.004}, {-0.01, 0.015, 0.006}, {-0.01, -0.02, 0.005}}, {{0, 1, 2}});
  trial.scene.obstacle = {moving(triangle, {0, 0, -0.04}, 10, trial.scene.step)};
  const auto simulation = trial.after(12);
  EXPECT_EQ(body_crossings(trial, *simulation, simulation->time()), 0);
}

TEST(BodyCrossing, AnOpenBodyBarsTheWayFromBothSides) {
  for (const double side : {1.0, -1.0}) {
    Trial trial(floating_sheet(60));
    trial.scene.obstacle = {
        moving(test::plate_at({0, 0, 0.003 * side}, 0.2), {0, 0, -0.02 * side}, 10, trial.scene.step)};
    const auto simulation = trial.after(10);
    for (const Vector3d& v : simulation->positions()) EXPECT_LT(side * v.z(), -0.017);
  }
}

// A paddle upright on the sheet turns by 90 degrees a step about an axis in it.
TEST(BodyCrossing, ABodyThatTurnsByARightAngleAStepThrowsTheSheetOff) {
  for (const Integrator integrator : {Integrator::implicit, Integrator::tr_bdf2}) {
    Scene scene = floating_sheet(60);
    scene.integrator = integrator;
    Trial trial(scene);
    Obstacle paddle =
        body_of({{-0.03, 0.002, 0.003}, {0.03, 0.002, 0.003}, {0.03, 0.002, 0.05}, {-0.03, 0.002, 0.05}},
                {{0, 1, 2}, {0, 2, 3}});
    paddle.motion.axis = Vector3d::UnitX();
    paddle.motion.keys = {{0, {0, 0, 0}, 0}, {4 * trial.scene.step, {0, 0, 0}, 360}};
    trial.scene.obstacle = {paddle};
    const auto simulation = trial.after(6);
    double farthest = 0;
    for (const Vector3d& v : simulation->positions()) farthest = std::max(farthest, std::abs(v.z()));
    EXPECT_GT(farthest, 0.02);
    EXPECT_EQ(body_crossings(trial, *simulation, simulation->time()), 0);
  }
}

}  // namespace
}  // namespace hysteron
