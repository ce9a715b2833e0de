// The `shape` element has one curvature tensor per face, which is exact for uniform curvature on every mesh.
//
// For vertices on z = x^T H x / 2 the angle of a hinge is linear in H = (H_xx, H_yy, sqrt2 H_xy):
//   theta_e = R_e H = h H_nn + (a0 - a1) H_nt - [a0 (L-a0)/h0 + a1 (L-a1)/h1]/2 H_tt,   h = (h0 + h1)/2,
// so theta/h alone is not the normal curvature.  Half an angle plus a correction s psi (s = +1 in the edge's
// first face, -1 in the second) belongs to each of the two faces:
//   S_f = sum over the edges e of f of (theta_e/2 + s psi_e) (L_e/A_f) nu(n_e),   nu(n) = (n_x^2, n_y^2,
//   sqrt2 n_x n_y),
// and psi_e = p_e H with H fitted by least squares to the angles of the two faces' hinges, so that uniform H
// gives S = H.  Free edges carry no moment across them: S is projected off nu of each free edge.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/bending/curvature_operator.h"

namespace hysteron {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Row = Eigen::RowVector3d;

// Below this ratio of singular values the fit of H takes one more ring of hinges.
constexpr double kWellPosed = 0.15;
// Directions that no hinge of the whole stencil sees (tiny meshes) are left out of the fit: squared singular
// value over the largest one.
constexpr double kRankTolerance = 1e-12;
constexpr int kLargestRing = 4;

Row nu(const Vector2d& n) { return {n.x() * n.x(), n.y() * n.y(), std::sqrt(2.0) * n.x() * n.y()}; }
Row mixed(const Vector2d& n, const Vector2d& t) {  // the row that maps H to n^T H t
  return {n.x() * t.x(), n.y() * t.y(), (n.x() * t.y() + n.y() * t.x()) / std::sqrt(2.0)};
}

// A patch of faces unfolded into one plane, keyed by face: positions of its three corners.
using Patch = std::map<int, std::array<Vector2d, 3>>;

int corner_index(const ClothMesh& mesh, int face, int vertex) {
  for (int k = 0; k < 3; ++k)
    if (mesh.face[face][k] == vertex) return k;
  return -1;
}

std::array<Vector2d, 3> flat_face(const ClothMesh& mesh, int f) {
  const auto axes = mesh.face_axes(f);
  const auto at = mesh.corners(f);
  std::array<Vector2d, 3> corner;
  for (int k = 0; k < 3; ++k) {
    const Vector3d d = at[k] - at[0];
    corner[k] = {d.dot(axes[0]), d.dot(axes[1])};
  }
  return corner;
}

// Unfolds `to`, the neighbour of `from` across edge e, into the plane of the patch.  The sides of a seam may
// differ in length: their middles meet.
void unfold(const ClothMesh& mesh, const Edge& e, int from, int to, Patch& patch) {
  const auto& placed = patch.at(from);
  std::array<Vector2d, 3> corner = flat_face(mesh, to);
  const int t2 = corner_index(mesh, to, e.p2), t3 = corner_index(mesh, to, e.p3);
  const Vector2d a = placed[corner_index(mesh, from, e.p2)], b = placed[corner_index(mesh, from, e.p3)];
  const Vector2d u = (corner[t3] - corner[t2]).normalized(), w = (b - a).normalized();
  Eigen::Matrix2d rotation;
  const double c = u.dot(w), s = u.x() * w.y() - u.y() * w.x();
  rotation << c, -s, s, c;
  const Vector2d origin = corner[t2];
  const double ease = mesh.sewn ? ((b - a).norm() - (corner[t3] - origin).norm()) / 2 : 0;
  for (Vector2d& p : corner) p = a + rotation * (p - origin) + ease * w;
  patch[to] = corner;
}

struct FlatHinge {
  Vector2d n, t;
  double length, height;  // L, (h0 + h1)/2
  Row angle;              // R_e
};

FlatHinge flat_hinge(const ClothMesh& mesh, const Edge& e, const Patch& patch) {
  const auto& f0 = patch.at(e.face0);
  const auto& f1 = patch.at(e.face1);
  const Vector2d p2 = f0[corner_index(mesh, e.face0, e.p2)], p3 = f0[corner_index(mesh, e.face0, e.p3)];
  const Vector2d u0 = f0[corner_index(mesh, e.face0, e.p0)] - p2;
  const Vector2d u1 = f1[corner_index(mesh, e.face1, e.p1)] - p2;
  FlatHinge h;
  h.length = (p3 - p2).norm();
  h.t = (p3 - p2) / h.length;
  h.n = {-h.t.y(), h.t.x()};  // left of t: p0 lies there because face 0 is counter-clockwise
  const double h0 = u0.dot(h.n), h1 = -u1.dot(h.n), a0 = u0.dot(h.t), a1 = u1.dot(h.t), l = h.length;
  h.height = (h0 + h1) / 2;
  h.angle = h.height * nu(h.n) + (a0 - a1) * mixed(h.n, h.t) -
            0.5 * (a0 * (l - a0) / h0 + a1 * (l - a1) / h1) * nu(h.t);
  return h;
}

// Returns row c of (V^T)^-1 that belongs to edge e in face f: the share of H that this edge contributes to S.
Row edge_share(const ClothMesh& mesh, int e, int f, const Patch& patch) {
  const auto& corner = patch.at(f);
  Eigen::Matrix3d v;
  int row = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector2d d = (corner[(k + 2) % 3] - corner[(k + 1) % 3]).normalized();
    v.row(k) = nu({-d.y(), d.x()});
    if (mesh.face_edge[f][k] == e) row = k;
  }
  return v.transpose().inverse().row(row);
}

void add_hinges(const ClothMesh& mesh, int f, std::vector<int>& hinges) {
  for (int e : mesh.face_edge[f])
    if (e < mesh.interior_edges && std::find(hinges.begin(), hinges.end(), e) == hinges.end())
      hinges.push_back(e);
}

// Returns the hinges of the two faces at e, unfolded; each `ring` adds the hinges of the neighbouring faces.
std::vector<int> stencil(const ClothMesh& mesh, int e, int rings, Patch& patch) {
  const Edge& edge = mesh.edge[e];
  patch[edge.face0] = flat_face(mesh, edge.face0);
  unfold(mesh, edge, edge.face0, edge.face1, patch);
  std::vector<int> hinges;
  for (int ring = 0; ring <= rings; ++ring) {
    std::vector<int> faces;
    for (const auto& [f, corner] : patch) faces.push_back(f);
    for (int f : faces) add_hinges(mesh, f, hinges);
    for (int h : std::vector<int>(hinges)) {  // every stencil hinge needs both its faces in the plane
      const Edge& other = mesh.edge[h];
      if (!patch.count(other.face1)) unfold(mesh, other, other.face0, other.face1, patch);
      if (!patch.count(other.face0)) unfold(mesh, other, other.face1, other.face0, patch);
    }
  }
  return hinges;
}

// Returns psi_e as a combination of the stencil's angles: hinge -> coefficient [-].
std::map<int, double> correction(const ClothMesh& mesh, int e) {
  for (int rings = 0;; ++rings) {
    Patch patch;
    const std::vector<int> hinges = stencil(mesh, e, rings, patch);
    Eigen::MatrixX3d rows(hinges.size(), 3);
    Eigen::VectorXd inverse_height(hinges.size());
    for (std::size_t i = 0; i < hinges.size(); ++i) {
      const FlatHinge h = flat_hinge(mesh, mesh.edge[hinges[i]], patch);
      inverse_height[i] = 1 / h.height;
      rows.row(i) = h.angle * inverse_height[i];
    }
    // pinv(rows) follows from the eigenvectors of rows^T rows; its eigenvalues are the squared singular
    // values, ascending.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> normal(rows.transpose() * rows);
    Vector3d inverse = normal.eigenvalues();
    const double largest = inverse[2];
    if (inverse[0] < kWellPosed * kWellPosed * largest && rings < kLargestRing) continue;
    for (double& s : inverse) s = s > kRankTolerance * largest ? 1 / s : 0;
    const Eigen::Matrix3Xd pinv =
        normal.eigenvectors() * inverse.asDiagonal() * normal.eigenvectors().transpose() * rows.transpose();
    const FlatHinge own = flat_hinge(mesh, mesh.edge[e], patch);
    const int f = mesh.edge[e].face0;
    const Row p = mesh.face_area[f] / own.length * edge_share(mesh, e, f, patch) - 0.5 * own.angle;
    const Eigen::RowVectorXd l = p * pinv * inverse_height.asDiagonal();
    std::map<int, double> psi;
    for (std::size_t i = 0; i < hinges.size(); ++i)
      if (std::abs(l[i]) > 1e-14) psi[hinges[i]] = l[i];
    return psi;
  }
}

// Returns I - B^+ B with rows nu of the face's free edges: a free edge carries no moment about itself.
Eigen::Matrix3d free_edge_projection(const ClothMesh& mesh, int f, const std::vector<char>& held) {
  const auto corner = flat_face(mesh, f);
  Eigen::MatrixX3d b(0, 3);
  for (int k = 0; k < 3; ++k) {
    const Edge& e = mesh.edge[mesh.face_edge[f][k]];
    if (e.interior() || (held[e.p2] && held[e.p3])) continue;
    const Vector2d d = (corner[(k + 2) % 3] - corner[(k + 1) % 3]).normalized();
    b.conservativeResize(b.rows() + 1, 3);
    b.row(b.rows() - 1) = nu({-d.y(), d.x()});
  }
  if (b.rows() == 0) return Eigen::Matrix3d::Identity();
  return Eigen::Matrix3d::Identity() - b.transpose() * (b * b.transpose()).inverse() * b;
}

}  // namespace

CurvatureOperator make_shape_operator(const ClothMesh& mesh, const std::vector<char>& held) {
  CurvatureOperator op;
  op.dimension = 3;
  op.area = mesh.face_area;
  op.rest_angle = rest_angles(mesh);
  std::vector<std::map<int, double>> psi(mesh.interior_edges);
#pragma omp parallel for schedule(dynamic, 64)
  for (int e = 0; e < mesh.interior_edges; ++e) psi[e] = correction(mesh, e);
  op.hinge.start.push_back(0);
  for (int f = 0; f < mesh.faces(); ++f) {
    const auto corner = flat_face(mesh, f);
    std::map<int, Vector3d> row;
    for (int k = 0; k < 3; ++k) {
      const int e = mesh.face_edge[f][k];
      if (e >= mesh.interior_edges) continue;
      const Vector2d d = corner[(k + 2) % 3] - corner[(k + 1) % 3];
      const Vector2d t = d.normalized();
      const Vector3d weight = d.norm() / mesh.face_area[f] * nu({-t.y(), t.x()}).transpose();
      const double side = mesh.edge[e].face0 == f ? 1 : -1;
      row.try_emplace(e, Vector3d::Zero()).first->second += 0.5 * weight;
      for (const auto& [hinge, c] : psi[e])
        row.try_emplace(hinge, Vector3d::Zero()).first->second += side * c * weight;
    }
    const Eigen::Matrix3d project = free_edge_projection(mesh, f, held);
    for (const auto& [hinge, c] : row) {
      const Vector3d projected = project * c;
      op.hinge.item.push_back(hinge);
      for (int k = 0; k < 3; ++k) op.coefficient.push_back(projected[k]);
    }
    op.hinge.start.push_back(static_cast<int>(op.hinge.item.size()));
  }
  transpose_rows(op, mesh.interior_edges);
  return op;
}

}  // namespace hysteron
