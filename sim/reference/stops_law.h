// Friction elements form a scalar law (Iwan 1966): a spring beside stops, springs p_j that slip at r_j,
//
//   y = b x + sum_j p_j clamp(x - S_j, -r_j, r_j),   S_j dragged along
//
// whose limits may grow with x, r_j + a_j |x| in place of r_j (membrane/in_plane_friction.h),
//
// for bending (x curvature [1/m], y moment per width [N], b and p_j [N m]) or stretch (x strain, y force per
// width [N/m], b and p_j [N/m]).  A branch after a reversal is the virgin curve doubled (Masing 1926) where
// they do not grow.
#pragma once

#include <vector>

namespace hysteron {

struct StopsLaw {
  double spring = 0;                            // b [N m] or [N/m]
  std::vector<double> thresholds, stiffnesses;  // r_j > 0 [1/m] or [-], p_j >= 0 in b's unit; equally many
  std::vector<double> growths = {};             // a_j in [0, 1), equally many; none: all 0

  int stops() const { return static_cast<int>(thresholds.size()); }
  double initial_stiffness() const;  // b + sum p_j, also after each reversal
  double friction() const;  // sum p_j r_j: half the width at x = 0 of a loop on which every stop slips
  double growth(int j) const { return growths.empty() ? 0 : growths[j]; }
};

// One point of a body with that law.
struct StopsPoint {
  double response = 0, tangent = 0;   // y, dy/dx
  double stored = 0, dissipated = 0;  // energy at present, and loss in the last step
};

// Evaluates the law at x, with the `anchors` (S_j, one per stop) of the last accepted step; it is exact if x
// is monotone in the step. stored + dissipated is the incremental potential, whose slope is the response.
StopsPoint respond(const StopsLaw& law, const double* anchors, double x);
// Drags the anchors (one per stop) along to x.
void accept(const StopsLaw& law, double* anchors, double x);

}  // namespace hysteron
