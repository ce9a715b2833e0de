// Writes a fabric that the loops of a FAB tester identify as a file, and reads one from a file:
//
//   [bending.stops]            thresholds = [..] [1/m], stiffnesses = [..] [N m]: along the first direction
//   [bending.stops.weft]       the same along the second, beside fabric.b2 times fabric.weft-bending
//   [membrane.stops.warp]      thresholds = [..] (strain), stiffnesses = [..] [N/m]; also .weft
//
// It can be read from any fabric: one without stops bends as its b1, b2 and k0 say.
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

// The identified laws, with the directions in the same order: warp first, then weft.
struct FabIdentification {
  std::vector<FabBending> bending;
  std::vector<FabTension> tension;
  std::string from;  // "cycle 2 of D1 in loops.csv"
};

// Writes every number with its source, its standard error and whether the data determine it.  Throws as
// write_fabric_text() does.
void write_fab_fabric(const std::filesystem::path& file, const FabIdentification& found,
                      const FabricNotes& notes);

// The direction along which a strip is cut.
enum class StripDirection { warp, weft, bias };

// Reads "L" or "warp", "W" or "weft", "B" or "bias"; throws Error::invalid_input for others.
StripDirection strip_direction(const std::string& name);

// The laws of a strip cut along one of three directions.
struct FabFabric {
  std::string name;
  double density = 0;                    // [kg/m^2]
  StopsLaw warp, weft;                   // bending laws
  std::optional<StopsLaw> bias;          // bending law, if the fabric has one
  StopsLaw warp_tension, weft_tension;   // laws of stretch
  std::optional<StopsLaw> bias_tension;  // law of stretch, if shear is known

  // Returns the strip's laws.  Along a bias without laws of its own they are half of each direction's: the
  // mean of the rigidities (Cooper 1960 with a twisting rigidity of that mean).  Throws as strip_direction()
  // does.
  FabStrip strip(const std::string& direction) const;
};

// Returns the fabric's laws.  Along weft and bias it bends by its weft-bending and bias-bending, with its
// stops along weft, and along the bias with those of hinges across it (SpectrumStops::turn).  A strip is
// twice as wide as it is long and clamped at both ends, which is taken to hold its width, as KES-FB1 does:
// along the bias it is stretched against a quarter of warp, of weft and of twice their coupling, and against
// all of the shear.  Where faces differ the strip has the means of both sides.
FabFabric fab_fabric(const Fabric& fabric);

}  // namespace hysteron
