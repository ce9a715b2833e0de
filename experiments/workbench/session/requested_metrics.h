// Measures the metrics that a scene requests, while it is simulated.
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

// A request with the part of the cloth that it is measured on.
class RequestedMetric {
 public:
  // Throws Error::invalid_input if the request selects nothing, names a missing pin, asks for a pin's force
  // with an integrator that has none, or for a silhouette without direction or instant to compare with.
  RequestedMetric(const MetricRequest& request, const Scene& scene, const Cloth& cloth, int dimension);

  const MetricRequest& request() const { return request_; }
  // Returns why it may not measure what was meant in a run of so long [s]; "" if there is no reason.
  std::string warning(double seconds) const;
  bool has_begun() const { return has_begun_; }
  // Stores the state at the time `from`, to which later values are relative.
  void begin(Simulation& simulation, const std::vector<Eigen::Vector3d>& x);
  // Returns the value; 0 for a request that has not begun.
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
  std::vector<int> items_, others_;  // indices of vertices, faces or bending elements
  bool has_begun_ = false;
  double before_ = 0;                      // value at `from`
  std::vector<Eigen::Vector3d> x_before_;  // positions at `from` for a silhouette [m]
};

// Writes everything that a scene requests: columns of metrics.csv, plots, and metrics at the end.  If phases
// are repeated, also at the end of each cycle, with the experiment's own columns in cycles.csv.
class RequestedMetrics {
 public:
  // Warns of keys that nothing reads and refuses names of files as Run::reserve() does.  The session must
  // outlive this object.
  RequestedMetrics(const std::vector<MetricRequest>& requests, Session& session);

  // Adds the requests to the plan, which this object must outlive: columns, measures, instants, checkpoints
  // and, if the experiment measures nothing itself, progress.
  void join(RunPlan& plan);
  // Writes metrics and plots when the run is over.
  void finish();

 private:
  std::vector<double> values(const Snapshot& instant);
  std::string words() const;  // returns "  gap [m] = 0.12" for each, as last measured
  void join_cycles(RunPlan& plan);
  void write_cycles();

  Session& session_;
  std::vector<RequestedMetric> metrics_;
  std::vector<double> last_;
  std::vector<std::string> columns_;         // columns of the plan, except the cycle's
  std::vector<std::vector<double>> cycles_;  // by cycle: time and these columns at its end
};

}  // namespace hysteron::experiments
