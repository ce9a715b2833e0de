// The KES-FB2 test on a strip of cloth between two clamps: one equilibrium per curvature, without weight and
// time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/reference/kes.h"
#include "sim/scene/cloth.h"
#include "sim/scene/motion.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

inline constexpr double kGauge = 0.01;  // the tester's gauge: length between the clamps' middles [m]

struct StripShape {
  std::string mesh = "aligned";  // a MeshFamily
  BendingElement element = BendingElement::shape;
  double width = 4e-3;    // [m]
  double warp_angle = 0;  // angle of the warp to the strip [degree]
  int triangles = 340;    // approximate number, clamped ones included
  // The number of equilibria from zero to the amplitude.  With 5 j - 2 of them the ends of the usual window,
  // 0.2 and 0.6 of the amplitude, fall on rows, so that a kink there is read exactly.
  int steps = 63;
};

// Returns the curvatures and times of the strip's equilibria.  None but the first is at K = 0, where an
// elastic strip carries nothing that its unbalanced forces could be compared with: the first step is half as
// long as all others.
KesWalk strip_walk(const KesProtocol& protocol, int steps);

// A strip with its clamps' motion through the test.  A clamp is two columns of vertices, the second on a
// straight line where the mesh of the family begins; its middle is half a column inside.
struct ClampedStrip {
  Scene scene;
  Cloth cloth;
  KesWalk walk;
  double spacing;  // distance of columns [m]

  Placement clamp(std::size_t row) const;  // placement of the moving clamp
  Eigen::Vector3d middle() const;          // initial middle of the moving clamp [m]
  // True if no clamp holds a corner of the face.
  bool is_free(int face) const;
};

// Builds a strip.  Throws Error::invalid_input for unknown meshes and elements, for bends of 360 degrees or
// more, and for laws that need edits during the test.
ClampedStrip clamped_strip(const StripShape& shape, const LawRequest& law, const Fabric& fabric,
                           const KesProtocol& protocol);

struct StripTest {
  KesReading reading;
  KesReading law_reading;      // reading of the law alone through the same rows
  std::vector<double> moment;  // moment of the moving clamp about its middle, per width [N], one per row
  // Moment of the law alone, with a cloth's memory, through the same rows [N].
  std::vector<double> law_moment;
  // Area-weighted mean curvature along the strip of the faces that no clamp touches [1/m]; element `shape`
  // only.
  std::vector<double> free_curvature;
  double largest_force = 0;      // largest clamp force over the width [N/m]; zero in pure bending
  double newton_iterations = 0;  // mean per row
  double seconds = 0;            // wall clock of the equilibria alone [s]
  long retried_steps = 0;
  std::size_t bytes = 0;  // memory of the simulation
};

// A StripWatch is called after each row, while the simulation is in that state.
using StripWatch = std::function<void(std::size_t row, Simulation& simulation)>;

// Tests the strip.  Throws Error::simulation if no equilibrium is found.
StripTest test_strip(const ClampedStrip& strip, const LawRequest& law, const KesProtocol& protocol,
                     const StripWatch& watch = {});

// Returns the largest difference of strip and law over the law's largest moment.
double largest_difference(const StripTest& test);

}  // namespace hysteron::experiments
