// A run as one animated scene of surfaces, instants and view, from which files for other programs are
// written.
//
// Surfaces that change their shape are in memory one instant at a time.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <string>
#include <vector>

#include "experiments/workbench/pictures/picture_view.h"
#include "render/shapes.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron::experiments {

// A pose places a body: x -> rotation (scale x) + translation [m].
struct Pose {
  Eigen::Vector3f translation{0, 0, 0};
  Eigen::Quaternionf rotation{1, 0, 0, 0};
  float scale = 1;
};

struct Instant {
  double time;         // [s]
  std::size_t number;  // index among all instants that the run has kept
};

// Warp and weft coordinates [m], one for each vertex or, if seams divide the cloth, for each triangle's
// corner.
struct TextureCoordinates {
  std::vector<Eigen::Vector2f> at;
  bool of_corners = false;
};

struct SurfaceState {
  std::vector<Eigen::Vector3f> points, normals;  // [m]; unit vectors
};

// A surface that either changes its shape or, as a rigid body, its pose.
struct AnimatedPart {
  std::string name;       // letters, digits and _: "cloth", "sphere_0" of the scene's obstacle[0]
  Eigen::Vector3f color;  // in linear light
  TextureCoordinates texture = {};
  render::TriangleMesh shape = {};  // triangles; for a rigid body also its points and normals
  std::function<std::vector<Eigen::Vector3f>(const Instant&)> points_at = {};  // [m]; empty for a rigid body
  std::function<Pose(const Instant&)> pose_at = {};  // empty if the body's points are in world coordinates
  double from = 0, until = 1e30;                     // times at which it is visible [s]
  float inset = 0;                                   // how much smaller than the obstacle it is [m]

  bool is_rigid() const { return !points_at; }
  bool is_seen(const Instant& at) const { return from <= at.time && at.time < until; }
};

// Return a part at that instant, before it is posed; normals cost more than points.
std::vector<Eigen::Vector3f> points_at(const AnimatedPart& part, const Instant& instant);
SurfaceState surface_at(const AnimatedPart& part, const Instant& instant);

struct AnimatedScene {
  std::vector<AnimatedPart> parts;
  std::vector<Instant> instants;  // at least one, ascending
  double rate = 0;                // approximate rate of instants [1/s]
  PictureView view;
};

// Returns the poses of a rigid body at each instant; of the two quaternions of an orientation it takes the
// one nearer to the previous instant.
std::vector<Pose> poses_at(const AnimatedPart& part, const std::vector<Instant>& instants);

// Converts a colour as a screen shows it to linear light.
Eigen::Vector3f linear_light(const render::Rgb8& color);

// Returns the cloth's part without its points.
AnimatedPart animated_cloth(const ClothMesh& mesh, const ClothShape& shape, const PictureView& view);
// Returns the bodies that pictures show beside the cloth: visible obstacles from the same triangles and with
// the same inset, and the ground as a square around the framed bounds.  `side` is that of the cloth's
// triangles [m].
std::vector<AnimatedPart> animated_bodies(const Scene& scene, const PictureView& view, float side);

// Keeps every second instant, and the last.
void halve(std::vector<Instant>& instants);

}  // namespace hysteron::experiments
