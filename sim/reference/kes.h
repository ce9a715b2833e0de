// Simulates the KES-FB2 pure bending test (Kawabata 1980) of a moment-curvature law alone: a specimen is bent
// uniformly at a constant rate to +-2.5 per cm, and its moment per width recorded.
#pragma once

#include <array>
#include <vector>

#include "sim/bending/laws/friction_shape.h"
#include "sim/bending/laws/law_run.h"

namespace hysteron {

struct KesProtocol : KesWindow {
  double rate = 50;   // rate of curvature [1/(m s)]: 0.5 per cm and second
  int steps = 20000;  // accepted steps to the amplitude; laws that take time need many to be exact to 1e-4
  int cycles = 3;     // the tester reads the first cycle; the area is that of the last
  bool minor_loops = true;  // adds cycles of smaller amplitudes and partial reversals
};

// Throws Error::invalid_input if curvatures are not 0 <= slope_from < slope_to <= amplitude or 0 < width_at <
// amplitude.
void check_protocol(const KesProtocol& protocol);

// A history of curvatures at a constant rate, from rest to each turning point in order.
struct KesWalk {
  std::vector<LawRow> rows;        // begins with K = 0
  std::vector<std::size_t> start;  // first row of the leg to each turning point, and the end of the last leg
};
// Makes the walk.  Each full amplitude is visited twice: as it is reached, and by a row without duration that
// carries the command to `grinspun-edit`.
KesWalk walk_to(const std::vector<double>& turns, const KesProtocol& protocol);

// The numbers that the tester reads, each the mean of the positive and the negative side.
struct KesReading {
  double rigidity = 0;             // B [N m], slope of the branch on which |K| grows
  double loop_width = 0;           // 2HB [N]
  double residual = 0;             // curvature at zero moment after release from the amplitude [1/m]
  double residual_by_formula = 0;  // the same in closed form [1/m]; NaN if the law has none
  double loop_area = 0;            // area of the last cycle's loop [J/m^2]
  double area_change = 0;          // relative change of the area by the last cycle; NaN if there was only one
  KesPair face, back;              // B [N m] and 2HB [N] on the positive and the negative side
};

// Reads a walk to the amplitude and then through `cycles` cycles; `moment` has one value per row [N].
KesReading read_loop(const KesProtocol& protocol, const KesWalk& walk, const std::vector<double>& moment);

// Returns B [N m] and 2HB [N] of a fabric by closed form: for three numbers b2 and twice the friction moment,
// for stops the tester's reading of the first loop.
KesPair kes_pair(const VirginCurve& curve, const KesProtocol& protocol = {});

// A smaller cycle, closed if the law closes it.
struct MinorLoop {
  enum class Family { amplitude = 1, partial_reversal = 2 } family;
  double reversal = 0;                    // amplitude, or the end of the release from full amplitude [1/m]
  std::vector<double> curvature, moment;  // [1/m], [N]
};

struct KesTest {
  KesReading reading;
  KesWalk walk;
  std::vector<double> moment;  // [N], one per row of the walk
  std::vector<MinorLoop> minor_loops;
  // The area of a law that takes time over that with a thousand steps or more, minus 1: the error due to the
  // length of its steps.
  double area_error = 0;
  std::array<int, 3> recovery_cases{};  // counts of reversals with |M| <= Ma, <= 2 Ma, > 2 Ma, in all loops
};

// Runs the test.  The reading of a law that takes no time does not depend on the length of the steps: it is
// taken between them, too, since a sum over few rows would take chords for the curve.  Throws
// Error::invalid_input as run_law() does.
KesTest test_in_kes(const LawRequest& request, const KesProtocol& protocol = {});

}  // namespace hysteron
