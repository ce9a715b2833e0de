#include "sim/identification/kes_sheet.h"

#include <cmath>

#include "sim/identification/published.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

const std::string kKesReader = "fit --kes-sheet";

// The quantities as KES-F prints them, with the range of clothing (Kawabata 1980; the six denims of Kumari &
// Khurana 2016 and the four shipped pairs lie well within).
constexpr SheetQuantity kKesQuantities[] = {
    {"LT", "1", "", "linearity of tension", 0.3, 1.3, true},
    {"WT", "gf cm/cm^2", "J/m2", "work of tension up to 500 gf/cm", 0.5, 80, true},
    {"RT", "%", "", "resilience of tension", 15, 100, true},
    {"EMT", "%", "", "extension at 500 gf/cm", 0.5, 80, true},
    {"B", "gf cm^2/cm", "N m", "bending rigidity", 0.004, 2, true},
    {"2HB", "gf cm/cm", "N", "width of the loop of bending at 1/cm", 0.002, 2, true},
    {"B-back", "gf cm^2/cm", "N m", "B of bends to the back, where B is that of bends to the face", 0.004, 2,
     true},
    {"2HB-back", "gf cm/cm", "N", "2HB of bends to the back, where 2HB is that of bends to the face", 0.002,
     2, true},
    {"G", "gf/(cm degree)", "N/m", "shear rigidity", 0.15, 8, true},
    {"2HG", "gf/cm", "N/m", "width of the loop of shear at 0.5 degree", 0.1, 15, true},
    {"2HG5", "gf/cm", "N/m", "width of the loop of shear at 5 degrees", 0.1, 20, true},
    {"LC", "1", "", "linearity of compression", 0.1, 1.1, false},
    {"WC", "gf cm/cm^2", "J/m2", "work of compression up to 50 gf/cm^2", 0.01, 4, false},
    {"RC", "%", "", "resilience of compression", 15, 100, false},
    {"MIU", "1", "", "mean coefficient of friction", 0.06, 0.7, true},
    {"MMD", "1", "", "mean deviation of MIU", 0.002, 0.2, true},
    {"SMD", "um", "m", "roughness", 0.5, 40, true},
    {"T0", "mm", "m", "thickness at 0.5 gf/cm^2", 0.08, 8, false},
    {"TM", "mm", "m", "thickness at 50 gf/cm^2", 0.05, 6, false},
    {"W", "mg/cm^2", "kg/m^2", "weight", 2, 120, false},
    kDrapeOfJis,
    kDrapeOfIso,
};

constexpr double kLargestTension = InPlaneProtocol().largest;  // [N/m]
constexpr double kLargestPressure = 50 * 98.0665;              // [Pa]

struct Warnings {
  KesSheet& sheet;

  // Returns WT over LT T EMT/2 with T = 500 gf/cm; in one test they are equal.
  double work_over_its_parts(SheetColumn of_work, SheetColumn of_parts) const {
    return sheet.along("WT", of_work) /
           (sheet.along("LT", of_parts) * kLargestTension * sheet.along("EMT", of_parts) / 2);
  }
  void of_tension() {
    if (!sheet.has("WT") || !sheet.has("LT") || !sheet.has("EMT")) return;
    for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft}) {
      const SheetColumn other = column == SheetColumn::warp ? SheetColumn::weft : SheetColumn::warp;
      const double own = work_over_its_parts(column, column), exchanged = work_over_its_parts(column, other);
      if (!(std::abs(own - 1) > kPrintedDigits)) continue;
      const std::string along = column_name(column);
      if (std::abs(exchanged - 1) < kPrintedDigits)
        sheet.warn("WT", "along " + along +
                             " is LT times 500 gf/cm times EMT/2 of the other direction: warp and weft are "
                             "exchanged in one of these rows");
      else
        sheet.warn(
            "WT",
            "along " + along + " is " + number_text(own, 3) +
                " times LT times 500 gf/cm times EMT/2, which it should be: one of the three is in another "
                "unit, or of another load");
    }
  }
  void of_compression() {
    if (!sheet.has("WC") || !sheet.has("LC") || !sheet.has("T0") || !sheet.has("TM")) return;
    const double way = sheet.mean("T0") - sheet.mean("TM");
    const double ratio = sheet.mean("WC") / (sheet.mean("LC") * kLargestPressure * way / 2);
    constexpr double kOfThickness = 0.3;  // differences of thicknesses are printed to few digits
    if (!(std::abs(ratio - 1) < kOfThickness))
      sheet.warn("WC", "is " + number_text(ratio, 3) +
                           " times LC times 50 gf/cm^2 times (T0 - TM)/2, which it should be");
  }
  // Warns of a ratio beyond that of woven cloth, [low, high] in the given unit.
  void of_ratio(const char* above, const char* below, double unit, const char* text, double low,
                double high) {
    if (!sheet.has(above) || !sheet.has(below)) return;
    for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft}) {
      const double ratio = sheet.along(above, column) / sheet.along(below, column) / unit;
      const std::string warning = woven_ratio_warning(ratio, text, below, low, high);
      if (!warning.empty()) sheet.warn(above, std::string("along ") + column_name(column) + " " + warning);
    }
  }
  // Warns if friction of one k0 for both directions would saturate in the tester's window along one of them.
  void of_directions() {
    constexpr double kFarApart = 25;
    const double ratio = sheet.along("2HB", SheetColumn::weft) / sheet.along("2HB", SheetColumn::warp);
    if (ratio > kFarApart || ratio < 1 / kFarApart)
      sheet.warn("2HB",
                 "along weft is " + number_text(ratio, 3) +
                     " times that along warp: is one of them in another unit? This model cannot return both");
  }
  // Warns of very different faces: one sheet of cloth has two faces of the same yarns.
  void of_faces() {
    constexpr double kFarApart = 3;
    for (const auto& [back, face] : {std::pair{"B-back", "B"}, {"2HB-back", "2HB"}})
      of_ratio(back, face, 1, "times", 1 / kFarApart, kFarApart);
  }
  void of_weight() {
    if (!sheet.has("W") || !sheet.has("T0")) return;
    const double bulk = sheet.mean("W") / sheet.mean("T0");
    if (bulk < 40 || bulk > 1300)
      sheet.warn("W", "over T0 makes " + number_text(bulk, 3) + " kg/m^3, and fabrics have 40 to 1300");
  }
};

void check_sheet(KesSheet& sheet, const std::string& file) {
  check_laboratory_sheet(sheet,
                         {kKesReader,
                          {"B", "2HB"},
                          ", which KES-FB2 prints: bending is not known",
                          "T0",
                          "TM",
                          "under 50 gf/cm^2 than under 0.5"},
                         file);
  Warnings warnings{sheet};
  warnings.of_tension();
  warnings.of_compression();
  warnings.of_ratio("2HB", "B", 1, "1/m", kLeastWidthOverB, kMostWidthOverB);
  warnings.of_ratio("2HG", "G", kDegree, "degree", 0.3, 8);
  warnings.of_ratio("2HG5", "2HG", 1, "times", 0.8, 5);
  warnings.of_directions();
  warnings.of_faces();
  warnings.of_weight();
}

}  // namespace

KesSheet read_kes_sheet(const std::filesystem::path& file) {
  KesSheet sheet = read_laboratory_sheet(file, kKesReader, kKesQuantities);
  check_sheet(sheet, file.filename().string());
  return sheet;
}

std::string kes_sheet_template() {
  return sheet_template(
      "# The sheet of a KES-F laboratory.  Fill in warp and weft, or the mean alone; leave blank what was "
      "not\n"
      "# measured (B and 2HB have to be there).  Another unit may stand in place of the printed one, SI as "
      "well.\n",
      kKesQuantities);
}

}  // namespace hysteron
