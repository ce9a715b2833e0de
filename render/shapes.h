// Triangle meshes of obstacles, smooth enough to be looked at.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace hysteron::render {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions;  // [m]
  std::vector<Eigen::Vector3f> normals;    // unit, outward
  std::vector<std::uint32_t> triangles;    // 3 per triangle, counter-clockwise from outside
  // Least radius on which cloth may lie [m]; 0 for edges, or if not known.
  float roundness = 0;
  // True if the body is convex about the origin and is made smaller by a factor along each axis; else it
  // shrinks along its normals, which folds over edges that are less round than the inset.
  bool centred = false;
  bool closed = true;  // false: both sides of its triangles are seen

  size_t triangle_count() const { return triangles.size() / 3; }
};

// Numbers of triangles around a shape's axis, along a flat side and over a rounded rim.
struct ShapeDetail {
  int sectors, bands, rim_bands;
};
// Detail of visible bodies: a radius of 45 mm deviates by 0.024 mm, and flat sides carry the soft shadows
// that are computed per vertex.
constexpr ShapeDetail kSeen{96, 8, 4};
// Detail of bodies that only cast shadows: a radius of 45 mm deviates by 0.1 mm.
constexpr ShapeDetail kCaster{48, 1, 2};

// All meshes are centred at the origin, with axes along z.  Error::invalid_input if a length is not positive.
TriangleMesh sphere_mesh(float radius, const ShapeDetail& detail = kSeen);
// `rim` is the radius of the rounded edge, at most radius and height / 2 [m].
TriangleMesh cylinder_mesh(float radius, float height, float rim, const ShapeDetail& detail = kSeen);
// `height` is the distance between the two hemispheres' centres [m].
TriangleMesh capsule_mesh(float radius, float height, const ShapeDetail& detail = kSeen);
// A ring around z: `radius` goes to the middle of its wire, which is `height` thick [m].
TriangleMesh torus_mesh(float radius, float height, const ShapeDetail& detail = kSeen);
// `rim` rounds edges and corners, at most by the least half edge [m].
TriangleMesh box_mesh(const Eigen::Vector3f& half_edges, float rim, const ShapeDetail& detail = kSeen);

// Builds the mesh of a file's triangles, whose corners are counter-clockwise from outside.  Normals are those
// around a vertex, weighted by area.
TriangleMesh smooth_mesh(std::span<const Eigen::Vector3d> position, std::span<const Eigen::Vector3i> face);

// Returns the rigid placement of a mesh whose z axis is to point along `axis`.
Eigen::Matrix4f placed(const Eigen::Vector3f& center, const Eigen::Vector3f& axis);

// Meshes are refined for quantities that are computed vertex by vertex.

// Returns the same surface with no side longer than `longest` [m]: longer ones are halved in both their
// triangles alike, so that nothing gapes, until none is left.  Normals of new vertices lie between those of a
// side's ends. Error::invalid_input if `longest` is not positive.
TriangleMesh refined(TriangleMesh mesh, float longest);

}  // namespace hysteron::render
