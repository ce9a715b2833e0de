// A cloth at rest: vertices, triangles, and all their properties that never change during a run.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "sim/base/enum_names.h"
#include "sim/mesh/length_unit.h"

namespace hysteron {

// An edge with its two triangles:
//
//              p0                     t  unit vector p2 -> p3
//             /  |                    n  in-plane unit normal of the edge, pointing to p0
//   face 0   / h0|                    h0, h1  heights of p0, p1 above the edge
//           / n^ |                    a0, a1  positions of p0, p1 along t, measured from p2
//      p2 -----> p3      t            L  length of the edge
//           \    |
//   face 1   \ h1|                    face 0 is (p2, p3, p0), face 1 is (p3, p2, p1), both counter-clockwise
//             \  |                    seen from the cloth's front side.
//              p1                     The angle is positive where the front side is concave (z = +x^2/2).
//
// On a boundary edge p1 = face1 = -1.
struct Edge {
  int p0, p1, p2, p3;
  int face0, face1;
  bool interior() const { return face1 >= 0; }
};

// Compressed rows: the entries of row i are item[start[i]] ... item[start[i+1]-1].
struct Adjacency {
  std::vector<int> start;
  std::vector<int> item;
};

// A face at rest [m], turned so that one of its edges leads from `from` to `to`, with `tip` opposite.
struct FaceSide {
  Eigen::Vector3d tip, from, to;
};

struct ClothMesh {
  std::vector<Eigen::Vector3d> rest;     // rest shape in space [m]; flat builders lie in z = 0
  std::vector<Eigen::Vector3i> face;     // counter-clockwise seen from the front
  std::vector<Eigen::Vector2d> pattern;  // texture coordinates per vertex; empty: none, or several on seams
  std::vector<std::array<Eigen::Vector2d, 3>> panel;  // on seams: those of the triangles' corners; else empty
  bool sewn = false;  // panels [m] are the cloth at rest, and `rest` is only where their seams hold them
  std::vector<double> bending_factor;  // per triangle: its bending moments over the fabric's; empty: 1
  Eigen::Vector3d warp_axis{1, 0, 0};  // warp direction in texture coordinates, or in space if there are none

  // These are filled in by build_topology().
  std::vector<Edge> edge;                     // interior edges first, then boundary edges
  int interior_edges = 0;                     // number of hinges
  std::vector<std::array<int, 3>> face_edge;  // face_edge[f][i] is the edge opposite to corner i of f
  Adjacency vertex_faces;                     // for each vertex 3*face + corner of its triangles
  std::vector<double> face_area;              // [m^2]
  std::vector<double> vertex_area;            // a third of the adjacent triangles' areas [m^2]

  int vertices() const { return static_cast<int>(rest.size()); }
  int faces() const { return static_cast<int>(face.size()); }
  // Returns the corners of face f at rest [m]: those of its panel, in z = 0, or in `rest`.
  std::array<Eigen::Vector3d, 3> corners(int f) const;
  // Returns face f at its edge e.
  FaceSide side(int f, int e) const;
  // Returns the length of an edge at rest [m]; along a seam the mean of its two sides.
  double edge_length(int e) const;
  // Return the mean length of the edges [m]: at rest, by edge_length(), and in `rest`, where seams hold a
  // sewn cloth.
  double mean_edge_length() const;
  double mean_edge_in_space() const;
  // Returns orthogonal warp and weft unit vectors of face f in its plane, relative to its corners at rest:
  // warp is the direction of warp_axis in texture coordinates, or, where there are none or they are
  // degenerate, warp_axis projected; weft = normal x warp.  A triangle that warp_axis pierces at a right
  // angle takes its first edge.
  std::array<Eigen::Vector3d, 2> face_axes(int f) const;
};

// Checks the mesh and fills the derived members.  `what` names the mesh in messages ("mesh shirt.obj").
// Throws Error::invalid_input for: no triangles, indices out of range, non-finite vertices, degenerate
// triangles (height/longest edge < 1e-6), an edge shared by more than two triangles, inconsistent
// orientation, vertices that no triangle uses, a triangle given twice, a pattern of another size than the
// vertices, panels of another number than the triangles.
void build_topology(ClothMesh& mesh, const std::string& what);

// The mesh families of the builders, on which the accuracy of a bending element depends:
//   aligned: squares cut by parallel diagonals; aligned-45: the same with the diagonals along x; flipped: the
//   other diagonal; unionjack: alternating diagonals; equilateral: rows of equilateral triangles; random:
//   jittered points, Delaunay triangulated.
enum class MeshFamily { aligned, aligned45, flipped, unionjack, equilateral, random };
constexpr std::array<const char*, 6> names(MeshFamily) {
  return {"aligned", "aligned-45", "flipped", "unionjack", "equilateral", "random"};
}
MeshFamily mesh_family(const std::string& name);  // Error::invalid_input for an unknown name

// Makes the rectangle [0, length] x [0, width] in z = 0 with about `triangles` triangles and warp along x.
// For structured families the cells are as square as the counts allow (equilateral: rows parallel to the
// length, closed by half triangles). random is seeded, with the same bits on every machine; its boundary
// vertices are evenly spaced, its angles mostly above 20 degrees.  Throws Error::invalid_input for lengths
// that are not positive and triangles outside 2 ... 10 million.
ClothMesh make_rectangle(double length, double width, int triangles, MeshFamily family, unsigned seed);
// Makes a rectangle of exactly nx x ny cells (aligned, flipped, unionjack) of 2 triangles each; equilateral
// and aligned-45 have ny (2 nx + 1) triangles, random 2 nx ny.
ClothMesh make_grid(double length, double width, int nx, int ny, MeshFamily family, unsigned seed);
// Makes a disc around the origin in z = 0; its outline is the polygon of the boundary vertices, all at
// `radius` and evenly spaced.  Inside, the structured families are their lattice, with axes along x and y, up
// to 0.8 of its spacing from the circle; a Delaunay triangulation joins it to the ring (angles above 28
// degrees from 50 triangles on).  The number of triangles is within 5 % or 8 of `triangles`.  Throws as
// make_rectangle() does.
ClothMesh make_disc(double radius, int triangles, MeshFamily family, unsigned seed);

// Makes a tube of this radius around the x axis from x = 0 to `length`, with warp along x and the front
// outside: the rectangle [0, length] x [0, 2 pi radius] sewn along its length at z = -radius.  Its vertices
// lie on the cylinder.  Throws as make_rectangle() does, and where the sides of the seam have different
// vertices.
ClothMesh make_tube(double length, double radius, int triangles, MeshFamily family, unsigned seed);

// Returns that many copies of the mesh, each `offset` [m] from the one before; vertices and triangles copy by
// copy.
ClothMesh copied_mesh(const ClothMesh& mesh, int copies, const Eigen::Vector3d& offset);

// Reads a Wavefront OBJ of triangles and quads (quads are cut along the shorter diagonal) in that unit.
// Texture coordinates, where every corner has one, become the pattern, or panels if they have seams. weld > 0
// merges each vertex into the first one closer than that distance [m].  Adds the warnings of mesh_warnings()
// (topology.h) to `warnings` unless it is null.  Throws Error::system for a file that cannot be read;
// Error::invalid_input, naming the file and the line, for malformed lines, numbers that are not finite, quads
// that cross themselves, and meshes that build_topology refuses.
ClothMesh read_obj(const std::string& file, double weld, LengthUnit unit = LengthUnit::metre,
                   std::vector<std::string>* warnings = nullptr);
// These write one frame, atomically (temporary name, then rename): position [m] per vertex, value (a
// curvature [1/m], or empty) per vertex as the property `curvature`.  OBJ has shortest exact decimals with
// its texture coordinates; PLY is binary little-endian, in doubles.  They throw Error::system.
void write_obj(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position);
void write_ply(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position,
               const std::vector<double>& value);

}  // namespace hysteron
