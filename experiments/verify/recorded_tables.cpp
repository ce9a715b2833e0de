#include "experiments/verify/recorded_tables.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "experiments/workbench/pages/manifest.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string column_name(const std::string& file, const std::string& column) { return file + ":" + column; }

// Returns the metric whose history the column is: plate_force_N for "plate_force [N]"; a page's columns are
// metrics by their own names.  "" if there is none.
std::string metric_of_column(const Metrics& metrics, const std::string& column) {
  if (metrics.contains(column)) return column;
  for (const auto& [name, value] : metrics)
    if (const NamedUnit parts = split_unit(name);
        quantity_in(column) == quantity_in(parts.text()) && unit_in(column) == unit_in(parts.text()))
      return name;
  return "";
}

// Returns the relative size of the last printed digit: a table of words and numbers has six digits, a series
// all.
double printed_round_off(const std::string& text) {
  constexpr int kTableDigits = 6;
  const std::size_t first = std::min(text.find_first_of("123456789"), text.size());
  const std::string mantissa = text.substr(first, text.find_first_of("eE", first) - first);
  const auto digits =
      std::count_if(mantissa.begin(), mantissa.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  return digits > kTableDigits ? 0 : std::pow(10., 1 - kTableDigits);
}

// Returns the column's name without the ending of a mean or a standard error over draws.
std::string drawn_metric(const std::string& column) {
  for (const std::string ending : {"_mean", "_stderr"})
    if (column.ends_with(ending)) return column.substr(0, column.size() - ending.size());
  return column;
}

// True for durations and columns that like them depend on the machine's load: memory, and the front of the
// cheapest settings.  They are recognised by their units, too, as a scene may call a length `wall`.
bool is_duration_column(const std::string& column) {
  static const std::set<std::string> kNames = {"computing [s]", "wall [s]", "memory [byte]", "on front"};
  return is_duration(drawn_metric(column)) || kNames.contains(column);
}

bool is_effort_column(const std::string& column) {
  return is_effort(drawn_metric(column)) || column == "remainder [J]";
}

// Compares two columns of one name as written in the tables.
class ColumnPair {
 public:
  ColumnPair(const Table& before, const Table& now, const std::string& column)
      : before_(before), now_(now), i_(before.at(column)), j_(now.at(column)) {
    for (std::size_t row = 0; row < before_.rows.size(); ++row) compare_row(row);
  }

  bool is_same() const { return !differs_; }
  // Returns the first row in which the two differ and one is no number; nothing if all that differ are
  // numbers.
  std::optional<std::size_t> word_row() const { return word_row_; }
  std::size_t worst_row() const { return worst_row_; }
  double before() const { return *number_in(before_.rows[worst_row_][i_]); }
  double now() const { return *number_in(now_.rows[worst_row_][j_]); }
  double largest() const { return largest_; }
  double printed() const { return printed_; }

 private:
  void compare_row(std::size_t row) {
    const std::string &a = before_.rows[row][i_], &b = now_.rows[row][j_];
    const std::optional<double> x = number_in(a), y = number_in(b);
    if (x && std::isfinite(*x)) largest_ = std::max(largest_, std::abs(*x));
    if (a == b) return;
    differs_ = true;
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
      if (!word_row_) word_row_ = row;
      return;
    }
    printed_ = std::max(printed_, std::min(printed_round_off(a), printed_round_off(b)));
    if (const double difference = std::abs(*x - *y); difference >= worst_)
      worst_row_ = row, worst_ = difference;
  }

  const Table &before_, &now_;
  std::size_t i_, j_, worst_row_ = 0;
  bool differs_ = false;
  std::optional<std::size_t> word_row_;
  double largest_ = 0, printed_ = 0, worst_ = 0;
};

class TablePair {
 public:
  TablePair(std::string file, const Table& before, const Table& now)
      : file_(std::move(file)), before_(before), now_(now) {
    for (const std::string& column : before_.head)
      if (unit_in(column) == "J" && now_.find(column))
        largest_energy_ = std::max(largest_energy_, ColumnPair(before_, now_, column).largest());
  }

  void compare(const Manifest& manifest, const Limits& limits, Repetition& repetition) const {
    for (const std::string& column : before_.head) {
      if (is_duration_column(column)) continue;
      const std::string name = column_name(file_, column);
      if (!now_.find(column)) {
        repetition.missing.push_back(name);
        continue;
      }
      ++repetition.series.count;
      const ColumnPair pair(before_, now_, column);
      if (!pair.is_same()) compare_column(column, pair, manifest, limits, repetition);
    }
  }

  // Records the columns that only the repetition has: the same program writes the same ones, and a later one
  // those that the scene requests.
  void add_unrecorded(const Manifest& recorded, const Manifest& now, Repetition& repetition) const {
    for (const std::string& column : now_.head) {
      if (before_.find(column) || is_duration_column(column)) continue;
      const std::string metric = metric_of_column(now.metrics, column);
      if (recorded.commit == now.commit || std::ranges::count(now.requested_metrics, metric) > 0)
        repetition.unrecorded.push_back(column_name(file_, column));
    }
  }

 private:
  void compare_column(const std::string& column, const ColumnPair& pair, const Manifest& manifest,
                      const Limits& limits, Repetition& repetition) const {
    const std::string name = column_name(file_, column), metric = metric_of_column(manifest.metrics, column);
    const std::optional<double> own_limit = limit(limits, name, metric);
    ComparedNumbers& found = repetition.series;
    if (!own_limit && is_effort_column(column))
      found.effort.push_back(name);
    else if (column == "state_hash")  // by run of a study; other bits are no difference
      found.rounded.push_back(name);
    else if (const auto row = pair.word_row())
      found.beyond.push_back(fmt::format("{} in row {}", name, *row + 1));
    else
      compare_numbers({.name = fmt::format("{} in row {}", name, pair.worst_row() + 1),
                       .before = pair.before(),
                       .now = pair.now(),
                       .round_off = (repetition.round_off + pair.printed()) * size(column, metric, pair),
                       .limit = own_limit,
                       .stated_error = metric.empty() ? 0 : stated_error(manifest.metrics, metric)},
                      found);
  }

  double size(const std::string& column, const std::string& metric, const ColumnPair& pair) const {
    if (unit_in(column) == "J") return largest_energy_;
    return metric_scale(metric.empty() ? column : metric, pair.largest());
  }

  static std::optional<double> limit(const Limits& limits, const std::string& name,
                                     const std::string& metric) {
    const std::optional<double> own = limits.of_metric(name);
    return own || metric.empty() ? own : limits.of_metric(metric);
  }

  const std::string file_;
  const Table &before_, &now_;
  double largest_energy_ = 0;  // [J]
};

}  // namespace

void compare_tables(const std::vector<std::string>& names, const fs::path& recorded, const fs::path& now,
                    const Manifest& manifest, const Manifest& manifest_now, const Limits& limits,
                    Repetition& repetition) {
  std::error_code ignored;
  for (const std::string& name : names) {
    if (!fs::is_regular_file(now / name, ignored)) {
      repetition.missing.push_back(name);
      continue;
    }
    try {
      const Table before = read_table(recorded / name), after = read_table(now / name);
      if (before.rows.size() != after.rows.size()) {
        repetition.series.beyond.push_back(
            fmt::format("{} with {} rows, now {}", name, before.rows.size(), after.rows.size()));
        continue;
      }
      const TablePair tables(name, before, after);
      tables.compare(manifest, limits, repetition);
      tables.add_unrecorded(manifest, manifest_now, repetition);
    } catch (const Error& error) {
      repetition.series.beyond.push_back(name + ": " + error.what());
    }
  }
}

TableColumns table_columns(const std::string& file, const fs::path& folder) {
  TableColumns columns;
  for (const std::string& column : read_table(folder / file).head)
    (is_duration_column(column) ? columns.durations : columns.compared).push_back(column_name(file, column));
  return columns;
}

}  // namespace hysteron::experiments
