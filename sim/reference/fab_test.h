// The tests of a FAB tester, simulated along the clamps' own way: every distance that was recorded, in order.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/reference/buckled_strip.h"
#include "sim/reference/fab_loops.h"
#include "sim/reference/stops_law.h"

namespace hysteron {

// A strip stretched between two clamps, its in-plane law with stops on the engineering strain d/L - 1.
// Without tension it is slack: it buckles, and keeps the strain at which tension ended until it is taut
// again.
class StretchedStripTest {
 public:
  // At its length L [m] between the clamps, virgin.  `law`: of force per width [N/m] against strain.
  StretchedStripTest(StopsLaw law, double length);

  void go_to(double distance);                       // of the clamps [m], monotone from the one before
  double force() const { return force_; }            // per width, >= 0 [N/m]
  double energy() const;                             // stored, per width [J/m]
  double dissipated() const { return dissipated_; }  // since the start, per width [J/m]
  bool slack() const { return force_ == 0; }
  double strain() const { return strain_; }  // of the strip, not of the clamps

 private:
  StopsLaw law_;
  double length_;
  std::vector<double> anchors_;
  double strain_ = 0, force_ = 0, dissipated_ = 0;
};

inline constexpr double kStandardGravity = 9.80665;  // [m/s^2]

struct FabStrip {
  StopsLaw bending;    // [N m] against curvature; of the direction along which the strip is cut
  StopsLaw stretch;    // [N/m] against strain
  double density = 0;  // weight bears on a strip that bends [kg/m^2]
  long most_halvings = BuckledStrip{}.most_halvings;
};

struct FabRun {
  BranchForces force;  // per branch of the loops, up to the last simulated [N/m]
  std::vector<std::vector<Eigen::Vector2d>> shapes;  // of a strip that bends: at first, at each branch's end
  double work = 0, stored = 0, dissipated = 0;       // of the clamps, from the first distance on [J/m]
  double largest_work = 0;                           // that was done at any distance on the way [J/m]
  double peak_curvature = 0;                         // [1/m]
};

// All branches, or the first `branches`.  A strip that bends is laid slack at the first distance, where its
// friction carries nothing, as recorded forces begin between the branches of the loop; its weight acts
// against a bend up and with one down.  Throws Error::simulation where no equilibrium is found.
FabRun run_fab(const FabLoops& loops, const FabStrip& strip, int branches = -1);

// A test that nobody recorded: cycles from `gauge` less `slack` to each of the compressions (`loops` bend) or
// extensions and back [m], a branch in `steps` rows.
FabLoops made_up_loops(const std::string& test, double gauge, double slack,
                       const std::vector<double>& amplitudes, int steps);

}  // namespace hysteron
