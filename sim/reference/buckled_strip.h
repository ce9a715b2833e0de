// Simulates an inextensible strip between two clamps that face each other, buckled by moving one towards the
// other: the bending test of FAB testers, as a planar elastica with friction.  It uses nothing of the cloth's
// solver.
//
//            .--.            L: length of the strip between the clamps     s along the strip, 0 at the clamp
//         .-'    `-.         d: distance of the clamps <= L                 theta: slope angle, 0 at both
//         clamps
//   =====o          o=====   F: force per width that the moving clamp       and, by symmetry, in the middle
//        |<-- d --->|           feels, tension > 0
//
// It is quasi-static: at each distance the strip rests at a minimum of
//   int W(theta') ds + w int y ds   under   int cos(theta) ds = d,   y = int sin(theta) ds,
// where W, the incremental potential of bending with stops, is convex, and the history of each point is that
// of the step before; F is the multiplier of the constraint.  The shape is symmetric; half of it is solved
// for.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/reference/stops_law.h"

namespace hysteron {

struct BuckledStrip {
  StopsLaw law;       // bending law
  double length = 0;  // L [m]
  double weight = 0;  // w per area [N/m^2], against the side to which the strip buckles; < 0: towards it
  int elements = 32;  // of half the strip; errors are of second order in their length
  // The number of the clamps' steps that may fail and be halved, in all, before the solve gives up: a search
  // among laws goes on to another one rather than creep.
  long most_halvings = 1'000'000'000;
};

class BuckledStripTest {
 public:
  // The first shape is reached in one of these ways.
  enum class Start {
    virgin,  // bent from straight in one step
    relaxed  // laid slack between the clamps, without friction in the first shape
  };
  BuckledStripTest(const BuckledStrip& strip, double distance, Start start);

  // Moves the clamps to a distance in (0, L) [m], in steps of at most `step` of the length (halved where
  // Newton's method fails).  Throws Error::simulation if no equilibrium is found.
  void go_to(double distance, double step = 0.01);

  double distance() const { return distance_; }
  double force() const { return force_; }            // F [N/m]
  double energy() const;                             // energy of bending and weight per width [J/m]
  double dissipated() const { return dissipated_; }  // since rest, per width [J/m]
  double peak_curvature() const;                     // largest |K| at present [1/m]
  double bend() const;                               // int |K| ds
  std::vector<Eigen::Vector2d> line() const;         // line of the whole strip, buckled upwards [m]

 private:
  struct Trial;
  struct Direction;
  void lay(double distance, Start start);
  bool solve(double distance, double weight);
  Direction direction(const Trial& at) const;
  void assemble(Trial& trial, double distance, double weight) const;
  void accept();
  double slope(int node) const;  // angle at a node, fixed ones included [rad]

  BuckledStrip strip_;
  double h_;                 // length of an element [m]
  Eigen::VectorXd angle_;    // at the nodes between clamp and middle [rad]
  Eigen::MatrixXd anchors_;  // of the stops: a column per element [1/m]
  double distance_ = 0, force_ = 0, dissipated_ = 0;
  long halvings_ = 0;
};

}  // namespace hysteron
