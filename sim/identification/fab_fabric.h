// A fabric as the loops of a FAB tester identify it, as a file and from one.
//
//   [bending.stops]            thresholds = [..] [1/m], stiffnesses = [..] [N m]: along the first direction
//   [bending.stops.weft]       the same along the second, beside fabric.b2 times fabric.weft-bending
//   [membrane.stops.warp]      thresholds = [..] (strain), stiffnesses = [..] [N/m]; also .weft
//
// Read from any fabric: one without stops bends as its b1, b2 and k0 say.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/identification/fab_bending.h"
#include "sim/identification/fab_tension.h"
#include "sim/identification/fabric_file.h"
#include "sim/scene/scene.h"

namespace hysteron {

// What was identified, the directions in the same order: warp first, then weft.
struct FabIdentification {
  std::vector<FabBending> bending;
  std::vector<FabTension> tension;
  std::string from;  // "cycle 2 of D1 in loops.csv"
};

// Every number with its source, its standard error and whether the data determine it.  Throws as
// write_fabric_text().
void write_fab_fabric(const std::filesystem::path& file, const FabIdentification& found,
                      const FabricNotes& notes);

// Along which a strip is cut.
enum class StripDirection { warp, weft, bias };

// Of "L" or "warp", "W" or "weft", "B" or "bias"; Error::invalid_input for others.
StripDirection strip_direction(const std::string& name);

// The laws that a strip cut along one of three directions follows.
struct FabFabric {
  std::string name;
  double density = 0;                    // [kg/m^2]
  StopsLaw warp, weft;                   // of bending
  std::optional<StopsLaw> bias;          // of bending, where something is known of it
  StopsLaw warp_tension, weft_tension;   // of stretch
  std::optional<StopsLaw> bias_tension;  // of stretch, where shear is known

  // Along a bias of which nothing is known, half of each: the mean of the rigidities (Cooper 1960 with a
  // twisting rigidity of that mean).  Throws as strip_direction().
  FabStrip strip(const std::string& direction) const;
};

// Along weft and bias a fabric bends as its weft-bending and bias-bending say, with the stops that it has
// along weft; along the bias with those that hinges across it have (SpectrumStops::turn).  A strip is twice
// as wide as it is long and clamped at both ends, which is taken to hold its width, as KES-FB1 does: it is
// stretched along the bias against a quarter of warp, of weft and of twice their coupling, and against all of
// the shear.  Where faces differ the strip has the means of both sides.
FabFabric fab_fabric(const Fabric& fabric);

}  // namespace hysteron
