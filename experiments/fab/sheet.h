// The bending test of FAB testers on a mesh of triangles, by the program's own solver: one equilibrium for
// every distance of the clamps.  It verifies the elastica (sim/reference/buckled_strip.h), which shares
// nothing with it but the stops.
//
//   o--o--.            .--o--o    A clamp holds two columns of vertices; cloth bends from the middle between
//         .`--.____.--'.          them on (clamped_mesh.h), and the gauge is that between the middles.
//   near  .            .   far    A bend down hangs, a bend up rises against its weight.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/reference/fab_test.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

struct SheetShape {
  std::string mesh = "aligned";
  int triangles = 2400;  // about, between the clamps
  double width = 0;      // [m]; 0: the strip's
};

// Row r of the loops, counted through all branches, is at the time kLayingSteps + r, in steps of 1 s.
inline constexpr int kLayingSteps = 8;  // in which weight is put on the first shape

struct FabSheet {
  Scene scene;
  Cloth cloth;         // slightly buckled to its side
  double spacing = 0;  // of the clamps' columns [m]
  double side = 1;     // 1: buckles up, -1: down
};

// Cut along the loops' direction; of a fabric whose stops differ along warp and weft, a strip on the bias
// bends by both at once.  A fabric's permanent set is left out, as the elastica has none.  Error::request for
// directions and meshes that do not exist and for tests that stretch.
FabSheet fab_sheet(const FabLoops& loops, const Fabric& fabric, const SheetShape& shape);

struct SheetRun {
  BranchForces force;                                // per branch, tension > 0 [N/m]
  std::vector<std::vector<Eigen::Vector2d>> shapes;  // of its edge, as FabRun's
  double work = 0, dissipated = 0;                   // of the clamp, from the first distance on [J/m]
  int triangles = 0;
  double newton_iterations = 0;  // mean per row
  long retried_steps = 0;
  std::uint64_t state_hash = 0;
  double seconds = 0;  // wall clock
};

// What is known at a row, with the state at hand.
struct SheetRow {
  std::size_t branch = 0, row = 0;
  double distance = 0, force = 0;  // [m], [N/m]
};
using SheetWatch = std::function<void(const SheetRow& row, Simulation& simulation)>;

// As the strip, the sheet is laid slack at the first distance, where its friction carries nothing.
// Error::run where no equilibrium is found.
SheetRun test_sheet(const FabSheet& sheet, const FabLoops& loops, const SheetWatch& watch = {});

}  // namespace hysteron::experiments
