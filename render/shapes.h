// Obstacles as triangles, smooth enough to be looked at.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace hysteron::render {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;  // [m]
  std::vector<Eigen::Vector3f> normals;    // unit, outward
  std::vector<std::uint32_t> triangles;    // 3 a triangle, counter-clockwise from outside
  // Least radius on which cloth may lie [m]; 0: edges, or not known.
  float roundness = 0;
  // Convex about the origin: made smaller by a factor along each axis.  Else along its normals, which folds
  // over edges that are less round than the inset.
  bool centred = false;
  bool closed = true;  // else both sides of its triangles are seen

  size_t triangle_count() const { return triangles.size() / 3; }
};

// How many triangles a shape gets around its axis, along a flat side and over a rounded rim.
struct ShapeDetail {
  int sectors, bands, rim_bands;
};
// What is looked at: a radius of 45 mm deviates by 0.024 mm, and flat sides carry the soft shadows that are
// computed per vertex.
constexpr ShapeDetail kSeen{96, 8, 4};
// What only hides light: 0.1 mm.
constexpr ShapeDetail kCaster{48, 1, 2};

// All are centred at the origin; axes along z.  Error::invalid_input if a length is not positive.
TriangleMesh sphere_mesh(float radius, const ShapeDetail& detail = kSeen);
// `rim`: radius of the rounded edge, at most radius and height / 2 [m].
TriangleMesh cylinder_mesh(float radius, float height, float rim, const ShapeDetail& detail = kSeen);
// `height`: length of the axis between the two hemispheres' centres.
TriangleMesh capsule_mesh(float radius, float height, const ShapeDetail& detail = kSeen);
// A ring around z: `radius` to the middle of its wire, which is `height` thick.
TriangleMesh torus_mesh(float radius, float height, const ShapeDetail& detail = kSeen);
// `rim` rounds edges and corners, at most the least half edge.
TriangleMesh box_mesh(const Eigen::Vector3f& half_edges, float rim, const ShapeDetail& detail = kSeen);

// The triangles of a file, corners counter-clockwise from outside.  Its normals are those around a vertex,
// weighted by area.
TriangleMesh smooth_mesh(std::span<const Eigen::Vector3d> position, std::span<const Eigen::Vector3i> face);

// Rigid placement of a mesh whose z axis is to point along `axis`.
Eigen::Matrix4f placed(const Eigen::Vector3f& center, const Eigen::Vector3f& axis);

// Finer triangles for what is computed vertex by vertex.

// The same surface with no side longer than `longest` [m]: longer ones are halved until none is left, on both
// sides of a side alike, so that nothing gapes.  Normals of new vertices lie between those of a side's ends.
// Error::invalid_input if `longest` is not positive.
TriangleMesh refined(TriangleMesh mesh, float longest);

}  // namespace hysteron::render
