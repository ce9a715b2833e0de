// The crease recovery specimen of ISO 2313 and AATCC 66: folded by a hand, loaded by a plate, let go.
#pragma once

#include "experiments/experiments.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct CreaseChoice {
  double force = 10;    // of the plate [N] (ISO 2313)
  double hold = 0.2;    // under the whole load [s]
  double recovery = 1;  // time to recover [s]
};

// When things happen [s].
struct CreaseTimes {
  double folded, pressed, released, end;
};

struct Crease {
  Scene scene;
  Cloth cloth;
  CreaseTimes times;

  // Force of the plate on the cloth at these positions [N].
  double plate_force(const std::vector<Eigen::Vector3d>& x, double time) const;
  // Angle between the limbs: 0 folded flat, 180 straight [degree].
  double opening(const std::vector<Eigen::Vector3d>& x) const;
  // What the law alone makes of it: the opening if each triangle had only been bent along the strip to its
  // `largest` curvature [1/m] and let go [degree].
  double opening_of_law(const std::vector<double>& largest) const;
};

// A specimen of scene.cloth.length by scene.cloth.width whose elements are at most a thickness long across
// the crease, which is in its middle.  Its near limb is clamped on a plane; a hand takes the end of the far
// limb over by half a turn, then a plate presses both down to `plate` above the plane [m] at its underside,
// stays, and goes.  No gravity, as the standards turn its moment away.
Crease creased(const Scene& scene, const CreaseChoice& choice, double plate);

// Height of the plate's underside at which it first bears the force: found by pressing until it does [m].
double loaded_plate(const Scene& scene, const CreaseChoice& choice);

}  // namespace hysteron::experiments
