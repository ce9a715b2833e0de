#include "experiments/validate/effects.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "experiments/validate/drapes.h"
#include "experiments/validate/figure.h"
#include "sim/base/comma_list.h"

namespace hysteron::experiments {

NumberEffects number_effects(const std::map<std::string, std::vector<double>>& drawn,
                             const std::map<std::string, Range>& ranges,
                             const std::vector<double>& coefficients) {
  const auto drapes = static_cast<Eigen::Index>(coefficients.size());
  const auto unknowns = static_cast<Eigen::Index>(drawn.size()) + 1;  // one for the mean
  NumberEffects result{{}, 0, coefficients.size(), 2 * static_cast<std::size_t>(unknowns)};
  if (drawn.empty() || result.drapes < result.needed) return result;
  Eigen::MatrixXd rows(drapes, unknowns);
  rows.col(0).setOnes();
  Eigen::Index column = 1;
  for (const auto& [number, values] : drawn) {
    for (Eigen::Index i = 0; i < drapes; ++i) rows(i, column) = std::log(values[static_cast<std::size_t>(i)]);
    rows.col(column).array() -= rows.col(column).mean();
    ++column;
  }
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(coefficients.data(), drapes);
  const Eigen::LDLT<Eigen::MatrixXd> normal(rows.transpose() * rows);
  const Eigen::VectorXd slopes = normal.solve(rows.transpose() * y);
  const double variance = (y - rows * slopes).squaredNorm() / static_cast<double>(drapes - unknowns);
  const Eigen::VectorXd spread = normal.solve(Eigen::MatrixXd::Identity(unknowns, unknowns)).diagonal();
  result.scatter = std::sqrt(variance);
  column = 1;
  for (const auto& [number, values] : drawn) {
    const Range& range = ranges.at(number);
    const double length = std::log(range.high / range.low);
    result.effects.push_back({number, range.low, range.high, slopes[column] * length,
                              std::sqrt(variance * spread[column]) * length});
    ++column;
  }
  std::ranges::stable_sort(result.effects, std::greater(),
                           [](const NumberEffect& effect) { return std::abs(effect.change); });
  return result;
}

namespace {

// Returns the column with this number as drawn; "" if the table lacks it.
std::string drawn_column(const Table& spread, const std::string& number) {
  const auto has = [&](const std::string& name) {
    return std::ranges::find(spread.head, name) != spread.head.end();
  };
  if (has(kDrawn + number)) return kDrawn + number;
  return has(number) ? number : "";
}

}  // namespace

NumberEffects effects_of_spread(const Table& spread, const FabricFile& file) {
  std::map<std::string, Range> ranges = uncertain_numbers(file);
  std::erase_if(ranges, [&](const auto& entry) { return drawn_column(spread, entry.first).empty(); });
  std::map<std::string, std::vector<double>> drawn;
  std::vector<double> coefficients;
  for (std::size_t row = 0; row < spread.rows.size(); ++row) {
    if (spread.word(row, "fabric") != file.fabric.name) continue;
    coefficients.push_back(spread.number(row, "drape coefficient [%]"));
    for (const auto& [number, range] : ranges) {
      const std::string column = drawn_column(spread, number);
      double value = spread.number(row, column);
      // In tables without the drawn numbers, bias depends on the ratio of weft (keep_what_was_measured()).
      if (column == "bias-bending" && ranges.contains("weft-bending"))
        value *= (1 + file.fabric.weft_bending) / (1 + spread.number(row, "weft-bending"));
      drawn[number].push_back(value);
    }
  }
  return number_effects(drawn, ranges, coefficients);
}

void note_effects(Run& run, const EffectsByFabric& all) {
  Table table({"fabric", "number", "low", "high", "drape changes by [%]", "standard error [%]",
               "scatter that no number explains [%]"});
  for (const auto& [fabric, found] : all)
    for (const NumberEffect& e : found.effects)
      table.row({fabric, e.number, e.low, e.high, e.change, e.error, found.scatter});
  if (!table.rows.empty()) table.write(run.path("effects.csv"));
  const auto& [fabric, last] = all.back();
  if (last.effects.empty()) {
    if (last.drapes < last.needed)
      run.progress(fmt::format("{}: {} drapes are too few to tell which number moves them most: --samples {}",
                               fabric, last.drapes, last.needed));
    return;
  }
  constexpr std::size_t kShown = 3;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(kShown, last.effects.size()); ++i) {
    const NumberEffect& e = last.effects[i];
    parts.push_back(fmt::format("{} {:+.1f} +- {:.1f} %", e.number, e.change, e.error));
  }
  run.progress(fabric + ": over their ranges its numbers move the drape by " + join(parts, ", "));
  run.metric(fabric + ".largest_effect", last.effects.front().number);
  run.metric(fabric + ".largest_effect_percent", last.effects.front().change);
  run.metric(fabric + ".largest_effect_stderr_percent", last.effects.front().error);
}

namespace {

// Returns the numbers of all fabrics, ordered by their largest effect on any drape.
std::vector<std::string> numbers_by_effect(const EffectsByFabric& all) {
  std::map<std::string, double> largest;
  for (const auto& [fabric, found] : all)
    for (const NumberEffect& e : found.effects)
      largest[e.number] = std::max(largest[e.number], std::abs(e.change));
  std::vector<std::string> numbers;
  for (const auto& [number, change] : largest) numbers.push_back(number);
  std::ranges::stable_sort(numbers, std::greater(), [&](const std::string& n) { return largest.at(n); });
  return numbers;
}

}  // namespace

render::Plot effects_plot(const EffectsByFabric& all) {
  constexpr double kApart = 0.14;  // offset of fabrics, over the distance between two numbers
  render::Plot plot{"What moves a drape, each number over its range", {""}, {"drape coefficient [points]"}};
  plot.x.categories = numbers_by_effect(all);
  render::Series errors{"standard error", {}, {}, render::Series::Style::line, "#888888"};
  for (std::size_t f = 0; f < all.size(); ++f) {
    const auto& [fabric, found] = all[f];
    render::Series series{fabric, {}, {}, render::Series::Style::points, fabric_color(f)};
    for (const NumberEffect& e : found.effects) {
      const auto place = std::ranges::find(plot.x.categories, e.number) - plot.x.categories.begin();
      const double x = static_cast<double>(place) +
                       kApart * (static_cast<double>(f) - (static_cast<double>(all.size()) - 1) / 2);
      series.add(x, e.change);
      for (const double sign : {-1., 1., double(NAN)}) errors.add(x, e.change + sign * e.error);
    }
    if (!series.x.empty()) plot.series.push_back(series);
  }
  if (plot.series.empty()) return plot;
  plot.key_inside = true;
  plot.x.low = -0.5, plot.x.high = static_cast<double>(plot.x.categories.size()) - 0.5;
  plot.series.insert(plot.series.begin(), errors);
  return plot;
}

}  // namespace hysteron::experiments
