// Numbers that a scene asks for by name, as tables [[metric]] of its file:
//
//   [[metric]]
//   name = "gap"            # column `gap` of metrics.csv, metric `gap_m`
//   kind = "distance"
//   point = [0, 0, 0]       # the nearest vertices to these on the flat cloth
//   to = [0.3, 0, 0]
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"
#include "sim/scene/cloth.h"
#include "sim/scene/key_table.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

struct MetricRequest {
  std::string name;
  std::string kind = "distance";
  Eigen::Vector3d point{0, 0, 0};
  Eigen::Vector3d to{0, 0, 0};
  Eigen::Vector3d low{-1e3, -1e3, -1e3};
  Eigen::Vector3d high{1e3, 1e3, 1e3};
  Eigen::Vector3d other_low{-1e3, -1e3, -1e3};
  Eigen::Vector3d other_high{1e3, 1e3, 1e3};
  int hand = 1;
  Eigen::Vector3d direction{0, 0, 0};
  std::string origin;  // "scene.toml:7"; no key

  std::string column() const;  // "gap [m]"
  std::string metric() const;  // "gap_m"
};

Keys bind_metric(MetricRequest& request);
Json to_json(const std::vector<MetricRequest>& requests);
// Of a scene file or of a manifest whose run asked for them.  Throws Error::invalid_input with file and line.
std::vector<MetricRequest> metrics_in(const std::string& scene);

// A sentence for each key that its kind does not read.
std::vector<std::string> idle_metric_warnings(const std::vector<MetricRequest>& requests);

// A request with what it is measured on.
class RequestedMetric {
 public:
  // Throws Error::invalid_input where it selects nothing, asks for a hand that there is not, or for the force
  // on one of an integrator that knows none.
  RequestedMetric(const MetricRequest& request, const Scene& scene, const Cloth& cloth, int dimension);

  const MetricRequest& request() const { return request_; }
  double value(Simulation& simulation, const std::vector<Eigen::Vector3d>& x) const;

 private:
  double angle(const std::vector<Eigen::Vector3d>& x) const;
  double force(Simulation& simulation) const;
  double residual_curvature(Simulation& simulation) const;

  MetricRequest request_;
  const Scene& scene_;
  const Cloth& cloth_;
  std::vector<int> items_, others_;  // vertices of a distance or a height, faces, or bending elements
};

}  // namespace hysteron::experiments
