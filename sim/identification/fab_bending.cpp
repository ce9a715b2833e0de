#include "sim/identification/fab_bending.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/reference/buckled_strip.h"
#include "sim/scene/key_table.h"

namespace hysteron {

namespace {

using Eigen::VectorXd;

constexpr double kMomentSpread = 1.5;  // prior standard deviation of a logarithm: a factor of 4.5
constexpr double kMedianSpread = 1.5, kShapeSpread = 0.7;  // prior standard deviations of logarithms
constexpr double kMedianStarts[] = {5, 20, 80};            // fabrics' measured spectra lie between [1/m]
constexpr double kSaturationStarts[] = {4, 25, 60};        // [1/m]
constexpr double kSpreadStarts[] = {0.4, 1.5};  // those of nearly one stop, and of measured spectra
constexpr double kLargestMedian = 1000, kLargestSpread = 4;  // bounds of fabric files [1/m], [-]
constexpr double kFarthest = 9;                              // largest distance of a logarithm from its prior

}  // namespace

FrictionForm free_stops(const std::vector<double>& thresholds) {
  const auto count = static_cast<double>(thresholds.size());
  return {std::to_string(thresholds.size()) + (thresholds.size() == 1 ? " stop" : " stops"),
          std::vector<double>(thresholds.size(), kMomentSpread), [=](const VectorXd& p, double moment) {
            Spectrum stops{thresholds, {}};
            for (std::size_t j = 0; j < thresholds.size(); ++j)
              stops.stiffnesses.push_back(std::exp(p[static_cast<int>(j)]) * moment / count / thresholds[j]);
            return stops;
          }};
}

FrictionShape friction_shape(const VectorXd& p) {
  return {kUsualMedian * std::exp(p[1]), kUsualSpread * std::exp(p[2])};
}

FrictionForm shaped_friction() {
  FrictionForm form{
      kShapedName, {kMomentSpread, kMedianSpread, kShapeSpread}, [](const VectorXd& p, double moment) {
        return shaped_stops(friction_shape(p), std::exp(p[0]) * moment);
      }};
  for (const double median : kMedianStarts)
    for (const double spread : kSpreadStarts)
      form.starts.emplace_back(
          Eigen::Vector3d(0, std::log(median / kUsualMedian), std::log(spread / kUsualSpread)));
  form.largest = [](double reach) -> VectorXd {
    return Eigen::Vector3d(kFarthest, std::log(std::min(reach, kLargestMedian) / kUsualMedian),
                           std::log(kLargestSpread / kUsualSpread));
  };
  return form;
}

double saturation_curvature(const VectorXd& p) { return kUsualSaturation * std::exp(p[1]); }

FrictionForm parabola_friction() {
  // Half of the friction moment of a parabola is in reach if it saturates at this multiple of the reach: 2 x
  // - x^2 = 1/2 at x = 1 - sqrt(1/2).
  constexpr double kHalfInReach = 3.41;
  FrictionForm form{kParabolaName, {kMomentSpread, kMedianSpread}, [](const VectorXd& p, double moment) {
                      const double k0 = saturation_curvature(p);
                      return parabola_stops(2 * std::exp(p[0]) * moment / k0, k0, kFewStops);
                    }};
  for (const double k0 : kSaturationStarts)
    form.starts.emplace_back(Eigen::Vector2d(0, std::log(k0 / kUsualSaturation)));
  form.largest = [](double reach) -> VectorXd {
    return Eigen::Vector2d(kFarthest,
                           std::log(std::min(kHalfInReach * reach, kLargestMedian) / kUsualSaturation));
  };
  return form;
}

FrictionForm even_friction(double k0, int stops) {
  return {"k0 = " + number_text(k0) + "/m", {kMomentSpread}, [=](const VectorXd& p, double moment) {
            return parabola_stops(2 * std::exp(p[0]) * moment / k0, k0, stops);
          }};
}

bool is_settling(const FabLoops& loops, int branch, std::size_t row, double settling) {
  const std::vector<double>& distance = loops.branches[branch].distance;
  const bool inwards = distance.back() < distance.front();
  const auto turn = inwards ? std::max_element(distance.begin(), distance.end())
                            : std::min_element(distance.begin(), distance.end());
  return row <= static_cast<std::size_t>(turn - distance.begin()) ||
         std::abs(distance[row] - *turn) < settling;
}

VectorXd stop_errors(const FrictionForm& form, const VectorXd& parameters,
                     const Eigen::MatrixXd& covariance) {
  constexpr double kStep = 1e-4;
  const auto logarithms = [&](const VectorXd& p) {
    const Spectrum stops = form.stops(p, 1);
    VectorXd result(stops.size() + 1);
    for (std::size_t j = 0; j < stops.size(); ++j)
      result[static_cast<int>(j)] = std::log(stops.stiffnesses[j]);
    result[result.size() - 1] = std::log(stops.friction_moment());
    return result;
  };
  Eigen::MatrixXd by(logarithms(parameters).size(), parameters.size());
  for (int i = 0; i < parameters.size(); ++i) {
    const VectorXd step = kStep * VectorXd::Unit(parameters.size(), i);
    by.col(i) = (logarithms(parameters + step) - logarithms(parameters - step)) / (2 * kStep);
  }
  return (by * covariance * by.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

namespace {

// The prior of b2 is centred on this HB/b2 [1/m], the middle of the KES pairs of assets/fabrics, which have
// 18 to 53.  Its standard deviation is a factor of 2.7 in that ratio and, independently, kMomentSpread in HB.
constexpr double kFrictionOverSpring = 31, kSpringSpread = 1.8;
constexpr double kSaturations[] = {3.125, 6.25, 12.5, 25, 50, 100};  // k0 [1/m]
// Strips of fabrics need fewer than 40 halvings (gauges of 15 to 50 mm); one that needs more takes seconds.
constexpr long kMostHalvings = 100;
constexpr double kLargestZero = 10;  // [N/m]

// Returns the friction moment with the loop's loss: 2 HB times the change of int |K| ds, which is the same
// for any elastic law without weight.  A loop as narrow as the noise [N/m] is not counted: its work is the
// noise's.
double friction_of_loop(const FabLoops& loops, int cycle, double noise) {
  const FabBranch& out = loops.branches[2 * cycle];
  const auto [low, high] = std::minmax_element(out.distance.begin(), out.distance.end());
  BuckledStripTest elastica({{1, {}, {}}, loops.gauge, 0, 32}, *high, BuckledStripTest::Start::relaxed);
  const double before = elastica.bend();
  elastica.go_to(*low, 0.02);
  const double work =
      std::max(std::abs(loop_area(loops, branch_forces(loops), cycle)), noise * (*high - *low));
  return work / (2 * (elastica.bend() - before));
}

// Returns the largest change of curvature from the first distance to the innermost one of the cycles [1/m]:
// that of the elastica without weight, whatever its rigidity.
double curvature_reach(const FabLoops& loops, const std::vector<int>& cycles) {
  double innermost = kInfinity;
  for (const int cycle : cycles)
    for (int b = 2 * cycle - 2; b < 2 * cycle; ++b)
      for (const double distance : loops.branches[b].distance) innermost = std::min(innermost, distance);
  BuckledStripTest elastica({{1, {}, {}}, loops.gauge, 0, 32}, loops.branches[0].distance.front(),
                            BuckledStripTest::Start::relaxed);
  const double before = elastica.peak_curvature();
  elastica.go_to(innermost, 0.02);
  return std::abs(elastica.peak_curvature() - before);
}

// The parameters are the logarithm of b2 over the one that the loops' work suggests, those of friction, then
// the zeros of force.
class BendingModel {
 public:
  BendingModel(const std::vector<FabLoops>& loops, const FabBendingQuestion& question)
      : loops_(loops),
        question_(question),
        form_(question.form ? *question.form : free_stops(question.thresholds)),
        numbers_(static_cast<int>(form_.spreads.size())),
        rows_(branch_rows(loops, question.cycles)) {
    double friction = 0;
    for (const FabLoops& one : loops) reach_ = std::max(reach_, curvature_reach(one, question.cycles));
    for (const FabLoops& one : loops)
      for (const int cycle : question.cycles)
        friction += friction_of_loop(one, cycle - 1, question.noise / one.width);
    for (FabRow& row : rows_) {
      const FabLoops& one = loops[row.loops];
      row.weight = one.width / question.noise *
                   (is_settling(one, row.branch, row.index, question.settling) ? question.trust : 1);
    }
    prior_friction_ = friction / static_cast<double>(loops.size() * question.cycles.size());
  }

  StopsLaw law(const VectorXd& p) const {
    const Spectrum stops = form_.stops(p.segment(1, numbers_), prior_friction_);
    return {std::exp(p[0]) * prior_spring(), stops.thresholds, stops.stiffnesses};
  }

  // Returns the residuals of rows, then the distances of logarithms from their priors; NaN where no
  // equilibrium is found.
  VectorXd residuals(const VectorXd& p) const {
    VectorXd result(size());
    try {
      result.head(rows()) =
          row_residuals(loops_, question_.cycles, rows_, {law(p), {}, question_.density, kMostHalvings},
                        p.tail(loops_.size()));
    } catch (const Error&) {
      return VectorXd::Constant(size(), kNone);
    }
    result[rows()] = p[0] / kSpringSpread;
    for (int j = 0; j < numbers_; ++j) result[rows() + 1 + j] = p[1 + j] / form_.spreads[j];
    return result;
  }

  // Returns the start at the prior, with the given parameters of friction.
  VectorXd start(const VectorXd& friction) const {
    VectorXd p = VectorXd::Zero(parameters());
    p.segment(1, numbers_) = friction;
    for (int i = 0; i < rows(); ++i) p[1 + numbers_ + rows_[i].loops] += rows_[i].force;
    for (std::size_t l = 0; l < loops_.size(); ++l)
      p[1 + numbers_ + l] /= static_cast<double>(
          std::count_if(rows_.begin(), rows_.end(), [&](const FabRow& r) { return r.loops == int(l); }));
    return p;
  }

  // Returns the next minimum from there.
  LeastSquares minimum(const VectorXd& start, SearchLimits limits = {}) const {
    VectorXd low = VectorXd::Constant(parameters(), -kFarthest), high = -low;
    if (form_.largest) high.segment(1, numbers_) = form_.largest(reach_);
    low.tail(loops_.size()).setConstant(-kLargestZero);
    high.tail(loops_.size()).setConstant(kLargestZero);
    return minimize([&](const VectorXd& p) { return residuals(p); }, start, low, high, limits);
  }

  int rows() const { return static_cast<int>(rows_.size()); }
  int numbers() const { return numbers_; }
  double reach() const { return reach_; }
  const FrictionForm& form() const { return form_; }
  int parameters() const { return 1 + numbers_ + static_cast<int>(loops_.size()); }
  int size() const { return rows() + 1 + numbers_; }
  double prior_spring() const { return prior_friction_ / kFrictionOverSpring; }

 private:
  const std::vector<FabLoops>& loops_;
  const FabBendingQuestion& question_;
  FrictionForm form_;
  int numbers_;  // number of friction's parameters
  std::vector<FabRow> rows_;
  double prior_friction_ = 0;  // [N]
  double reach_ = 0;           // [1/m]
};

// Every start is followed to its minimum on few rows of each branch, which costs little.
constexpr std::size_t kCoarseRows = 12;
constexpr SearchLimits kCoarseSearch = {20, 1e-3};

// Returns the same loops with at most so many rows per branch, the first and the last among them.
FabLoops thinned(FabLoops loops, std::size_t most) {
  for (FabBranch& branch : loops.branches) {
    const std::size_t rows = branch.distance.size();
    if (rows <= most) continue;
    FabBranch few;
    for (std::size_t i = 0; i < most; ++i) {
      const std::size_t row = i * (rows - 1) / (most - 1);
      few.distance.push_back(branch.distance[row]);
      few.force.push_back(branch.force[row]);
    }
    branch = few;
  }
  return loops;
}

// Returns the deepest of the minima that the form's starts lead to; of those that are as deep, the first.
LeastSquares deepest_minimum(const BendingModel& model, const std::vector<FabLoops>& loops,
                             const FabBendingQuestion& question) {
  const VectorXd none = VectorXd::Zero(model.numbers());
  LeastSquares best = model.minimum(model.start(none));
  if (model.form().starts.empty()) return best;
  std::vector<FabLoops> few;
  for (const FabLoops& one : loops) few.push_back(thinned(one, kCoarseRows));
  const auto few_rows = static_cast<double>(branch_rows(few, question.cycles).size());
  FabBendingQuestion coarse_question = question;
  coarse_question.noise *= std::sqrt(few_rows / model.rows());
  const BendingModel coarse(few, coarse_question);
  const LeastSquares known = coarse.minimum(best.parameters, kCoarseSearch);
  LeastSquares other = known;
  for (const VectorXd& start : model.form().starts) {
    const LeastSquares found = coarse.minimum(coarse.start(start), kCoarseSearch);
    if (is_deeper(found, other)) other = found;
  }
  if (!is_deeper(other, known)) return best;
  const LeastSquares found = model.minimum(other.parameters);
  return is_deeper(found, best) ? found : best;
}

void set_bending_errors(const BendingModel& model, const LeastSquares& best, FabBending& found) {
  const int n = model.numbers();
  const Eigen::MatrixXd c = posterior(best, model.rows());
  const VectorXd error = c.diagonal().cwiseMax(0).cwiseSqrt();
  const VectorXd of_stops = stop_errors(model.form(), best.parameters.segment(1, n), c.block(1, 1, n, n));
  found.set_errors(error[0], of_stops);
  found.form_errors = error.segment(1, model.numbers());
  const VectorXd zeros = error.tail(error.size() - 1 - model.numbers());
  found.zero_errors.assign(zeros.begin(), zeros.end());
  found.friction_error = of_stops[found.law.stops()] * found.law.friction();
}

}  // namespace

double FabBending::friction_within_reach() const {
  double friction = 0;
  for (int j = 0; j < law.stops(); ++j)
    if (law.thresholds[j] <= reach) friction += law.stiffnesses[j] * law.thresholds[j];
  return friction;
}

bool FabBending::knows_friction() const {
  return is_determined(friction_error / law.friction()) &&
         kWidestFactor * friction_within_reach() >= law.friction();
}

std::vector<std::string> FabBending::undetermined() const {
  std::vector<std::string> names;
  if (is_shaped()) {
    if (!determined[0]) names.push_back("b2");
    if (!is_determined(form_errors[1])) names.push_back("median");
    if (!is_determined(form_errors[2])) names.push_back("spread");
    if (!knows_friction()) names.push_back("HB");
    return names;
  }
  if (is_parabola()) {
    if (!is_determined(form_errors[1])) names.push_back("k0");
    if (!knows_friction()) names.push_back("HB");
    return names;
  }
  for (std::size_t i = 0; i < determined.size(); ++i)
    if (!determined[i]) names.push_back(i == 0 ? "b2" : "stop " + number_text(law.thresholds[i - 1]) + "/m");
  return names;
}

namespace {

// Returns the largest less the smallest force of the fitted cycles, for the whole strip [N]; the largest of
// several tests.
double largest_force_range(const std::vector<FabLoops>& loops, const std::vector<int>& cycles) {
  double range = 0;
  for (const FabLoops& one : loops)
    for (const int cycle : cycles)
      range = std::max(range, one.width * force_range(branch_forces(one), cycle - 1));
  return range;
}

}  // namespace

FabBending identify_fab_bending(const std::vector<FabLoops>& loops, const FabBendingQuestion& question) {
  check_cycles(loops, question.cycles);
  const BendingModel model(loops, question);
  const LeastSquares best = deepest_minimum(model, loops, question);
  if (!best.residuals.allFinite())
    throw Error::simulation("along " + loops[0].direction +
                            " no equilibrium is found of a strip as stiff as its loops' " +
                            "work suggests, b2 = " + number_text(model.prior_spring(), 4) +
                            " N m: check gauge, width, density and the units of forces");
  FabBending found;
  found.take(best, loops, model.rows());
  found.law = model.law(best.parameters);
  found.form = best.parameters.segment(1, model.numbers());
  found.reach = model.reach();
  found.form_name = model.form().name;
  found.noise = question.noise;
  found.residuals = best.residuals.head(model.rows());
  found.residual_rms = std::sqrt(found.residuals.squaredNorm() / model.rows());
  found.residual_share = found.residual_rms * question.noise / largest_force_range(loops, question.cycles);
  set_bending_errors(model, best, found);
  return found;
}

std::vector<FabForm> even_form_fits(const std::function<FabBending(const FrictionForm&)>& identify,
                                    int stops) {
  std::vector<FabForm> forms;
  for (const double k0 : kSaturations) {
    const FrictionForm form = even_friction(k0, stops);
    try {
      forms.push_back({form.name, identify(form), true});
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;
    }
  }
  return forms;
}

std::vector<FabForm> even_forms(const std::vector<FabLoops>& loops, const FabBendingQuestion& question) {
  return even_form_fits([&](const FrictionForm& form) {
    FabBendingQuestion one = question;
    one.form = form;
    return identify_fab_bending(loops, one);
  });
}

FabBending identify_one_stop(const std::vector<FabLoops>& loops, const FabBendingQuestion& question) {
  FabBending best;
  std::optional<Error> failure;
  for (const double threshold : question.thresholds) {
    FabBendingQuestion one = question;
    one.form = free_stops({threshold});
    try {
      FabBending found = identify_fab_bending(loops, one);
      if (best.rows == 0 || found.residual_rms < best.residual_rms) best = std::move(found);
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;
      failure = error;
    }
  }
  if (best.rows == 0 && failure) throw *failure;
  return best;
}

}  // namespace hysteron
