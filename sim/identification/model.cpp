#include "sim/identification/model.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/identification/identification.h"
#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

constexpr int kScanned = 36;                       // k0 a factor of 1.26 apart,
constexpr double kScanLow = 1e-2, kScanHigh = 30;  // over the largest curvature
constexpr double kLargestRigidity = 1e4;
constexpr double kWide = 100;               // for nuisance parameters: no bound
constexpr double kFarthestFactor = 9;       // of a logarithm
constexpr double kSmallestRigidity = 1e-6;  // over the measurement's slope: avoids the logarithm of zero
constexpr double kUsualK0 = 50;             // [1/m]
constexpr double kUnread = 1e-9;            // over the largest moment: rounding
constexpr double kSameModel = 1e-8;         // over the largest moment: the law is linear in b2 and g

// Solves least squares whose first two coefficients are >= 0, by trying which of them is zero.
Eigen::VectorXd nonnegative_solution(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(columns.cols());
  double least = INFINITY;
  for (const auto& [first, second] : {std::pair{1, 1}, {1, 0}, {0, 1}}) {
    Eigen::MatrixXd used = columns;
    used.col(0) *= first;
    used.col(1) *= second;
    Eigen::VectorXd solution = linear_least_squares(used, values);
    solution[0] *= first;
    solution[1] *= second;
    const double sum = (columns * solution - values).squaredNorm();
    if (solution[0] < 0 || solution[1] < 0 || sum >= least) continue;
    best = solution;
    least = sum;
  }
  return best;
}

}  // namespace

MomentModel::MomentModel(const MomentSeries& series, const LawRequest& law, SoughtBeside beside, bool cycling)
    : law_(law),
      rows_(law_rows(series, cycling)),
      moment_(Eigen::Map<const Eigen::VectorXd>(series.moment.data(), series.rows())),
      beside_(beside),
      turns_(sought_turns(series, cycling, beside.step_at_turns)),
      largest_(series.largest_moment()),
      curvature_(series.largest_curvature()),
      slope_(largest_ / curvature_) {
  LawRequest request = law_;  // throws here for an unknown law or parameter, whatever the numbers are
  request.curve = {slope_, slope_ / 2, std::min(kUsualK0, curvature_)};
  run_law(request, {LawRow{}});
}

double MomentModel::curvature_zero(const CurvePoint& point) const {
  return beside_.curvature ? point.nuisance[zeros() - 1] * curvature_ : 0;
}

Eigen::VectorXd MomentModel::law_moments(const CurvePoint& point) const {
  LawRequest request = law_;
  request.curve = point.curve();
  DrivenRows driven = turns_.empty()
                          ? DrivenRows{rows_, {}}
                          : with_turns(rows_, static_cast<int>(moment_.size()), turns_, turns_at(point));
  if (beside_.curvature)
    for (LawRow& row : driven.rows) row.curvature -= curvature_zero(point);
  std::vector<double> all(driven.rows.size(), kNone);
  try {
    all = run_law(request, driven.rows).moment;
  } catch (const Error&) {
    // The law has bounds on its numbers: beyond them it describes nothing.
  }
  if (!driven.is_added.empty()) all = without_added(all, driven);
  const Eigen::Map<const Eigen::VectorXd> moments(all.data(), static_cast<int>(all.size()));
  return moments.tail(moment_.size());
}

Eigen::VectorXd MomentModel::moments(const CurvePoint& point) const {
  return law_moments(point).array() + (beside_.moment ? point.nuisance[0] * largest_ : 0);
}

Eigen::VectorXd MomentModel::residuals(const CurvePoint& point) const {
  return (moments(point) - moment_) / largest_;
}

std::vector<double> MomentModel::turning_curvatures(const CurvePoint& point) const {
  std::vector<double> curvatures;
  for (std::size_t i = 0; i < turns_.size(); ++i)
    curvatures.push_back(turns_[i].curvature_at(turns_at(point)[static_cast<int>(i)]));
  return curvatures;
}

std::vector<Eigen::VectorXd> MomentModel::nuisance_starts() const {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(nuisances());
  std::vector<Eigen::VectorXd> starts = {nothing};
  if (!beside_.curvature) return starts;
  const auto [low, high] = std::minmax_element(
      rows_.begin(), rows_.end(), [](const LawRow& a, const LawRow& b) { return a.curvature < b.curvature; });
  for (const double zero : {(low->curvature + high->curvature) / 2, rows_.front().curvature}) {
    starts.push_back(nothing);
    starts.back()[zeros() - 1] = zero / curvature_;
  }
  return starts;
}

MomentModel::LinearSolution MomentModel::linear_at(double k0, const Eigen::VectorXd& nuisance) const {
  const Eigen::VectorXd elastic = moments({slope_, 0, k0, nuisance, 0});
  Eigen::MatrixXd columns(moment_.size(), beside_.moment ? 3 : 2);
  columns.col(0) = elastic / largest_;
  columns.col(1) = (moments({slope_, slope_, k0, nuisance, 0}) - elastic) / largest_;
  if (beside_.moment) columns.col(2).setOnes();
  if (!columns.allFinite()) return {{slope_, slope_, k0, nuisance, INFINITY}, true};
  Eigen::VectorXd best = nonnegative_solution(columns, moment_ / largest_);
  best.head<2>() = best.head<2>().cwiseMax(kSmallestRigidity);
  CurvePoint point{best[0] * slope_, best[1] * slope_, k0, nuisance, 0};
  if (beside_.moment) point.nuisance[0] = best[2];
  point.sum = residuals(point).squaredNorm();
  const double foreseen = (columns * best - moment_ / largest_).squaredNorm();
  return {point, std::abs(point.sum - foreseen) <= kSameModel * static_cast<double>(moment_.size())};
}

CurvePoint MomentModel::best_at(double k0, int& iterations) const {
  const std::vector<Eigen::VectorXd> starts = nuisance_starts();
  LinearSolution best = linear_at(k0, starts[0]);
  if (beside_.curvature) {
    for (std::size_t i = 1; i < starts.size(); ++i)
      if (const LinearSolution other = linear_at(k0, starts[i]); other.point.sum < best.point.sum)
        best = other;
    const CurvePoint found = searched_from(best.point, iterations);
    return found.sum < best.point.sum ? found : best.point;
  }
  if (best.holds) return best.point;
  const CurvePoint other = searched_from({slope_ / 2, slope_ / 2, k0, starts[0], 0}, iterations);
  return other.sum < best.point.sum ? other : best.point;
}

CurvePoint MomentModel::searched_from(const CurvePoint& begin, int& iterations, SearchLimits limits) const {
  const auto numbers = [&](const Eigen::VectorXd& factor) {
    return CurvePoint{begin.b2 * factor[0], begin.g * factor[1], begin.k0, {}, 0};
  };
  const Tied tied = fit_tied(*this, numbers, 2, begin, limits);
  iterations += tied.iterations;
  return tied.best;
}

UnreadNumbers MomentModel::unread(const CurvePoint& point) const {
  const auto differs = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return !((a - b).cwiseAbs().maxCoeff() <= kUnread * largest_);
  };
  CurvePoint stiffer = point;  // with friction, which the best fit may hardly have
  stiffer.g += point.b2 + point.g;
  CurvePoint sooner = stiffer, later = stiffer;
  sooner.k0 /= 2;
  later.k0 *= 2;
  const Eigen::VectorXd moments = law_moments(stiffer);
  return {!differs(law_moments(point), moments),
          !differs(law_moments(sooner), moments) && !differs(law_moments(later), moments)};
}

Eigen::VectorXd MomentModel::parameters(const CurvePoint& point) const {
  Eigen::VectorXd result(3 + point.nuisance.size());
  result[0] = std::log(point.b2 / slope_);
  result[1] = std::log(point.g / slope_);
  result[2] = std::log(point.k0 / curvature_);
  result.tail(point.nuisance.size()) = point.nuisance;
  return result;
}

CurvePoint MomentModel::point(const Eigen::VectorXd& parameters) const {
  return {std::exp(parameters[0]) * slope_, std::exp(parameters[1]) * slope_,
          std::exp(parameters[2]) * curvature_, parameters.tail(parameters.size() - 3), 0};
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> MomentModel::nuisance_bounds() const {
  Eigen::VectorXd low = Eigen::VectorXd::Constant(nuisances(), -kWide), high = -low;
  for (int i = zeros(); i < nuisances(); ++i) {
    low[i] = turns_[i - zeros()].low;
    high[i] = turns_[i - zeros()].high;
  }
  return {low, high};
}

std::pair<Eigen::VectorXd, Eigen::VectorXd> MomentModel::bounds() const {
  Eigen::VectorXd low(3 + nuisances()), high(3 + nuisances());
  const auto [nuisance_low, nuisance_high] = nuisance_bounds();
  low << std::log(kSmallestRigidity), std::log(kSmallestRigidity), std::log(kScanLow / 2), nuisance_low;
  high << std::log(kLargestRigidity), std::log(kLargestRigidity), std::log(kScanHigh * 2), nuisance_high;
  return {low, high};
}

std::vector<double> MomentModel::scanned_k0() const {
  std::vector<double> all;
  for (int i = 0; i < kScanned; ++i) {
    const double fraction = static_cast<double>(i) / (kScanned - 1);
    all.push_back(curvature_ * kScanLow * std::pow(kScanHigh / kScanLow, fraction));
  }
  return all;
}

std::vector<CurvePoint> MomentModel::scan(int& iterations) const {
  std::vector<CurvePoint> points;
  for (const double k0 : scanned_k0()) points.push_back(best_at(k0, iterations));
  return points;
}

CurvePoint MomentModel::start_with_turns(const CurvePoint& at_rows) const {
  CurvePoint best = at_rows;
  best.nuisance = Eigen::VectorXd::Zero(nuisances());
  best.nuisance.head(zeros()) = at_rows.nuisance;
  const Eigen::VectorXd at = best.nuisance;
  Eigen::VectorXd even = at;
  for (int turn = 0; turn < nuisances() - zeros(); ++turn) even[zeros() + turn] = turns_[turn].by_even_steps;
  for (const double times : {1., 2., 4.})  // turns at rows make k0 small
    for (const Eigen::VectorXd& nuisance : {at, even})
      if (const CurvePoint other = linear_at(times * at_rows.k0, nuisance).point; other.sum < best.sum)
        best = other;
  return best;
}

Tied fit_tied(const MomentModel& model, const FromFactors& numbers, int factors, const CurvePoint& start,
              SearchLimits limits) {
  const int others = static_cast<int>(start.nuisance.size());
  const auto point = [&](const Eigen::VectorXd& p) {
    CurvePoint result = numbers(p.head(factors).array().exp());
    result.nuisance = p.tail(others);
    return result;
  };
  Eigen::VectorXd first = Eigen::VectorXd::Zero(factors + others);
  first.tail(others) = start.nuisance;
  Eigen::VectorXd low = Eigen::VectorXd::Constant(first.size(), -kFarthestFactor), high = -low;
  const auto [nuisance_low, nuisance_high] = model.nuisance_bounds();
  low.tail(others) = nuisance_low;
  high.tail(others) = nuisance_high;
  const LeastSquares fit =
      minimize([&](const Eigen::VectorXd& p) { return model.residuals(point(p)); }, first, low, high, limits);
  Tied tied{point(fit.parameters), fit.residuals, fit.jacobian, fit.iterations};
  tied.best.sum = fit.residuals.allFinite() ? fit.residuals.squaredNorm() : INFINITY;
  return tied;
}

}  // namespace hysteron
