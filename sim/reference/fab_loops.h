// Reads records of a FAB tester: a strip clamped at both ends, one clamp moved towards the other and back (it
// buckles up or down) or away and back (it stretches), in cycles of growing amplitude; force against
// distance.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hysteron {

struct FabBranch {  // one way, out or back
  // Distances of the clamps [m]; forces per width of the strip, tension > 0 [N/m].
  std::vector<double> distance, force;
  std::vector<int> lines;  // lines of the file that it was read from; empty: no file
};

struct FabLoops {
  std::string direction;                   // "L", "W", "B": direction along which the strip was cut
  std::string test;                        // "U1" bends up, "D1" down, "S1" stretches; gauges 1, 2
  double gauge = 0;                        // length of the strip between the clamps [m]
  double width = 0;                        // [m]
  std::vector<FabBranch> branches;         // out, back, out, back, ...
  std::vector<std::string> warnings = {};  // sentences on possible errors of the record
  bool is_usable = true;                   // a test that nobody asked for may be unusable

  int cycles() const { return static_cast<int>(branches.size()) / 2; }
  bool bends() const { return test.front() != 'S'; }
  bool bends_up() const { return test.front() == 'U'; }
  std::string name() const { return direction + " " + test; }
};

enum class TesterUnits { si, fab };
constexpr std::array<const char*, 2> names(TesterUnits) { return {"si", "fab"}; }

// Reads a table with the columns direction, test, branch, clamp_distance, force, gauge_length, width, their
// units as endings: _m and _N (si), or _cm and _gf (fab: the tester's own; lines before the head, semicolons
// and decimal commas are read, too).  Forces in it are those of the whole width.  Throws Error::system,
// Error::invalid_input with file and line: other units than stated, a column or a number that is missing,
// branches out of order, another gauge or width within a test.  For requested tests it also throws as
// check_clamp_path(), and for forces that do not vary, do not rise as the clamps part (tension > 0), or by
// which a cycle gives back work, beyond drift and noise; within these it adds a doubt.  The zero of force
// does not matter.
struct FabRequest {
  std::function<bool(const FabLoops&)> asks_for = {};  // which tests are asked for; none: every test
  std::vector<int> cycles = {};                        // requested cycles, the first being 1; none: all
  double noise = 0;                                    // noise of forces of the whole width [N]
};
std::vector<FabLoops> read_fab(const std::filesystem::path& file, TesterUnits units,
                               const std::string& reader, const FabRequest& request = {});

// Finds a test among the loops of a file; Error::invalid_input names the tests that there are.
const FabLoops& find_loops(const std::vector<FabLoops>& all, const std::string& direction,
                           const std::string& test);

// The following readings of one cycle, the first being 0, do not depend on the zero of force: forces are
// taken from their mean over the cycle.  `force` has a list per branch of the loops (measured, or a model's).
using BranchForces = std::vector<std::vector<double>>;
BranchForces branch_forces(const FabLoops& loops);
// Integrates both branches by the trapezoidal rule: work lost per width, > 0 [J/m].
double loop_area(const FabLoops& loops, const BranchForces& force, int cycle);
// Returns the largest less the smallest force [N/m].
double force_range(const BranchForces& force, int cycle);
// Returns the largest push of a buckled strip, or pull of a stretched one, >= 0 unless the zero is elsewhere
// [N/m].
double peak_force(const FabLoops& loops, const BranchForces& force, int cycle);

// The loops of a FAB tester have to pass these checks before anything is read off them or fitted to them.

// The largest slack of a strip that bends, and largest stretch of one that is pulled, at the beginning of a
// test, over its gauge: testers begin with a strip that is almost straight.
inline constexpr double kLargestStart = 0.25;

// Checks the way of the clamps: a known test and direction, two branches a cycle, lengths of a strip, a
// beginning near the gauge, rows in order, branches that go out and back, each from where the last ended.
// Throws Error::invalid_input: "fit: loops.csv: L D1: ...".
void check_clamp_path(const FabLoops& loops, const std::string& file, const std::string& reader);

}  // namespace hysteron
