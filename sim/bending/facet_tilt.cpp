#include "sim/bending/facet_tilt.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace hysteron {

FacetTilt::FacetTilt(const ClothMesh& mesh)
    : shape_(make_shape_operator(mesh, std::vector<char>(mesh.vertices()))) {
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto corner = mesh.corners(f);
    const auto [warp, weft] = mesh.face_axes(f);
    auto& side = side_.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d e = corner[(k + 1) % 3] - corner[k];
      side[k] = {e.dot(warp), e.dot(weft)};
    }
  }
}

std::vector<double> FacetTilt::tilts(const std::vector<double>& bent) const {
  std::vector<double> result(side_.size());
  for (std::size_t f = 0; f < side_.size(); ++f) {
    Eigen::Vector3d s = Eigen::Vector3d::Zero();
    for (int j = shape_.hinge.start[f]; j < shape_.hinge.start[f + 1]; ++j) {
      s += bent[shape_.hinge.item[j]] *
           Eigen::Vector3d::Map(&shape_.coefficient[3 * static_cast<std::size_t>(j)]);
    }
    Eigen::Matrix2d tensor;
    tensor << s[0], s[2] / std::sqrt(2.0), s[2] / std::sqrt(2.0), s[1];
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal;
    principal.computeDirect(tensor);
    const Eigen::Vector2d curvature = principal.eigenvalues();
    const int larger = std::abs(curvature[0]) > std::abs(curvature[1]) ? 0 : 1;
    double product = curvature[larger];
    for (const Eigen::Vector2d& e : side_[f]) product *= principal.eigenvectors().col(larger).dot(e);
    const double doubled_area =
        std::abs(side_[f][0].x() * side_[f][1].y() - side_[f][0].y() * side_[f][1].x());
    result[f] = std::abs(product) / (2 * doubled_area);
  }
  return result;
}

}  // namespace hysteron
