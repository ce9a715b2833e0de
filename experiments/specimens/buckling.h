// A strip clamped at one end that buckles under its own weight: its threshold from a Southwell plot, and the
// reference from beam theory.
#pragma once

#include <array>
#include <vector>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// An upright strip stands on its clamp and falls over (Greenhill 1881).  One on edge is clamped level, its
// width vertical, and turns over sideways (Prandtl 1899).
enum class Buckling { upright, edge };
constexpr std::array<const char*, 2> names(Buckling) { return {"upright", "edge"}; }

// Returns the heaviness Gamma, weight per area times L^3/b2, at which a strip of this law and fabric buckles
// that is narrow, b << L, and bends far more easily out of its plane than in it.  Its bending rigidity is EI
// = B b and its torsional one GJ = 2 B b (W = B |S|^2/2 with a twist S_xy alone), B the law's slope at rest.
// A fabric that bends differently along warp, weft and bias has EI = q B b, q = rigidity_along(), and GJ = (4
// bias - 1 - weft) B b for a strip along warp or weft.  Between them strips twist as they bend; on edge they
// are refused (Error::invalid_input), as are strips on edge whose slope to the back differs from that to the
// face.  An upright strip buckles to its softer side, whose slope is then B.
//   upright: weight L^3/B = 7.8373 (Timoshenko & Gere 1961, 2.12)
//   edge: q L^3/sqrt(EI GJ) = 12.8538 with q = weight b (the same, 6.3)
double reference_gamma(Buckling kind, const Scene& scene);

// Returns the relative increase of the reference by the width b.  On edge the clamp keeps the strip from
// warping: a length of sqrt(EI b^2/(12 GJ)) next to it hardly twists (Vlasov 1961), and Gamma goes as 1/L^3.
// At b = L/20 the increase is 3.1 %, which is 0.06 % too little.
double fraction_of_width(Buckling kind, const Scene& scene, double length);

struct BucklingStrip : CantileverStrip {
  Buckling kind;
  // Direction of buckling: the cloth's initial normal, or its opposite if the back is the softer side.
  Eigen::Vector3d side;

  // Returns the mean displacement of the free end to that side [m].
  double deflection(const std::vector<Eigen::Vector3d>& x) const;
};

// Builds the strip from the scene's cloth as overhang() does, clamped as `kind` requires, with gravity tilted
// by `tilt` [rad] to the side.  Its density is such that the weight grows to `most` times that of the
// reference in scene.ramp = `most` seconds.
BucklingStrip buckling_strip(Scene scene, Buckling kind, double length, double tilt, double most);

// Builds a strip for measuring thresholds: under its tilt the deflection is proportional to it, the weight
// reaches 2.5 times the reference in steps of a tenth, equilibria are precise enough for both, and, on edge,
// the membrane sags so little in its plane that the threshold rises by less than 0.3 %.
BucklingStrip measured_strip(Scene scene, Buckling kind, double length);

// States of equilibrium on the way to the threshold.
struct Southwell {
  std::vector<double> gamma;       // weight per area times L^3/b2
  std::vector<double> deflection;  // relative to the length
  double critical_gamma = 0;
};

// Increases the weight step by step until it comes close to the threshold.  Near it one mode grows as 1/(1 -
// x/critical), the others hardly (Southwell 1932; for beams on edge, Mandal & Calladine 2002), with x the
// load (upright) or its square (on edge, where the load acts twice: by its moment and by the twist).  So
// deflection/load = (a + b x)/(1 - x/critical), with three unknowns, through the last three states.
// `simulation` is that of the strip, not advanced yet.  Throws Error::simulation if no threshold is found
// below the full weight.
Southwell approach_threshold(const BucklingStrip& strip, Simulation& simulation);

// Returns the power of the load, 1 or 2, by which the threshold is extrapolated.
int power_of_load(Buckling kind);

}  // namespace hysteron::experiments
