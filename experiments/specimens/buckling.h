// A strip clamped at one end that buckles under its own weight: its threshold from a Southwell plot, and what
// the theory of beams says of it.
#pragma once

#include <array>
#include <vector>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// upright: it stands on its clamp and falls over (Greenhill 1881).
// edge: it is clamped level, its width vertical, and turns over sideways (Prandtl 1899).
enum class Buckling { upright, edge };
constexpr std::array<const char*, 2> names(Buckling) { return {"upright", "edge"}; }

// Heaviness Gamma, weight per area times L^3/b2, at which a strip of this law and fabric buckles that is
// narrow, b << L, and bends far more easily out of its plane than in it.  Its bending rigidity is EI = B b
// and its torsional one GJ = 2 B b (W = B |S|^2/2 with a twist S_xy alone), B the law's slope at rest; a
// fabric that bends differently along warp, weft and bias has EI = q B b, q = rigidity_along(), and GJ =
// (4 bias - 1 - weft) B b for a strip along warp or weft; between them strips twist as they bend, and on edge
// they are refused (Error::invalid_input), as is one on edge with another slope to its back than to its face.
// Upright such a strip gives way to its softer side, whose slope B is.
//   upright: weight L^3/B = 7.8373 (Timoshenko & Gere 1961, 2.12)
//   edge: q L^3/sqrt(EI GJ) = 12.8538 with q = weight b (the same, 6.3)
double reference_gamma(Buckling kind, const Scene& scene);

// What a width b adds to the reference, as a share of it.  On edge the clamp keeps the strip from warping: a
// length of sqrt(EI b^2/(12 GJ)) next to it hardly twists (Vlasov 1961), and Gamma goes as 1/L^3.  At b =
// L/20 that is 3.1 %, and 0.06 % too little.
double fraction_of_width(Buckling kind, const Scene& scene, double length);

struct BucklingStrip : CantileverStrip {
  Buckling kind;
  Eigen::Vector3d side;  // where it buckles to: the cloth's normal at the start, or where its back is the
                         // softer side against it

  // Mean displacement of the free end to that side [m].
  double deflection(const std::vector<Eigen::Vector3d>& x) const;
};

// The scene's cloth as overhang() makes it, clamped as `kind` asks, with gravity that pulls it `tilt` [rad]
// to the side.  Its density becomes such that the weight grows to `most` times that of the reference in
// scene.ramp = `most` seconds.
BucklingStrip buckling_strip(Scene scene, Buckling kind, double length, double tilt, double most);

// For measuring thresholds: a tilt under which the strip deflects in proportion to it, a weight that reaches
// 2.5 times the reference in steps of a tenth, equilibria precise enough for both, and, on edge, a membrane
// that sags so little in its plane that the threshold rises by less than 0.3 %.
BucklingStrip measured_strip(Scene scene, Buckling kind, double length);

// States of equilibrium on the way to the threshold.
struct Southwell {
  std::vector<double> gamma;       // weight per area times L^3/b2
  std::vector<double> deflection;  // over the length
  double critical_gamma = 0;
};

// Increases the weight step by step until it comes close to the threshold.  Near it one mode grows as
// 1/(1 - x/critical), the others hardly (Southwell 1932; for beams on edge, Mandal & Calladine 2002), with x
// the load (upright) or its square (on edge, where the load acts twice: by its moment and by the twist).  So
// deflection/load = (a + b x)/(1 - x/critical), with three unknowns, through the last three states.
// `simulation` is that of the strip, not advanced yet.  Error::simulation if no threshold is found below the
// full weight.
Southwell approach_threshold(const BucklingStrip& strip, Simulation& simulation);

// By which power of the load the threshold is extrapolated: 1 or 2.
int power_of_load(Buckling kind);

}  // namespace hysteron::experiments
