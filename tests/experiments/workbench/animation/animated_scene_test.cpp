// An animated scene has what pictures show as surfaces in motion.
#include "experiments/workbench/animation/animated_scene.h"

#include <gtest/gtest.h>

#include "render/inset.h"
#include "tests/experiments/workbench/animation/moving_scene.h"
#include "tests/sim/mesh/panel_tube.h"

namespace hysteron::experiments {
namespace {

TEST(AnimatedScene, HasWhatPicturesShowByItsNumberInTheScene) {
  const MovingScene moving;
  const auto& parts = moving.scene.parts;
  ASSERT_EQ(parts.size(), 3u) << "cloth, ball and ground, and no hidden ball";
  EXPECT_EQ(parts[0].name, "cloth");
  EXPECT_EQ(parts[1].name, "sphere_1");
  EXPECT_EQ(parts[2].name, "ground_2");
  EXPECT_FALSE(parts[0].is_rigid());
  EXPECT_TRUE(parts[1].is_rigid());
}

TEST(AnimatedScene, BodiesAreAsMuchSmallerAsPicturesDrawThem) {
  const MovingScene moving;
  const AnimatedPart& ball = moving.scene.parts[1];
  EXPECT_GE(ball.inset, moving.scene.view.look.obstacle_inset);
  for (const Eigen::Vector3f& p : ball.shape.positions)
    ASSERT_NEAR(p.norm(), MovingScene::kRadius - ball.inset, 1e-6);
}

TEST(AnimatedScene, BodiesGoWhereTheirKeysLead) {
  const MovingScene moving;
  const Pose pose = poses_at(moving.scene.parts[1], moving.scene.instants)[2];
  EXPECT_LT((pose.translation - Eigen::Vector3f(0.15f, 0.2f, 0.3f)).norm(), 1e-6);
  EXPECT_EQ(pose.scale, MovingScene::kGrows);
  EXPECT_LT((pose.rotation * Eigen::Vector3f::UnitZ() - Eigen::Vector3f::UnitX()).norm(), 1e-6)
      << "a quarter turn about y";
}

// In turns by a third the quaternions would jump to their negatives, between which a viewer may turn the long
// way.
TEST(AnimatedScene, OrientationsOfABodyThatGoesOnTurningAreNearEachOther) {
  AnimatedPart part{"wheel", {1, 1, 1}};
  part.pose_at = [](const Instant& at) {
    const Eigen::AngleAxisd turn(2 * std::numbers::pi / 3 * at.time, Eigen::Vector3d::UnitX());
    return Pose{{0, 0, 0}, Eigen::Quaternionf(turn.toRotationMatrix().cast<float>()), 1};
  };
  const std::vector<Pose> poses = poses_at(part, {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}});
  for (std::size_t k = 0; k + 1 < poses.size(); ++k)
    EXPECT_NEAR(poses[k].rotation.dot(poses[k + 1].rotation), 0.5, 1e-6);
}

TEST(AnimatedScene, TheGroundIsASquareAtItsHeightAroundWhatIsFramed) {
  const MovingScene moving;
  const AnimatedPart& ground = moving.scene.parts[2];
  const Pose pose = poses_at(ground, moving.scene.instants)[0];
  const render::Box& framed = moving.scene.view.bounds;
  render::Box box = framed;
  box.high.z() = -1;
  for (const Eigen::Vector3f& p : ground.shape.positions) {
    const Eigen::Vector3f at = pose.rotation * p + pose.translation;
    EXPECT_NEAR(at.z(), -0.5, 1e-6);
    box = box.merged({at, at});
  }
  EXPECT_LT(box.low.x(), framed.low.x() - framed.radius());
  EXPECT_GT(box.high.y(), framed.high.y() + framed.radius());
}

// The scene has no ground, but its pictures have one, as a drape's.
TEST(AnimatedScene, AFloorOfPicturesAloneIsThere) {
  const MovingScene moving;
  const PictureView view = picture_view(moving.setup, {{0, 0, 0}, {1, 1, 1}}, -0.25f);
  const std::vector<AnimatedPart> parts = animated_bodies(default_scene(), view, 0.01f);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].name, "floor");
  EXPECT_EQ(poses_at(parts[0], {{0, 0}})[0].translation.z(), -0.25f);
}

// The mean normal of facets an angle apart is the cylinder's to second order in that angle.
TEST(AnimatedScene, NormalsTurnWithTheCloth) {
  const MovingScene moving;
  const double kFacets = std::pow(MovingScene::kCurvature[2] * MovingScene::kLength / 8, 2);
  const SurfaceState state = surface_at(moving.scene.parts[0], moving.scene.instants[2]);
  int inside = 0;
  for (std::size_t v = 0; v < state.points.size(); ++v) {
    const Eigen::Vector3d& x = moving.mesh.rest[v];
    if (x.head<2>().minCoeff() <= 0 || x.head<2>().maxCoeff() >= MovingScene::kLength) continue;
    ++inside;
    const double angle = MovingScene::kCurvature[2] * x.x();
    EXPECT_NEAR(state.normals[v].x(), -std::sin(angle), kFacets);
    EXPECT_NEAR(state.normals[v].z(), std::cos(angle), kFacets);
  }
  EXPECT_EQ(inside, 7 * 7);
}

TEST(AnimatedScene, TextureIsTheClothAtRestAlongWarpAndWeft) {
  MovingScene moving;
  moving.mesh.warp_axis = {0, 1, 0};
  const AnimatedPart cloth = animated_cloth(moving.mesh, moving.setup.scene.cloth, moving.scene.view);
  ASSERT_FALSE(cloth.texture.of_corners);
  ASSERT_EQ(cloth.texture.at.size(), moving.mesh.rest.size());
  for (std::size_t v = 0; v < moving.mesh.rest.size(); ++v) {
    EXPECT_NEAR(cloth.texture.at[v].x(), moving.mesh.rest[v].y(), 1e-8);
    EXPECT_NEAR(cloth.texture.at[v].y(), -moving.mesh.rest[v].x(), 1e-8);
  }
}

TEST(AnimatedScene, AlongASewnSeamEachSideHasATextureOfItsOwn) {
  const ClothMesh mesh = test::PanelTube().mesh();
  const AnimatedPart cloth = animated_cloth(mesh, ClothShape(), MovingScene().scene.view);
  ASSERT_TRUE(cloth.texture.of_corners);
  ASSERT_EQ(cloth.texture.at.size(), cloth.shape.triangles.size());
  EXPECT_LT((cloth.texture.at[4] - mesh.panel[1][1].cast<float>()).norm(), 1e-7);
}

TEST(AnimatedScene, HalvedKeepsTheFirstAndTheLastInstant) {
  std::vector<Instant> instants = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  halve(instants);
  ASSERT_EQ(instants.size(), 3u);
  EXPECT_EQ(instants[1].number, 2u);
  EXPECT_EQ(instants[2].number, 3u);
}

}  // namespace
}  // namespace hysteron::experiments
