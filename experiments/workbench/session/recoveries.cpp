#include "experiments/workbench/session/recoveries.h"

#include <Eigen/Core>
#include <algorithm>

#include "sim/bending/laws/recovery.h"

namespace hysteron::experiments {

Recoveries::Recoveries(const Scene& scene) : curve_(scene.fabric.virgin_curve()) {
  if (scene.law == "pabst" || scene.law == "linear") return;
  counts_ = has_residual_formula(choose_law(scene.law, curve_, scene.param));
}

void Recoveries::see(Simulation& simulation) {
  if (counts()) see(simulation.moment(), simulation.dimension());
}

void Recoveries::see(const std::vector<double>& moment, int dimension) {
  const std::size_t elements = moment.size() / dimension;
  const double limit = curve_.elastic_limit_moment();
  before_.resize(moment.size());
  peak_.resize(elements);
  for (std::size_t i = 0; i < elements; ++i) {
    const Eigen::Map<const Eigen::VectorXd> now(&moment[i * dimension], dimension),
        before(&before_[i * dimension], dimension);
    const double size = now.norm();
    if (size <= limit) continue;
    const bool goes_on = before.norm() > limit && now.dot(before) > 0;
    peak_[i] = goes_on ? std::max(peak_[i], size) : size;
  }
  before_ = moment;
}

std::array<long, 3> Recoveries::cases() const {
  std::array<long, 3> count{};
  for (double moment : peak_) ++count[static_cast<int>(recovery_case(curve_, moment)) - 1];
  return count;
}

}  // namespace hysteron::experiments
