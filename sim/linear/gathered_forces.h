// Forces of elements on their vertices, gathered in a fixed order.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

template <class Real>
struct GatheredForces {
  const int* start = nullptr;         // rows: vertices; null: no elements
  const int* item = nullptr;          // numbers of forces: 4 * element + corner
  const Vec3<Real>* force = nullptr;  // [N]
  HYST_HD Vec3<Real> at(int vertex) const {
    Vec3<Real> f = Vec3<Real>::Zero();
    for (int j = start[vertex]; j < start[vertex + 1]; ++j) f += force[item[j]];
    return f;
  }
};

}  // namespace hysteron
