// Obstacles that are sharper than the mesh: what stands between the vertices does not enter triangles.
#include "sim/contact/face_contact.h"

#include <gtest/gtest.h>

#include <random>

#include "sim/base/enum_names.h"
#include "sim/contact/face_touch.h"
#include "sim/contact/obstacle_set.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Trial;

constexpr double kSide = 0.1;     // of the cloth [m]
constexpr double kClosed = 1e-9;  // of the energy balance
constexpr double kFaceGravity = 9.81;
constexpr int kDivisions = 20;  // of a triangle's edges: 231 points

using Triangle = Vector3d[3];

// Returns points of a triangle on a grid.
std::vector<Vector3d> grid_on(const Vector3d (&x)[3]) {
  std::vector<Vector3d> points;
  for (int i = 0; i <= kDivisions; ++i)
    for (int j = 0; j <= kDivisions - i; ++j)
      points.push_back((i * x[0] + j * x[1] + (kDivisions - i - j) * x[2]) / kDivisions);
  return points;
}

double least_distance(const Obstacle3<double>& obstacle, const Vector3d (&x)[3]) {
  double least = 1e30;
  for (const Vector3d& p : grid_on(x)) least = std::min(least, distance_to<double>(obstacle, p).value);
  return least;
}

// Returns the least distance of a simulation's triangles from its obstacles [m].
double least_distance(const Trial& trial, Simulation& simulation) {
  const auto set = obstacles_during<double>(trial.scene.obstacle, 0.3, simulation.time(), simulation.time());
  const auto position = simulation.positions();
  double least = 1e30;
  for (const auto& face : trial.cloth.mesh.face) {
    const Triangle x = {position[face[0]], position[face[1]], position[face[2]]};
    for (int o = 0; o < set.count; ++o) least = std::min(least, least_distance(set.item[o], x));
  }
  return least;
}

Obstacle box(const Vector3d& half, const Vector3d& center, double rim = 1e-4) {
  Obstacle o = test::box_at(center, half);
  o.rim = rim;
  return o;
}

Obstacle rod(double radius, const Vector3d& center) {
  Obstacle o;
  o.kind = ObstacleKind::capsule;
  o.radius = radius;
  o.height = 0.3;
  o.axis = {0, 1, 0};
  o.center = center;
  return o;
}

Obstacle3<double> placed(const Obstacle& o) { return obstacles_during<double>({o}, 0.3, 0, 0).item[0]; }

ContactModel<double> scene_contact_model(const Scene& scene) {
  const ObstacleResponse<double> response = obstacle_response(scene);
  return {response, kElasticSlip * response.thickness, 0.5 * response.stiffest()};
}

TEST(PlacedObstacle, IsABoxTurnedWithItsEdgesAlongZ) {
  Obstacle turned = box({0.01, 0.02, 0.03}, {0, 0, 0});
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 2, 0), Vector3d(1, 1, 1)}) {
    turned.axis = axis;
    constexpr double kRounding = 1e-15;
    EXPECT_LT((placed(turned).rotation * Vector3d::UnitZ() - axis.normalized()).norm(), kRounding);
    EXPECT_TRUE(obstacle_form(turned).has_axis);
  }
}

// These obstacles are convex, with edges, corners and rounded sides.
std::vector<Obstacle> convex_obstacles() {
  Obstacle cylinder = rod(0.01, {0, 0, 0});
  cylinder.kind = ObstacleKind::cylinder;
  cylinder.height = 0.02;
  Obstacle ball = rod(0.004, {0, 0, 0});
  ball.kind = ObstacleKind::sphere;
  return {box({0.01, 0.02, 0.01}, {0, 0, 0}), box({0.01, 0.02, 0.01}, {0, 0, 0}, 2e-3), rod(1e-3, {0, 0, 0}),
          cylinder, ball};
}

void random_triangle(std::mt19937& generator, double size, Vector3d (&x)[3]) {
  std::uniform_real_distribution<double> uniform(-size, size);
  for (Vector3d& p : x) p = {uniform(generator), uniform(generator), uniform(generator)};
}

// Moves a triangle along the obstacle's normal until its least distance is `distance` (outside).
void put_at(const Obstacle3<double>& obstacle, double distance, Vector3d (&x)[3]) {
  for (int k = 0; k < 50; ++k) {
    const Triangle p = {obstacle.rotation.transpose() * (x[0] - obstacle.center),
                        obstacle.rotation.transpose() * (x[1] - obstacle.center),
                        obstacle.rotation.transpose() * (x[2] - obstacle.center)};
    const FacePoint<double> nearest = face_point<double>(obstacle.shape, p, 5e-5);
    for (Vector3d& corner : x)
      corner += (distance - nearest.distance) * (obstacle.rotation * nearest.normal).normalized();
  }
}

TEST(FacePoint, IsTheNearestPointOfATriangleToAConvexSolid) {
  constexpr double kSpacing = 0.03 * 2 / kDivisions;  // of the points that it is compared with [m]
  std::mt19937 generator(5);
  for (const Obstacle& o : convex_obstacles()) {
    const Obstacle3<double> obstacle = placed(o);
    for (int n = 0; n < 50; ++n) {
      Triangle x, p;
      random_triangle(generator, 0.03, x);
      for (int k = 0; k < 3; ++k) p[k] = obstacle.rotation.transpose() * x[k];
      const double found = face_point<double>(obstacle.shape, p, 0).distance,
                   sampled = least_distance(obstacle, x);
      EXPECT_LT(found, sampled + 1e-12) << enum_name(o.kind);
      EXPECT_GT(found, sampled - kSpacing) << enum_name(o.kind);
      EXPECT_LT(least_possible(obstacle.shape, p), found + 1e-12) << enum_name(o.kind);
    }
  }
}

// The nearest point of anything on a flat side is a corner.
TEST(FaceTouch, LeavesFlatContactToTheVertices) {
  const Scene scene;
  const ContactModel<double> model = scene_contact_model(scene);
  const Obstacle3<double> table = placed(box({0.1, 0.1, 0.1}, {0, 0, -0.1}));
  std::mt19937 generator(7);
  for (int n = 0; n < 100; ++n) {
    Triangle x;
    random_triangle(generator, 0.02, x);
    for (Vector3d& p : x) p.z() = scene.fabric.thickness * (0.5 + p.z() / 0.05);
    EXPECT_FALSE(face_touch(table, model, x, 1e-4).is_active());
    EXPECT_EQ(face_touch(table, model, x, 1e-4).energy, 0);
  }
}

// Central differences of the energy: the error falls with the square of their width, or is rounding.
TEST(FaceTouch, ForceIsTheGradientOfItsEnergy) {
  const Scene scene;
  const ContactModel<double> model = scene_contact_model(scene);
  const double thickness = scene.fabric.thickness, area = 5e-5;
  std::mt19937 generator(11);
  int active = 0, with_corners = 0;
  for (const Obstacle& o : convex_obstacles()) {
    const Obstacle3<double> obstacle = placed(o);
    for (int n = 0; n < 60; ++n) {
      Triangle x, d;
      random_triangle(generator, n % 2 ? 0.01 : 0.0015, x);
      random_triangle(generator, 1, d);
      put_at(obstacle, 0.3 * thickness, x);
      const FaceTouch<double> touch = face_touch(obstacle, model, x, area);
      if (!touch.is_active()) continue;
      ++active;
      with_corners += touch.pull[0].norm() + touch.pull[1].norm() + touch.pull[2].norm() > 0;
      double slope = 0;
      for (int k = 0; k < 3; ++k) slope -= touch.on_corner(k).dot(d[k]);
      EXPECT_NE(slope, 0);
      const auto width_error = [&](double width) {
        Triangle ahead, behind;
        for (int k = 0; k < 3; ++k) {
          ahead[k] = x[k] + width * d[k];
          behind[k] = x[k] - width * d[k];
        }
        return std::abs((face_touch(obstacle, model, ahead, area).energy -
                         face_touch(obstacle, model, behind, area).energy) /
                            (2 * width) -
                        slope);
      };
      const double coarse = width_error(4e-7), fine = width_error(1e-7), rounding = 1e-5 * touch.force;
      EXPECT_LT(fine, coarse / 10 + rounding) << enum_name(o.kind) << " " << n;
    }
  }
  EXPECT_GT(active, 100);
  EXPECT_GT(with_corners, 10);
}

// Off corners that are active and along the normal of a side that is straight there, nothing else curves it.
TEST(FaceTouch, StiffnessIsTheSecondDerivativeAlongTheNormal) {
  const Scene scene;
  const ContactModel<double> model = scene_contact_model(scene);
  const Obstacle3<double> thin = placed(rod(1e-3, {0, 0, 0}));
  const double height = 1e-3 + 0.4 * scene.fabric.thickness, width = 1e-7, area = 5e-5;
  const auto at = [&](double z) {
    const Triangle x = {{-0.01, -0.004, z}, {0.01, -0.004, z}, {0.001, 0.009, z}};
    return face_touch(thin, model, x, area);
  };
  const double difference = -(at(height + width).force - at(height - width).force) / (2 * width);
  EXPECT_GT(difference, 0);
  EXPECT_NEAR(at(height).stiffness / difference, 1, 1e-6);
}

Scene sheet(int triangles, const std::string& integrator = "implicit") {
  Scene scene = test::free_square(triangles);
  scene.cloth.length = kSide;
  scene.cloth.position = {-kSide / 2, -kSide / 2, scene.fabric.thickness};
  scene.law = "prandtl";
  scene.integrator = value_named<Integrator>(integrator);
  scene.solver_tolerance = 1e-6;
  scene.step = 1.0 / 120;
  return scene;
}

struct Sharp {
  const char* name;
  Obstacle obstacle;
};

std::vector<Sharp> sharp_obstacles() {
  return {{"wall of 2 cm", box({0.01, 0.1, 0.05}, {0, 0, -0.05})},
          {"column of 4 cm", box({0.02, 0.02, 0.05}, {0, 0, -0.05})},
          {"rod of 1 mm", rod(1e-3, {0, 0, -1e-3})}};
}

TEST(FaceContact, SheetLetDownOnEdgesCornersAndRodsIsNeverInThem) {
  for (const Sharp& of : sharp_obstacles()) {
    Scene scene = sheet(200);
    scene.obstacle = {of.obstacle};
    const Trial trial(scene);
    const auto simulation = trial.simulation();
    for (int k = 0; k < 2; ++k) {
      simulation->advance(8);
      EXPECT_GT(least_distance(trial, *simulation), 0) << of.name;
    }
    EXPECT_EQ(simulation->counts().deep, 0) << of.name;
    EXPECT_EQ(simulation->counts().unbalanced, 0) << of.name;
    EXPECT_LT(simulation->ledger().remainder_relative, kClosed) << of.name;
  }
}

// The cloth's point that was at `at` when it lay flat.
Vector3d material_position(const Trial& trial, const std::vector<Vector3d>& x, const Eigen::Vector2d& at) {
  constexpr double kRounding = 1e-9;
  for (const auto& face : trial.cloth.mesh.face) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) << trial.cloth.start[face[k]].head<2>(), 1;
    const Vector3d w = corners.inverse() * Vector3d(at.x(), at.y(), 1);
    if (w.minCoeff() > -kRounding) return w[0] * x[face[0]] + w[1] * x[face[1]] + w[2] * x[face[2]];
  }
  throw std::out_of_range("not on the cloth");
}

// Angle by which the cloth's line at rest along x, at y, turns around a rod along y at height z [rad]: -pi
// where it lies flat above it, pi below.  Whatever moves without passing through the rod, the ends included,
// keeps the sense while they turn by less than pi.
double turn_around(const Trial& trial, Simulation& simulation, double y, double z) {
  constexpr int kPoints = 400;
  const auto x = simulation.positions();
  double turn = 0;
  Eigen::Vector2d last;
  for (int i = 0; i <= kPoints; ++i) {
    const Vector3d point = material_position(trial, x, {(static_cast<double>(i) / kPoints - 0.5) * kSide, y});
    const Eigen::Vector2d here(point.x(), point.z() - z);
    if (i > 0) turn += std::atan2(last.x() * here.y() - last.y() * here.x(), last.dot(here));
    last = here;
  }
  return turn;
}

// 1 mm thick, through 17 mm long edges of free cloth: 83 mm a step.
class FastRod : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, FastRod,
                         ::testing::Values("implicit", "bdf2", "tr-bdf2", "semi-implicit"), test::CaseName());

// Two keys a way L and a time T apart are 1.5 L/T apart in speed in their middle.
TEST_P(FastRod, AtFiveMetresASecondCarriesACoarseMeshBeforeIt) {
  constexpr double kTravel = 0.5, kSeconds = 0.15, kRadius = 1e-3;
  Scene scene = sheet(70, GetParam());
  scene.self_contact = scene.integrator == Integrator::semi_implicit;  // else its solve has no line search
  scene.step = 1.0 / 60;
  scene.gravity.setZero();
  scene.cloth.position.z() = 0;
  scene.obstacle = {rod(kRadius, {0, 0, -kTravel / 2})};
  scene.obstacle[0].motion.keys = {{0, {0, 0, 0}, 0}, {kSeconds, {0, 0, kTravel}, 0}};
  const Trial trial(scene);
  const auto simulation = trial.simulation();
  for (int k = 0; k < 9; ++k) {
    simulation->advance(1);
    EXPECT_GT(least_distance(trial, *simulation), 0);
  }
  for (double y : {-0.4, -0.2, 0.0, 0.2, 0.4})  // it slides round the rod as it likes: only its sense stays
    EXPECT_LT(turn_around(trial, *simulation, y * kSide, kTravel / 2), 0);
  EXPECT_EQ(simulation->counts().deep, 0);
  EXPECT_GT(simulation->ledger().obstacle_work, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, kClosed);
}

// A corner under the middle of a triangle whose edges are far from it.
TEST(FaceContact, CornerThatPokesOneTriangleBearsTheCloth) {
  Scene scene = sheet(8);
  scene.step = 1.0 / 240;
  Obstacle column = box({5e-3, 5e-3, 0.05}, {0.008, -0.012, -0.0505});
  scene.obstacle = {column};
  const Trial trial(scene);
  const auto simulation = trial.simulation();
  for (int k = 0; k < 4; ++k) {
    simulation->advance(10);
    EXPECT_GT(least_distance(trial, *simulation), 0);
  }
  EXPECT_GT(simulation->ledger().contact, 0);
  EXPECT_LT(simulation->ledger().remainder_relative, kClosed);
}

// A strip over the edges of a wall that is narrower than its triangles, pulled along by `slope` of gravity:
// it is in equilibrium on friction alone up to tan = mu.
double slid_on_wall(double slope, double friction) {
  Scene scene = sheet(8);
  scene.cloth.length = 0.04;
  scene.cloth.position = {-0.02, -0.02, scene.fabric.thickness};
  scene.fabric.b1 = scene.fabric.b2 = 1e-2;  // does not bend
  scene.gravity = {0, kFaceGravity * std::sin(slope), -kFaceGravity * std::cos(slope)};
  scene.obstacle = {box({2e-3, 0.2, 0.01}, {0, 0, -0.01})};
  scene.obstacle[0].friction = friction;
  const Trial trial(scene);
  const auto simulation = trial.after(60);
  double mean = 0;
  const auto x = simulation->positions();
  for (std::size_t i = 0; i < x.size(); ++i) mean += (x[i] - trial.cloth.start[i]).y() / double(x.size());
  return mean;
}

TEST(FaceContact, HoldsBelowTheFrictionAngleAndSlidesByCoulombsLawAboveIt) {
  constexpr double kFriction = 0.3, kSeconds = 0.5;
  constexpr double kHeld = 1e-5;                              // [m]: the stops' elastic slip is 5e-6 m
  constexpr double kLanding = 0.05;                           // the first steps build contact and stops up
  EXPECT_LT(std::abs(slid_on_wall(0.25, kFriction)), kHeld);  // tan 0.25 = 0.255
  const double slope = 0.5, displacement = kFaceGravity * (std::sin(slope) - kFriction * std::cos(slope)) *
                                           kSeconds * kSeconds / 2;
  EXPECT_NEAR(slid_on_wall(slope, kFriction) / displacement, 1, kLanding);
}

TEST(FaceContact, SavedInTheMiddleGoesOnBitForBit) {
  Scene scene = sheet(60, "tr-bdf2");
  scene.obstacle = {box({0.02, 0.02, 0.05}, {0, 0, -0.05})};
  const Trial trial(scene);
  const auto whole = trial.after(10);
  const std::string saved = trial.after(5)->save();
  const auto resumed = trial.simulation();
  resumed->load(saved);
  resumed->advance(5);
  EXPECT_EQ(resumed->state_hash(), whole->state_hash());
  EXPECT_EQ(resumed->ledger().rows(), whole->ledger().rows());
  EXPECT_GT(whole->ledger().contact_friction, 0);
}

// The curvature of obstacles is compared with the mesh's edges: triangles with edges of 10 mm dip 0.5 mm into
// a sphere of 33 mm.
TEST(FaceContact, IsThereOnlyForObstaclesSharperThanTheMesh) {
  Scene scene = sheet(200);
  const Trial trial(scene);
  const double sharp = sharp_radius(scene, trial.cloth.mesh);
  const auto needs = [&](const Obstacle& o) {
    scene.obstacle = {o};
    return is_sharper_than_mesh(scene, trial.cloth.mesh);
  };
  Obstacle o = rod(1, {0, 0, 0});
  o.height = 1e-3;
  for (const ObstacleKind kind :
       {ObstacleKind::ground, ObstacleKind::hollow, ObstacleKind::cylinder, ObstacleKind::torus}) {
    o.kind = kind;
    EXPECT_FALSE(needs(o)) << enum_name(kind);
  }
  o.kind = ObstacleKind::sphere;
  o.radius = 1.01 * sharp;
  EXPECT_FALSE(needs(o));
  o.radius = 0.99 * sharp;
  EXPECT_TRUE(needs(o));
  o.radius = 1.2 * sharp;
  o.motion.keys = {{0}, {1, {0, 0, 0}, 0, 0.8}};  // shrinks
  EXPECT_TRUE(needs(o));
  EXPECT_TRUE(needs(rod(1e-3, {0, 0, 0})));
  EXPECT_FALSE(needs(box({1, 1, 1}, {0, 0, 0}, 1.01 * sharp)));
  EXPECT_TRUE(needs(box({1, 1, 1}, {0, 0, 0})));
}

}  // namespace
}  // namespace hysteron
