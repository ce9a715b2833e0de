// A strip stretched between two clamps, its in-plane law with stops on the engineering strain d/L - 1.
// Without tension it is slack: it buckles, and keeps the strain at which tension ended until it is taut
// again.
#pragma once

#include <vector>

#include "sim/reference/stops_law.h"

namespace hysteron {

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

}  // namespace hysteron
