#include "experiments/validate/effects.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace hysteron::experiments {

NumberEffects number_effects(const std::map<std::string, std::vector<double>>& drawn,
                             const std::map<std::string, Range>& ranges,
                             const std::vector<double>& coefficients) {
  const auto drapes = static_cast<Eigen::Index>(coefficients.size());
  const auto unknowns = static_cast<Eigen::Index>(drawn.size()) + 1;  // and the mean
  if (drawn.empty() || drapes < 2 * unknowns) return {};
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
  NumberEffects result{{}, std::sqrt(variance)};
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

NumberEffects effects_of_spread(const Table& spread, const FabricFile& file) {
  std::map<std::string, Range> ranges = file.range;
  for (const char* follows : {"b1", "b2", "kes-b", "kes-2hb"}) ranges.erase(follows);
  std::erase_if(ranges, [&](const auto& entry) {
    return !std::count(spread.head.begin(), spread.head.end(), entry.first);
  });
  std::map<std::string, std::vector<double>> drawn;
  std::vector<double> coefficients;
  for (std::size_t row = 0; row < spread.rows.size(); ++row) {
    if (spread.word(row, "fabric") != file.fabric.name) continue;
    coefficients.push_back(spread.number(row, "drape coefficient [%]"));
    for (const auto& [number, range] : ranges) {
      double value = spread.number(row, number);
      if (number == "bias-bending" && ranges.contains("weft-bending"))
        value *= (1 + file.fabric.weft_bending) / (1 + spread.number(row, "weft-bending"));
      drawn[number].push_back(value);
    }
  }
  return number_effects(drawn, ranges, coefficients);
}

}  // namespace hysteron::experiments
