// `hysteron law` runs one law alone, from a list of curvatures to moments and energies.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run_files.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/rising_time.h"
#include "sim/bending/laws/law_run.h"
#include "sim/bending/laws/recovery.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/reference/kes.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::experiments {
namespace {

struct LawFlags {
  std::string law = "prandtl";
  std::string fabric = "cotton-broad";
  VirginCurve curve{};  // includes the fabric's bending parts
  Parameters param;
  std::string in;   // input with columns `curvature [1/m]`, optional `time [s]`, `edit`
  std::string out;  // output: curvature, moment, tangent, stored, dissipated (cumulative)
};

using L = LawFlags;
// clang-format off
const KeyRow<LawFlags> kRows[] = {
    {"fabric", at<&L::fabric>, "", any(), "whose b1, b2, k0 are taken where not given, and what its file has beyond them; its stops unless b1 or k0 is given"},
    {"law", at<&L::law>, "", any(), "see `hysteron list laws`"},
    {"b1", at<&L::curve, &VirginCurve::b1>, "N m", at_least(0), "initial bending rigidity, >= b2"},
    {"b2", at<&L::curve, &VirginCurve::b2>, "N m", at_least(0), "bending rigidity of the straight branch"},
    {"k0", at<&L::curve, &VirginCurve::k0>, "1/m", at_least(0), "curvature at which friction saturates"},
    {"param", at<&L::param>, "", any(), "parameters of the law"},
    {"in", at<&L::in>, "", any(), "CSV with column `curvature [1/m]`, optional `time [s]` and `edit`"},
    {"out", at<&L::out>, "", any(), "CSV with moments and energies"},
};
// clang-format on

constexpr const char* kCurvature = "curvature [1/m]";
constexpr const char* kTime = "time [s]";
constexpr const char* kEdit = "edit";

void warn(const std::string& text) {
  if (!text.empty()) std::cerr << "warning: " << text << std::endl;
}

// Warns of doubtful numbers, of the fabric and of those given in their place.
void check_numbers(const CommandLine& line, const LawFlags& flags) {
  std::vector<std::string> warnings = checked_fabric_warnings(flags.fabric);
  const std::pair<const char*, double> numbers[] = {
      {"b1", flags.curve.b1}, {"b2", flags.curve.b2}, {"k0", flags.curve.k0}};
  for (const auto& [name, value] : numbers) {
    const std::string key = name;
    if (last_text(line.flags, key, "").empty()) continue;
    check_fabric_number(key, value, key, "--" + key);
    std::erase_if(warnings, [&](const std::string& text) { return text.starts_with("fabric." + key + " "); });
    warnings.push_back(fabric_number_warning(key, value, key, "--" + key));
  }
  for (const std::string& text : warnings) warn(text);
}

void check_curve(const VirginCurve& curve) {
  const auto refuse = [](const char* name, double value, const char* unit, const std::string& allowed) {
    throw Error::invalid_input(std::string("--") + name + " = " + number_text(value, 6, unit) + " must be " +
                               allowed)
        .with_key(name, number_text(value, 6))
        .with_experiment("law");
  };
  if (!(curve.b2 >= 0) || !std::isfinite(curve.b2)) refuse("b2", curve.b2, "N m", "finite and >= 0");
  if (!(curve.b1 >= curve.b2) || !std::isfinite(curve.b1))
    refuse("b1", curve.b1, "N m", "finite and >= b2 = " + number_text(curve.b2, 6, "N m"));
  if (!(curve.k0 >= 0) || !std::isfinite(curve.k0)) refuse("k0", curve.k0, "1/m", "finite and >= 0");
}

// Returns a column's numbers, or nothing if the table lacks the column.
std::vector<double> metric_values(const Table& table, const std::string& column) {
  return table.find(column) ? table.numbers(column) : std::vector<double>{};
}

void check_edit(const Table& table) {
  const std::vector<double> edit = metric_values(table, kEdit);
  for (size_t row = 0; row < edit.size(); ++row) {
    if (edit[row] != 0 && edit[row] != 1) {
      throw table.refusal(row, "edit = " + number_text(edit[row], 6) + " must be 0 or 1");
    }
  }
}

constexpr double kSharpest = 1e6;  // limit of a bend [1/m]; fibres are thicker than its radius, 1 um

void check_curvature(const Table& table) {
  const std::vector<double> curvature = table.numbers(kCurvature);
  for (size_t row = 0; row < curvature.size(); ++row) {
    if (std::abs(curvature[row]) > kSharpest)
      throw table.refusal(row, "curvature = " + number_text(curvature[row], 6, "1/m") + " must be within +-" +
                                   number_text(kSharpest, 6, "1/m"));
  }
}

// Throws if a result is not finite: parameters of any size are allowed, and may overflow.
void check_results(const std::vector<Column>& results, const Table& table) {
  for (size_t row = 0; row < table.lines.size(); ++row) {
    for (const Column& column : results) {
      if (!std::isfinite(column.values[row]))
        throw table.refusal(row, "at curvature = " + number_text(results[0].values[row], 6, "1/m") +
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

// Throws if a law that depends on time gets times that never rise.
void check_time_passes(const Table& table, const LawRequest& request) {
  const std::vector<double> time = metric_values(table, kTime);
  if (time.size() < 2 || time.back() > time.front() || !takes_time(request)) return;
  throw table.refusal(time.size() - 1, "time = " + number_text(time.back(), 6, "s") +
                                           " must rise from the first row to the last: law " + request.name +
                                           " takes time");
}

std::string time_warning(const Table& table, const LawRequest& request) {
  if (table.find(kTime) || !takes_time(request)) return "";
  return table.file + " has no column time [s], and law " + request.name +
         " takes time: every row is taken as a step of 1 s";
}

constexpr int kParts = 8;  // steps that each row is divided into, to see the effect of its length
constexpr std::size_t kMostPartSteps = 100000;  // larger inputs are not checked
constexpr double kMostByLength = 0.02;          // largest relative difference allowed
constexpr double kRoundingOfEnergy = 1e-9;  // rounding over the largest moment times the largest curvature

// Divides each row into `kParts` equal steps that take its time together; an edit follows the last.
std::vector<LawRow> rows_in_parts(const std::vector<LawRow>& rows) {
  std::vector<LawRow> parts;
  double before = 0;
  for (const LawRow& row : rows) {
    for (int part = 1; part < kParts; ++part)
      parts.push_back({before + (row.curvature - before) * part / kParts, row.seconds / kParts});
    parts.push_back({row.curvature, row.seconds / kParts, row.edit});
    before = row.curvature;
  }
  return parts;
}

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

// Returns the largest relative difference of the last moment, the largest moment and the lost energy at the
// rows' ends; 0 if a number of either run is not finite, or is rounding in laws that lose no energy.
double difference_by_length(const std::vector<LawRow>& rows, const LawRun& whole, const LawRun& parts) {
  LawRun ends;
  for (std::size_t i = kParts - 1; i < parts.moment.size(); i += kParts) {
    ends.moment.push_back(parts.moment[i]);
    ends.dissipated.push_back(parts.dissipated[i]);
  }
  const auto over = [](double difference, double largest) {
    const double ratio = std::abs(difference) / largest;
    return largest > 0 && std::isfinite(ratio) ? ratio : 0;
  };
  const double most = largest_of(ends.moment), most_whole = largest_of(whole.moment),
               lost = largest_of(ends.dissipated), lost_whole = largest_of(whole.dissipated);
  const double scale = std::max(most, most_whole);
  double sharpest = 0;
  for (const LawRow& row : rows) sharpest = std::max(sharpest, std::abs(row.curvature));
  const double least_lost = kRoundingOfEnergy * scale * sharpest;
  const double most_lost = std::max({lost, lost_whole, least_lost});
  return std::max({over(whole.moment.back() - ends.moment.back(), scale), over(most_whole - most, scale),
                   over(whole.dissipated.back() - ends.dissipated.back(), most_lost)});
}

// Warns if the answer depends on the steps' lengths, as with narain, kim, laws that depend on time, and
// fatigue.
std::string step_length_warning(const LawRequest& request, const std::vector<LawRow>& rows,
                                const LawRun& whole) {
  if (rows.size() * kParts > kMostPartSteps) return "";
  const double difference = difference_by_length(rows, whole, run_law(request, rows_in_parts(rows)));
  if (!(difference > kMostByLength)) return "";
  return fmt::format(
      "law {}: rows are taken as whole steps: with each cut into eight the moment or the dissipated energy "
      "differs by {:.2g} %: give more rows",
      request.name, 100 * difference);
}

// Returns what a bending tester would read of the fabric's stops.
std::string stops_summary(const LawRequest& request) {
  if (request.curve.parts.stops.empty()) return "";
  const KesProtocol p;
  const KesPair pair = kes_pair(request.curve, p);
  return fmt::format("stops{}: B = {} between {:g} and {}, 2HB = {} at {}, HB/B = {}\n",
                     request.curve.parts.faces.on() ? " (bends to the face)" : "",
                     number_text(pair.rigidity, 6, "N m"), p.slope_from, number_text(p.slope_to, 6, "1/m"),
                     number_text(pair.loop_width, 6, "N"), number_text(p.width_at, 6, "1/m"),
                     number_text(pair.loop_width / 2 / pair.rigidity, 6, "1/m"));
}

std::string recovery_summary(const LawRequest& request, const std::vector<LawRow>& rows, const LawRun& run) {
  const LawParams choice = choose_law(request.name, request.curve, request.parameters, LawUse::alone);
  const RecoveryCounts counts = count_recoveries(choice.curve, rows, run);
  std::string text = fmt::format(
      "reversals from |M| <= Ma: {}, <= 2 Ma: {}, > 2 Ma: {}\nresidual curvature after the last row: {}",
      counts.of[0], counts.of[1], counts.of[2],
      number_text(residual_after(request, rows), 6, "1/m") + " (root)");
  if (has_residual_formula(choice))
    text += ", " +
            number_text(residual_by_formula(choice, rows.back().curvature, run.moment.back()), 6, "1/m") +
            " (formula, if that row lies on the virgin curve)";
  return text + "\n";
}

// Drops the fabric's stops if b1 or k0 is given, because these mean friction of three numbers.
void drop_stops_unless_asked_for(const CommandLine& line, LawFlags& flags) {
  const bool by_hand = std::any_of(line.flags.begin(), line.flags.end(),
                                   [](const Flag& flag) { return flag.path == "b1" || flag.path == "k0"; });
  if (by_hand) flags.curve.parts.stops = flags.curve.parts.weft_stops = {};
}

// The end of the first line of every table of results.
constexpr const char* kResultsMark = ",moment [N],tangent [N m],stored [J/m2],dissipated [J/m2]";

// Reads the fabric and applies the flags over its numbers.
LawFlags read_flags(const CommandLine& line) {
  LawFlags flags;
  const Keys keys = bind(kRows, flags);
  const auto apply = [&](const Flag& flag) { assign_flag(keys, flag); };
  for (const Flag& flag : line.flags)
    if (flag.path == "fabric") apply(flag);
  Fabric fabric = read_fabric(flags.fabric, "--fabric").fabric;
  for (const Flag& flag : line.flags) {
    if (flag.path != "k0" || !fabric.kes.gives_numbers()) continue;
    apply(flag);
    fabric.k0 = flags.curve.k0;
    fabric.follow_kes();  // so that B and 2HB stay
  }
  flags.curve = fabric.virgin_curve();
  for (const Flag& flag : line.flags) apply(flag);
  drop_stops_unless_asked_for(line, flags);
  if (flags.in.empty() || flags.out.empty()) throw Error::invalid_input("needs --in K.csv and --out M.csv");
  std::error_code missing;
  if (std::filesystem::equivalent(flags.in, flags.out, missing))
    throw Error::invalid_input("--out " + flags.out + " is the input: give another file")
        .with_key("out", flags.out);
  require_own_file(flags.out, kResultsMark, "a table of moments", "out");
  return flags;
}

// Runs the table through the law.  The first row is the first curvature visited from rest; every row is one
// accepted step, which takes the difference of the two times (the first row: 0 s), or 1 s without a `time`
// column, with a warning for laws that depend on time; time must not fall.  `edit` = 1 sets the rest
// curvature to that of the row (grinspun-edit; others ignore it).  Prints the reversals by recovery case, and
// the residual curvature after the last row.
int run_law_command(const CommandLine& line) {
  const LawFlags flags = read_flags(line);
  check_curve(flags.curve);
  check_numbers(line, flags);
  const LawRequest request{flags.law, flags.curve, flags.param};
  const Table table = read_csv(flags.in, {kCurvature}, {kTime, kEdit}, "law");
  check_curvature(table);
  check_time_rises(table, metric_values(table, kTime));
  check_edit(table);
  check_time_passes(table, request);
  warn(time_warning(table, request));
  for (const std::string& text : unused_parameter_warnings(request.name, request.curve, request.parameters,
                                                           LawUse::alone, flags.fabric))
    warn(text);
  const std::vector<LawRow> rows = law_table_rows(table);
  const LawRun run = run_law(request, rows);
  std::vector<Column> results = {{kCurvature, table.numbers(kCurvature)},
                                 {"moment [N]", run.moment},
                                 {"tangent [N m]", run.tangent},
                                 {"stored [J/m2]", run.stored},
                                 {"dissipated [J/m2]", run.dissipated}};
  if (!run.relaxed.empty()) results.push_back({"relaxed [J/m2]", run.relaxed});
  check_results(results, table);
  warn(step_length_warning(request, rows, run));
  std::cout << recovery_summary(request, rows, run) << stops_summary(request);
  Table(results).write(flags.out);
  return 0;
}

}  // namespace

Experiment law() {
  return {.name = "law",
          .question = "one law alone: curvatures in, moments out (CSV)",
          .run = run_law_command,
          .own_keys = own_key_descriptions<kRows>};
}

}  // namespace hysteron::experiments
