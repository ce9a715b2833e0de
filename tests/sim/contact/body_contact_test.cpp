// Cloth on bodies of triangles: it rests, is carried, pushed and rubbed as by obstacles with a signed
// distance.
#include <gtest/gtest.h>

#include <array>

#include "sim/mesh/intersections.h"
#include "sim/scene/body.h"
#include "tests/sim/contact/mesh_bodies.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::ball_at;
using test::on_plate;
using test::Trial;

constexpr double kFreeFall = 9.81;  // [m/s^2]

double slid(const Trial& trial, Simulation& simulation, const Vector3d& along) {
  const auto x = simulation.positions();
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += along.dot(x[i] - trial.cloth.start[i]);
  return sum / static_cast<double>(x.size());
}

TEST(BodyContact, BearsClothWithinItsThickness) {
  for (const Integrator integrator :
       {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2, Integrator::quasi_static}) {
    Trial trial = on_plate(0, 0.3, integrator);
    const auto simulation = trial.after(60);
    const double t = trial.scene.fabric.thickness;
    for (const Vector3d& x : simulation->positions()) {
      EXPECT_GT(x.z(), 0.8 * t);
      EXPECT_LT(x.z(), 1.01 * t);
    }
  }
}

// The slopes are 1 % below and above the angle of friction.
TEST(BodyContact, HoldsBelowTheFrictionAngleAndSlidesByCoulombsLawAboveIt) {
  constexpr double kFriction = 0.3, kCreep = 1e-11;  // in the fifth second, of settling [m]
  const double below = 0.99 * std::atan(kFriction), above = 1.01 * std::atan(kFriction);
  const Trial resting = on_plate(below, kFriction), sliding = on_plate(above, kFriction);
  const auto path = [](const Trial& trial, double slope, int settling, int interval) {
    const Vector3d down(std::cos(slope), 0, -std::sin(slope));
    const auto simulation = trial.after(settling);
    std::array<double, 3> at;
    for (double& s : at) {
      s = slid(trial, *simulation, down);
      simulation->advance(interval);
    }
    return at;
  };
  const auto held = path(resting, below, 720, 240);
  EXPECT_NEAR(held[2], held[1], kCreep);
  const auto slides = path(sliding, above, 60, 120);
  const double interval = 120 * sliding.scene.step;
  const double acceleration = (slides[2] - 2 * slides[1] + slides[0]) / (interval * interval);
  EXPECT_NEAR(acceleration / (kFreeFall * (std::sin(above) - kFriction * std::cos(above))), 1, 0.02);
}

// Its work is that of a box which carries the cloth alike.
TEST(BodyContact, CarriesItsClothWithItsFriction) {
  constexpr double kTravel = 0.04;
  Trial trial = on_plate(0, 0.3);
  Obstacle& table = trial.scene.obstacle[0];
  table.motion.keys = {{0, {0, 0, 0}, 0}, {0.4, {kTravel, 0, 0}, 0}};
  const auto on_mesh = trial.simulation();
  on_mesh->advance(trial.steps(0.2));
  const double work = on_mesh->ledger().obstacle_work;  // the kinetic energy, most of it
  on_mesh->advance(trial.steps(0.3));
  EXPECT_NEAR(slid(trial, *on_mesh, Vector3d::UnitX()), kTravel, 5e-5);
  table.kind = ObstacleKind::box;
  table.size = {0.2, 0.2, 0.05};
  table.center = {0, 0, -0.05};
  const double of_box = trial.at(0.2)->ledger().obstacle_work;
  EXPECT_GT(of_box, 0);
  EXPECT_NEAR(work / of_box, 1, 0.02);
}

// A ball goes up through where the sheet lies, pushes it along and throws it off; nothing passes.
TEST(BodyContact, PushesClothWithoutPassingThroughIt) {
  for (const Integrator integrator : {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2}) {
    Scene scene = test::free_square(200);
    scene.integrator = integrator;
    scene.step = 1.0 / 240;
    Obstacle ball = ball_at({0.1, 0.1, -0.04}, 0.03);
    ball.motion.keys = {{0, {0, 0, 0}, 0}, {0.2, {0, 0, 0.1}, 0}};
    scene.obstacle = {ball};
    const Trial trial(scene);
    const auto simulation = trial.at(0.2);
    const auto x = simulation->positions();
    double highest = -1;
    for (const Vector3d& v : x) highest = std::max(highest, v.z());
    EXPECT_GT(highest, 0.09);
    std::vector<Vector3d> all = x, at = body_positions(scene.obstacle[0], simulation->time());
    all.insert(all.end(), at.begin(), at.end());
    std::vector<Eigen::Vector3i> faces = trial.cloth.mesh.face;
    for (const auto& f : scene.obstacle[0].mesh->face)
      faces.push_back(f.array() + trial.cloth.mesh.vertices());
    EXPECT_TRUE(intersecting_triangles(faces, all).empty());
    EXPECT_GT(simulation->ledger().obstacle_work, 0);
    EXPECT_EQ(simulation->counts().pinched, 0);
  }
}

// A plate 83 thicknesses away at each step's end from where it was at its start, as for plates with a signed
// distance (contact.md): it carries the sheet before it.
TEST(BodyContact, CarriesClothBeforeAFastBody) {
  constexpr double kThicknesses = 83, kSteps = 4;
  for (const Integrator integrator : {Integrator::implicit, Integrator::bdf2, Integrator::tr_bdf2}) {
    Trial trial = on_plate(0, 0.3, integrator);
    const double h = trial.scene.step, way = kSteps * kThicknesses * trial.scene.fabric.thickness;
    auto mesh = std::make_shared<BodyMesh>(*trial.scene.obstacle[0].mesh);
    mesh->frames.push_back(mesh->frames[0]);
    for (Vector3d& x : mesh->frames[1]) x.z() += way;
    mesh->fps = 1 / (kSteps * h);
    trial.scene.obstacle[0].mesh = mesh;
    const auto simulation = trial.after(static_cast<int>(kSteps));
    for (const Vector3d& x : simulation->positions()) EXPECT_GT(x.z(), way) << enum_name(integrator);
    EXPECT_EQ(simulation->counts().pinched, 0) << enum_name(integrator);
  }
}

// The drape is as on the sphere of the same radius, but for the facets, and for the triangles of the cloth,
// which the sphere enters between their vertices.
TEST(BodyContact, DrapesClothAsASphereDoes) {
  Scene scene = test::free_square(600);
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 120;
  scene.air_drag = 2;
  scene.obstacle = {ball_at({0.1, 0.1, -0.0505}, 0.05, 4)};
  const Trial on_mesh(scene);
  scene.obstacle = {test::sphere_at({0.1, 0.1, -0.0505}, 0.05)};
  const Trial on_sphere(scene);
  const auto a = on_mesh.at(0.12)->positions(), b = on_sphere.at(0.12)->positions();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  EXPECT_LT(std::sqrt(sum / static_cast<double>(a.size())), 1e-3);
}

// Frames of a body are as good as keys.
TEST(BodyContact, FollowsASequenceAsItFollowsKeys) {
  constexpr double kRise = 0.02, kSeconds = 0.2;
  const auto risen = [&](bool by_frames) {
    Trial trial = on_plate(0, 0.3);
    Obstacle& plate = trial.scene.obstacle[0];
    if (by_frames) {
      auto mesh = std::make_shared<BodyMesh>(*plate.mesh);
      mesh->frames.push_back(mesh->frames[0]);
      for (Vector3d& x : mesh->frames[1]) x.z() += kRise;
      mesh->fps = 1 / kSeconds;
      plate.mesh = mesh;
    } else {
      plate.motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, kRise}, 0}};
    }
    const auto simulation = trial.at(kSeconds);
    double sum = 0;
    for (const Vector3d& x : simulation->positions()) sum += x.z();
    return sum / trial.cloth.mesh.vertices();
  };
  EXPECT_NEAR(risen(true), kRise + Fabric{}.thickness, 2e-3);
  EXPECT_NEAR(risen(false), kRise + Fabric{}.thickness, 2e-3);
}

// A plate that drives off with its sheet goes on from a saved state with the same bits.
TEST(BodyContact, GoesOnFromASavedState) {
  Trial trial = on_plate(0, 0.3, Integrator::tr_bdf2);
  trial.scene.obstacle[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.4, {0.04, 0, 0.01}, 0}};
  const auto first = trial.after(20), second = trial.simulation();
  second->load(first->save());
  first->advance(10);
  second->advance(10);
  EXPECT_EQ(second->state_hash(), first->state_hash());
  EXPECT_EQ(second->ledger().obstacle_work, first->ledger().obstacle_work);
}

// Layers count where the scene asks for them.
TEST(BodyContact, LeavesLayersAloneWithoutSelfContact) {
  Trial trial = on_plate(0, 0.3);
  const auto alone = trial.after(5)->positions();
  trial.scene.self_contact = true;
  const auto with_layers = trial.after(5)->positions();
  EXPECT_LT(test::farthest(alone, with_layers), 1e-7);
}

}  // namespace
}  // namespace hysteron
