#include "experiments/kes/output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/law_family.h"
#include "render/panels.h"
#include "sim/base/csv.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr int kShownSteps = 100;  // rows of a table from zero to the amplitude

std::string prefix(const KesResult& result) { return result.name.empty() ? "" : result.name + "."; }

double curvature_amplitude(const KesResult& result) { return result.test.walk.rows.back().curvature; }

// Returns the suffix of a result's own files.
std::string ending(const std::string& name) { return name.empty() ? "" : "_" + name; }

std::string moment_column(const KesResult& result) {
  return (result.name.empty() ? result.law : result.name) + " moment [N]";
}

// Returns every so many rows, and the last row of each leg.
std::vector<std::size_t> shown_rows(const KesWalk& walk, int steps) {
  const std::size_t stride = std::max(1, steps / kShownSteps);
  std::vector<std::size_t> rows;
  for (std::size_t leg = 0; leg + 1 < walk.start.size(); ++leg) {
    const std::size_t end = walk.start[leg + 1];
    for (std::size_t i = walk.start[leg] + (leg > 0); i < end; i += stride) rows.push_back(i);
    if (rows.back() + 1 != end && walk.rows[end - 1].curvature == walk.rows[end].curvature)
      rows.push_back(end - 1);
    rows.push_back(end);
  }
  return rows;
}

void write_loops(Run& run, const KesTests& tests, const KesProtocol& protocol) {
  const KesWalk& walk = tests.reference.walk;
  const std::vector<std::size_t> rows = shown_rows(walk, protocol.steps);
  std::vector<Column> columns = {{"curvature [1/m]", {}}, {"time [s]", {}}};
  std::vector<double> time;
  for (const LawRow& row : walk.rows) time.push_back((time.empty() ? 0 : time.back()) + row.seconds);
  for (std::size_t i : rows) {
    columns[0].values.push_back(walk.rows[i].curvature);
    columns[1].values.push_back(time[i]);
  }
  for (const KesResult& result : tests.results) {
    columns.push_back({moment_column(result), {}});
    for (std::size_t i : rows) columns.back().values.push_back(result.test.moment[i]);
  }
  Table(columns).write(run.path("loops.csv"));
}

void write_minor_loops(Run& run, const KesTests& tests, const KesProtocol& protocol) {
  const std::vector<MinorLoop>& shape = tests.reference.minor_loops;
  const std::size_t stride = std::max(1, protocol.steps / kShownSteps);
  std::vector<Column> columns = {{"family", {}}, {"reversal [1/m]", {}}, {"curvature [1/m]", {}}};
  for (const KesResult& result : tests.results) columns.push_back({moment_column(result), {}});
  for (std::size_t loop = 0; loop < shape.size(); ++loop) {
    for (std::size_t i = 0; i < shape[loop].curvature.size(); i += stride) {
      columns[0].values.push_back(static_cast<int>(shape[loop].family));
      columns[1].values.push_back(shape[loop].reversal);
      columns[2].values.push_back(shape[loop].curvature[i]);
      std::size_t column = 3;
      for (const KesResult& result : tests.results)
        columns[column++].values.push_back(result.test.minor_loops[loop].moment[i]);
    }
  }
  Table(columns).write(run.path("minor_loops.csv"));
}

void write_readings(Run& run, const KesTests& tests) {
  const bool has_faces = tests.fabric.bending.faces.on();
  Table table(
      std::string("fabric,law,B [N m],2HB [N],residual curvature [1/m],residual by formula [1/m],"
                  "loop area [J/m2],reversals |M| <= Ma,reversals |M| <= 2Ma,reversals |M| > 2Ma") +
      (has_faces ? ",B of the face [N m],2HB of the face [N],B of the back [N m],2HB of the back [N]" : ""));
  for (const KesResult& result : tests.results) {
    const KesReading& r = result.test.reading;
    std::vector<Cell> fields = {tests.fabric.name, result.law};
    for (double value : {r.rigidity, r.loop_width, r.residual, r.residual_by_formula, r.loop_area})
      fields.push_back(std::isnan(value) ? "" : number_text(value, 9));
    for (int count : result.test.recovery_cases) fields.push_back(count);
    if (has_faces)
      for (const KesPair& side : {r.face, r.back})
        for (double value : {side.rigidity, side.loop_width}) fields.push_back(number_text(value, 9));
    table.row(fields);
  }
  table.write(run.path("table.csv"));
}

// ---- small multiples of the loops: a panel per law ----

constexpr const char* kReferenceColor = "#C8C8C8";
constexpr const char* kMinorColors[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"};
constexpr int kDrawnSteps = 50;    // points from zero to the amplitude
constexpr double kSettled = 0.01;  // relative change of the area between cycles below which it is settled
constexpr double kHeadroom = 1.7;  // top of the axis over the largest moment of `prandtl`

render::Series curve(const std::vector<double>& curvature, const std::vector<double>& moment, int steps,
                     const std::string& color, double width) {
  render::Series series{.label = "", .x = {}, .y = {}, .color = color, .line_width = width};
  const std::size_t stride = std::max(1, steps / kDrawnSteps);
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    const bool turn = i > 0 && i + 1 < curvature.size() &&
                      (curvature[i] - curvature[i - 1]) * (curvature[i + 1] - curvature[i]) <= 0;
    if (i % stride && !turn && i + 1 < curvature.size()) continue;
    series.add(curvature[i], kMilli * moment[i]);
  }
  return series;
}

render::Series whole_walk(const KesTest& test, int steps, const std::string& color, double width) {
  std::vector<double> curvature;
  for (const LawRow& row : test.walk.rows) curvature.push_back(row.curvature);
  return curve(curvature, test.moment, steps, color, width);
}

double largest_moment(const KesTest& test) {
  double largest = 0;
  for (double m : test.moment) largest = std::max(largest, std::abs(m));
  return largest;
}

// Returns remarks that are needed to read a law's loop.
std::vector<std::string> remarks(const KesResult& result, double shown_moment) {
  std::vector<std::string> lines;
  if (result.law == "grinspun-edit") lines.push_back("rest curvature edited at both ends");
  if (std::abs(result.test.reading.area_change) > kSettled) lines.push_back("not settled");
  const double largest = largest_moment(result.test);
  if (kMilli * largest > shown_moment)
    lines.push_back("cut: reaches " + number_text(kMilli * largest, 2, "mN"));
  return lines;
}

// Formats the readings of both sides: "face 11.57, back 16.2".
std::string of_sides(double face, double back) { return fmt::format("face {:.4g}, back {:.4g}", face, back); }

std::vector<std::string> readings(const KesReading& r, const Faces& faces) {
  if (faces.on())
    return {"B: " + of_sides(1e6 * r.face.rigidity, 1e6 * r.back.rigidity) + " µN m",
            "2HB: " + of_sides(kMilli * r.face.loop_width, kMilli * r.back.loop_width) + " mN",
            fmt::format("residual {:.4g} /m", r.residual), fmt::format("area {:.3g} J/m²", r.loop_area)};
  return {fmt::format("B = {:.4g} µN m", 1e6 * r.rigidity),
          fmt::format("2HB = {:.4g} mN", kMilli * r.loop_width),
          fmt::format("residual {:.4g} /m", r.residual), fmt::format("area {:.3g} J/m²", r.loop_area)};
}

render::Panels empty_grid(const KesTests& tests, const KesProtocol& p, const std::string& what) {
  render::Panels grid{
      .title = what + " of " + tests.fabric.name, .subtitle = "", .x = {}, .y = {}, .panels = {}};
  const double moment = kMilli * kHeadroom * largest_moment(tests.reference);
  grid.x = {"curvature [1/m]", false, -1.08 * p.amplitude, 1.08 * p.amplitude};
  grid.y = {"moment per width [mN]", false, -moment, moment};
  grid.columns = static_cast<int>(std::min<std::size_t>(3, tests.results.size()));  // wide enough to be read
  return grid;
}

render::Panels loops(const KesTests& tests, const KesProtocol& p) {
  render::Panels grid = empty_grid(tests, p, "KES-FB2 pure bending");
  grid.subtitle = std::to_string(p.cycles) + " cycles" + fmt::format(" to ±{:.4g}/m", p.amplitude) +
                  fmt::format(" at {:.4g}/(m s);", p.rate) + fmt::format(" B from {:.4g}", p.slope_from) +
                  fmt::format(" to {:.4g}/m,", p.slope_to) + fmt::format(" 2HB at {:.4g}/m.", p.width_at) +
                  "  Grey: prandtl";
  for (const KesResult& result : tests.results) {
    render::Panel panel{result.law,
                        {},
                        readings(result.test.reading, tests.fabric.bending.faces),
                        remarks(result, grid.y.high)};
    panel.series = {whole_walk(tests.reference, p.steps, kReferenceColor, 5),
                    whole_walk(result.test, p.steps, render::hex(color_of_law(result.law)), 1.8)};
    grid.panels.push_back(panel);
  }
  return grid;
}

render::Panels minor_loops(const KesTests& tests, const KesProtocol& p, MinorLoop::Family family) {
  const bool amplitudes = family == MinorLoop::Family::amplitude;
  render::Panels grid =
      empty_grid(tests, p, amplitudes ? "Settled loops of several amplitudes" : "Partial reversals");
  grid.subtitle =
      (amplitudes ? "last of " + std::to_string(p.cycles) + " cycles from rest."
                  : fmt::format("from {:.4g}/m part of the way back, and to it again.", p.amplitude)) +
      std::string("  Grey: the law's loop of the full amplitude");
  for (const KesResult& result : tests.results) {
    render::Panel panel{result.law, {whole_walk(result.test, p.steps, kReferenceColor, 4)}, {}, {}};
    panel.remarks = remarks(result, grid.y.high);
    int color = 0;
    for (const MinorLoop& loop : result.test.minor_loops) {
      if (loop.family != family) continue;
      panel.series.push_back(
          curve(loop.curvature, loop.moment, p.steps, kMinorColors[color++ % std::size(kMinorColors)], 1.5));
    }
    grid.panels.push_back(panel);
  }
  return grid;
}

}  // namespace

void write_metrics(Run& run, const KesTests& tests) {
  for (const KesResult& result : tests.results) {
    const KesReading& r = result.test.reading;
    const std::string p = prefix(result);
    run.metric(p + "B_N_m", r.rigidity);
    run.metric(p + "2HB_N", r.loop_width);
    run.metric(p + "HB_over_B_per_m", r.loop_width / 2 / r.rigidity);
    if (tests.fabric.bending.faces.on()) {
      for (const auto& [side, read] : {std::pair("face", r.face), std::pair("back", r.back)}) {
        run.metric(p + "B_" + side + "_N_m", read.rigidity);
        run.metric(p + "2HB_" + side + "_N", read.loop_width);
      }
    }
    run.metric(p + "residual_curvature_per_m", r.residual);
    run.metric(p + "residual_by_formula_per_m", r.residual_by_formula);
    run.metric(p + "loop_area_J_per_m2", r.loop_area);
    run.metric(p + "loop_area_change_percent", 100 * r.area_change);
    run.metric(p + "reversals_elastic", result.test.recovery_cases[0]);
    run.metric(p + "reversals_partial", result.test.recovery_cases[1]);
    run.metric(p + "reversals_full_slip", result.test.recovery_cases[2]);
    if (result.strip) write_strip_metrics(run, p, curvature_amplitude(result), *result.strip);
  }
}

namespace {

// Returns "law kim, steps = 10: the area of the loop is 23.5 % too small by the length of its steps"; "" if
// the error is small.
std::string coarse_steps_warning(const std::string& what, double error) {
  constexpr double kMostError = 5e-3;  // relative error below the resolution of testers and meshes
  if (!(std::abs(error) > kMostError)) return "";
  return fmt::format("{}: the area of the loop is {:.1f} % too {} by the length of its steps: take more",
                     what, 100 * std::abs(error), error < 0 ? "small" : "large");
}

}  // namespace

std::vector<std::string> coarse_steps_warnings(const KesTests& tests, int steps, int strip_steps) {
  std::vector<std::string> warnings;
  for (const KesResult& result : tests.results) {
    warnings.push_back(
        coarse_steps_warning(fmt::format("law {}, steps = {}", result.law, steps), result.test.area_error));
    const double area = result.test.reading.loop_area;
    if (!result.strip || !result.strip->failure.empty() || area == 0) continue;
    // The law alone, through the strip's curvatures in the same steps, has the same error as the strip.
    const double error = result.strip->test.law_reading.loop_area / area - 1;
    warnings.push_back(coarse_steps_warning(
        fmt::format("strip under law {}, strip-steps = {}", result.law, strip_steps), error));
  }
  std::erase(warnings, "");
  return warnings;
}

void write_tables(Run& run, const KesTests& tests, const KesProtocol& protocol) {
  write_loops(run, tests, protocol);
  if (protocol.minor_loops) write_minor_loops(run, tests, protocol);
  write_readings(run, tests);
  for (const KesResult& result : tests.results)
    if (result.strip && result.strip->failure.empty())
      write_strip_table(run, ending(result.name), *result.strip);
}

void write_plots(Run& run, const KesTests& tests, const KesProtocol& p) {
  const auto write = [&](const std::string& name, const render::Panels& grid) {
    run.plot(name, grid, render::write_panels);
  };
  for (const KesResult& result : tests.results)
    if (result.strip && result.strip->failure.empty())
      write_strip_figures(run, ending(result.name), *result.strip);
  write("plot_loops", loops(tests, p));
  if (!p.minor_loops) return;
  write("plot_amplitudes", minor_loops(tests, p, MinorLoop::Family::amplitude));
  write("plot_minor_loops", minor_loops(tests, p, MinorLoop::Family::partial_reversal));
}

}  // namespace hysteron::experiments
