// The KES-FB1 tests on a specimen of cloth between two clamps: one equilibrium per row, no weight of its own.
#pragma once

#include <string>

#include "sim/reference/kes_in_plane.h"

namespace hysteron::experiments {

inline constexpr double kInPlaneGauge = 0.05, kInPlaneWidth = 0.2;  // of the tester's specimen [m]

struct InPlaneSpecimen {
  std::string mesh = "aligned";
  int triangles = 2000;  // about
  int steps = 16;        // equilibria from zero to the largest: a multiple of 16 reads shear where they are
};

// Clamps lead along the way that uniform strain takes; what the free edges change, their forces show.  The
// cloth stays in its plane, which it does not leave without a disturbance.
template <class Test>
struct InPlaneCloth {
  Test test;           // its rows and readings, of the specimen
  double tension = 0;  // per width, mean over the rows of shear [N/m]
  int triangles = 0;
  double seconds = 0;  // wall clock
};

// `along`: the direction from clamp to clamp.  Throws Error::simulation where no equilibrium is found.
InPlaneCloth<ShearTest> shear_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                    InPlaneProtocol protocol);
InPlaneCloth<TensionTest> stretch_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                        InPlaneProtocol protocol);

}  // namespace hysteron::experiments
