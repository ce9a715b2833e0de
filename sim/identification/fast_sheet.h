// Reads the sheet of a FAST laboratory (De Boos & Tester 1994), or of a cantilever alone (Peirce 1930; ASTM
// D1388): bending lengths, extensions under three loads and along the bias, thicknesses and weight, along
// warp and weft (laboratory_sheet.h).
//
// A strip that is pushed over an edge until its end hangs at 41.5 degrees has the bending length c of half
// its overhang, and the rigidity w c^3 of its weight w per area.  That rigidity is the one of first bending:
// the strip's friction carries its part.  So b2 is less than w c^3 by the part of a friction moment that no
// cantilever can tell; this moment is assumed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "sim/identification/laboratory_sheet.h"

namespace hysteron {

using FastSheet = LaboratorySheet;

// Reads a sheet.  Throws as read_laboratory_sheet() does, and for a sheet without C or W, or with two drapes.
// Warns of B and G that contradict C and EB5, and of extensions that do not rise with their loads.
FastSheet read_fast_sheet(const std::filesystem::path& file);

// Returns a sheet to fill in, with the unit, the meaning and the usual range of each row as comments.
std::string fast_sheet_template();

inline constexpr double kLaboratoryGravity = 9.80665;  // [m/s^2]

// The friction of a strip: its moment HB [N], and the curvature at which it saturates [1/m].
struct StripFriction {
  double moment, k0;
};
// Returns the friction of a strip with rigidity b2 [N m].
using FrictionOfRigidity = std::function<StripFriction(double b2)>;

// Returns the b2 [N m] with which an overhang of twice the bending length [m], of weight w [N/m^2], hangs at
// 41.5 degrees after first bending; at least a thirtieth of w c^3, however large the friction.  Throws
// Error::simulation if no equilibrium is found.
double rigidity_of_bending_length(double bending_length, double weight, const FrictionOfRigidity& friction);

// Returns the bending length [m] of a strip with this curve along it, of this weight per area [kg/m^2].
double virtual_bending_length(const VirginCurve& curve, double density);

// The friction moment over rigidity [1/m] where none was measured, and its bounds.
inline constexpr double kAssumedFriction = 35, kLeastFriction = 18, kMostFriction = 55;

// Makes a fabric: b2 from C along warp with the assumed friction, b1 = b2 + 2HB/k0, weft-bending and
// weft-friction the ratio along weft; shear = 123/EB5 (De Boos & Tester 1994); warp and weft such that 100
// gf/cm extend them by E100 (or 20 by E20); thickness = T2; density = W.  The ranges of B and 2HB are those
// of the assumed friction, with which B falls as 2HB rises (`validate` keeps the bending length), and of the
// repeats of C.
SheetFabric fabric_of_fast_sheet(const FastSheet& sheet, const Assumptions& assumptions);

}  // namespace hysteron
