#include "experiments/workbench/session/recoveries.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sim/bending/laws/recovery.h"
#include "sim/bending/vertex_curvature.h"

namespace hysteron::experiments {

Recoveries::Recoveries(const Scene& scene) : curve_(mean_of_faces(scene.fabric.virgin_curve())) {
  if (scene.law == "pabst" || scene.law == "linear") return;
  if (has_faces(scene.law) && scene.fabric.bending.faces.on()) return;
  if (scene.fabric.rubs_otherwise()) return;  // elasticity and friction differ in anisotropy
  counts_ = has_residual_formula(choose_law(scene.law, curve_, scene.param));
}

namespace {

// Returns the simulation's moments as its law gives them [N].
std::vector<double> law_moment(Simulation& simulation) {
  std::vector<double> moment = simulation.moment();
  const std::vector<double> metric = simulation.metric();
  for (std::size_t i = 0; i < metric.size(); ++i) moment[i] = metric[i] > 0 ? moment[i] / metric[i] : 0;
  return moment;
}

// Returns the residual curvature of each element by the closed form [1/m], with the simulation's components.
std::vector<double> residual_of_elements(Simulation& simulation, const LawParams& law) {
  const int d = simulation.dimension();
  const std::vector<double> metric = simulation.metric(), m = law_moment(simulation);
  std::vector<double> k = simulation.curvature();
  for (std::size_t i = 0; i < metric.size(); ++i) k[i] *= metric[i];
  for (std::size_t i = 0; i < k.size(); i += d) {
    Eigen::Map<Eigen::VectorXd> curvature(&k[i], d);
    const Eigen::Map<const Eigen::VectorXd> moment(&m[i], d);
    const double size = curvature.norm(), along = size > 0 ? moment.dot(curvature) / size : 0;
    if (size > 0) curvature *= residual_by_formula(law, size, std::max(along, 0.0)) / size;
  }
  for (std::size_t i = 0; i < metric.size(); ++i) k[i] = metric[i] > 0 ? k[i] / metric[i] : 0;
  return k;
}

}  // namespace

void Recoveries::watch(Session& session, const Snapshot&) {
  if (counts()) see(law_moment(session.simulation()), session.simulation().dimension());
}

void Recoveries::finish(Session& session, const std::string&) {
  Run& run = session.run();
  Simulation& simulation = session.simulation();
  const Scene& scene = session.scene();
  const int d = simulation.dimension();
  const std::vector<double> area = element_areas(session.cloth().mesh, d);
  run.metric("residual_curvature_rms_per_m", curvature_rms(simulation.residual_curvature(), area, d));
  if (!counts()) return;
  const std::array<long, 3> count = cases();
  run.metric("recovery_elastic_count", count[0]);
  run.metric("recovery_partial_count", count[1]);
  run.metric("recovery_full_slip_count", count[2]);
  const LawParams law = choose_law(scene.law, curve_, scene.param);
  run.metric("residual_curvature_formula_rms_per_m",
             curvature_rms(residual_of_elements(simulation, law), area, d));
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
