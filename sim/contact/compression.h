// Models how cloth yields to pressure, between layers and against obstacles alike.
//
// It has one number: at the pressure of the KES compression test, 50 gf/cm^2 = 4.9 kPa (Kawabata 1980), a
// barrier is compressed by a fifth of the thickness; this softness is assumed, the same for all fabrics.
#pragma once

#include "sim/contact/barrier.h"
#include "sim/scene/scene.h"

namespace hysteron {

inline constexpr double kTestPressure = 50 * 98.0665;  // 50 gf/cm^2 [Pa]
inline constexpr double kHardest = 0.5;     // share of the activation distance to which pressure can compress
inline constexpr double kCompressed = 0.2;  // share of it by which the test's pressure compresses
inline constexpr double kCrushed = 0.4;     // share of the thickness where an obstacle's last barrier begins
inline constexpr double kLastGap = 0.01;    // share of its range below which its stiffness is constant
inline constexpr double kYieldPressure = 130 * kTestPressure;  // pressure at which solids yield [Pa]
inline constexpr double kElasticSlip = 0.01;                   // slip of friction over the thickness

// Returns the stiffness k [N/m^3] of the barrier of an activation distance, the thickness [m].
double barrier_stiffness(double thickness);

// The response of an obstacle to cloth within the activation distance is a barrier up to the compression that
// was measured; beyond, its stiffness stays.  Where it is crushed to kCrushed, under some five times the
// test's pressure, a last barrier begins, which ends at the surface of the solid: the pressure on single
// vertices, such as the tips of folds, grows with the mesh.  Steps that do not end in equilibrium, as
// explicit ones, have no last barrier: a blow would end in it beyond the stiffness that they bear.  Under
// kYieldPressure, next to the surface, the solid yields: from there on it is no stiffer than the compression
// that was measured, so that solids which close on cloth pinch it and go on.
template <class Real>
struct ObstacleResponse {
  Real thickness;  // of the cloth, the activation distance [m]
  Real k;          // of the barrier [N/m^3]
  Real last;       // distance at which the last barrier begins [m]; 0: none
  Real yield;      // distance below which the solid yields [m]

  HYST_HD Barrier<Real> at(Real distance) const {
    if (!(distance < yield && last > 0)) return elastic(distance);
    const Barrier<Real> b = elastic(yield);
    const Real deeper = distance - yield, stiffness = stiffest();
    return {b.energy + deeper * (b.slope + deeper * stiffness / 2), b.slope + deeper * stiffness, stiffness};
  }
  // Returns the stiffness of the cloth beyond the compression that was measured [N/m^3].
  HYST_HD Real stiffest() const { return measured(0).stiffness; }

 private:
  HYST_HD Barrier<Real> elastic(Real distance) const {
    const Barrier<Real> cloth = measured(distance);
    if (!(last > 0 && distance < last)) return cloth;
    return cloth + barrier(k, distance, last, static_cast<Real>(kLastGap));
  }
  HYST_HD Barrier<Real> measured(Real distance) const {
    // Share of the range left at the test's pressure.
    constexpr double kMeasured = (1 - kHardest - kCompressed) / (1 - kHardest);
    const Real hardest = static_cast<Real>(kHardest) * thickness;
    return barrier(k, distance - hardest, thickness - hardest, static_cast<Real>(kMeasured));
  }
};

// Returns the response of a scene's obstacles: `contact-stiffness` is its stiffness at the compression of the
// test.
ObstacleResponse<double> obstacle_response(const Scene& scene);
// Returns the distance [m] at which obstacles answer with a pressure [Pa] that they do not yield to.
double distance_under(const ObstacleResponse<double>& response, double pressure);

// The common model of contact with obstacles for vertices and triangles.
template <class Real>
struct ContactModel {
  ObstacleResponse<Real> response;
  Real slip;        // elastic slip of friction [m]
  Real tangential;  // bound on the stiffness of friction [N/m^3]

  // Returns the stiffness of friction's stop [N/m].
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
