#include "experiments/kes/in_plane.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/session/run_warnings.h"
#include "render/plot.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/cloth.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/keys.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

struct InPlaneSpecimen {
  std::string mesh = "aligned";
  int triangles = 2000;  // approximate number
  // Equilibria from zero to the largest strain; a multiple of 16 puts rows at the angles where shear is read.
  int steps = 16;
};

struct InPlaneFlags {
  TesterMode test = TesterMode::shear;
  Along along = Along::warp;
  Tested on = Tested::law;
  InPlaneProtocol protocol;
  InPlaneSpecimen specimen;
  Options options;
};
using F = InPlaneFlags;
using S = InPlaneSpecimen;
using P = InPlaneProtocol;
// clang-format off
const KeyRow<InPlaneFlags> kOwnRows[] = {
    {"along", at<&F::along>, "", any(), "shear, tension: the direction from clamp to clamp"},
    {"load", at<&F::protocol, &P::largest>, "N/m", positive(), "tension: largest force per width; the tester's is 500 gf/cm"},
};
// These keys are shared with the bending test.
const KeyRow<InPlaneFlags> kSharedRows[] = {
    {"test", at<&F::test>, "", any(), "KES-FB2 bending, KES-FB1 shear or tension"},
    {"on", at<&F::on>, "", any(), "the law alone, or beside it a specimen of cloth"},
    {"mesh", at<&F::specimen, &S::mesh>, "", any(), "of the specimen"},
    {"triangles", at<&F::specimen, &S::triangles>, "", between(80, 1e6), "about how many it has"},
    {"strip-steps", at<&F::specimen, &S::steps>, "", between(4, 1e5), "its equilibria from zero to the largest"},
};
// clang-format on
constexpr int kQuickTriangles = 400;

Keys option_keys(InPlaneFlags& flags) {
  Keys keys = bind(kSharedRows, flags);
  for (const BoundKey& key : bind(kOwnRows, flags)) keys.push_back(key);
  return with_output_options(keys, flags.options);
}

// ---- the tests on a specimen of cloth between two clamps: one equilibrium per row, without weight ----

constexpr double kInPlaneGauge = 0.05, kInPlaneWidth = 0.2;  // size of the tester's specimen [m]

// The result of a test on cloth.  The clamps follow the path of uniform strain; the effect of the free edges
// shows in their forces.  The cloth stays in its plane, which it does not leave without a disturbance.
template <class Test>
struct InPlaneCloth {
  Test test;  // rows and readings of the specimen
  Test law;   // the law alone through the same rows
  int triangles = 0;
  double seconds = 0;  // wall clock [s]
};

using Clock = std::chrono::steady_clock;

// The moving clamp's displacement over the gauge: away from the other clamp, and along itself.
struct ClampPlace {
  double apart, along;
};

Scene strip_scene(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                  const std::vector<ClampPlace>& places) {
  Scene scene;
  scene.fabric = fabric;
  scene.fabric.damping = 0;
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = kInPlaneGauge;
  scene.cloth.width = kInPlaneWidth;
  scene.cloth.warp_angle = along == Along::warp ? 0 : 90;
  scene.mesh = specimen.mesh;
  scene.triangles = specimen.triangles;
  scene.integrator = Integrator::quasi_static;
  scene.gravity.setZero();
  scene.step = 1;
  scene.seconds = static_cast<double>(places.size());
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.pin = {held_between(-1, 0), held_between(kInPlaneGauge, 1)};
  std::vector<Keyframe>& keys = scene.pin[1].motion.keys = {{}};
  for (const ClampPlace& place : places)
    keys.push_back(
        {keys.back().time + scene.step, {kInPlaneGauge * place.apart, kInPlaneGauge * place.along, 0}});
  return scene;
}

// The moving clamp's forces per width at each place: away from the other clamp, and along itself [N/m].
struct ClampForces {
  std::vector<ClampPlace> force;
  int triangles = 0;
  double seconds = 0;
};

ClampForces forces_at(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                      const std::vector<ClampPlace>& places) {
  const Scene scene = strip_scene(fabric, along, specimen, places);
  const Cloth cloth = make_cloth(scene);
  const auto simulation = make_simulation(scene, cloth);
  ClampForces result;
  result.triangles = cloth.mesh.faces();
  const auto start = Clock::now();
  for (std::size_t i = 0; i < places.size(); ++i) {
    simulation->advance(1);
    const std::vector<Eigen::Vector3d> force = simulation->pin_forces();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int vertex : cloth.pin_vertices[1]) sum += force[vertex];
    result.force.push_back({sum.x() / kInPlaneWidth, sum.y() / kInPlaneWidth});
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

// Shears a specimen; `along` is the direction from clamp to clamp.  Throws Error::simulation if no
// equilibrium is found.
InPlaneCloth<ShearTest> shear_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                    InPlaneProtocol protocol) {
  protocol.steps = specimen.steps;
  const ShearTest law = test_shear(in_plane_law(fabric, along), protocol);
  std::vector<ClampPlace> places;
  for (std::size_t i = 0; i < law.force.size(); ++i)
    places.push_back({law.walk.stretch[i] - 1, law.walk.shear.rows[i].curvature});
  const ClampForces forces = forces_at(fabric, along, specimen, places);
  InPlaneCloth<ShearTest> cloth{{{}, law.walk, {}}, law, forces.triangles, forces.seconds};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [tension, force] = forces.force[i];
    cloth.test.force.push_back(force - tension * places[i].along / law.walk.stretch[i]);
  }
  cloth.test.reading = read_shear(protocol, law.walk.shear, cloth.test.force);
  return cloth;
}

InPlaneCloth<TensionTest> stretch_cloth(const Fabric& fabric, Along along, const InPlaneSpecimen& specimen,
                                        InPlaneProtocol protocol) {
  protocol.steps = specimen.steps;
  const TensionTest law = test_tension(in_plane_law(fabric, along), protocol);
  std::vector<ClampPlace> places;
  for (std::size_t i = 1; i < law.extension.size(); ++i) places.push_back({law.extension[i], 0});
  const ClampForces forces = forces_at(fabric, along, specimen, places);
  InPlaneCloth<TensionTest> cloth{{{}, law.extension, {0}, law.turn}, law, forces.triangles, forces.seconds};
  for (const ClampPlace& of : forces.force) cloth.test.force.push_back(of.apart);
  cloth.test.reading = read_tension(cloth.test.extension, cloth.test.force, law.turn);
  return cloth;
}

// ---- metrics, tables and plot ----

enum class InPlaneTest { shear, tension };
constexpr auto names(InPlaneTest) { return std::array{"shear", "tension"}; }

// A number that the tester reads.
struct InPlaneNumber {
  const char* key;    // name of the metric, with its unit
  const char* label;  // label in table.csv, with its unit
  double value;
};

// A loop and the numbers read from it; `x` is in degrees of shear or percent of extension.
struct InPlaneLoop {
  std::vector<double> x, force;  // x, and force per width [N/m]
  std::vector<InPlaneNumber> numbers;
};

struct InPlaneResult {
  Fabric fabric;
  InPlaneLoop law;
  // The loops of the specimen of cloth and of one with a quarter of the triangles; they have no numbers if no
  // cloth was requested.
  InPlaneLoop cloth, coarse;
  InPlaneLoop law_through_rows;  // the law alone through the specimen's rows
  int triangles = 0;
  double seconds = 0;
};

constexpr const char* kLawColor = "#C8C8C8";
constexpr const char* kClothColor = "#0072B2";

// A number as a fabric's source prints it, and its unit in SI.
struct PrintedNumber {
  const char *key, *name, *unit;
  double si;
};
constexpr PrintedNumber kPrinted[] = {
    {"G_N_per_m", "G", "gf/(cm degree)", kGramForcePerCentimetre / kDegree},
    {"2HG_N_per_m", "2HG", "gf/cm", kGramForcePerCentimetre},
    {"2HG5_N_per_m", "2HG5", "gf/cm", kGramForcePerCentimetre},
    {"LT", "LT", "", 1},
    {"WT_J_per_m2", "WT", "gf cm/cm^2", kGramForcePerCentimetre},
    {"RT_percent", "RT", "%", 1},
    {"EMT_percent", "EMT", "%", 1},
};

double published(const Fabric& fabric, const std::string& key) {  // in SI; NaN if not published
  for (const PrintedNumber& printed : kPrinted) {
    const auto found = fabric.published.find(printed.name);
    if (key == printed.key && found != fabric.published.end() && found->second.unit == printed.unit)
      return found->second.value * printed.si;
  }
  return NAN;
}

constexpr double kNothing = 1e-9;  // [N/m], [J/m^2]: rounding in width and area of an elastic law's loop

// Returns a/b - 1 [%].
double difference(double a, double b) { return 100 * (a / b - 1); }
// The differences [%] of the specimen's number from the law's, and of a coarser specimen's from the
// specimen's; NaN where the law reads zero.
struct ClothDifference {
  double law = NAN, mesh = NAN;
};
ClothDifference cloth_difference(const InPlaneResult& result, std::size_t i) {
  const double law = result.law.numbers[i].value, cloth = result.cloth.numbers[i].value;
  if (std::abs(law) < kNothing) return {};
  return {difference(cloth, law), difference(result.coarse.numbers[i].value, cloth)};
}

const char* strain_axis_label(InPlaneTest test) {
  return test == InPlaneTest::shear ? "angle [degree]" : "extension [percent]";
}

render::Series series(const InPlaneLoop& loop, const char* label, const char* color, double width) {
  return {.label = label, .x = loop.x, .y = loop.force, .color = color, .line_width = width};
}

InPlaneLoop in_plane_loop(const ShearTest& test) {
  InPlaneLoop loop;
  for (const LawRow& row : test.walk.shear.rows) loop.x.push_back(std::atan(row.curvature) / kDegree);
  loop.force = test.force;
  const ShearReading& r = test.reading;
  loop.numbers = {{"G_N_per_m", "G [N/m]", r.stiffness},
                  {"2HG_N_per_m", "2HG [N/m]", r.width},
                  {"2HG5_N_per_m", "2HG5 [N/m]", r.second_width},
                  {"shear_loop_area_J_per_m2", "area [J/m2]", r.loop_area}};
  return loop;
}

InPlaneLoop in_plane_loop(const TensionTest& test) {
  InPlaneLoop loop;
  for (const double e : test.extension) loop.x.push_back(100 * e);
  loop.force = test.force;
  const TensionReading& r = test.reading;
  loop.numbers = {{"LT", "LT", r.linearity},
                  {"WT_J_per_m2", "WT [J/m2]", r.work},
                  {"RT_percent", "RT [%]", r.resilience},
                  {"EMT_percent", "EMT [%]", r.extension}};
  return loop;
}

// Writes the numbers of the law; as strip_* those of the specimen, their differences from the law's, and
// their change from a quarter of the triangles on.
void write_in_plane_metrics(Run& run, const InPlaneResult& result) {
  for (const InPlaneNumber& n : result.law.numbers) {
    run.metric(n.key, n.value);
    const double printed = published(result.fabric, n.key);
    if (!std::isnan(printed))
      run.metric(std::string("published_") + n.key + "_difference_percent", difference(n.value, printed));
  }
  for (std::size_t i = 0; i < result.cloth.numbers.size(); ++i) {
    const InPlaneNumber& n = result.cloth.numbers[i];
    const std::string name = std::string("strip_") + n.key;
    run.metric(name, n.value);
    const ClothDifference apart = cloth_difference(result, i);
    run.metric(name + "_difference_percent", apart.law);
    run.metric(name + "_mesh_error_percent", std::abs(apart.mesh));
  }
  if (result.cloth.numbers.empty()) return;
  run.metric("strip_triangles_count", result.triangles);
  run.metric("strip_solve_s", result.seconds);
}

// Warns of numbers that too few rows make wrong, for the specimen as for the law, and of a mesh with another
// number of triangles than requested.
void warn_of_sizes(const CommandLine& line, const InPlaneFlags& flags, const InPlaneResult& result,
                   Run& run) {
  constexpr double kMostPercent = 0.5;
  for (std::size_t i = 0; i < result.law_through_rows.numbers.size(); ++i) {
    const InPlaneNumber& law = result.law.numbers[i];
    const double percent = difference(result.law_through_rows.numbers[i].value, law.value);
    if (std::abs(law.value) < kNothing || !(std::abs(percent) > kMostPercent)) continue;
    run.warn(
        fmt::format("strip-steps = {}: {} of the specimen is {:.1f} % too {}, since it is read between "
                    "few equilibria: take more steps",
                    flags.specimen.steps, law.key, std::abs(percent), percent < 0 ? "small" : "large"));
  }
  if (result.cloth.numbers.empty() || last_text(line.flags, "triangles", "").empty()) return;
  const std::string warning =
      triangle_count_warning(flags.specimen.triangles, "--triangles", result.triangles);
  if (!warning.empty()) run.warn(warning);
}

// Writes loops.csv, strip.csv, and table.csv, which includes the fabric's published values.
void write_in_plane_tables(Run& run, const InPlaneResult& result, InPlaneTest test) {
  const auto write = [&](const std::string& name, const InPlaneLoop& loop) {
    Table({{strain_axis_label(test), loop.x}, {"force per width [N/m]", loop.force}}).write(run.path(name));
  };
  write("loops.csv", result.law);
  const bool cloth = !result.cloth.numbers.empty();
  if (cloth) write("strip.csv", result.cloth);
  Table table("fabric,number,published,law,strip,strip of a quarter of the triangles");
  for (std::size_t i = 0; i < result.law.numbers.size(); ++i) {
    const InPlaneNumber& n = result.law.numbers[i];
    table.row({result.fabric.name, n.label, published(result.fabric, n.key), n.value,
               cloth ? result.cloth.numbers[i].value : NAN, cloth ? result.coarse.numbers[i].value : NAN});
  }
  table.write(run.path("table.csv"));
}

// Draws plot_loops.
void write_in_plane_plot(Run& run, const InPlaneResult& result, InPlaneTest test) {
  render::Plot plot{.title = "KES-FB1 " + enum_name(test) + " of " + result.fabric.name,
                    .x = {strain_axis_label(test)},
                    .y = {"force per width [N/m]"}};
  plot.axes_at_zero = plot.key_inside = true;
  plot.series.push_back(series(result.law, "law alone", kLawColor, 6));
  if (!result.cloth.numbers.empty())
    plot.series.push_back(series(result.cloth, "specimen of cloth", kClothColor, 1.6));
  run.plot("plot_loops", plot);
}

template <class Test, class OnCloth>
void test_on_cloth(InPlaneResult& result, const Test& law, const InPlaneFlags& flags,
                   const OnCloth& on_cloth) {
  result.law = in_plane_loop(law);
  if (flags.on == Tested::law) return;
  InPlaneSpecimen coarse = flags.specimen;
  coarse.triangles /= 4;
  const auto cloth = on_cloth(result.fabric, flags.along, flags.specimen, flags.protocol);
  result.cloth = in_plane_loop(cloth.test);
  result.law_through_rows = in_plane_loop(cloth.law);
  result.coarse = in_plane_loop(on_cloth(result.fabric, flags.along, coarse, flags.protocol).test);
  result.triangles = cloth.triangles;
  result.seconds = cloth.seconds;
}

InPlaneResult tested(const Fabric& fabric, InPlaneTest test, const InPlaneFlags& flags) {
  InPlaneResult result;
  result.fabric = fabric;
  const InPlaneLaw law = in_plane_law(fabric, flags.along);
  if (test == InPlaneTest::shear)
    test_on_cloth(result, test_shear(law, flags.protocol), flags, shear_cloth);
  else
    test_on_cloth(result, test_tension(law, flags.protocol), flags, stretch_cloth);
  return result;
}

Json resolved(InPlaneFlags& flags, const Fabric& fabric) {
  Json keys = to_json(option_keys(flags));
  Scene scene;
  scene.fabric = fabric;
  keys["fabric"] = to_json(scene)["fabric"];
  return keys;
}

}  // namespace

int run_in_plane(const CommandLine& line) {
  InPlaneFlags flags;
  set_keys(line, option_keys(flags),
           [&] { flags.specimen.triangles = std::min(flags.specimen.triangles, kQuickTriangles); });
  const auto test = value_named<InPlaneTest>(enum_name(flags.test));
  const std::string name = last_text(line.flags, "fabric", Fabric{}.name);
  const Fabric fabric = resolved_fabric(name, line.flags);
  const InPlaneResult result = tested(fabric, test, flags);
  Run run(line, flags.options, resolved(flags, fabric));
  for (const std::string& warning : checked_fabric_warnings(name, line.flags)) run.warn(warning);
  warn_of_sizes(line, flags, result, run);
  write_in_plane_metrics(run, result);
  write_in_plane_tables(run, result, test);
  if (!flags.options.no_images) write_in_plane_plot(run, result, test);
  finish_with_report(run);
  return 0;
}

std::vector<KeyDescription> in_plane_keys() {
  std::vector<KeyDescription> keys = key_descriptions(kOwnRows);
  std::erase_if(keys,
                // The bending test has it, too.
                [](const KeyDescription& key) { return key.path == "along"; });
  for (const KeyDescription& key : scene_keys()) {
    const bool stiffness =
        key.path == "fabric.warp" || key.path == "fabric.weft" || key.path == "fabric.shear";
    if (stiffness || key.path.starts_with("fabric.membrane.")) keys.push_back(key);
  }
  return keys;
}

}  // namespace hysteron::experiments
