#include "sim/bending/bending_elements.h"

#include <algorithm>

namespace hysteron {

template <class Real>
BendingElements<Real>::BendingElements(const Bending<Real, Cpu>& bending) : bending_(bending) {
  const BendingFactors<Real> factors = bending.factors();
  vertex_.start.push_back(0);
  for (int e = 0; e < factors.elements; ++e) {
    std::vector<int> vertices;
    for (int j = factors.start[e]; j < factors.start[e + 1]; ++j) {
      std::array<int, 4> corner;
      for (int k = 0; k < 4; ++k) {
        const int v = factors.corner[factors.hinge[j]][k];
        corner[k] = static_cast<int>(std::find(vertices.begin(), vertices.end(), v) - vertices.begin());
        if (corner[k] == static_cast<int>(vertices.size())) vertices.push_back(v);
      }
      corner_.push_back(corner);
    }
    vertex_.item.insert(vertex_.item.end(), vertices.begin(), vertices.end());
    vertex_.start.push_back(static_cast<int>(vertex_.item.size()));
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
