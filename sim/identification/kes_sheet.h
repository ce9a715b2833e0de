// Reads the sheet of a KES-F laboratory (Kawabata 1980): the sixteen numbers of tension, bending, shear,
// compression, surface, thickness and weight as they are printed, along warp and weft (laboratory_sheet.h).
#pragma once

#include <filesystem>
#include <string>

#include "sim/identification/laboratory_sheet.h"

namespace hysteron {

using KesSheet = LaboratorySheet;

// Reads a sheet.  Throws as read_laboratory_sheet() does, and for a sheet without B or 2HB, or with T0 < TM.
// Warns of possible errors: numbers of one test that contradict each other (WT beside LT and EMT, warp and
// weft exchanged), ratios that no woven cloth has.
KesSheet read_kes_sheet(const std::filesystem::path& file);

// Returns a sheet to fill in, with the unit, the meaning and the usual range of each row as comments.
std::string kes_sheet_template();

// Makes a fabric: b2 = B and b1 = B + 2HB/k0 along warp, with k0 the assumed one as the geometric mean of
// warp and weft, weft-bending and weft-friction the ratios along weft, bias their mean; back-bending and
// back-friction the ratios of the rows B-back and 2HB-back, geometric means of warp and weft; shear = G with
// a stop of moment 2HG/2, which grows with the angle so that it is 2HG5/2 at 5 degrees; warp and weft such
// that 500 gf/cm extend them by EMT; friction = MIU; thickness = T0; density = W.  Numbers that the sheet
// lacks are those of the shipped fabrics, assumed, with their range.
SheetFabric fabric_of_sheet(const KesSheet& sheet, const Assumptions& assumptions);

}  // namespace hysteron
