// The sheet of a KES-F laboratory (Kawabata 1980): the sixteen numbers of tension, bending, shear,
// compression, surface, thickness and weight as they are printed, along warp and weft.
//
//   quantity,unit,warp,weft,mean
//   B,gf cm^2/cm,0.118,0.094,
//   W,mg/cm^2,,,12.4
//
// A row fills warp and weft, or the mean of both.  As CSV (whatever separator and decimal mark csv.h reads)
// or TOML: [B] unit = "gf cm^2/cm", warp = 0.118, weft = 0.094.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sim/identification/identification.h"

namespace hysteron {

enum class SheetColumn { warp, weft, mean };

// One row in SI: N m, N, N/m (of an angle: per radian), J/m^2, m, kg/m^2, ratios for percentages.
struct SheetRow {
  double value[3] = {kNone, kNone, kNone};  // by SheetColumn
  std::string unit;                         // as printed
  std::string place;                        // "sheet.csv:4"

  bool has(SheetColumn column) const;
  // Along warp or weft: of its own, else the mean; kNone if neither is there.
  double along(SheetColumn column) const;
  double mean() const;  // stated, or of warp and weft; kNone
};

struct KesSheet {
  std::string name;                     // of the fabric: in the sheet, or of its file
  std::map<std::string, SheetRow> row;  // by "B", "2HB", "G", ...
  std::vector<std::string> warnings;    // what is doubtful, by row and column

  bool has(const std::string& quantity) const { return row.contains(quantity); }
  double along(const std::string& quantity, SheetColumn column) const;  // kNone: not there
  double mean(const std::string& quantity) const;
};

// Throws Error::system, Error::invalid_input with file, row and column: no B or no 2HB, unknown quantities
// and units, cells that are no numbers, numbers that no fabric has (with the unit in which one would), T0 <
// TM. Warned of, since it may be so: a blank beside a number, numbers of one test that contradict each other
// (WT beside LT and EMT, warp and weft exchanged), ratios that no woven cloth has.
KesSheet read_kes_sheet(const std::filesystem::path& file);

// A sheet to fill in, with the unit, the meaning and the usual range of each row as comments.
std::string kes_sheet_template();

// A fabric's file from the sheet, and what a reader has to know of it.
struct SheetFabric {
  std::string text;                  // TOML for read_fabric()
  std::vector<std::string> assumed;  // what the sheet does not say, the number that moves a drape most first
};

// b2 = B and b1 = B + 2HB/k0 along warp, with k0 the assumed one as the geometric mean of warp and weft,
// weft-bending and weft-friction the ratios along weft, bias their mean; shear = G with a stop of moment
// 2HG/2, which grows with the angle so that it is 2HG5/2 at 5 degrees; warp and weft such that 500 gf/cm
// extend them by EMT; friction = MIU; thickness = T0; density = W. What the sheet lacks is that of the
// shipped fabrics, assumed, with its range.
SheetFabric fabric_of_sheet(const KesSheet& sheet, const Assumptions& assumptions);

}  // namespace hysteron
