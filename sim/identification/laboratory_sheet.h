// Reads the sheet of a textile laboratory: a row for each quantity, as it is printed, along warp and weft.
//
//   quantity,unit,warp,weft,mean
//   B,gf cm^2/cm,0.118,0.094,
//   W,mg/cm^2,,,12.4
//
// A row fills warp and weft, or the mean of both.  Sheets are CSV (with any separator and decimal mark that
// csv.h reads) or TOML: [B] unit = "gf cm^2/cm", warp = 0.118, weft = 0.094.  A test that is repeated has a
// row for each specimen.  Each laboratory has its own quantities (kes_sheet.h, fast_sheet.h).
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/identification/identification.h"

namespace hysteron {

enum class SheetColumn { warp, weft, mean };
const char* column_name(SheetColumn column);

// Numbers of two digits contradict each other beyond this share.
inline constexpr double kPrintedDigits = 0.1;

// A row as it is printed, its unit and the one in SI, and the range of printed numbers of clothing.  A number
// below half or above twice that range is taken to be in another unit.
struct SheetQuantity {
  const char *name, *unit, *si, *meaning;
  double low, high;
  bool has_directions;
  bool may_repeat = false;  // rows of several specimens
};

// One quantity in SI: N m, N, N/m (for an angle: per radian), J/m^2, m, kg/m^2, ratios for percentages.
struct SheetRow {
  std::array<double, 3> value = {kNone, kNone, kNone};  // by SheetColumn; the mean of repeats
  std::string unit;                                     // as printed
  std::string place;                                    // "sheet.csv:4"
  std::array<std::vector<double>, 3> repeats = {};      // by SheetColumn: each specimen's

  bool has(SheetColumn column) const;
  // Returns the value along warp or weft: its own, else the mean; kNone if neither is there.
  double along(SheetColumn column) const;
  double mean() const;  // as stated, or of warp and weft; else kNone
  // Returns the standard error of along() over its value, from the scatter of repeats; kNone for fewer than
  // two.
  double relative_error(SheetColumn column) const;
};

struct LaboratorySheet {
  std::string name;                     // of the fabric: in the sheet, or that of its file
  std::map<std::string, SheetRow> row;  // by "B", "2HB", "G", ...
  std::vector<std::string> warnings;    // by row and column

  bool has(const std::string& quantity) const { return row.contains(quantity); }
  double along(const std::string& quantity, SheetColumn column) const;  // kNone: not there
  double mean(const std::string& quantity) const;
  // Adds the warning "W (sheet.csv:4) what", about a row that is there.
  void warn(const std::string& quantity, const std::string& what);
};

// Reads a sheet; `reader` says who asks, "fit --kes-sheet".  Throws Error::system, Error::invalid_input with
// file, row and column: unknown quantities and units, cells that are not numbers, numbers that no fabric has
// (with the unit in which one would).  Warns of blanks beside a number, and of a mean that contradicts its
// warp and weft.
LaboratorySheet read_laboratory_sheet(const std::filesystem::path& file, const std::string& reader,
                                      std::span<const SheetQuantity> quantities);
// Returns the error of a sheet: "fit --kes-sheet: what (place)".
Error sheet_refusal(const std::string& reader, const std::string& what, const std::string& place);

// Rows that every laboratory's sheet may have: a drape coefficient with its tester, for comparison only.
inline constexpr SheetQuantity kDrapeOfJis = {
    "DC-JIS", "%", "", "drape coefficient of 254 mm on 127 mm (JIS L 1096), to compare with", 10, 98, false};
inline constexpr SheetQuantity kDrapeOfIso = {
    "DC-ISO9073", "%", "",   "drape coefficient of 300 mm on 180 mm (ISO 9073-9), to compare with",
    10,           98,  false};

// The rules for a laboratory's sheet.
struct SheetRules {
  std::string reader;
  std::vector<const char*> needed;
  const char* why_needed;
  const char *thick, *thin, *pressed;  // rows of a thickness, and of that under pressure, in words
};
// Throws Error::invalid_input for a sheet that lacks a needed row, has two drapes, or is thicker under the
// larger pressure.
void check_laboratory_sheet(const LaboratorySheet& sheet, const SheetRules& rules, const std::string& file);

// Returns a sheet to fill in below that head (comments), with unit, meaning and usual range of each row.
std::string sheet_template(const std::string& head, std::span<const SheetQuantity> quantities);

// A fabric's file from the sheet, and the warnings for its reader.
struct SheetFabric {
  std::string text;                  // TOML for read_fabric()
  std::vector<std::string> assumed;  // numbers that the sheet lacks, the one that moves a drape most first
};

}  // namespace hysteron
