// A run as one scene in motion, which files for other programs are written from: surfaces, instants, view.
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
  std::size_t number;  // among all that the run has kept
};

// Warp and weft coordinates [m], one for each vertex or, where seams part them, for each triangle's corner.
struct TextureCoordinates {
  std::vector<Eigen::Vector2f> at;
  bool of_corners = false;
};

struct SurfaceState {
  std::vector<Eigen::Vector3f> points, normals;  // [m], unit
};

// A surface that either changes its shape or, as a rigid body, its place.
struct AnimatedPart {
  std::string name;       // letters, digits and _: "cloth", "sphere_0" of the scene's obstacle[0]
  Eigen::Vector3f color;  // of linear light
  TextureCoordinates texture = {};
  render::TriangleMesh shape = {};  // triangles; of a rigid body its points and normals, too
  std::function<std::vector<Eigen::Vector3f>(const Instant&)> points_at = {};  // [m]; empty: a rigid body
  std::function<Pose(const Instant&)> pose_at = {};  // empty: it stands where its points are
  double from = 0, until = 1e30;                     // [s] it is seen
  float inset = 0;                                   // by which it is smaller than the obstacle [m]

  bool is_rigid() const { return !points_at; }
  bool is_seen(const Instant& at) const { return from <= at.time && at.time < until; }
};

// A part at that instant, before it is posed; normals cost more than points.
std::vector<Eigen::Vector3f> points_at(const AnimatedPart& part, const Instant& instant);
SurfaceState surface_at(const AnimatedPart& part, const Instant& instant);

struct AnimatedScene {
  std::vector<AnimatedPart> parts;
  std::vector<Instant> instants;  // at least one, ascending
  double rate = 0;                // instants a second, nearly [1/s]
  PictureView view;
};

// Poses of a rigid body at each instant; of the two quaternions of an orientation the nearer one to the
// instant before is taken.
std::vector<Pose> poses_at(const AnimatedPart& part, const std::vector<Instant>& instants);

// Linear light of a colour as a screen shows it.
Eigen::Vector3f linear_light(const render::Rgb8& color);

// The cloth without its points.
AnimatedPart animated_cloth(const ClothMesh& mesh, const ClothShape& shape, const PictureView& view);
// Bodies are what pictures show beside the cloth: visible obstacles from the same triangles, as much smaller
// as they draw them, and the ground as a square around what they frame.  `side`: of the cloth's triangles
// [m].
std::vector<AnimatedPart> animated_bodies(const Scene& scene, const PictureView& view, float side);

// Every second instant, and the last.
void halve(std::vector<Instant>& instants);

}  // namespace hysteron::experiments
