#include "sim/identification/fab_tension.h"

#include <algorithm>
#include <cmath>

#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

using Eigen::VectorXd;

constexpr double kTensionSpread = 1.5;  // prior standard deviation of logarithms
constexpr double kFarthestTension = 9;  // largest distance of a logarithm from its prior
constexpr double kSharedByStops = 0.5;  // share of the force at the largest strain that is the prior

// The parameters are logarithms of the spring and of the forces p_j r_j over their priors, then the zeros of
// force.
class TensionModel {
 public:
  TensionModel(const std::vector<FabLoops>& loops, const FabTensionQuestion& question)
      : loops_(loops),
        question_(question),
        stops_(static_cast<int>(question.thresholds.size())),
        rows_(branch_rows(loops, question.cycles)) {
    for (const FabRow& row : rows_) {
      const FabLoops& one = loops[row.loops];
      largest_force = std::max(largest_force, row.force - smallest(one));
      largest_strain_ =
          std::max(largest_strain_, one.branches[row.branch].distance[row.index] / one.gauge - 1);
    }
    for (FabRow& row : rows_)
      row.weight = 1 / std::hypot(question.noise / loops[row.loops].width, question.fraction * largest_force);
  }

  StopsLaw law(const VectorXd& p) const {
    StopsLaw law{
        std::exp(p[0]) * (1 - kSharedByStops) * largest_force / largest_strain_, question_.thresholds, {}};
    for (int j = 0; j < stops_; ++j)
      law.stiffnesses.push_back(std::exp(p[1 + j]) * kSharedByStops * largest_force / stops_ /
                                law.thresholds[j]);
    return law;
  }

  VectorXd residuals(const VectorXd& p) const {
    VectorXd result(rows() + 1 + stops_);
    result.head(rows()) =
        row_residuals(loops_, question_.cycles, rows_, {{}, law(p), 0}, p.tail(loops_.size()));
    result.tail(1 + stops_) = p.head(1 + stops_) / kTensionSpread;
    return result;
  }

  VectorXd start() const {
    VectorXd p = VectorXd::Zero(parameters());
    for (std::size_t l = 0; l < loops_.size(); ++l) p[1 + stops_ + l] = smallest(loops_[l]);
    return p;
  }

  int rows() const { return static_cast<int>(rows_.size()); }
  int parameters() const { return 1 + stops_ + static_cast<int>(loops_.size()); }
  double rms(const VectorXd& residuals) const {  // [N/m]
    double sum = 0;
    for (int i = 0; i < rows(); ++i) sum += std::pow(residuals[i] / rows_[i].weight, 2);
    return std::sqrt(sum / rows());
  }

  double largest_force = 0;

 private:
  static double smallest(const FabLoops& loops) {
    double least = loops.branches[0].force[0];
    for (const FabBranch& branch : loops.branches)
      for (const double f : branch.force) least = std::min(least, f);
    return least;
  }

  const std::vector<FabLoops>& loops_;
  const FabTensionQuestion& question_;
  int stops_;
  std::vector<FabRow> rows_;
  double largest_strain_ = 0;
};

}  // namespace

std::vector<std::string> FabTension::undetermined() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < determined.size(); ++i)
    if (!determined[i])
      names.push_back(i == 0 ? "tension spring" : "tension stop " + number_text(law.thresholds[i - 1]));
  return names;
}

FabTension identify_fab_tension(const std::vector<FabLoops>& loops, const FabTensionQuestion& question) {
  check_cycles(loops, question.cycles);
  const TensionModel model(loops, question);
  const auto count = static_cast<Eigen::Index>(loops.size());
  VectorXd low = VectorXd::Constant(model.parameters(), -kFarthestTension), high = -low;
  low.tail(count) = model.start().tail(count).array() - model.largest_force;
  high.tail(count) = model.start().tail(count).array() + model.largest_force;
  const LeastSquares best =
      minimize([&](const VectorXd& p) { return model.residuals(p); }, model.start(), low, high);
  FabTension found;
  found.take(best, loops, model.rows());
  found.law = model.law(best.parameters);
  found.largest_force = model.largest_force;
  found.residual_rms = model.rms(best.residuals);
  const VectorXd error = posterior(best, model.rows()).diagonal().cwiseMax(0).cwiseSqrt();
  found.set_errors(error[0], error.tail(error.size() - 1));
  return found;
}

}  // namespace hysteron
