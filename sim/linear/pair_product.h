// Applies the stiffness between pairs of layers in the rows of a product.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

// The stiffness acts between the closest points of a pair, which are weighted sums of its four vertices.
template <class Real>
struct PairStiffness {
  int v[4];
  Mat3<Real> block;  // between the closest points [N/m]
  Vec<Real, 4> weight;

  // Returns how far a displacement takes the closest points apart [m].
  template <class Vector>
  HYST_HD Vec3<Real> apart(const Vector& displacement) const {
    Vec3<Real> sum = Vec3<Real>::Zero();
    for (int k = 0; k < 4; ++k) sum += weight[k] * Vec3<Real>(displacement[v[k]]);
    return sum;
  }
};

// Every row finds the forces of its own pairs: each pair is computed four times, but no separate loop over
// pairs is needed, and few vertices touch.
template <class Real>
struct PairProduct {
  const int* start = nullptr;  // n + 1 row starts, one row per vertex; null: there are no layers
  const int* item = nullptr;   // 4 * pair + corner
  const PairStiffness<Real>* pair = nullptr;
  int count = 0;  // number of pairs

  // Returns the force on this vertex under a displacement of all vertices [N].
  template <class Vector>
  HYST_HD Vec3<Real> at(int vertex, const Vector& displacement) const {
    Vec3<Real> force = Vec3<Real>::Zero();
    for (int j = start[vertex]; j < start[vertex + 1]; ++j) {
      const PairStiffness<Real>& s = pair[item[j] / 4];
      force += s.weight[item[j] % 4] * (s.block * s.apart(displacement));
    }
    return force;
  }
};

}  // namespace hysteron
