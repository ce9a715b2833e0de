// Cloth that starts across the surface of a body of triangles, or inside it, is refused.
#include <gtest/gtest.h>

#include "sim/contact/start_checks.h"
#include "sim/scene/body.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/contact/two_sheets.h"
#include "tests/sim/mesh/bodies.h"

namespace hysteron {
namespace {

using test::kAccepted;
using test::says;

// The fixture has a free square of 0.2 m in z = 0 and a body with its middle at `center`.
class StartBesideBody : public testing::Test {
 protected:
  std::string start(const test::Body& body, const Eigen::Vector3d& center) {
    Obstacle o;
    o.kind = ObstacleKind::mesh;
    o.file = "body.obj";
    o.center = center;
    BodyMesh mesh;
    mesh.face = body.face;
    mesh.frames = {body.vertex};
    mesh.closed =
        3 * mesh.face.size() == 2 * (mesh.face.size() + body.vertex.size() - 2);  // of a ball (Euler)
    o.mesh = std::make_shared<const BodyMesh>(mesh);
    scene_.obstacle = {Obstacle{}, o};
    scene_.obstacle[0].center.z() = -10;
    const Cloth cloth = make_cloth(scene_);
    return test::refusal([&] { check_start(scene_, cloth); });
  }

  Scene scene_ = test::free_square(200);
  const Eigen::Vector3d middle_{scene_.cloth.length / 2, scene_.cloth.length / 2, 0};
};

TEST_F(StartBesideBody, IsAcceptedAboveItAndBelow) {
  const test::Body ball = test::ball(0.05, 3);
  for (const double z : {0.051, -0.051, 1.0})
    EXPECT_EQ(start(ball, middle_ + Eigen::Vector3d(0, 0, z)), kAccepted);
}

TEST_F(StartBesideBody, IsRefusedAcrossItsSurface) {
  EXPECT_TRUE(says(start(test::ball(0.05, 3), middle_ + Eigen::Vector3d(0, 0, 0.049)),
                   "obstacle: at the start ",
                   " triangles of the cloth lie across the surface of obstacle[1] (mesh body.obj)",
                   "move the cloth or the obstacle"));
  scene_.self_contact = true;
  EXPECT_TRUE(says(start(test::ball(0.05, 3), middle_), "lie across the surface"));
}

// No step may bring the cloth nearer than a tenth of its thickness.
TEST_F(StartBesideBody, IsRefusedNearerThanAnyStepMayBringIt) {
  const double least = 0.1 * scene_.fabric.thickness;
  const auto at = [&](double distance) {
    return start(test::ball(0.05, 3), middle_ + Eigen::Vector3d(0, 0, 0.05 + distance));
  };
  EXPECT_EQ(at(1.1 * least), kAccepted);
  EXPECT_TRUE(says(at(0.8 * least), "obstacle: at the start the cloth is ",
                   " from obstacle[1] (mesh body.obj)", "and must be more than 0.0497 mm away",
                   "move the cloth or the obstacle"));
}

// The body is smaller than a triangle, and between its vertices.
TEST_F(StartBesideBody, IsRefusedWithASmallBodyInATriangle) {
  const Cloth cloth = make_cloth(scene_);
  const Eigen::Vector3i& f = cloth.mesh.face[40];
  const Eigen::Vector3d at = (cloth.start[f[0]] + cloth.start[f[1]] + cloth.start[f[2]]) / 3;
  EXPECT_TRUE(says(start(test::ball(1e-3, 0), at), "1 triangles of the cloth lie across"));
}

TEST_F(StartBesideBody, IsRefusedInsideWithItsDepth) {
  const test::Body ball = test::ball(1, 3);
  const std::string said = start(ball, middle_);
  EXPECT_TRUE(
      says(said, "triangles of the cloth lie inside obstacle[1] (mesh body.obj), vertex ", " mm deep"));
  EXPECT_EQ(start(ball.inside_out(), middle_), kAccepted) << "in a hollow";
  test::Body open = ball;
  open.face.pop_back();
  EXPECT_EQ(start(open, middle_), kAccepted) << "it has a way out";
}

TEST_F(StartBesideBody, MayBeAcrossWhereItIsHeldThroughout) {
  Pin all;
  all.low.setConstant(-1), all.high.setConstant(1);
  scene_.pin = {all};
  EXPECT_EQ(start(test::ball(0.05, 3), middle_), kAccepted);
  scene_.pin[0].until = 0.5 * scene_.seconds;
  EXPECT_TRUE(says(start(test::ball(0.05, 3), middle_), "lie across the surface"));
}

}  // namespace
}  // namespace hysteron
