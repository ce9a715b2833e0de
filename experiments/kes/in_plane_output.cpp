#include "experiments/kes/in_plane_output.h"

#include <cmath>

#include "render/plot.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

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

double published(const Fabric& fabric, const std::string& key) {  // in SI; NaN: not published
  for (const PrintedNumber& printed : kPrinted) {
    const auto found = fabric.published.find(printed.name);
    if (key == printed.key && found != fabric.published.end() && found->second.unit == printed.unit)
      return found->second.value * printed.si;
  }
  return NAN;
}

constexpr double kNothing = 1e-9;  // [N/m], [J/m^2]: what an elastic law's loop has of width and area

// Over another, minus 1 [percent].
double difference(double a, double b) { return 100 * (a / b - 1); }
// Of a specimen's number over the law's, and of one with fewer triangles over the specimen's; NaN where the
// law reads nothing.
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

}  // namespace

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
  if (result.tension > 0) run.metric("strip_tension_N_per_m", result.tension);
  run.metric("strip_triangles_count", result.triangles);
  run.metric("strip_solve_s", result.seconds);
}

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

}  // namespace hysteron::experiments
