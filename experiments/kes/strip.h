// The KES-FB2 test on a strip of cloth between two clamps: one equilibrium per curvature, no weight, no time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/reference/kes.h"
#include "sim/scene/cloth.h"
#include "sim/scene/motion.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

inline constexpr double kGauge = 0.01;  // of the tester: cloth between the clamps' middles [m]

struct StripShape {
  std::string mesh = "aligned";  // one of strip_meshes()
  BendingElement element = BendingElement::shape;
  double width = 4e-3;    // [m]
  double warp_angle = 0;  // of the fabric against the strip [degree]
  int triangles = 340;    // about as many, clamped ones included
  // Equilibria from zero to the amplitude.  5 j - 2 of them put the ends of the usual window, 0.2 and 0.6 of
  // the amplitude, on rows, so that a kink there is read exactly.
  int steps = 63;
};

// The families of the builders.
const std::vector<std::string>& strip_meshes();

// Curvatures and times of the strip's equilibria.  None but the first is at K = 0, where an elastic strip
// carries nothing that its unbalanced forces could be compared with: the first step is half as long as all
// others.
KesWalk strip_walk(const KesProtocol& protocol, int steps);

// A strip with its clamps' motion over the walk.  A clamp is two columns of vertices, the second on a
// straight line where the mesh of the family begins; its middle is half a column inside.
struct ClampedStrip {
  Scene scene;
  Cloth cloth;
  KesWalk walk;
  double spacing;  // of columns [m]

  Placement clamp(std::size_t row) const;  // of the moving one
  Eigen::Vector3d middle() const;          // of the moving clamp, before it moves [m]
  // Nothing of the face's corners is held.
  bool is_free(int face) const;
};

// Throws Error::invalid_input for meshes and elements that do not exist, for bends of a whole turn, and for
// laws that need orders on the way.
ClampedStrip clamped_strip(const StripShape& shape, const LawRequest& law, const Fabric& fabric,
                           const KesProtocol& protocol);

struct StripTest {
  KesReading reading;
  KesReading law_reading;          // of the law alone through the same rows
  std::vector<double> moment;      // per width, of the moving clamp about its middle [N], one per row
  std::vector<double> law_moment;  // of the law alone, with a cloth's memory, through the same rows [N]
  // Of the faces that no clamp touches, along the strip, mean by area [1/m]; element `shape` only.
  std::vector<double> free_curvature;
  double largest_force = 0;      // of a clamp over the width [N/m]; zero in pure bending
  double newton_iterations = 0;  // mean per row
  double seconds = 0;            // wall clock, of the equilibria alone
  long retried_steps = 0;
  std::size_t bytes = 0;  // that the simulation holds
};

// Called after each row, with the state at hand.
using StripWatch = std::function<void(std::size_t row, Simulation& simulation)>;

// Throws Error::simulation where no equilibrium is found.
StripTest test_strip(const ClampedStrip& strip, const LawRequest& law, const KesProtocol& protocol,
                     const StripWatch& watch = {});

// Largest difference of strip and law over the law's largest moment.
double largest_difference(const StripTest& test);

}  // namespace hysteron::experiments
