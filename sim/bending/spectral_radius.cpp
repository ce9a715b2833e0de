#include "sim/bending/bending.h"
#include "sim/linear/power_iteration.h"

namespace hysteron {
namespace {

// Angles and their gradients at rest, and the map v -> M^-1 J^T C^T A C J v.
class RestBending {
 public:
  RestBending(const ClothMesh& mesh, const CurvatureOperator& op) : mesh_(mesh), op_(op) {
    for (int h = 0; h < mesh.interior_edges; ++h) {
      const auto [p0, p1, p2, p3] = rest_hinge(mesh, h);
      angle_.push_back(dihedral_angle<double>(p0, p1, p2, p3));
    }
    rate_.resize(angle_.size());
    moment_.resize(static_cast<std::size_t>(op.elements()) * op.dimension);
  }

  // w = J^T C^T A C J v
  void apply(const std::vector<Eigen::Vector3d>& v, std::vector<Eigen::Vector3d>& w) {
    const int d = op_.dimension;
    for (std::size_t h = 0; h < angle_.size(); ++h) {
      const Edge& e = mesh_.edge[h];
      const auto& a = angle_[h];
      rate_[h] = a.g0.dot(v[e.p0] - (1 - a.t0) * v[e.p2] - a.t0 * v[e.p3]) +
                 a.g1.dot(v[e.p1] - (1 - a.t1) * v[e.p2] - a.t1 * v[e.p3]);
    }
    std::fill(moment_.begin(), moment_.end(), 0);
    for (int i = 0; i < op_.elements(); ++i)
      for (int j = op_.hinge.start[i]; j < op_.hinge.start[i + 1]; ++j)
        for (int k = 0; k < d; ++k)
          moment_[i * d + k] += op_.area[i] * op_.coefficient[j * d + k] * rate_[op_.hinge.item[j]];
    std::fill(w.begin(), w.end(), Eigen::Vector3d::Zero());
    for (std::size_t h = 0; h < angle_.size(); ++h) {
      double torque = 0;
      for (int j = op_.element.start[h]; j < op_.element.start[h + 1]; ++j)
        for (int k = 0; k < d; ++k)
          torque += op_.transposed[j * d + k] * moment_[op_.element.item[j] * d + k];
      const Edge& e = mesh_.edge[h];
      const Eigen::Vector3d f0 = torque * angle_[h].g0, f1 = torque * angle_[h].g1;
      const Eigen::Vector3d f3 = angle_[h].t0 * f0 + angle_[h].t1 * f1;
      w[e.p0] += f0;
      w[e.p1] += f1;
      w[e.p3] -= f3;
      w[e.p2] -= f0 + f1 - f3;
    }
  }

 private:
  const ClothMesh& mesh_;
  const CurvatureOperator& op_;
  std::vector<Angle<double>> angle_;
  std::vector<double> rate_, moment_;
};

}  // namespace

double bending_spectral_radius(const ClothMesh& mesh, const CurvatureOperator& op, double stiffness,
                               const std::vector<double>& mass, const std::vector<char>& held) {
  RestBending bending(mesh, op);
  return stiffness * largest_eigenvalue(mass, held, [&](const auto& v, auto& w) { bending.apply(v, w); });
}

}  // namespace hysteron
