#include "experiments/workbench/animation/animated_scene.h"

#include "experiments/workbench/pictures/frame_source.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/inset.h"
#include "render/srgb.h"
#include "sim/scene/body.h"
#include "sim/scene/motion.h"

namespace hysteron::experiments {
namespace {

constexpr float kGroundReach = 4;  // half a side of the ground over the radius of the framed bounds

// Returns normals weighted by area, as in the pictures' shader normals.vert.
std::vector<Eigen::Vector3f> vertex_normals(const std::vector<Eigen::Vector3f>& points,
                                            const std::vector<std::uint32_t>& triangles) {
  std::vector<Eigen::Vector3d> sum(points.size(), Eigen::Vector3d::Zero());
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    const Eigen::Vector3d a = points[triangles[t]].cast<double>(),
                          b = points[triangles[t + 1]].cast<double>(),
                          c = points[triangles[t + 2]].cast<double>(), normal = (b - a).cross(c - a);
    for (std::size_t k = 0; k < 3; ++k) sum[triangles[t + k]] += normal;
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve(sum.size());
  for (const Eigen::Vector3d& n : sum)
    normals.push_back((n.norm() > 0 ? n.normalized() : Eigen::Vector3d::UnitZ()).cast<float>());
  return normals;
}

// Returns one coordinate per vertex; with sewn seams one per triangle corner, as each side of a seam has its
// own.
TextureCoordinates texture_coordinates(const ClothMesh& mesh, const ClothShape& shape) {
  TextureCoordinates texture;
  if (const std::vector<float> uv = pattern_coordinates(mesh, shape); !uv.empty()) {
    for (std::size_t i = 0; i < uv.size(); i += 2) texture.at.emplace_back(uv[i], uv[i + 1]);
    return texture;
  }
  texture.of_corners = true;
  const Eigen::Vector2d warp = mesh.warp_axis.head<2>(), weft(-warp.y(), warp.x());
  for (const auto& corners : mesh.panel)
    for (const Eigen::Vector2d& at : corners)
      texture.at.emplace_back(Eigen::Vector2d(at.dot(warp), at.dot(weft)).cast<float>());
  return texture;
}

render::TriangleMesh square(const Eigen::Vector2f& middle, float half) {
  render::TriangleMesh mesh;
  for (const Eigen::Vector2f& corner : {Eigen::Vector2f(-half, -half), Eigen::Vector2f(half, -half),
                                        Eigen::Vector2f(half, half), Eigen::Vector2f(-half, half)}) {
    const Eigen::Vector2f at = middle + corner;
    mesh.positions.emplace_back(at.x(), at.y(), 0);
    mesh.normals.push_back(Eigen::Vector3f::UnitZ());
  }
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Pose pose_of(const Obstacle& obstacle, double time) {
  const Eigen::Matrix4f placed = placed_at(obstacle, time);
  const float scale = static_cast<float>(state_at(obstacle.motion, time).scale);
  const Eigen::Matrix3f rotation = placed.topLeftCorner<3, 3>() / scale;
  return {placed.topRightCorner<3, 1>(), Eigen::Quaternionf(rotation).normalized(), scale};
}

// Returns the ground as a square in the plane's own frame, below the middle of the framed bounds.
AnimatedPart ground_part(const Obstacle& plane, const PictureView& view) {
  const Eigen::Matrix4f placed = placed_at(plane, 0);
  const Eigen::Vector3f middle =
      placed.topLeftCorner<3, 3>().transpose() * (view.bounds.center() - placed.topRightCorner<3, 1>());
  AnimatedPart part{"", linear_light(view.look.obstacle)};
  part.shape = square(middle.head<2>(), kGroundReach * view.bounds.radius());
  return part;
}

// Returns a body of triangles that changes its shape, with its vertices in world coordinates.
AnimatedPart deforming_part(const Obstacle& body, const PictureView& view) {
  AnimatedPart part{"", linear_light(view.look.obstacle)};
  for (const Eigen::Vector3i& face : body.mesh->face)
    for (const int v : face) part.shape.triangles.push_back(static_cast<std::uint32_t>(v));
  part.points_at = [body](const Instant& at) {
    std::vector<Eigen::Vector3f> points;
    for (const Eigen::Vector3d& x : body_positions(body, at.time)) points.push_back(x.cast<float>());
    return points;
  };
  return part;
}

std::optional<AnimatedPart> obstacle_part(const Obstacle& obstacle, const PictureView& view, float side) {
  if (obstacle.kind == ObstacleKind::ground) return ground_part(obstacle, view);
  if (is_body(obstacle) && obstacle.mesh->moves()) return deforming_part(obstacle, view);
  const auto body = obstacle_mesh(obstacle);
  if (!body) return {};
  AnimatedPart part{"", linear_light(view.look.obstacle)};
  part.inset = render::body_inset(render::BodyMeasure(*body), side, view.look.obstacle_inset);
  part.shape = render::shrunk(*body, part.inset);
  return part;
}

}  // namespace

std::vector<Eigen::Vector3f> points_at(const AnimatedPart& part, const Instant& instant) {
  return part.is_rigid() ? part.shape.positions : part.points_at(instant);
}

SurfaceState surface_at(const AnimatedPart& part, const Instant& instant) {
  if (part.is_rigid()) return {part.shape.positions, part.shape.normals};
  SurfaceState state{part.points_at(instant), {}};
  state.normals = vertex_normals(state.points, part.shape.triangles);
  return state;
}

std::vector<Pose> poses_at(const AnimatedPart& part, const std::vector<Instant>& instants) {
  std::vector<Pose> poses;
  for (const Instant& at : instants) {
    Pose pose = part.pose_at ? part.pose_at(at) : Pose();
    if (!poses.empty() && pose.rotation.dot(poses.back().rotation) < 0) pose.rotation.coeffs() *= -1;
    poses.push_back(pose);
  }
  return poses;
}

Eigen::Vector3f linear_light(const render::Rgb8& color) {
  Eigen::Vector3f light;
  for (int k = 0; k < 3; ++k) light[k] = render::linear_of_srgb8()[color[static_cast<std::size_t>(k)]];
  return light;
}

AnimatedPart animated_cloth(const ClothMesh& mesh, const ClothShape& shape, const PictureView& view) {
  AnimatedPart cloth{"cloth", linear_light(view.look.front), texture_coordinates(mesh, shape)};
  for (const Eigen::Vector3i& face : mesh.face)
    for (const int v : face) cloth.shape.triangles.push_back(static_cast<std::uint32_t>(v));
  return cloth;
}

std::vector<AnimatedPart> animated_bodies(const Scene& scene, const PictureView& view, float side) {
  std::vector<AnimatedPart> parts;
  bool has_ground = false;
  for (std::size_t i = 0; i < scene.obstacle.size(); ++i) {
    const Obstacle& obstacle = scene.obstacle[i];
    auto part = obstacle.visible ? obstacle_part(obstacle, view, side) : std::nullopt;
    if (!part) continue;
    has_ground = has_ground || obstacle.kind == ObstacleKind::ground;
    part->name = enum_name(obstacle.kind) + "_" + std::to_string(i);
    if (part->is_rigid())
      part->pose_at = [obstacle](const Instant& at) { return pose_of(obstacle, at.time); };
    part->from = obstacle.from;
    part->until = obstacle.until;
    parts.push_back(std::move(*part));
  }
  if (view.floor && !has_ground) {
    Obstacle level;
    level.center.z() = *view.floor;
    AnimatedPart floor = ground_part(level, view);
    floor.name = "floor";
    floor.pose_at = [level](const Instant& at) { return pose_of(level, at.time); };
    parts.push_back(std::move(floor));
  }
  return parts;
}

void halve(std::vector<Instant>& instants) {
  std::vector<Instant> kept;
  for (std::size_t k = 0; k < instants.size(); ++k)
    if (k % 2 == 0 || k + 1 == instants.size()) kept.push_back(instants[k]);
  instants = std::move(kept);
}

}  // namespace hysteron::experiments
