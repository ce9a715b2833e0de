// The disc of cloth that is draped, as it lies before the test.
#pragma once

#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct Specimen {
  double radius;                       // [m]
  Eigen::Vector3d middle = {0, 0, 0};  // [m]
};

// Measured where the cloth starts; that of a cloth that is built is its scene's.  Throws Error::invalid_input
// unless it is a disc that lies flat.
Specimen disc_specimen(const Scene& scene, const Cloth& cloth);

}  // namespace hysteron::experiments
