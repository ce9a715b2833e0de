// Simulates the shear and the tension test of KES-FB1 (Kawabata 1980) of a fabric's in-plane law alone, under
// uniform strain.
//
// A specimen, wide beside the distance L of its clamps, keeps its width: only the strain E between the clamps
// and the shear g (2 E12) change.  With the clamps u apart along themselves and l L between each other
//
//   g = u/L,   E = (l^2 + g^2 - 1)/2,   tension per width T = S l,   force along the clamps F = S12 + S g
//
// The shear test leads g to +-tan 8 degrees while a weight keeps T at 10 gf/cm; the weight's pull is not the
// cloth's and turns with it, so that the reading is F - T tan(angle between the clamps), which is S12.  The
// tension test goes from rest until T is 500 gf/cm, and back to T = 0.  The angles, the loads, and the rule
// that a number is the mean of both sides are known from descriptions of the tester, not from Kawabata's
// book.  Subtracting the weight's part is chosen here.
#pragma once

#include "sim/reference/kes.h"
#include "sim/reference/stops_law.h"
#include "sim/scene/scene.h"

namespace hysteron {

// The laws of the cloth between the clamps; forces per width [N/m] against strain.
struct InPlaneLaw {
  StopsLaw tension, shear;
};
enum class Along { warp, weft };  // the direction from clamp to clamp
constexpr auto names(Along) { return std::array{"warp", "weft"}; }
InPlaneLaw in_plane_law(const Fabric& fabric, Along along);

inline constexpr double kGramForcePerCentimetre = 0.980665;  // [N/m]
inline constexpr double kDegree = 3.14159265358979323846 / 180;

struct InPlaneProtocol {
  double angle = 8;                                // largest shear [degree]
  double slope_from = 0.5, slope_to = 2.5;         // G is the slope between these [degree]
  double width_at = 0.5, second_width_at = 5;      // angles at which 2HG and 2HG5 are read [degree]
  double weight = 10 * kGramForcePerCentimetre;    // tension in the shear test [N/m]
  double largest = 500 * kGramForcePerCentimetre;  // largest tension of the tension test [N/m]
  int steps = 2000;                                // accepted steps from zero to the largest
};

// Each number is the mean of both sides.
struct ShearReading {
  double stiffness = 0;     // G, force over angle [N/m]
  double width = 0;         // 2HG [N/m]
  double second_width = 0;  // 2HG5 [N/m]
  double loop_area = 0;     // [J/m^2]
};

// The clamps' way through one cycle from rest.
struct ShearWalk {
  KesWalk shear;                // with g in place of curvature
  std::vector<double> stretch;  // l, one per row, in balance with the weight
};

struct ShearTest {
  ShearReading reading;
  ShearWalk walk;
  std::vector<double> force;  // F - T g/l, one per row [N/m]
};

struct TensionReading {
  double linearity = 0;   // LT = WT/(T e/2), e the largest extension
  double work = 0;        // WT = int T de of loading [J/m^2]
  double resilience = 0;  // RT, the share of that work which comes back [percent]
  double extension = 0;   // EMT, e [percent]
};

struct TensionTest {
  TensionReading reading;
  std::vector<double> extension, force;  // l - 1, T [N/m], one per row
  std::size_t turn = 0;                  // the row of the largest tension
};

// Reads the shear test; `force` is F - T g/l, one per row [N/m].
ShearReading read_shear(const InPlaneProtocol& protocol, const KesWalk& walk,
                        const std::vector<double>& force);
TensionReading read_tension(const std::vector<double>& extension, const std::vector<double>& force,
                            std::size_t turn);

ShearTest test_shear(const InPlaneLaw& law, const InPlaneProtocol& protocol = {});
// Throws Error::invalid_input for a fabric that does not reach the largest tension before twice its length.
TensionTest test_tension(const InPlaneLaw& law, const InPlaneProtocol& protocol = {});

}  // namespace hysteron
