// What contact of vertices and of triangles with obstacles have in common.
#pragma once

#include "sim/contact/compression.h"

namespace hysteron {

template <class Real>
struct ContactModel {
  ObstacleShell<Real> shell;
  Real slip;        // elastic slip of friction [m]
  Real tangential;  // most of its stiffness [N/m^3]

  // Stiffness of friction's stop [N/m].
  HYST_HD Real stop_stiffness(Real limit, Real area) const {
    const Real most = tangential * area;
    return limit < most * slip ? limit / slip : most;
  }
};

struct ContactLoss {
  double friction = 0;       // dissipated [J]
  double obstacle_work = 0;  // done on the cloth by moving obstacles [J]
};

}  // namespace hysteron
