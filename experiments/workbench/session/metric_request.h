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

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "sim/base/error.h"
#include "sim/scene/key_table.h"

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
  double threshold = 20;
  double cutoff = 0.04;
  double from = -1;
  std::string origin;  // "scene.toml:7"; no key

  std::string column() const;  // "gap [m]"
  // "gap_m"; at the end of the second cycle "gap_cycle_2_m".
  std::string metric(int cycle = 0) const;
  bool has_part() const;  // between low and high
  Error refusal(const std::string& what) const;
};

Keys bind_metric(MetricRequest& request);
Json to_json(const std::vector<MetricRequest>& requests);
// Of the scene file that is called so, or of a manifest whose run asked for them; `scene` is what it says.
// Throws Error::invalid_input with file and line.
std::vector<MetricRequest> metrics_in(const std::string& name, const Scene& scene);
// Those of a set-up's scene, noted there for manifest, last words and --errors.  Throws likewise.
std::vector<MetricRequest> take_requests(Setup& setup);

// A sentence for each key that its kind does not read.
std::vector<std::string> idle_metric_warnings(const std::vector<MetricRequest>& requests);

}  // namespace hysteron::experiments
