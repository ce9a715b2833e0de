#include "sim/scene/fabric_limits.h"

#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/shown_key.h"

namespace hysteron {
namespace {

// Another unit in which a number may have been given by mistake, and its size in the parameter's own unit.
struct UnitSlip {
  const char* unit;
  double factor;
};

struct FabricLimit {
  const char* parameter;
  const char* unit;
  double (*value)(const Fabric&);  // null for a list
  Range possible, usual;           // zero, "none" for a rigidity or friction, is always usual
  UnitSlip slip;
};

// A list that a fabric may have beyond its parameters; each of its numbers has these limits.
struct FabricListLimit {
  FabricLimit each;
  const std::vector<double>& (*values)(const Fabric&);
};

constexpr UnitSlip kKesRigidity = {"gf cm^2/cm", kGramForceSquareCentimetrePerCentimetre};
constexpr UnitSlip kKesWidth = {"gf cm/cm", kGramForceCentimetrePerCentimetre};
constexpr UnitSlip kKesStiffness = {"gf/cm", 0.980665};
constexpr UnitSlip kGramsPerSquareMetre = {"g/m^2", 1e-3};
constexpr UnitSlip kMillimetres = {"mm", 1e-3};
constexpr UnitSlip kPercent = {"%", 0.01};
constexpr UnitSlip kMinutes = {"min", 60};
constexpr UnitSlip kPerCentimetre = {"1/cm", 100};
constexpr UnitSlip kNoSlip = {nullptr, 1};

// Densities range from voile of 10 g/m^2 to felt and carpet; rigidities from silk's to leather's: a steel
// foil of 0.1 mm has 0.02 N m, the most that a bending tester reads, and studies of stability go beyond.
// Stiffnesses range from a knit's to a coated weave's.  A number from which others follow comes before them,
// so that a refusal names the number that was given.
const FabricLimit kLimits[] = {
    {"density", "kg/m^2", [](const Fabric& f) { return f.density; }, between(1e-3, 20), between(0.01, 1.5),
     kGramsPerSquareMetre},
    {"thickness", "m", [](const Fabric& f) { return f.thickness; }, between(1e-6, 0.1), between(2e-5, 0.01),
     kMillimetres},
    {"kes-b", "N m", [](const Fabric& f) { return f.kes.read.rigidity; }, between(0, 0.02),
     between(1e-8, 1e-3), kKesRigidity},
    {"kes-2hb", "N", [](const Fabric& f) { return f.kes.read.loop_width; }, between(0, 0.1),
     between(1e-6, 0.02), kKesWidth},
    {"b1", "N m", [](const Fabric& f) { return f.b1; }, between(0, 10), between(1e-8, 1e-3), kKesRigidity},
    {"b2", "N m", [](const Fabric& f) { return f.b2; }, between(0, 10), between(1e-8, 1e-3), kKesRigidity},
    {"k0", "1/m", [](const Fabric& f) { return f.k0; }, between(0, 1e7), between(1, 1e3), kPerCentimetre},
    {"weft-bending", "", [](const Fabric& f) { return f.weft_bending; }, between(1e-3, 1e3),
     between(0.02, 50), kNoSlip},
    {"weft-friction", "", [](const Fabric& f) { return f.weft_friction; }, between(0, 1e3), between(0.02, 50),
     kNoSlip},
    {"back-bending", "", [](const Fabric& f) { return f.bending.faces.bending; }, between(0.02, 50),
     between(0.3, 3.4), kNoSlip},
    {"back-friction", "", [](const Fabric& f) { return f.bending.faces.friction; }, between(0.02, 50),
     between(0.3, 3.4), kNoSlip},
    {"bias-bending", "", [](const Fabric& f) { return f.bias_bending; }, between(1e-3, 1e3),
     between(0.02, 50), kNoSlip},
    {"warp", "N/m", [](const Fabric& f) { return f.warp; }, between(0, 1e8), between(1, 1e6), kKesStiffness},
    {"weft", "N/m", [](const Fabric& f) { return f.weft; }, between(0, 1e8), between(1, 1e6), kKesStiffness},
    {"shear", "N/m", [](const Fabric& f) { return f.shear; }, between(0, 1e8), between(3, 1e6),
     kKesStiffness},
    {"damping", "s", [](const Fabric& f) { return f.damping; }, between(0, 1e3), between(0, 1), kNoSlip},
    {"friction", "", [](const Fabric& f) { return f.friction; }, between(0, 100), between(0, 3), kNoSlip},
    {"bending.set.yield", "1/m", [](const Fabric& f) { return f.bending.set.yield; }, between(0, 1e7),
     between(1, 1e4), kPerCentimetre},
    {"bending.set.hardening", "N m", [](const Fabric& f) { return f.bending.set.hardening; }, between(0, 10),
     between(0, 1e-2), kKesRigidity},
    {"membrane.stops.shear.growth", "", [](const Fabric& f) { return f.in_plane.shear_growth; },
     between(0, 1e3), between(0, 120), kNoSlip},
};

// Stiffnesses have no least usual value, since a fit may leave a stop next to nothing; the thresholds of
// bending's stops are judged together (threshold_warning()).
const Range kUsualStrains = between(1e-5, 0.3);
const FabricListLimit kListLimits[] = {
    {{"bending.stops.thresholds", "1/m", nullptr, between(0, 1e7), between(0, 1e7), kPerCentimetre},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.stops.thresholds; }},
    {{"bending.stops.stiffnesses", "N m", nullptr, between(0, 10), between(0, 1e-3), kKesRigidity},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.stops.stiffnesses; }},
    {{"bending.stops.weft.thresholds", "1/m", nullptr, between(0, 1e7), between(0, 1e7), kPerCentimetre},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.weft_stops.thresholds; }},
    {{"bending.stops.weft.stiffnesses", "N m", nullptr, between(0, 10), between(0, 1e-3), kKesRigidity},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.weft_stops.stiffnesses; }},
    {{"bending.branches.times", "s", nullptr, between(0, 1e12), between(1e-3, 1e8), kMinutes},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.branches.times; }},
    {{"bending.branches.stiffnesses", "N m", nullptr, between(0, 10), between(0, 1e-3), kKesRigidity},
     [](const Fabric& f) -> const std::vector<double>& { return f.bending.branches.stiffnesses; }},
    {{"membrane.stops.warp.thresholds", "", nullptr, between(0, 10), kUsualStrains, kPercent},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.warp.thresholds; }},
    {{"membrane.stops.warp.stiffnesses", "N/m", nullptr, between(0, 1e8), between(0, 1e6), kKesStiffness},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.warp.stiffnesses; }},
    {{"membrane.stops.weft.thresholds", "", nullptr, between(0, 10), kUsualStrains, kPercent},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.weft.thresholds; }},
    {{"membrane.stops.weft.stiffnesses", "N/m", nullptr, between(0, 1e8), between(0, 1e6), kKesStiffness},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.weft.stiffnesses; }},
    {{"membrane.stops.shear.thresholds", "", nullptr, between(0, 10), kUsualStrains, kPercent},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.shear.thresholds; }},
    {{"membrane.stops.shear.stiffnesses", "N/m", nullptr, between(0, 1e8), between(0, 1e6), kKesStiffness},
     [](const Fabric& f) -> const std::vector<double>& { return f.in_plane.shear.stiffnesses; }},
};

const FabricLimit* limit_of(const std::string& parameter) {
  for (const FabricLimit& limit : kLimits)
    if (limit.parameter == parameter) return &limit;
  return nullptr;
}

// Suggests a unit in which the value would be usual: "; g/m^2 given? Then it is 0.124 kg/m^2".  A ratio as
// small as a rigidity was probably meant as a rigidity.
std::string slip_text(const FabricLimit& limit, double value) {
  const std::string parameter = limit.parameter;
  if (parameter.ends_with("-bending") && between(1e-8, 1e-3).contains(value))
    return "; a rigidity in N m given? It is a ratio, over the rigidity along warp";
  if (!limit.slip.unit || !limit.usual.contains(value * limit.slip.factor)) return "";
  return std::string("; ") + limit.slip.unit + " given? Then it is " +
         number_text(value * limit.slip.factor, 3, limit.unit);
}

std::string shown_number(const FabricLimit& limit, double value, const std::string& key) {
  return key + " = " + number_text(value, {.unit = limit.unit});
}

void check_number(const FabricLimit& limit, double value, const std::string& key, const std::string& origin) {
  if (limit.possible.contains(value)) return;
  throw Error::invalid_input(shown_number(limit, value, key) + " must be " +
                             with_unit(limit.possible.text(), limit.unit) + ", as fabrics can be" +
                             slip_text(limit, value))
      .with_origin(origin)
      .with_key(key, number_text(value));
}

// Warns of an unusual value; "" where it is usual.
std::string number_warning(const FabricLimit& limit, double value, const std::string& key,
                           const std::string& origin) {
  if (value == 0 || limit.usual.contains(value)) return "";
  const bool was_given = !origin.starts_with(kSetBy);  // only a number that was given can have the wrong unit
  return shown_number(limit, value, key) + " (" + origin + ") is unusual: fabrics have " +
         number_text(limit.usual.low, 3) + " to " + number_text(limit.usual.high, 3, limit.unit) +
         (was_given ? slip_text(limit, value) : "");
}

// Calls visit(limit, value, key) with every number of the fabric that has limits.
template <class Visit>
void for_each_number(const Fabric& fabric, const Visit& visit) {
  for (const FabricLimit& limit : kLimits)
    visit(limit, limit.value(fabric), std::string("fabric.") + limit.parameter);
  for (const FabricListLimit& list : kListLimits)
    for (const double value : list.values(fabric))
      visit(list.each, value, std::string("fabric.") + list.each.parameter);
}

// Warns of friction that saturates below all curvatures that a tester sees, or beyond all that cloth bears.
std::string threshold_warning(const Spectrum& stops) {
  const Range usual = between(2, 1e4);  // [1/m]: the largest threshold is above low, the smallest below high
  if (stops.empty() || (stops.thresholds.back() >= usual.low && stops.thresholds.front() <= usual.high))
    return "";
  return "thresholds of bending stops from " + number_text(stops.thresholds.front(), 3) + " to " +
         number_text(stops.thresholds.back(), 3) + " 1/m are unusual: are they in 1/m, not in 1/cm?";
}

}  // namespace

void check_fabric_number(const std::string& parameter, double value, const std::string& key,
                         const std::string& origin) {
  if (const FabricLimit* limit = limit_of(parameter)) check_number(*limit, value, key, origin);
}

std::string fabric_number_warning(const std::string& parameter, double value, const std::string& key,
                                  const std::string& origin) {
  const FabricLimit* limit = limit_of(parameter);
  return limit ? number_warning(*limit, value, key, origin) : "";
}

void check_fabric_numbers(const Scene& scene) {
  for_each_number(scene.fabric, [&](const FabricLimit& limit, double value, const std::string& key) {
    check_number(limit, value, key, key_origin(scene, key));
  });
}

std::vector<std::string> fabric_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  std::string warned;  // the key of the last warning: one number speaks for its list
  for_each_number(scene.fabric, [&](const FabricLimit& limit, double value, const std::string& key) {
    const std::string warning = number_warning(limit, value, key, key_origin(scene, key));
    if (warning.empty() || warned == key) return;
    warnings.push_back(warning);
    warned = key;
  });
  for (const Spectrum* stops : {&scene.fabric.bending.stops, &scene.fabric.bending.weft_stops})
    if (const std::string warning = threshold_warning(*stops); !warning.empty()) warnings.push_back(warning);
  const Fabric& fabric = scene.fabric;
  if (fabric.kes.gives_numbers() && fabric.k0 > KesWindow().slope_from)
    warnings.push_back(shown(scene, "fabric.k0", fabric.k0, "1/m") + " lies in the window of KES-FB2, from " +
                       number_text(KesWindow().slope_from) +
                       " 1/m: it reads another B and 2HB than fabric.kes-b and fabric.kes-2hb");
  return warnings;
}

std::vector<std::string> checked_fabric_warnings(const std::string& name_or_file,
                                                 const std::vector<Flag>& flags) {
  std::vector<Flag> own = {{"fabric", name_or_file}};
  for (const Flag& flag : flags)
    if (flag.path.starts_with("fabric.")) own.push_back(flag);
  Scene scene;
  apply_flags(scene, own);
  check_fabric_numbers(scene);
  return fabric_warnings(scene);
}

}  // namespace hysteron
