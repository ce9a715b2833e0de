#include "sim/bending/curvature_operator.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/angle.h"
#include "sim/bending/bending.h"
#include "sim/linear/power_iteration.h"

namespace hysteron {

std::vector<double> hinge_angles(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position) {
  std::vector<double> angles(mesh.interior_edges);
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    angles[i] = dihedral_angle<double>(position[e.p0], position[e.p1], position[e.p2], position[e.p3]).theta;
  }
  return angles;
}

std::array<Eigen::Vector3d, 4> rest_hinge(const ClothMesh& mesh, int hinge) {
  const Edge& e = mesh.edge[hinge];
  if (!mesh.sewn) return {mesh.rest[e.p0], mesh.rest[e.p1], mesh.rest[e.p2], mesh.rest[e.p3]};
  // Returns where the corner opposite to the edge lies: along the edge, from its middle, and above it.
  const auto tip = [&](int f) {
    const auto [corner, from, to] = mesh.side(f, hinge);
    const double length = (to - from).norm();
    return Eigen::Vector2d((corner - (from + to) / 2).dot(to - from) / length,
                           2 * mesh.face_area[f] / length);
  };
  const Eigen::Vector2d first = tip(e.face0), second = tip(e.face1);
  const double half = mesh.edge_length(hinge) / 2;
  return {Eigen::Vector3d(first.x(), first.y(), 0), Eigen::Vector3d(-second.x(), -second.y(), 0),
          Eigen::Vector3d(-half, 0, 0), Eigen::Vector3d(half, 0, 0)};
}

std::vector<double> rest_angles(const ClothMesh& mesh) {
  std::vector<double> angles(mesh.interior_edges);
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const auto [p0, p1, p2, p3] = rest_hinge(mesh, i);
    angles[i] = dihedral_angle<double>(p0, p1, p2, p3).theta;
  }
  return angles;
}

void transpose_rows(CurvatureOperator& op, int hinges) {
  const int d = op.dimension, items = static_cast<int>(op.hinge.item.size());
  op.element.start.assign(hinges + 1, 0);
  for (int hinge : op.hinge.item) ++op.element.start[hinge + 1];
  for (int h = 0; h < hinges; ++h) op.element.start[h + 1] += op.element.start[h];
  op.element.item.resize(items);
  op.transposed.resize(static_cast<std::size_t>(items) * d);
  std::vector<int> next(op.element.start.begin(), op.element.start.end() - 1);
  for (int i = 0; i < op.elements(); ++i)
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j) {
      const int to = next[op.hinge.item[j]]++;
      op.element.item[to] = i;
      for (int k = 0; k < d; ++k) op.transposed[to * d + k] = op.coefficient[j * d + k];
    }
}

CurvatureOperator make_hinge_operator(const ClothMesh& mesh) {
  CurvatureOperator op;
  op.dimension = 1;
  op.rest_angle = rest_angles(mesh);
  op.hinge.start.push_back(0);
  for (int i = 0; i < mesh.interior_edges; ++i) {
    const Edge& e = mesh.edge[i];
    const double length = mesh.edge_length(i);
    const double height = (mesh.face_area[e.face0] + mesh.face_area[e.face1]) / length;  // (h0 + h1)/2
    op.area.push_back(length * height);
    op.coefficient.push_back(1 / height);
    op.hinge.item.push_back(i);
    op.hinge.start.push_back(i + 1);
  }
  transpose_rows(op, mesh.interior_edges);
  return op;
}

namespace {

constexpr double kOnAxis = 1e-12;  // smaller components of a direction are rounding

// Returns the diagonal of Q over the rigidity along warp.
Eigen::Vector3d rigidities(double weft, double bias) {
  return {1, weft, std::max(0.0, 2 * bias - (1 + weft) / 2)};
}

// Returns nu of a bend across interior edge i, in the frame of its first face.
Eigen::Vector3d across(const ClothMesh& mesh, int i) {
  const int f = mesh.edge[i].face0;
  const auto axes = mesh.face_axes(f);
  const FaceSide side = mesh.side(f, i);
  const Eigen::Vector3d along = (side.to - side.from).normalized();
  const double x = along.dot(axes[1]), y = along.dot(axes[0]);  // the edge's normal, up to signs
  return {x * x, y * y, std::sqrt(2.0) * x * y};
}

// Returns the factors of the D components of element i, with Q as in the header.
Eigen::Vector3d component_factors(const CurvatureOperator& op, const ClothMesh& mesh, int i,
                                  const Eigen::Vector3d& q) {
  if (op.dimension == 3) return q.cwiseSqrt();
  const Eigen::Vector3d nu = across(mesh, i);
  return {std::sqrt(nu.dot(q.cwiseProduct(nu))), 0, 0};
}

}  // namespace

double strip_rigidity(double weft, double bias, double angle) {
  const Eigen::Vector3d q = rigidities(weft, bias);
  const double x = std::cos(angle), y = std::sin(angle);
  const Eigen::Vector3d nu(x * x, y * y, std::sqrt(2.0) * x * y);
  double compliance = 0;
  for (int k = 0; k < 3; ++k)
    if (std::abs(nu[k]) > kOnAxis) compliance += nu[k] * nu[k] / q[k];
  return 1 / compliance;
}

void stiffen(CurvatureOperator& op, const ClothMesh& mesh, double weft, double bias) {
  const Eigen::Vector3d q = rigidities(weft, bias);
  const int d = op.dimension;
  op.metric.clear();
  for (int i = 0; i < op.elements(); ++i) {
    const Eigen::Vector3d factor = component_factors(op, mesh, i, q);
    op.metric.insert(op.metric.end(), factor.data(), factor.data() + d);
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j)
      for (int k = 0; k < d; ++k) op.coefficient[j * d + k] *= factor[k];
  }
  transpose_rows(op, mesh.interior_edges);
}

void set_rigidity(CurvatureOperator& op, const ClothMesh& mesh, double b2, DirectionRatios rigidity,
                  DirectionRatios friction) {
  const Eigen::Vector3d q = rigidities(rigidity.weft, rigidity.bias),
                        own = rigidities(friction.weft, friction.bias);
  op.elastic.clear();
  for (int i = 0; i < op.elements(); ++i) {
    const Eigen::Vector3d root = component_factors(op, mesh, i, q), law = component_factors(op, mesh, i, own);
    for (int k = 0; k < op.dimension; ++k)
      op.elastic.push_back(law[k] > 0 ? b2 * (root[k] * root[k] / (law[k] * law[k]) - 1) : 0);
  }
}

void set_directions(CurvatureOperator& op, const ClothMesh& mesh, double weft, double bias) {
  const Eigen::Vector3d q = rigidities(weft, bias);
  op.direction.clear();
  for (int i = 0; i < op.elements(); ++i) {
    const Eigen::Vector3d nu = across(mesh, i), squares = q.cwiseProduct(nu.cwiseAbs2());
    for (int k = 0; k < 2; ++k) op.direction.push_back(squares[k] / squares.sum());
  }
}

CurvatureOperator make_curvature_operator(BendingElement element, const ClothMesh& mesh,
                                          const std::vector<char>& held) {
  CurvatureOperator op =
      element == BendingElement::hinge ? make_hinge_operator(mesh) : make_shape_operator(mesh, held);
  if (mesh.bending_factor.empty()) return op;
  const std::vector<double>& factor = mesh.bending_factor;
  for (int i = 0; i < op.elements(); ++i) {
    if (element == BendingElement::hinge) {
      op.area[i] *= (factor[mesh.edge[i].face0] + factor[mesh.edge[i].face1]) / 2;
    } else {
      op.area[i] *= factor[i];
    }
  }
  return op;
}

namespace {

// Holds angles and their gradients at rest, and applies v -> M^-1 J^T C^T A C J v.
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

  // Sets w = J^T C^T A C J v.
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
