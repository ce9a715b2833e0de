#include "experiments/law/law.h"

#include <fmt/core.h>

#include <cmath>
#include <iostream>

#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/laws/recovery.h"
#include "sim/reference/kes.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kCurvature = "curvature [1/m]";
constexpr const char* kTime = "time [s]";
constexpr const char* kEdit = "edit";

std::string with_unit(double value, const char* unit) { return fmt::format("{:g} {}", value, unit); }

void check_curve(const VirginCurve& curve) {
  const auto refuse = [](const char* name, double value, const char* unit, const std::string& allowed) {
    throw Error::invalid_input(std::string("--") + name + " = " + with_unit(value, unit) + " must be " +
                               allowed)
        .with_key(name, fmt::format("{:g}", value))
        .with_experiment("law");
  };
  if (!(curve.b2 >= 0) || !std::isfinite(curve.b2)) refuse("b2", curve.b2, "N m", "finite and >= 0");
  if (!(curve.b1 >= curve.b2) || !std::isfinite(curve.b1))
    refuse("b1", curve.b1, "N m", "finite and >= b2 = " + with_unit(curve.b2, "N m"));
  if (!(curve.k0 >= 0) || !std::isfinite(curve.k0)) refuse("k0", curve.k0, "1/m", "finite and >= 0");
}

// None where the column is not there.
std::vector<double> metric_values(const Table& table, const std::string& column) {
  return table.find(column) ? table.numbers(column) : std::vector<double>{};
}

void check_time(const Table& table) {
  const std::vector<double> time = metric_values(table, kTime);
  for (size_t row = 1; row < time.size(); ++row) {
    if (time[row] < time[row - 1]) {
      throw table.refusal(row, "time = " + with_unit(time[row], "s") + " must be >= " +
                                   with_unit(time[row - 1], "s") + ", the time of the row before");
    }
  }
}

void check_edit(const Table& table) {
  const std::vector<double> edit = metric_values(table, kEdit);
  for (size_t row = 0; row < edit.size(); ++row) {
    if (edit[row] != 0 && edit[row] != 1) {
      throw table.refusal(row, "edit = " + with_unit(edit[row], "must be 0 or 1"));
    }
  }
}

constexpr double kSharpest = 1e6;  // [1/m] of a bend; fibres are thicker than its radius, 1 um

void check_curvature(const Table& table) {
  const std::vector<double> curvature = table.numbers(kCurvature);
  for (size_t row = 0; row < curvature.size(); ++row) {
    if (std::abs(curvature[row]) > kSharpest)
      throw table.refusal(row, "curvature = " + with_unit(curvature[row], "1/m") + " must be within +-" +
                                   with_unit(kSharpest, "1/m"));
  }
}

// Parameters of any size are allowed; what they make of a curvature may be beyond all numbers.
void check_results(const std::vector<Column>& results, const Table& table) {
  for (size_t row = 0; row < table.lines.size(); ++row) {
    for (const Column& column : results) {
      if (!std::isfinite(column.values[row]))
        throw table.refusal(row, "at curvature = " + with_unit(results[0].values[row], "1/m") +
                                     " the law's " + column.name +
                                     " is no finite number; take smaller b1, b2, k0 or parameters");
    }
  }
}

std::vector<LawRow> law_table_rows(const Table& table) {
  const std::vector<double> curvature = table.numbers(kCurvature), time = metric_values(table, kTime),
                            edit = metric_values(table, kEdit);
  std::vector<LawRow> rows;
  for (size_t i = 0; i < curvature.size(); ++i) {
    LawRow row{curvature[i]};
    if (!time.empty()) row.seconds = i == 0 ? 0 : time[i] - time[i - 1];
    if (!edit.empty()) row.edit = edit[i] == 1;
    rows.push_back(row);
  }
  return rows;
}

// What a bending tester would read of the fabric's stops.
std::string stops_summary(const LawRequest& request) {
  if (request.curve.parts.stops.empty()) return "";
  const KesProtocol p;
  const KesPair pair = kes_pair(request.curve, p);
  return fmt::format("stops: B = {} between {:g} and {}, 2HB = {} at {}, HB/B = {}\n",
                     with_unit(pair.rigidity, "N m"), p.slope_from, with_unit(p.slope_to, "1/m"),
                     with_unit(pair.loop_width, "N"), with_unit(p.width_at, "1/m"),
                     with_unit(pair.loop_width / 2 / pair.rigidity, "1/m"));
}

std::string recovery_summary(const LawRequest& request, const std::vector<LawRow>& rows, const LawRun& run) {
  const RecoveryCounts counts = count_recoveries(request.curve, rows, run);
  const LawChoice choice = choose_law(request.name, request.curve, request.parameters, LawUse::alone);
  std::string text = fmt::format(
      "reversals from |M| <= Ma: {}, <= 2 Ma: {}, > 2 Ma: {}\nresidual curvature after the last row: {}",
      counts.of[0], counts.of[1], counts.of[2], with_unit(residual_after(request, rows), "1/m (root)"));
  if (has_residual_formula(choice))
    text += ", " + with_unit(residual_by_formula(choice, rows.back().curvature, run.moment.back()),
                             "1/m (formula, if that row lies on the virgin curve)");
  return text + "\n";
}

}  // namespace

int run_law_command(const LawOptions& options) {
  check_curve(options.curve);
  const LawRequest request{options.law, options.curve, options.parameters};
  const Table table = read_csv(options.in, {kCurvature}, {kTime, kEdit}, "law");
  check_curvature(table);
  check_time(table);
  check_edit(table);
  const std::vector<LawRow> rows = law_table_rows(table);
  const LawRun run = run_law(request, rows);
  std::vector<Column> results = {{kCurvature, table.numbers(kCurvature)},
                                 {"moment [N]", run.moment},
                                 {"tangent [N m]", run.tangent},
                                 {"stored [J/m2]", run.stored},
                                 {"dissipated [J/m2]", run.dissipated}};
  if (!run.relaxed.empty()) results.push_back({"relaxed [J/m2]", run.relaxed});
  check_results(results, table);
  std::cout << recovery_summary(request, rows, run) << stops_summary(request);
  Table(results).write(options.out);
  return 0;
}

}  // namespace hysteron::experiments
