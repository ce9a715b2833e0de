#include "experiments/kes/output.h"

#include <fmt/core.h>

#include <cmath>

#include "sim/base/csv.h"
#include "sim/scene/fabric_reader.h"

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

void write_loops(Run& run, const std::vector<KesFabric>& fabrics, const KesProtocol& protocol) {
  const KesWalk& walk = fabrics.front().reference.walk;
  const std::vector<std::size_t> rows = shown_rows(walk, protocol.steps);
  std::vector<Column> columns = {{"curvature [1/m]", {}}, {"time [s]", {}}};
  std::vector<double> time;
  for (const LawRow& row : walk.rows) time.push_back((time.empty() ? 0 : time.back()) + row.seconds);
  for (std::size_t i : rows) {
    columns[0].values.push_back(walk.rows[i].curvature);
    columns[1].values.push_back(time[i]);
  }
  for (const KesFabric& fabric : fabrics) {
    for (const KesResult& result : fabric.results) {
      columns.push_back({moment_column(result), {}});
      for (std::size_t i : rows) columns.back().values.push_back(result.test.moment[i]);
    }
  }
  Table(columns).write(run.path("loops.csv"));
}

void write_minor_loops(Run& run, const std::vector<KesFabric>& fabrics, const KesProtocol& protocol) {
  const std::vector<MinorLoop>& shape = fabrics.front().reference.minor_loops;
  const std::size_t stride = std::max(1, protocol.steps / kShownSteps);
  std::vector<Column> columns = {{"family", {}}, {"reversal [1/m]", {}}, {"curvature [1/m]", {}}};
  for (const KesFabric& fabric : fabrics)
    for (const KesResult& result : fabric.results) columns.push_back({moment_column(result), {}});
  for (std::size_t loop = 0; loop < shape.size(); ++loop) {
    for (std::size_t i = 0; i < shape[loop].curvature.size(); i += stride) {
      columns[0].values.push_back(static_cast<int>(shape[loop].family));
      columns[1].values.push_back(shape[loop].reversal);
      columns[2].values.push_back(shape[loop].curvature[i]);
      std::size_t column = 3;
      for (const KesFabric& fabric : fabrics)
        for (const KesResult& result : fabric.results)
          columns[column++].values.push_back(result.test.minor_loops[loop].moment[i]);
    }
  }
  Table(columns).write(run.path("minor_loops.csv"));
}

void write_readings(Run& run, const std::vector<KesFabric>& fabrics) {
  Table table(
      "fabric,law,B [N m],2HB [N],residual curvature [1/m],residual by formula [1/m],"
      "loop area [J/m2],reversals |M| <= Ma,reversals |M| <= 2Ma,reversals |M| > 2Ma");
  for (const KesFabric& fabric : fabrics) {
    for (const KesResult& result : fabric.results) {
      const KesReading& r = result.test.reading;
      std::vector<Cell> fields = {fabric.fabric.name, result.law};
      for (double value : {r.rigidity, r.loop_width, r.residual, r.residual_by_formula, r.loop_area})
        fields.push_back(std::isnan(value) ? "" : fmt::format("{:.9g}", value));
      for (int count : result.test.recovery_cases) fields.push_back(count);
      table.row(fields);
    }
  }
  table.write(run.path("table.csv"));
}

// B and 2HB in SI as the fabric's source prints them; NaN where it does not.
double published(const Fabric& fabric, const std::string& name, const std::string& unit, double si) {
  const auto found = fabric.published.find(name);
  return found != fabric.published.end() && found->second.unit == unit ? found->second.value * si : NAN;
}

}  // namespace

void write_metrics(Run& run, const std::vector<KesFabric>& fabrics) {
  for (const KesFabric& fabric : fabrics) {
    for (const KesResult& result : fabric.results) {
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
      write_strip_metrics(run, p, curvature_amplitude(result), result.strips);
    }
  }
}

void write_tables(Run& run, const std::vector<KesFabric>& fabrics, const KesProtocol& protocol) {
  write_loops(run, fabrics, protocol);
  if (protocol.minor_loops) write_minor_loops(run, fabrics, protocol);
  write_readings(run, fabrics);
  for (const KesFabric& fabric : fabrics)
    for (const KesResult& result : fabric.results) write_strip_table(run, ending(result.name), result.strips);
}

void print_table(const std::vector<KesFabric>& fabrics) {
  for (const KesFabric& fabric : fabrics) {
    print_row(fabric.fabric.name,
              {"B [N m]", "2HB [N]", "residual [1/m]", "by formula", "area [J/m2]", "reversals *"});
    const double b = published(fabric.fabric, "B", "gf cm^2/cm", kGramForceSquareCentimetrePerCentimetre);
    const double width = published(fabric.fabric, "2HB", "gf cm/cm", kGramForceCentimetrePerCentimetre);
    if (!std::isnan(b) && !std::isnan(width)) print_row("published", {four_digits(b), four_digits(width)});
    for (const KesResult& result : fabric.results) {
      const KesReading& r = result.test.reading;
      std::string cases;
      for (int count : result.test.recovery_cases)
        cases += (cases.empty() ? "" : "/") + std::to_string(count);
      print_row(result.law, {four_digits(r.rigidity), four_digits(r.loop_width), four_digits(r.residual),
                             four_digits(r.residual_by_formula), four_digits(r.loop_area), cases});
      print_strips(curvature_amplitude(result), result.strips);
    }
    fmt::print("\n");
  }
  fmt::print("* of all loops, by the moment at the reversal: |M| <= Ma / <= 2 Ma / > 2 Ma\n");
}

}  // namespace hysteron::experiments
