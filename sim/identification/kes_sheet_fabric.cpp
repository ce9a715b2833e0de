// Makes a fabric's file from a KES-F sheet.
#include <cmath>

#include "sim/identification/kes_sheet.h"
#include "sim/identification/sheet_writer.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/key_table.h"
#include "sim/scene/scene.h"

namespace hysteron {
namespace {

constexpr double kTestedTension = InPlaneProtocol().largest;  // [N/m]
// It is chosen here that friction of shear has slipped before 0.5 degree, where the window of G begins.
constexpr double kShearThreshold = 0.25 * kDegree;
// The half width of the loop of shear grows per unit of shear by at most this share of G (chosen here): where
// stops slip on the way back to no shear the cloth has G less twice as much, which must stay positive.
constexpr double kSteepestGrowth = 0.45;

void write_bending(SheetWriter& writer, const Assumptions& assumptions) {
  const KesSheet& sheet = writer.sheet;
  const auto along = [&](const char* row, SheetColumn column) { return sheet.along(row, column); };
  const double b = along("B", SheetColumn::warp), width = along("2HB", SheetColumn::warp),
               weft = along("B", SheetColumn::weft) / b, friction = along("2HB", SheetColumn::weft) / width;
  // Along weft friction saturates at k0 over the ratio of its moments: this choice keeps both directions near
  // the assumed value.
  const double spread = std::sqrt(friction);
  Estimate k0 = assumptions.assumed_k0();
  k0.value *= spread, k0.low *= spread, k0.high *= spread;
  if (friction != 1) k0.source += "; along warp, so that it is the geometric mean of warp and weft";
  writer.derived("b1", "N m", b + width / k0.value,
                 "B + 2HB/k0 along warp, so that the friction moment (b1 - b2) k0/2 is HB");
  writer.published("b2", "N m", b, "B along warp");
  writer.entry("k0", "1/m", k0);
  writer.derived("weft-bending", "", weft, "B along weft over B along warp");
  writer.derived("weft-friction", "", friction, "2HB along weft over 2HB along warp");
  writer.suppose_bias(weft);
}

// Writes the ratio of bends to the back to bends to the face: one ratio for warp and weft.
void write_back(SheetWriter& writer, const char* key, const char* back, const char* face) {
  const KesSheet& sheet = writer.sheet;
  const auto ratio = [&](SheetColumn column) {
    return sheet.along(back, column) / sheet.along(face, column);
  };
  // One direction alone, or means, yield one ratio.
  const SheetRow& measured = sheet.row.at(back);
  const bool has_warp = measured.has(SheetColumn::warp), has_weft = measured.has(SheetColumn::weft);
  const double of_means = sheet.mean(back) / sheet.mean(face);
  const double warp = has_warp   ? ratio(SheetColumn::warp)
                      : has_weft ? ratio(SheetColumn::weft)
                                 : of_means,
               weft = has_weft ? ratio(SheetColumn::weft) : warp;
  const auto rounded = [](double x) { return std::round(1e5 * x) / 1e5; };
  constexpr double kSame = 1e-4;
  Estimate mean{rounded(std::sqrt(warp * weft)), kNone, true, std::string(back) + " over " + face, "derived"};
  if (std::abs(warp / weft - 1) > kSame) {
    mean.source += ", the geometric mean of warp and weft; the range is from one to the other";
    mean.low = rounded(std::min(warp, weft));
    mean.high = rounded(std::max(warp, weft));
  }
  writer.entry(key, "", mean);
}

void write_faces(SheetWriter& writer) {
  constexpr double kApart = 1.5;  // chosen here
  const bool rigidity = writer.sheet.has("B-back"), friction = writer.sheet.has("2HB-back");
  const auto suppose = [&](const char* key, const char* of) {
    writer.suppose(key, "", 1, 1 / kApart, kApart,
                   std::string("the sheet has bends to the back without ") + of + ": as to the face");
  };
  if (rigidity)
    write_back(writer, "back-bending", "B-back", "B");
  else if (friction)
    suppose("back-bending", "B-back");
  if (friction)
    write_back(writer, "back-friction", "2HB-back", "2HB");
  else if (rigidity)
    suppose("back-friction", "2HB-back");
}

// Friction of shear: the half width of its loop is at_rest + rise x at the shear x.
struct ShearFriction {
  double at_rest, rise;  // [N/m]

  double growth() const { return rise / at_rest; }  // per unit of shear
  // Returns the threshold.  On the way back from the tester's 8 degrees friction has turned before 5, and on
  // each loading before 0.5: the limits at both ends of a way are less than the way together.
  double threshold() const {
    constexpr double kWellBefore = 0.9;
    const double largest = shear_at(InPlaneProtocol().angle), read = second_width_shear();
    return std::min(kShearThreshold, kWellBefore * (largest - read) / (2 + growth() * (largest + read)));
  }
  static double shear_at(double degrees) { return std::tan(degrees * kDegree); }
  static double width_shear() { return shear_at(InPlaneProtocol().width_at); }
  static double second_width_shear() { return shear_at(InPlaneProtocol().second_width_at); }
};

// Returns friction whose loop is 2HG wide at 0.5 degree and 2HG5 at 5, as far as a cloth of the shear
// rigidity G bears it.
ShearFriction shear_friction(const KesSheet& sheet, double rigidity) {
  const double half = sheet.mean("2HG") / 2, first = ShearFriction::width_shear(),
               second = ShearFriction::second_width_shear();
  if (!(sheet.mean("2HG5") / 2 > half)) return {half, 0};
  constexpr double kOfHalf = 0.5;  // largest share of the half width at 0.5 degree that has grown since zero
  const double rise = std::min({(sheet.mean("2HG5") / 2 - half) / (second - first),
                                kSteepestGrowth * rigidity, kOfHalf * half / first});
  return {half - rise * first, rise};
}

void write_shear_stop(SheetWriter& writer, const ShearFriction& friction) {
  const double threshold = friction.threshold();
  writer.tables += "\n[membrane.stops.shear]\nthresholds = [" + number_text(threshold, 6) +
                   "]\nstiffnesses = [" + number_text(friction.at_rest / threshold, 6) + "]\n";
  if (friction.rise > 0)
    writer.tables += fabric_entry("growth", "1",
                                  {friction.growth(), kNone, true,
                                   "such that the loop is 2HG wide at 0.5 degree and 2HG5 at 5", "derived"});
  writer.tables += std::string("source = \"") +
                   (friction.rise > 0 ? "half the loop's width at no shear, by 2HG and 2HG5," : "2HG/2") +
                   " over the threshold, which is assumed: below 0.5 degree\"\nconfidence = \"derived\"\n";
}

void write_shear(SheetWriter& writer) {
  const KesSheet& sheet = writer.sheet;
  constexpr double kTypical = 60, kLow = 30, kHigh = 110;  // [N/m]
  const double rigidity = sheet.has("G") ? sheet.mean("G") : kTypical;
  const ShearFriction friction = sheet.has("2HG") ? shear_friction(sheet, rigidity) : ShearFriction{0, 0};
  if (!sheet.has("G"))
    writer.suppose("shear", "N/m", kTypical, kLow, kHigh,
                   "not in the sheet: typical of KES-FB1 on woven fabrics");
  else if (friction.rise > 0)
    writer.derived("shear", "N/m", rigidity - friction.rise,
                   "G per radian, the mean of both directions, less what friction that grows adds to it");
  else
    writer.published("shear", "N/m", rigidity, "G per radian, the mean of both directions");
  if (sheet.has("2HG")) write_shear_stop(writer, friction);
}

void write_tension(SheetWriter& writer) {
  const KesSheet& sheet = writer.sheet;
  for (const auto& [name, column] : {std::pair{"warp", SheetColumn::warp}, {"weft", SheetColumn::weft}}) {
    const bool by_work = !sheet.has("EMT") && sheet.has("WT") && sheet.has("LT");
    const double e = by_work ? 2 * sheet.along("WT", column) / (sheet.along("LT", column) * kTestedTension)
                             : sheet.along("EMT", column);
    if (std::isfinite(e)) {
      writer.derive_stiffness(name, kTestedTension, e,
                              std::string("such that 500 gf/cm extend it by ") +
                                  (by_work ? "2 WT/(LT 500 gf/cm)" : "EMT") +
                                  ": a straight line, which has LT = 1 and no friction");
    } else {
      writer.suppose(name, "N/m", 10000, 5000, 30000,
                     "not in the sheet: that of a denim, half to three times");
    }
  }
}

}  // namespace

SheetFabric fabric_of_sheet(const KesSheet& sheet, const Assumptions& assumptions) {
  SheetWriter writer(sheet);
  write_bending(writer, assumptions);
  write_faces(writer);
  write_shear(writer);
  write_tension(writer);
  writer.write_rest("T0");
  writer.write_drapes();
  writer.tell_k0(assumptions.assumed_k0(), "where bending friction saturates, which KES-FB2 does not read");
  return writer.fabric("fit --kes-sheet", "from the sheet of a KES-F laboratory");
}

}  // namespace hysteron
