#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

// Two lists of one table that must have equally many numbers, those of the first ascending.
struct PairedLists {
  const char* table;  // the table's name in the fabric
  const char* first_name;
  const char* second_name;
  const std::vector<double>& first;
  const std::vector<double>& second;
  std::size_t most;
};

void check_pairs(const Scene& scene, const PairedLists& lists) {
  const std::string table = std::string("fabric.") + lists.table + ".";
  const std::string key = table + lists.first_name;
  const std::string of = lists.first.empty() && !is_given(scene, key) ? table + lists.second_name : key;
  const auto refuse = [&](const std::string& what) {
    throw Error::invalid_input(key + " " + what + " (" + key_origin(scene, of) + ")").with_key(key, "");
  };
  if (lists.first.size() != lists.second.size())
    refuse("has " + std::to_string(lists.first.size()) + " numbers and must have as many as " + table +
           lists.second_name + ", " + std::to_string(lists.second.size()));
  if (lists.first.size() > lists.most)
    refuse("has " + std::to_string(lists.first.size()) + " numbers and must have at most " +
           std::to_string(lists.most));
  for (std::size_t i = 1; i < lists.first.size(); ++i)
    if (!(lists.first[i] > lists.first[i - 1]))
      refuse("must be ascending: " + number_text(lists.first[i]) + " follows " +
             number_text(lists.first[i - 1]));
}

void check_stops(const Scene& scene, const char* table, const Spectrum& of) {
  check_pairs(scene, {table, "thresholds", "stiffnesses", of.thresholds, of.stiffnesses, kMaxStops});
}

}  // namespace

void Fabric::follow_kes() {
  if (kes.gives_numbers()) {
    b2 = kes.read.rigidity;
    b1 = b2 + (k0 > 0 ? kes.read.loop_width / k0 : 0);
    bending.stops = bending.weft_stops = {};
    provenance["b2"] = {"kes-b", "derived"};
    provenance["b1"] = {"kes-b + kes-2hb/k0", "derived"};
  }
  if (!kes.on()) return;
  const ShapedFriction friction = friction_from_kes(kes.read, kes.shape);
  const double first_slope = friction.stops.stiffness();
  b2 = friction.b2;
  b1 = b2 + first_slope;
  k0 = first_slope > 0 ? 2 * friction.stops.friction_moment() / first_slope : 0;
  bending.stops = first_slope > 0 ? friction.stops : Spectrum();
  for (const char* key : {"b2", "bending.stops.thresholds", "bending.stops.stiffnesses"})
    provenance[key] = {"kes-b and kes-2hb with stops-median and stops-spread", "derived"};
  provenance["b1"] = {"b2 and the stops' stiffnesses", "derived"};
  provenance["k0"] = {"2 HB/(b1 - b2) of the stops", "derived"};
}

void follow_stops(Fabric& fabric) {
  const Spectrum& stops = fabric.bending.stops;
  if (stops.empty() || stops.thresholds.size() != stops.stiffnesses.size()) return;
  fabric.b1 = fabric.b2 + stops.stiffness();
  fabric.k0 = 2 * stops.friction_moment() / stops.stiffness();
  fabric.provenance["b1"] = {"b2 and the stops' stiffnesses", "derived"};
  fabric.provenance["k0"] = {"2 HB/(b1 - b2) of the stops", "derived"};
}

void follow_weft(Fabric& fabric) {
  fabric.bias_bending = (1 + fabric.weft_bending) / 2;
  fabric.provenance["bias-bending"] = {"the mean of warp and weft", "assumed"};
}

// Friction whose curvatures and moments along weft are s times those along warp has s^2 times their stiffness
// along weft; its bias ratio is to the mean of both directions as that of the rigidities is.
DirectionRatios Fabric::friction_ratios() const {
  if (!rubs_otherwise()) return rigidity_ratios();
  const double weft = weft_friction * weft_friction;
  return {weft, bias_bending * (1 + weft) / (1 + weft_bending)};
}

// Returns the factor on the threshold of twist, which has half of what bends along warp and along weft need
// (faces.h), and its own elasticity.
double Fabric::widening_of_twist() const {
  const DirectionRatios rigidity = rigidity_ratios(), friction = friction_ratios();
  const auto twist = [](const DirectionRatios& q) { return 2 * q.bias - (1 + q.weft) / 2; };
  if (!(twist(friction) > 0)) return 1;  // twist has no friction
  const double needed = (1 + rigidity.weft / friction.weft) / 2;
  return std::max(1.0, needed * twist(friction) / twist(rigidity));
}

double Fabric::friction_curvature() const { return std::max(k0, KesWindow().slope_from); }

VirginCurve Fabric::virgin_curve() const {
  VirginCurve curve{b1, b2, k0, bending};
  // Laws see curvatures multiplied by the root of the metric (curvature_operator.h).
  for (double& r : curve.parts.weft_stops.thresholds) r *= std::sqrt(weft_bending);
  for (double& p : curve.parts.weft_stops.stiffnesses) p /= weft_bending;
  if (rubs_otherwise()) {
    curve.parts.faces.weft_elastic = rigidity_ratios().weft / friction_ratios().weft;
    curve.parts.faces.wider = widening_of_twist();
  }
  return curve;
}

namespace {

// Refuses b1 and k0 that say another friction than the stops: laws without stops take b1 and k0, and would
// differ from the others by it.
void check_numbers_of_stops(const Scene& scene) {
  constexpr double kDigits = 0.01;  // numbers in a file may be rounded to two digits
  if (scene.fabric.bending.stops.empty()) return;
  Fabric follows = scene.fabric;
  follow_stops(follows);
  const auto check = [&](const std::string& key, double value, double must, const std::string& unit) {
    if (std::abs(value - must) <= kDigits * must) return;
    const std::string stops = "fabric.bending.stops.thresholds";
    throw refused_value(scene, key, value, unit,
                        "must be " + number_text(must, 6, unit) + ", as fabric.bending.stops say (" +
                            key_origin(scene, stops) +
                            "): leave b1 and k0 out, which then follow from the stops, or the stops");
  };
  check("fabric.b1", scene.fabric.b1, follows.b1, "N m");
  check("fabric.k0", scene.fabric.k0, follows.k0, "1/m");
}

// Stops that slip on the way back to no shear push by g sum_j p_j r_j per unit of shear against the
// elasticity beside them: if they exceeded it the cloth's energy would be concave.
void check_growth(const Scene& scene) {
  const Spectrum& stops = scene.fabric.in_plane.shear;
  const double growth = scene.fabric.in_plane.shear_growth, shear = scene.fabric.shear;
  if (growth == 0) return;
  const std::string key = "fabric.membrane.stops.shear.growth", table = "fabric.membrane.stops.shear.";
  const auto refuse = [&](const std::string& what) { throw refused_value(scene, key, growth, "", what); };
  if (stops.empty()) refuse("needs " + table + "thresholds and stiffnesses beside it, which it raises");
  if (growth * stops.thresholds.back() >= 1)
    refuse("must be < " + number_text(1 / stops.thresholds.back(), 4) + ", 1 over the largest of " + table +
           "thresholds: a stop whose limit grows as fast as the shear never slips");
  if (growth * stops.friction_moment() > shear)
    refuse("must be <= " + number_text(shear / stops.friction_moment(), 4) + ", " +
           shown(scene, "fabric.shear", shear, "N/m") + " over the sum of " + table +
           "thresholds times stiffnesses: beyond it cloth is unstable on the way back to no shear");
}

}  // namespace

void check_fabric_lists(const Scene& scene) {
  const BendingParts& b = scene.fabric.bending;
  check_stops(scene, "bending.stops", b.stops);
  check_stops(scene, "bending.stops.weft", b.weft_stops);
  const std::string weft = "fabric.bending.stops.weft.thresholds";
  if (!b.weft_stops.empty() && b.weft_stops.size() != b.stops.size())
    throw Error::invalid_input(weft + " has " + std::to_string(b.weft_stops.size()) +
                               " numbers and must have as many as fabric.bending.stops.thresholds, " +
                               std::to_string(b.stops.size()) + " (" + key_origin(scene, weft) + ")");
  check_numbers_of_stops(scene);
  check_pairs(scene, {"bending.branches", "times", "stiffnesses", b.branches.times, b.branches.stiffnesses,
                      kMaxBranches});
  if (b.set.on() != (b.set.yield > 0))
    throw Error::invalid_input(shown(scene, "fabric.bending.set.yield", b.set.yield, "1/m") + " and " +
                               shown(scene, "fabric.bending.set.hardening", b.set.hardening, "N m") +
                               " must both be > 0, or both 0: no set");
  const InPlaneStops& p = scene.fabric.in_plane;
  check_stops(scene, "membrane.stops.warp", p.warp);
  check_stops(scene, "membrane.stops.weft", p.weft);
  check_stops(scene, "membrane.stops.shear", p.shear);
  check_growth(scene);
}

}  // namespace hysteron
