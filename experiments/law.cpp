#include "experiments/law.h"

#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

#include "experiments/csv.h"
#include "sim/error.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kCurvature = "curvature [1/m]";
constexpr const char* kTime = "time [s]";
constexpr const char* kEdit = "edit";

std::string with_unit(double value, const char* unit) {
  std::ostringstream text;
  text << value << " " << unit;
  return text.str();
}

void check_curve(const VirginCurve& curve) {
  const auto refuse = [](const char* name, double value, const char* unit, const std::string& allowed) {
    throw Error::request(std::string("law: --") + name + " = " + with_unit(value, unit) + " must be " +
                         allowed);
  };
  if (!(curve.b2 >= 0) || !std::isfinite(curve.b2)) refuse("b2", curve.b2, "N m", "finite and >= 0");
  if (!(curve.b1 >= curve.b2) || !std::isfinite(curve.b1))
    refuse("b1", curve.b1, "N m", "finite and >= b2 = " + with_unit(curve.b2, "N m"));
  if (!(curve.k0 >= 0) || !std::isfinite(curve.k0)) refuse("k0", curve.k0, "1/m", "finite and >= 0");
}

void check_time(const Table& table, const std::filesystem::path& file) {
  const Column* time = table.find(kTime);
  if (!time) return;
  for (size_t row = 1; row < time->values.size(); ++row) {
    if (time->values[row] < time->values[row - 1]) {
      throw Error::request("law: " + file.string() + ":" + std::to_string(table.lines[row]) +
                           ": time = " + with_unit(time->values[row], "s") + " must be >= " +
                           with_unit(time->values[row - 1], "s") + ", the time of the row before");
    }
  }
}

}  // namespace

std::pair<std::string, LawParameter> parse_parameter(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw Error::request("law: --param '" + text + "' must have the form name=value");
  const std::string value = text.substr(equals + 1);
  double number = 0;
  const auto [end, failure] = std::from_chars(value.data(), value.data() + value.size(), number);
  const bool is_number = failure == std::errc() && end == value.data() + value.size();
  return {text.substr(0, equals), is_number ? LawParameter(number) : LawParameter(value)};
}

int run_law_command(const LawOptions& options) {
  check_curve(options.curve);
  LawRequest request{options.law, options.curve, {}};
  for (const std::string& text : options.parameters) {
    auto [name, value] = parse_parameter(text);
    request.parameters.insert_or_assign(name, value);
  }

  const Table table = read_csv(options.in, {kCurvature}, {kTime, kEdit}, "law");
  check_time(table, options.in);
  const std::vector<double>& curvature = table.find(kCurvature)->values;
  std::vector<LawRow> rows;
  for (double k : curvature) rows.push_back({k});

  LawRun run = run_law(request, rows);
  write_csv(options.out, {{{kCurvature, curvature},
                           {"moment [N]", std::move(run.moment)},
                           {"tangent [N m]", std::move(run.tangent)},
                           {"stored [J/m2]", std::move(run.stored)},
                           {"dissipated [J/m2]", std::move(run.dissipated)}},
                          {}});
  return 0;
}

}  // namespace hysteron::experiments
