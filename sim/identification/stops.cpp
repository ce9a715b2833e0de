#include "sim/identification/stops.h"

#include <algorithm>
#include <cmath>

#include "sim/identification/curve.h"
#include "sim/identification/least_squares.h"

namespace hysteron {
namespace {

constexpr double kTogether = 1.1;        // ratio of thresholds that no noisy loop keeps apart
constexpr double kClearlyBetter = 0.95;  // as in curve.cpp: a cycle before the first row

// Parameters: logarithms of b2, p_1 ... p_N over the slope, r_1 ... r_N over the largest curvature.
struct StopsModel {
  std::vector<LawRow> rows;
  Eigen::VectorXd moment;  // measured [N]
  double curvature, largest;
  int count;

  double slope() const { return largest / curvature; }
  double b2(const Eigen::VectorXd& p) const { return std::exp(p[0]) * slope(); }

  std::vector<Stop> stops(const Eigen::VectorXd& p) const {
    std::vector<Stop> result(count);
    for (int j = 0; j < count; ++j) {
      result[j].stiffness = std::exp(p[1 + j]) * slope();
      result[j].threshold = std::exp(p[1 + count + j]) * curvature;
    }
    return result;
  }

  Eigen::VectorXd moments(const Eigen::VectorXd& p) const {
    const std::vector<double> all = stops_moments(b2(p), stops(p), rows);
    const Eigen::Map<const Eigen::VectorXd> moments(all.data(), static_cast<int>(all.size()));
    return moments.tail(moment.size());
  }
  Eigen::VectorXd residuals(const Eigen::VectorXd& p) const { return (moments(p) - moment) / largest; }

  Eigen::VectorXd parameters(double elastic, const std::vector<Stop>& elements) const {
    Eigen::VectorXd p(1 + 2 * count);
    p[0] = std::log(elastic / slope());
    for (int j = 0; j < count; ++j) {
      p[1 + j] = std::log(elements[j].stiffness / slope());
      p[1 + count + j] = std::log(elements[j].threshold / curvature);
    }
    return p;
  }

  Eigen::VectorXd start() const {
    std::vector<Stop> elements(count);
    for (int j = 0; j < count; ++j) elements[j] = {0.5 * curvature * (j + 0.5) / count, slope() / count};
    return parameters(slope() / 2, elements);
  }
};

LeastSquares fit(const StopsModel& model, const Eigen::VectorXd& start) {
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(start.size(), std::log(1e-6));
  Eigen::VectorXd high = Eigen::VectorXd::Constant(start.size(), std::log(1e4));
  high.tail(model.count).setConstant(std::log(4.0));  // beyond 2, a stop within +-1 is a spring
  return minimize([&](const Eigen::VectorXd& p) { return model.residuals(p); }, start, low, high);
}

std::vector<Stop> sorted(std::vector<Stop> stops) {
  std::sort(stops.begin(), stops.end(),
            [](const Stop& a, const Stop& b) { return a.threshold < b.threshold; });
  return stops;
}

// One element with the slope and the moment of both.
Stop together(const Stop& a, const Stop& b) {
  const double stiffness = a.stiffness + b.stiffness;
  return {(a.stiffness * a.threshold + b.stiffness * b.threshold) / stiffness, stiffness};
}

// Elements that never slip are springs, and join b2; those whose moment stays below what can be measured go;
// neighbours that slip almost together become one.  Returns whether there were any.
bool prune(StopsModel& model, LeastSquares& best) {
  double b2 = model.b2(best.parameters);
  std::vector<Stop> kept;
  for (const Stop& stop : sorted(model.stops(best.parameters))) {
    if (stop.threshold >= model.curvature) {
      b2 += stop.stiffness;
    } else if (stop.stiffness * stop.threshold <= kBestAccuracy * model.largest) {
      continue;
    } else if (!kept.empty() && stop.threshold < kTogether * kept.back().threshold) {
      kept.back() = together(kept.back(), stop);
    } else {
      kept.push_back(stop);
    }
  }
  if (kept.empty() || static_cast<int>(kept.size()) == model.count) return false;
  model.count = static_cast<int>(kept.size());
  const int before = best.iterations;
  best = fit(model, model.parameters(b2, kept));
  best.iterations += before;
  return true;
}

StopsModel stops_model(const MomentSeries& series, int count, bool cycling) {
  return {law_rows(series, cycling), Eigen::Map<const Eigen::VectorXd>(series.moment.data(), series.rows()),
          series.largest_curvature(), series.largest_moment(), count};
}

void set_stop_errors(const Covariance& c, std::vector<Stop>& stops) {
  const int n = static_cast<int>(stops.size());
  const Eigen::VectorXd error = c.matrix.diagonal().cwiseMax(0).cwiseSqrt();
  const Eigen::VectorXd judged = c.with_floor.diagonal().cwiseMax(0).cwiseSqrt();
  for (int j = 0; j < n; ++j) {
    if (is_determined(judged[1 + j])) stops[j].stiffness_error = error[1 + j] * stops[j].stiffness;
    if (is_determined(judged[1 + n + j])) stops[j].threshold_error = error[1 + n + j] * stops[j].threshold;
  }
}

void say(StopsIdentification& found, int requested) {
  Identification& fabric = found.fabric;
  const int used = static_cast<int>(found.stops.size());
  int open = 0;
  for (const Stop& stop : found.stops) open += !(stop.threshold_error > 0 && stop.stiffness_error > 0);
  fabric.statements.insert(
      fabric.statements.begin(),
      std::to_string(requested) + " friction elements beside a spring took " +
          std::to_string(fabric.iterations) + " iterations" + (found.converged ? "" : " without converging") +
          (used < requested ? "; " + std::to_string(used) + " of them do something that can be seen" : "") +
          "; b1, b2 and k0 are those of the quadratic law (prandtl) from the same data");
  if (open == 0) return;
  fabric.statements.push_back("the data do not fix threshold and stiffness of " + std::to_string(open) +
                              " of the elements one by one: neighbours can share their work");
}

void add_sums(StopsIdentification& found) {
  double g = 0, hb = 0;
  for (const Stop& stop : found.stops) {
    g += stop.stiffness;
    hb += stop.stiffness * stop.threshold;
  }
  found.fabric.further.emplace_back("stops_b1_N_m", found.spring + g);
  found.fabric.further.emplace_back("stops_b2_N_m", found.spring);
  found.fabric.further.emplace_back("stops_HB_N", hb);
}

}  // namespace

std::vector<double> stops_moments(double b2, const std::vector<Stop>& stops,
                                  const std::vector<LawRow>& rows) {
  std::vector<double> anchor(stops.size(), 0.0), moments;
  moments.reserve(rows.size());
  for (const LawRow& row : rows) {
    double moment = b2 * row.curvature;
    for (std::size_t j = 0; j < stops.size(); ++j) {
      const double r = stops[j].threshold, u = std::clamp(row.curvature - anchor[j], -r, r);
      anchor[j] = row.curvature - u;
      moment += stops[j].stiffness * u;
    }
    moments.push_back(moment);
  }
  return moments;
}

StopsIdentification identify_stops(const MomentSeries& series, int count, const Assumptions& assumptions) {
  StopsModel model = stops_model(series, count, false);
  LeastSquares best = fit(model, model.start());
  bool cycling = false;
  if (series.reversals > 0) {
    const StopsModel cycle = stops_model(series, count, true);
    const LeastSquares other = fit(cycle, cycle.start());
    cycling = other.residuals.norm() < kClearlyBetter * best.residuals.norm();
    if (cycling) {
      model = cycle;
      best = other;
    }
  }
  while (prune(model, best)) {
  }
  StopsIdentification found;
  found.converged = best.converged;
  found.stops = model.stops(best.parameters);
  const Covariance c = covariance(best.jacobian, best.residuals);
  found.spring = model.b2(best.parameters);
  CurveQuestion question;
  question.assumptions = assumptions;
  found.fabric = identify_curve(series, question);
  Identification& fabric = found.fabric;
  fabric.law = "stops";
  fabric.iterations = best.iterations;
  const Eigen::VectorXd moments = model.moments(best.parameters);
  fabric.model.assign(moments.begin(), moments.end());
  set_stop_errors(c, found.stops);
  found.stops = sorted(found.stops);
  add_sums(found);
  say(found, count);
  return found;
}

}  // namespace hysteron
