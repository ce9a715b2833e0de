#include "sim/mesh/garment.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron {
namespace {

constexpr double kLargestStretch = 2;         // of all sides together; sewn cloth stretches by far less
constexpr double kImplausibleStretch = 1.15;  // of all sides, or along one texture coordinate over the other

bool is_mirrored(const ClothMesh& mesh, int f) {
  const auto at = mesh.corners(f);
  return (at[1] - at[0]).cross(at[2] - at[0]).z() < 0;
}

// Refuses folded rest shapes: flat cloth has one side up, and so has each panel.
void check_folds(const ClothMesh& mesh, const std::string& what) {
  for (int e = 0; e < mesh.interior_edges; ++e) {
    const Edge& edge = mesh.edge[e];
    if (is_seam(mesh, e) || is_mirrored(mesh, edge.face0) == is_mirrored(mesh, edge.face1)) continue;
    throw Error::invalid_input(what + ": triangle " + std::to_string(edge.face1 + 1) +
                               " is turned over in its texture coordinates against its neighbour " +
                               std::to_string(edge.face0 + 1) + ", where the cloth must be flat");
  }
}

// Returns the lengths of all triangles' sides together [m].
double length_of_sides(const ClothMesh& mesh) {
  double sum = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto at = mesh.corners(f);
    for (int k = 0; k < 3; ++k) sum += (at[(k + 1) % 3] - at[k]).norm();
  }
  return sum;
}

// Lists vertices as files count them: "1 2 12".
std::string vertex_list(const Eigen::Vector3i& face) {
  return std::to_string(face[0] + 1) + " " + std::to_string(face[1] + 1) + " " + std::to_string(face[2] + 1);
}

// Refuses other triangles: the vertices of `start` would then be others.
void check_triangles(const ClothMesh& start, const ClothMesh& rest, const std::string& what) {
  if (start.vertices() != rest.vertices() || start.faces() != rest.faces())
    throw Error::invalid_input(
        what + " has " + std::to_string(start.vertices()) + " vertices and " + std::to_string(start.faces()) +
        " triangles; where cloth starts it must have the same as at rest, " +
        std::to_string(rest.vertices()) + " and " + std::to_string(rest.faces()) + ", in the same order");
  for (int f = 0; f < rest.faces(); ++f)
    if (start.face[f] != rest.face[f])
      throw Error::invalid_input(
          what + ": its triangle " + std::to_string(f + 1) + " has the vertices " +
          vertex_list(start.face[f]) + " and at rest " + vertex_list(rest.face[f]) +
          "; where cloth starts all must be the same (a quad that is bent may be cut along its "
          "other diagonal: triangulate both files alike)");
}

void check_size(double stretch, const std::string& what) {
  if (stretch <= kLargestStretch && stretch >= 1 / kLargestStretch) return;
  std::ostringstream text;
  text.precision(3);
  text << what << ": where cloth starts, sides of its triangles are " << stretch
       << " times as long as at rest, which must be " << 1 / kLargestStretch << " to " << kLargestStretch
       << ": both files must be in cloth.unit, and their vertices in the same order";
  throw Error::invalid_input(text.str());
}

std::string scale_text(double stretch, double scale) {
  return "its triangles' sides are " + number_text(stretch, 3) +
         " times as long as in texture coordinates of " + number_text(scale) + " m a unit";
}

std::string fitting_scale(double stretch, double scale) {
  return "cloth.texture-scale = " + number_text(scale * stretch, 3) + " m makes them equal";
}

void check_scale(double stretch, double scale, const std::string& what) {
  if (stretch <= kLargestStretch && stretch >= 1 / kLargestStretch) return;
  throw Error::invalid_input(what + ": " + scale_text(stretch, scale) + ", which must be " +
                             number_text(1 / kLargestStretch) + " to " + number_text(kLargestStretch) + "; " +
                             fitting_scale(stretch, scale));
}

bool is_implausible(double stretch) {
  return stretch > kImplausibleStretch || stretch < 1 / kImplausibleStretch;
}

// Returns how much longer the worn cloth is along the texture's first coordinate than along its second, in
// the root mean square over the area.
double unevenness(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& worn) {
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto flat = mesh.corners(f);
    const Eigen::Vector3i& v = mesh.face[f];
    Eigen::Matrix2d texture;
    texture << (flat[1] - flat[0]).head<2>(), (flat[2] - flat[0]).head<2>();
    Eigen::Matrix<double, 3, 2> sides;
    sides << worn[v[1]] - worn[v[0]], worn[v[2]] - worn[v[0]];
    const Eigen::Matrix<double, 3, 2> stretch = sides * texture.inverse();
    squares += mesh.face_area[f] * stretch.colwise().squaredNorm().transpose().array();
  }
  return std::sqrt(squares[0] / squares[1]);
}

// Warns of a doubtful size; "" where there is none.
std::string size_warning(double uneven, double stretch, double scale) {
  if (is_implausible(uneven))
    return "where it starts, its triangles are " + number_text(uneven, 3) +
           " times as long along the first texture coordinate, compared with that along the second: where a "
           "program has scaled each of them to 0 to 1, multiply the first by " +
           number_text(uneven, 3);
  return is_implausible(stretch) ? scale_text(stretch, scale) + ": " + fitting_scale(stretch, scale) : "";
}

}  // namespace

bool is_seam(const ClothMesh& mesh, int edge) {
  if (mesh.panel.empty()) return false;
  const Edge& e = mesh.edge[edge];
  const auto panel_vertex = [&](int f, int vertex) {
    return mesh.panel[f][mesh.face[f][0] == vertex ? 0 : mesh.face[f][1] == vertex ? 1 : 2];
  };
  return panel_vertex(e.face0, e.p2) != panel_vertex(e.face1, e.p2) ||
         panel_vertex(e.face0, e.p3) != panel_vertex(e.face1, e.p3);
}

ClothMesh read_pattern(const std::string& file, double weld, double scale, LengthUnit unit,
                       std::vector<std::string>* warnings) {
  ClothMesh mesh = read_obj(file, weld, unit, warnings);
  const std::string what = "mesh " + file;
  if (mesh.pattern.empty() && mesh.panel.empty())
    throw Error::invalid_input(what + ": its texture coordinates are no flat cloth: corners have none");
  const std::vector<Eigen::Vector3d> worn = mesh.rest;
  const double sides = length_of_sides(mesh);
  for (Eigen::Vector2d& at : mesh.pattern) at *= scale;
  for (auto& corners : mesh.panel)
    for (Eigen::Vector2d& at : corners) at *= scale;
  mesh.sewn = !mesh.panel.empty();
  for (int v = 0; !mesh.sewn && v < mesh.vertices(); ++v) mesh.rest[v] << mesh.pattern[v], 0;
  build_topology(mesh, what + ", its texture coordinates");
  check_folds(mesh, what);
  const double stretch = sides / length_of_sides(mesh);
  check_scale(stretch, scale, what);
  const std::string warning = size_warning(unevenness(mesh, worn), stretch, scale);
  if (warnings && !warning.empty()) warnings->push_back(what + ": " + warning);
  return mesh;
}

std::vector<Eigen::Vector3d> read_start(const std::string& file, double weld, const ClothMesh& mesh,
                                        LengthUnit unit) {
  ClothMesh start = read_obj(file, weld, unit);
  const std::string what = "mesh " + file;
  check_triangles(start, mesh, what);
  check_size(length_of_sides(start) / length_of_sides(mesh), what);
  return std::move(start.rest);
}

}  // namespace hysteron
