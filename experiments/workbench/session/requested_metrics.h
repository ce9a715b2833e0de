// The metrics that a scene asks for, measured while it is simulated.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/workbench/session/metric_request.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// A request with what it is measured on.
class RequestedMetric {
 public:
  // Throws Error::invalid_input where it selects nothing, asks for a hand that there is not, for the force on
  // one of an integrator that knows none, or for a silhouette without direction or instant to compare with.
  RequestedMetric(const MetricRequest& request, const Scene& scene, const Cloth& cloth, int dimension);

  const MetricRequest& request() const { return request_; }
  // Why it may not say what was meant in a run of so long [s]; "": no reason is seen.
  std::string doubt(double seconds) const;
  bool has_begun() const { return has_begun_; }
  // At the time `from`: later values are against this one.
  void begin(Simulation& simulation, const std::vector<Eigen::Vector3d>& x);
  // Of a request that has not begun 0.
  double value(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const;
  void serialise(Archive& archive);

 private:
  double absolute(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const;
  double angle(const std::vector<Eigen::Vector3d>& x) const;
  double force(Simulation& simulation) const;
  double residual_curvature(Simulation& simulation) const;
  double ridge_length(Simulation& simulation) const;
  double silhouette(const std::vector<Eigen::Vector3d>& x) const;
  void choose(const char* low, const char* high, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              const std::vector<Eigen::Vector3d>& places, std::vector<int>& items) const;
  void check_force() const;

  MetricRequest request_;
  const Scene& scene_;
  const Cloth& cloth_;
  std::vector<int> items_, others_;  // vertices, faces or bending elements
  bool has_begun_ = false;
  double before_ = 0;                      // at `from`
  std::vector<Eigen::Vector3d> x_before_;  // of a silhouette [m]
};

// All that a scene asks for: columns of metrics.csv, plots, and metrics at the end.  Of phases that are gone
// through several times also at the end of each cycle, with the experiment's own columns in cycles.csv.
class RequestedMetrics {
 public:
  // Warns of keys that nothing reads and refuses names of files as Run::reserve() does.  The session must
  // outlive it.
  RequestedMetrics(const std::vector<MetricRequest>& requests, Session& session);

  // Adds what is requested to the plan, which it must outlive: columns, measures, instants, checkpoints.
  void join(RunPlan& plan);
  // "  gap [m] = 0.12" for each, as last measured.
  std::string words() const;
  // Metrics and plots, when the run is over.
  void finish();

 private:
  std::vector<double> values(const Snapshot& instant);
  void join_cycles(RunPlan& plan);
  void write_cycles();

  Session& session_;
  std::vector<RequestedMetric> metrics_;
  std::vector<double> last_;
  std::vector<std::string> columns_;         // of the plan, without that of the cycle
  std::vector<std::vector<double>> cycles_;  // time and these columns at the end of each
};

}  // namespace hysteron::experiments
