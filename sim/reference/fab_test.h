// Simulates the tests of a FAB tester along the recorded way of the clamps, distance by distance.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/reference/buckled_strip.h"
#include "sim/reference/fab_loops.h"
#include "sim/reference/stops_law.h"

namespace hysteron {

// A strip is stretched between two clamps, with an in-plane law of stops on the engineering strain d/L - 1.
// Without tension it is slack: it buckles, and keeps the strain at which tension ended until it is taut
// again.
class StretchedStripTest {
 public:
  // The virgin strip has its length L [m] between the clamps.  `law` is force per width [N/m] against strain.
  StretchedStripTest(StopsLaw law, double length);

  void go_to(double distance);             // distance of the clamps [m], monotone from the one before
  double force() const { return force_; }  // per width, >= 0 [N/m]
  double energy() const;                   // stored, per width [J/m]
  double dissipated() const { return dissipated_; }  // per width, since the start [J/m]
  bool slack() const { return force_ == 0; }
  double strain() const { return strain_; }  // strain of the strip, not of the clamps

 private:
  StopsLaw law_;
  double length_;
  std::vector<double> anchors_;
  double strain_ = 0, force_ = 0, dissipated_ = 0;
};

inline constexpr double kStandardGravity = 9.80665;  // [m/s^2]

struct FabStrip {
  StopsLaw bending;    // moment [N] against curvature [1/m], along the direction in which the strip is cut
  StopsLaw stretch;    // force [N/m] against strain
  double density = 0;  // [kg/m^2], whose weight acts on a strip that bends
  long most_halvings = BuckledStrip{}.most_halvings;
};

struct FabRun {
  BranchForces force;  // per branch of the loops, up to the last one simulated [N/m]
  // The shapes of a strip that bends: at first, and at each branch's end [m].
  std::vector<std::vector<Eigen::Vector2d>> shapes;
  double work = 0, stored = 0, dissipated = 0;  // since the first distance [J/m]; the clamps' work
  double largest_work = 0;                      // the largest value of `work` on the way [J/m]
};

// Simulates all branches, or the first `branches`.  A strip that bends is laid slack at the first distance,
// where its friction carries nothing, as recorded forces begin between the branches of the loop; its weight
// acts against a bend up and with one down.  Throws Error::simulation where no equilibrium is found.
FabRun run_fab(const FabLoops& loops, const FabStrip& strip, int branches = -1);

// Makes a test that nobody recorded: cycles from `gauge` less `slack` to each of the compressions (`loops`
// bend) or extensions and back [m], with `steps` rows per branch.
FabLoops made_up_loops(const std::string& test, double gauge, double slack,
                       const std::vector<double>& amplitudes, int steps);

}  // namespace hysteron
