#include "sim/mesh/material_point.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace hysteron {
namespace {

constexpr double kSlack = 1e-9;  // [m]; rounding then leaves the cloth's edge on the cloth

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

struct FlatFace {
  std::array<Eigen::Vector2d, 3> corner;

  FlatFace(const ClothMesh& mesh, int f) {
    const std::array<Eigen::Vector3d, 3> at = mesh.corners(f);
    for (int k = 0; k < 3; ++k) corner[k] = at[k].head<2>();
  }
  double twice_area() const { return cross(corner[1] - corner[0], corner[2] - corner[0]); }
  Eigen::Vector3d weights(const Eigen::Vector2d& p) const {
    Eigen::Vector3d weight;
    for (int k = 0; k < 3; ++k)
      weight[k] = cross(corner[(k + 1) % 3] - p, corner[(k + 2) % 3] - p) / twice_area();
    return weight;
  }
  // Returns the distance from the edge opposite to corner k to a point of that weight, positive inside [m].
  double distance(int k, double weight) const {
    return weight * std::abs(twice_area()) / (corner[(k + 2) % 3] - corner[(k + 1) % 3]).norm();
  }
};

}  // namespace

Eigen::Vector3d MaterialPoint::among(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x) const {
  const Eigen::Vector3i& t = mesh.face[face];
  return weight[0] * x[t[0]] + weight[1] * x[t[1]] + weight[2] * x[t[2]];
}

bool is_flat(const ClothMesh& mesh) {
  for (int f = 0; f < mesh.faces(); ++f) {
    const std::array<Eigen::Vector3d, 3> at = mesh.corners(f);
    if (std::abs(at[1].z() - at[0].z()) > kSlack || std::abs(at[2].z() - at[0].z()) > kSlack) return false;
  }
  return true;
}

std::optional<MaterialPoint> material_point(const ClothMesh& mesh, const Eigen::Vector2d& at) {
  for (int f = 0; f < mesh.faces(); ++f) {
    const FlatFace face(mesh, f);
    const Eigen::Vector3d weight = face.weights(at);
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside = inside && face.distance(k, weight[k]) >= -kSlack;
    if (inside) return MaterialPoint{f, weight};
  }
  return {};
}

int nearest_hinge(const ClothMesh& mesh, const MaterialPoint& point) {
  const FlatFace face(mesh, point.face);
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int e = mesh.face_edge[point.face][k];
    const double distance = face.distance(k, point.weight[k]);
    if (e >= mesh.interior_edges || distance >= least) continue;
    nearest = e;
    least = distance;
  }
  return nearest;
}

}  // namespace hysteron
