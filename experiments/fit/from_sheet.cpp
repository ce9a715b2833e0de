#include "experiments/fit/from_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "experiments/specimens/cantilever_strip.h"
#include "sim/base/csv.h"
#include "sim/base/units.h"
#include "sim/reference/kes.h"
#include "sim/reference/kes_in_plane.h"

namespace hysteron::experiments {
namespace {

constexpr double kAgrees = 1, kSidesAgree = 0.5;  // [%]; smaller differences need no reason

Along direction_of(SheetColumn column) { return column == SheetColumn::weft ? Along::weft : Along::warp; }

KesReading bend(const Fabric& fabric, SheetColumn column, int steps) {
  KesProtocol protocol;
  protocol.minor_loops = false;
  protocol.steps = steps;
  return test_in_kes({"prandtl", curve_along(fabric, direction_of(column)), {}}, protocol).reading;
}

constexpr const char *kStraight = "tension is a straight line without friction: LT = 1 and RT = 100 %",
                     *kOneShear = "the shear of this model is the same along warp and weft: their mean",
                     *kOneRatio = "back over face is one ratio for warp and weft: their geometric mean",
                     *kNoFriction = "without 2HG the shear of this model has no friction",
                     *kNotLess = "friction of shear grows with the angle or stays; it does not fall",
                     *kNoCloth = "no woven cloth has a 2HG5 of more than five times 2HG",
                     *kMostGrowth =
                         "friction that grew so much would leave no stiffness on the way back to no shear";

// Returns why the tester's 2HG5 differs from the entered one.
const char* second_width_reason(const KesSheet& sheet, double read) {
  if (!sheet.has("2HG")) return kNoFriction;
  const double entered = sheet.mean("2HG5"), first = sheet.mean("2HG");
  if (entered < first) return kNotLess;
  if (read >= (1 - kAgrees / 100) * entered) return kOneShear;
  return entered > 5 * first ? kNoCloth : kMostGrowth;
}

// Compares the sheet's numbers along one direction with those that a tester reads.
struct Beside {
  const LaboratorySheet& sheet;
  SheetColumn column;
  std::vector<SheetReading>& all;

  void add(const char* quantity, const char* unit, const char* si, double read, const char* reason) const {
    const double entered = sheet.along(quantity, column);
    if (std::isfinite(entered)) all.push_back({quantity, unit, si, column, entered, read, reason});
  }
};

void add_direction(std::vector<SheetReading>& all, const KesSheet& sheet, const Fabric& fabric,
                   SheetColumn column, int steps) {
  const Beside beside{sheet, column, all};
  const KesReading bending = bend(fabric, column, steps);
  const KesPair face =
      fabric.bending.faces.on() ? bending.face : KesPair{bending.rigidity, bending.loop_width};
  beside.add("B", "gf cm^2/cm", "N m", face.rigidity, "");
  beside.add("2HB", "gf cm/cm", "N", face.loop_width, "");
  beside.add("B-back", "gf cm^2/cm", "N m", bending.back.rigidity, kOneRatio);
  beside.add("2HB-back", "gf cm/cm", "N", bending.back.loop_width, kOneRatio);
  const InPlaneLaw law = in_plane_law(fabric, direction_of(column));
  InPlaneProtocol in_plane;
  in_plane.steps = steps;
  const ShearReading shear = test_shear(law, in_plane).reading;
  beside.add("G", "gf/(cm degree)", "N/m", shear.stiffness, kOneShear);
  beside.add("2HG", "gf/cm", "N/m", shear.width, kOneShear);
  beside.add("2HG5", "gf/cm", "N/m", shear.second_width, second_width_reason(sheet, shear.second_width));
  const TensionReading tension = test_tension(law, in_plane).reading;
  beside.add("EMT", "%", "", tension.extension / 100, "");
  beside.add("LT", "1", "", tension.linearity, kStraight);
  beside.add("WT", "gf cm/cm^2", "J/m2", tension.work, kStraight);
  beside.add("RT", "%", "", tension.resilience / 100, kStraight);
}

}  // namespace

std::vector<SheetReading> read_by_testers(const KesSheet& sheet, const Fabric& fabric, int steps) {
  std::vector<SheetReading> all;
  for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft})
    add_direction(all, sheet, fabric, column, steps);
  return all;
}

std::vector<SheetReading> read_by_cantilever(const FastSheet& sheet, const Fabric& fabric) {
  std::vector<SheetReading> all;
  for (const SheetColumn column : {SheetColumn::warp, SheetColumn::weft}) {
    const Beside beside{sheet, column, all};
    beside.add("C", "mm", "m",
               virtual_bending_length(curve_along(fabric, direction_of(column)), fabric.density), "");
    const InPlaneLaw law = in_plane_law(fabric, direction_of(column));
    for (const auto& [quantity, load] : {std::pair{"E5", 5}, {"E20", 20}, {"E100", 100}}) {
      InPlaneProtocol protocol;
      protocol.largest = load * kGramForcePerCentimetre;
      beside.add(quantity, "%", "", test_tension(law, protocol).reading.extension / 100, kStraight);
    }
  }
  return all;
}

namespace {

std::string write_comparison(Run& run, const std::vector<SheetReading>& all) {
  Table table("quantity,direction,unit,entered,read,difference [%],reason");
  std::size_t longest = 5;  // length of "2HG5"
  for (const SheetReading& b : all) longest = std::max(longest, std::strlen(b.quantity));
  const std::size_t width = longest + 1;
  std::string text =
      fmt::format("{:<{}}{:<6}{:>10}{:>10}{:>9}  {}\n", "", width, "", "entered", "read", "%", "unit");
  for (const SheetReading& b : all) {
    const double unit = factor_to(b.si, b.unit).value_or(1);
    const bool differs = std::abs(b.difference()) > (b.reason == kOneRatio ? kSidesAgree : kAgrees);
    table.row({b.quantity, column_name(b.column), b.unit, b.entered / unit, b.read / unit, b.difference(),
               differs ? b.reason : ""});
    text += fmt::format("{:<{}}{:<6}{:>10.4g}{:>10.4g}{:>+9.2f}  {}{}\n", b.quantity, width,
                        column_name(b.column), b.entered / unit, b.read / unit, b.difference(), b.unit,
                        differs && *b.reason ? std::string("; ") + b.reason : "");
    run.metric(fmt::format("{}.{}_difference_percent", column_name(b.column), b.quantity), b.difference());
  }
  table.write(run.path("sheet.csv"));
  return text;
}

}  // namespace

std::string report_sheet(Run& run, const LaboratorySheet& sheet, const SheetFabric& found,
                         const std::vector<SheetReading>& readings) {
  const std::string file = run.path("fabric.toml").string();
  std::string text = sheet.name + ": the sheet beside what the virtual testers read of the fabric\n" +
                     write_comparison(run, readings);
  text += "assumed, what moves a drape most first:\n";
  for (const std::string& sentence : found.assumed) text += "  " + sentence + "\n";
  text += "written: " + file + "\n";
  text += "  hysteron drape --fabric " + file + " --errors       the drape, and how far to trust it\n";
  text += "  hysteron validate --parts spread,budget --fabrics " + file +
          "   its interval, and which number moves it\n";
  return text;
}

}  // namespace hysteron::experiments
