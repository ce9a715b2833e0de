// Reads fabrics from files: every number has its value, unit, source and confidence.
//
//   name = "cotton-broad"
//   description = "100 % cotton broad cloth, plain weave"
//   [sources]            citations by the names that entries use, and how lists show them
//   kes = {short = "Author Year", text = "Author Year, ..."}
//   rigidity = "b1 = B + 2HB/k0"       a text alone is its own short name
//   [parameters]         the keys fabric.* of a scene, in their SI units
//   b2 = 1.157e-5                      the value alone: "given" by the file, or
//   b2 = {value = 0.118, unit = "gf cm^2/cm", source = "kes", confidence = "published"}
//                        in any unit that is known (sim/base/units.h); source and confidence may be left out
//                        optional: stderr = 2e-7, the standard error in the same unit
//                        optional: range = [8e-6, 1.5e-5], between which the number may lie
//                        kes-b and kes-2hb may stand for b1 and b2, with stops-median and stops-spread for k0
//   [bending.stops]      optional: friction elements; also [bending.stops.weft], [bending.branches],
//   [bending.set] thresholds = [5, 20, 60]           1/m, ascending stiffnesses = [8e-6, 4e-6, 1e-6]   N m
//   source = "kes"                     optional, as is confidence: of the whole table; a number that is no
//                                      list may be {value, unit, source, confidence} instead
//   [membrane.stops.shear]             optional: friction elements in the plane; also .warp, .weft
//   thresholds = [0.005, 0.02]         strains, ascending
//   stiffnesses = [200, 50]            N/m
//   growth = 6                         optional, of shear alone: fabric.membrane.stops.shear.growth
//   [published]          what the source prints besides, in its own units
//   B = {value = 0.118, unit = "gf cm^2/cm", source = "kes", confidence = "published"}
//                        B and 2HB may state a range: between which numbers the print rounds to them
//   [look]               for pictures only, which read it: experiments/workbench/pictures/fabric_look.h
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {

struct FabricFile {
  Fabric fabric;
  std::string description;
  std::map<std::string, std::string> place;        // by parameter: "assets/fabrics/cotton-broad.toml:12"
  std::map<std::string, Range> range;              // by parameter, if it states one, in its unit
  std::map<std::string, Range> published_range;    // for B and 2HB as printed, in their own units
  std::map<std::string, std::string> short_names;  // of sources, by their texts

  // Returns the source's short name, or its text.
  const std::string& shown(const Provenance& from) const;
};

// KES units (Kawabata 1980) in SI units; 1 gf = 9.80665e-3 N by definition.
inline constexpr double kGramForceSquareCentimetrePerCentimetre = 9.80665e-5;  // [N m]
inline constexpr double kGramForceCentimetrePerCentimetre = 9.80665e-3;        // [N]

// Reads a fabric by name (assets/fabrics) or file; `origin` says who asks ("--fabric").  b1, b2, k0, density
// and thickness must be there, but b1 and k0 may be left to the stops; other parameters keep the program's
// default, whose provenance says so.  Throws Error::invalid_input with file and line for unknown or missing
// keys, wrong units, missing sources, values out of range.
FabricFile read_fabric(const std::string& name_or_file, const std::string& origin);

// Sets b1 and k0 to those with the first slope and the friction moment of the stops; without stops nothing
// changes.
void follow_stops(Fabric& fabric);
// Sets bias_bending to the mean of warp and weft, as where none is stated.
void follow_weft(Fabric& fabric);

// Returns all fabrics of the assets folder, sorted by name.
std::vector<FabricFile> list_fabrics();

}  // namespace hysteron
