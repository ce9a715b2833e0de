#include "sim/identification/fast_sheet.h"

#include <cmath>
#include <numbers>

#include "sim/base/error.h"
#include "sim/identification/sheet_writer.h"
#include "sim/reference/elastica.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

const std::string kFastReader = "fit --fast-sheet";
constexpr double kOverEdge = 41.5 * std::numbers::pi / 180;
constexpr double kSmallLoad = 5 * kGramForcePerCentimetre, kMiddleLoad = 20 * kGramForcePerCentimetre,
                 kLargeLoad = 100 * kGramForcePerCentimetre;  // [N/m]

// The quantities as a FAST chart prints them, with the range of clothing (De Boos & Tester 1994).
constexpr SheetQuantity kFastQuantities[] = {
    {"C", "mm", "m", "bending length (FAST-2, ASTM D1388); a row for each specimen, if you have them", 8, 60,
     true, true},
    {"B", "uN m", "N m", "rigidity of that length, to check it", 0.5, 60, true},
    {"E5", "%", "", "extension at 5 gf/cm", 0.05, 15, true, true},
    {"E20", "%", "", "extension at 20 gf/cm", 0.1, 30, true, true},
    {"E100", "%", "", "extension at 100 gf/cm", 0.3, 60, true, true},
    {"EB5", "%", "", "extension along the bias at 5 gf/cm", 0.5, 20, false, true},
    {"G", "N/m", "N/m", "shear rigidity, to check EB5", 8, 200, false},
    {"T2", "mm", "m", "thickness at 2 gf/cm^2", 0.08, 8, false, true},
    {"T100", "mm", "m", "thickness at 100 gf/cm^2", 0.05, 6, false, true},
    {"W", "g/m^2", "kg/m^2", "weight", 20, 1200, false, true},
    kDrapeOfJis,
    kDrapeOfIso,
};

// Returns the chord angle [rad] to which an overhang of twice the bending length [m], of that weight [N/m^2],
// hangs after first bending.
double chord_of_overhang(double bending_length, double weight, const VirginCurve& curve) {
  HeavyStrip strip;
  strip.law = {"prandtl", curve, {}};
  strip.weight = weight;
  strip.length = 2 * bending_length;
  strip.segments = 60;
  constexpr int kSteps = 12;  // of a load that only rises
  return sagging_strips(strip, {1}, kSteps).front().chord_angle();
}

// Finds where a function of the logarithm passes 0 between low and high, by regula falsi in which an end that
// stays counts half (Dowell & Jarratt 1971).
template <class Function>
double root_between(double low, double high, const Function& function) {
  constexpr int kMostSteps = 30;
  constexpr double kPrecision = 1e-4;  // of the logarithm
  double x[] = {std::log(low), std::log(high)}, y[] = {function(low), function(high)};
  for (int step = 0, stays = -1; step < kMostSteps && std::abs(x[1] - x[0]) > kPrecision; ++step) {
    const double middle = (x[0] * y[1] - x[1] * y[0]) / (y[1] - y[0]), value = function(std::exp(middle));
    const int end = value * y[1] > 0 ? 1 : 0;
    if (std::abs(x[end] - middle) < kPrecision) return std::exp(middle);
    x[end] = middle, y[end] = value;
    if (stays == 1 - end) y[1 - end] /= 2;
    stays = 1 - end;
  }
  return std::exp((x[0] + x[1]) / 2);
}

double shear_of_bias(double extension) { return kSmallLoad / (4 * extension); }

double apparent_rigidity(const FastSheet& sheet, SheetColumn column) {
  return kLaboratoryGravity * sheet.mean("W") * std::pow(sheet.along("C", column), 3);
}

void warn_of_contradicting_rows(FastSheet& sheet) {
  for (const auto& [name, column] : {std::pair{"warp", SheetColumn::warp}, {"weft", SheetColumn::weft}}) {
    if (sheet.has("B"))
      if (const double ratio = sheet.along("B", column) / apparent_rigidity(sheet, column);
          std::abs(ratio - 1) > kPrintedDigits)
        sheet.warn("B", std::string("along ") + name + " is " + number_text(ratio, 3) +
                            " times W g C^3, which it should be: one of the three is in another unit");
    if (sheet.has("E20") && sheet.has("E100") && !(sheet.along("E20", column) < sheet.along("E100", column)))
      sheet.warn("E20", std::string("along ") + name + " is not less than E100: are they exchanged?");
  }
  if (sheet.has("E5") && !sheet.has("E20") && !sheet.has("E100"))
    sheet.warn("E5", "is not used: cloth crimps under so little, and its stretch is that of E100 or E20");
  if (sheet.has("G") && sheet.has("EB5"))
    if (const double ratio = sheet.mean("G") / shear_of_bias(sheet.mean("EB5"));
        std::abs(ratio - 1) > kPrintedDigits)
      sheet.warn("G", "is " + number_text(ratio, 3) +
                          " times 123/EB5, which it should be: one of them is in another "
                          "unit");
}

void check_fast_sheet(FastSheet& sheet, const std::string& file) {
  check_laboratory_sheet(sheet,
                         {kFastReader,
                          {"C", "W"},
                          ": bending is known from a bending length and a weight",
                          "T2",
                          "T100",
                          "under 100 gf/cm^2 than under 2"},
                         file);
  warn_of_contradicting_rows(sheet);
}

// Returns b2 [N m] along a direction, for the assumed friction over rigidity [1/m].  Friction along other
// directions than warp has moments and curvatures in the ratio of the rigidities (Fabric::friction_ratios()):
// its k0 is smaller by that ratio.
double rigidity_along(const FastSheet& sheet, SheetColumn column, double over_rigidity,
                      const std::function<double(double b2)>& k0) {
  return rigidity_of_bending_length(sheet.along("C", column), kLaboratoryGravity * sheet.mean("W"),
                                    [&](double b2) {
                                      return StripFriction{over_rigidity * b2, k0(b2)};
                                    });
}

void write_bending_of_length(SheetWriter& writer, const Assumptions& assumptions) {
  const FastSheet& sheet = writer.sheet;
  const Estimate k0 = assumptions.assumed_k0();
  const auto along_warp = [&](double friction) {
    return rigidity_along(sheet, SheetColumn::warp, friction, [&](double) { return k0.value; });
  };
  const double b = along_warp(kAssumedFriction), hb = kAssumedFriction * b,
               stiffest = along_warp(kLeastFriction), limpest = along_warp(kMostFriction),
               least = kLeastFriction * stiffest, most = kMostFriction * limpest;
  const double weft = rigidity_along(sheet, SheetColumn::weft, kAssumedFriction,
                                     [&](double b2) { return k0.value * b / b2; }) /
                      b;
  const double scatter = 3 * sheet.row.at("C").relative_error(SheetColumn::warp);
  const std::string share = number_text(100 * (1 - b / apparent_rigidity(sheet, SheetColumn::warp)), 2);
  writer.derived("b1", "N m", b + 2 * hb / k0.value,
                 "b2 + 2HB/k0, so that the friction moment (b1 - b2) k0/2 is HB");
  Estimate b2{
      b, std::isfinite(scatter) ? scatter * b : kNone, true,
      "C along warp: an overhang of 2 C hangs at 41.5 degrees after first bending, beside the assumed "
      "friction, which carries " +
          share + " % of W g C^3",
      "derived"};
  writer.entry("b2", "N m", b2);
  writer.entry("k0", "1/m", k0);
  writer.derived("weft-bending", "", weft, "C along weft as along warp, b2 over b2");
  writer.derived("weft-friction", "", weft, "as weft-bending: friction over rigidity is assumed alike");
  writer.suppose_bias(weft);
  writer.published_table +=
      "bending-length = {value = " + number_text(sheet.along("C", SheetColumn::warp), 6) +
      ", unit = \"m\", source = \"the sheet's C along warp\", confidence = \"published\"}\nB = {value = " +
      number_text(b, 6) +
      ", unit = \"N m\", source = \"the bending length beside the assumed friction\", confidence = "
      "\"derived\"}\n2HB = {value = " +
      number_text(2 * hb, 6) +
      ", unit = \"N\", source = \"not measured by a cantilever: " + number_text(kAssumedFriction) +
      "/m times B, between the lowest and the highest of four shipped fabrics and six denims (Kumari, "
      "Khurana "
      "2016)\", confidence = \"assumed\", range = [" +
      number_text(2 * least, 6) + ", " + number_text(2 * most, 6) + "]}\n";
  writer.assumed.push_back(
      "2HB = " + number_text(2 * hb, 3) + " N along warp, between " + number_text(2 * least, 3) + " and " +
      number_text(2 * most, 3) + ": no cantilever measures friction; B is then " + number_text(b, 3) +
      " N m (" + number_text(stiffest, 3) + " to " + number_text(limpest, 3) + "), where W g C^3 is " +
      number_text(apparent_rigidity(sheet, SheetColumn::warp), 3));
  if (std::isfinite(scatter))
    writer.assumed.push_back("B has a standard error of " + number_text(100 * scatter, 2) +
                             " % from the repeats of C, which is measured, not assumed");
}

void write_shear_of_bias(SheetWriter& writer) {
  const FastSheet& sheet = writer.sheet;
  if (sheet.has("EB5"))
    writer.derived("shear", "N/m", shear_of_bias(sheet.mean("EB5")), "123/EB5 (De Boos, Tester 1994)");
  else if (sheet.has("G"))
    writer.published("shear", "N/m", sheet.mean("G"), "G");
  else
    writer.suppose("shear", "N/m", 60, 30, 110, "not in the sheet: typical of woven fabrics");
}

void write_extension(SheetWriter& writer) {
  const FastSheet& sheet = writer.sheet;
  const bool is_large = sheet.has("E100");
  const double load = is_large ? kLargeLoad : kMiddleLoad;
  for (const auto& [name, column] : {std::pair{"warp", SheetColumn::warp}, {"weft", SheetColumn::weft}}) {
    const double e = sheet.along(is_large ? "E100" : "E20", column);
    if (std::isfinite(e))
      writer.derived(
          name, "N/m", load / ((e + e * e / 2) * (1 + e)),
          is_large ? "such that 100 gf/cm extend it by E100" : "such that 20 gf/cm extend it by E20");
    else
      writer.suppose(name, "N/m", 10000, 3000, 30000,
                     "not in the sheet: that of a denim, a third to three times");
  }
}

}  // namespace

FastSheet read_fast_sheet(const std::filesystem::path& file) {
  FastSheet sheet = read_laboratory_sheet(file, kFastReader, kFastQuantities);
  check_fast_sheet(sheet, file.filename().string());
  return sheet;
}

std::string fast_sheet_template() {
  return sheet_template(
      "# The sheet of a FAST laboratory, or of a cantilever alone: C and W have to be there, everything else "
      "may\n"
      "# stay blank.  Fill in warp and weft, or the mean alone.  Another unit may stand in place of the "
      "printed "
      "one.\n",
      kFastQuantities);
}

double rigidity_of_bending_length(double bending_length, double weight, const FrictionOfRigidity& friction) {
  const double apparent = weight * std::pow(bending_length, 3);
  return root_between(apparent / 30, 1.5 * apparent, [&](double b2) {
    const auto [moment, k0] = friction(b2);
    return kOverEdge - chord_of_overhang(bending_length, weight, {b2 + 2 * moment / k0, b2, k0});
  });
}

double virtual_bending_length(const VirginCurve& curve, double density) {
  const double weight = kLaboratoryGravity * density, elastic = std::cbrt(curve.b2 / weight);
  return root_between(elastic / 2, 5 * elastic,
                      [&](double length) { return chord_of_overhang(length, weight, curve) - kOverEdge; });
}

SheetFabric fabric_of_fast_sheet(const FastSheet& sheet, const Assumptions& assumptions) {
  SheetWriter writer(sheet);
  write_bending_of_length(writer, assumptions);
  write_shear_of_bias(writer);
  write_extension(writer);
  writer.write_rest("T2");
  writer.write_drapes();
  writer.tell_k0(assumptions.assumed_k0(), "where bending friction saturates");
  return writer.fabric(kFastReader, "from the sheet of a FAST laboratory or a cantilever");
}

}  // namespace hysteron
