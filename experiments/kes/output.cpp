#include "experiments/kes/output.h"

#include <fmt/core.h>

#include <cmath>

#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

constexpr int kShownSteps = 100;  // rows of a table from zero to the amplitude

std::string prefix(const KesResult& result) { return result.name.empty() ? "" : result.name + "."; }

double curvature_amplitude(const KesResult& result) { return result.test.walk.rows.back().curvature; }

// Of the names of a result's own files.
std::string ending(const std::string& name) { return name.empty() ? "" : "_" + name; }

std::string moment_column(const KesResult& result) {
  return (result.name.empty() ? result.law : result.name) + " moment [N]";
}

// Every so many rows, and all where a leg ends.
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
  Table table(
      "fabric,law,B [N m],2HB [N],residual curvature [1/m],residual by formula [1/m],"
      "loop area [J/m2],reversals |M| <= Ma,reversals |M| <= 2Ma,reversals |M| > 2Ma");
  for (const KesResult& result : tests.results) {
    const KesReading& r = result.test.reading;
    std::vector<Cell> fields = {tests.fabric.name, result.law};
    for (double value : {r.rigidity, r.loop_width, r.residual, r.residual_by_formula, r.loop_area})
      fields.push_back(std::isnan(value) ? "" : fmt::format("{:.9g}", value));
    for (int count : result.test.recovery_cases) fields.push_back(count);
    table.row(fields);
  }
  table.write(run.path("table.csv"));
}

}  // namespace

void write_metrics(Run& run, const KesTests& tests) {
  for (const KesResult& result : tests.results) {
    const KesReading& r = result.test.reading;
    const std::string p = prefix(result);
    run.metric(p + "B_N_m", r.rigidity);
    run.metric(p + "2HB_N", r.loop_width);
    run.metric(p + "HB_over_B_per_m", r.loop_width / 2 / r.rigidity);
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

void write_tables(Run& run, const KesTests& tests, const KesProtocol& protocol) {
  write_loops(run, tests, protocol);
  if (protocol.minor_loops) write_minor_loops(run, tests, protocol);
  write_readings(run, tests);
  for (const KesResult& result : tests.results)
    if (result.strip && result.strip->failure.empty())
      write_strip_table(run, ending(result.name), *result.strip);
}

}  // namespace hysteron::experiments
