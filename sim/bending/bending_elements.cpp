#include "sim/bending/bending_elements.h"

#include <algorithm>

namespace hysteron {

Adjacency vertices_of_elements(int elements, const int* start, const int* hinge,
                               const Eigen::Vector4i* corner) {
  Adjacency vertices;
  vertices.start.push_back(0);
  for (int e = 0; e < elements; ++e) {
    const auto first = vertices.item.size();
    for (int j = start[e]; j < start[e + 1]; ++j)
      for (const int v : corner[hinge[j]])
        if (std::find(vertices.item.begin() + first, vertices.item.end(), v) == vertices.item.end())
          vertices.item.push_back(v);
    vertices.start.push_back(static_cast<int>(vertices.item.size()));
  }
  return vertices;
}

template <class Real>
BendingElements<Real>::BendingElements(const Bending<Real, Cpu>& bending) : bending_(bending) {
  const BendingFactors<Real> factors = bending.factors();
  vertex_ = vertices_of_elements(factors.elements, factors.start, factors.hinge, factors.corner);
  for (int e = 0; e < factors.elements; ++e) {
    const auto first = vertex_.item.begin() + vertex_.start[e];
    for (int j = factors.start[e]; j < factors.start[e + 1]; ++j) {
      std::array<int, 4> corner;
      for (int k = 0; k < 4; ++k)
        corner[k] = static_cast<int>(
            std::find(first, vertex_.item.end(), factors.corner[factors.hinge[j]][k]) - first);
      corner_.push_back(corner);
    }
  }
}

template <class Real>
void BendingElements<Real>::linearised(int element, Rates& rates, Eigen::Matrix3d& stiffness) const {
  const BendingFactors<Real> factors = bending_.factors();
  const int d = factors.dimension;
  rates.setZero();
  for (int j = factors.start[element]; j < factors.start[element + 1]; ++j) {
    const Real* gradient = factors.gradient + 8 * static_cast<std::size_t>(factors.hinge[j]);
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    for (int k = 0; k < d; ++k) c[k] = static_cast<double>(factors.coefficient[j * d + k]);
    for (int k = 0; k < 4; ++k)
      rates.middleCols<3>(3 * corner_[j][k]) +=
          c * angle_gradient(gradient, k).template cast<double>().transpose();
  }
  stiffness.setZero();
  const Real* tangent = factors.tangent + static_cast<std::size_t>(element) * (d * (d + 1) / 2);
  for (int a = 0; a < d; ++a)
    for (int b = 0; b <= a; ++b) stiffness(a, b) = stiffness(b, a) = static_cast<double>(*tangent++);
}

template class BendingElements<double>;
template class BendingElements<float>;

}  // namespace hysteron
