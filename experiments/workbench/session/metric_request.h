// A scene requests numbers by name, as tables [[metric]] of its file:
//
//   [[metric]]
//   name = "gap"            # column `gap` of metrics.csv, metric `gap_m`
//   kind = "distance"
//   point = [0, 0, 0]       # the nearest vertices to these on the flat cloth
//   to = [0.3, 0, 0]
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "sim/base/error.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {

// A kind of metric measures what the doc of the key `kind` says.
enum class MetricKind {
  distance,
  height,
  angle,
  force,
  residual_curvature,
  ridge_length,
  ridge_height,
  silhouette
};
constexpr std::array<const char*, 8> names(MetricKind) {
  return {"distance",           "height",       "angle",        "force",
          "residual-curvature", "ridge-length", "ridge-height", "silhouette"};
}

struct MetricRequest {
  std::string name;
  MetricKind kind = MetricKind::distance;
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
  std::string origin;  // place of the table, "scene.toml:7"; it is no key

  std::string column() const;  // returns "gap [m]"
  // Returns "gap_m"; at the end of the second cycle "gap_cycle_2_m".
  std::string metric(int cycle = 0) const;
  bool has_part() const;  // true if measured on a part, between low and high
  Error refusal(const std::string& what) const;
};

Keys bind_metric(MetricRequest& request);
Json to_json(const std::vector<MetricRequest>& requests);
// Returns the requests of the scene file of that name, or of a manifest whose run had them; `scene` is the
// scene of that file.  Throws Error::invalid_input with file and line.
std::vector<MetricRequest> metrics_in(const std::string& name, const Scene& scene);
// Returns the requests of a set-up's scene, and stores them there for manifest, summary and --errors.  Throws
// as metrics_in() does.
std::vector<MetricRequest> take_requests(Setup& setup);

// Returns a sentence for each key that its kind does not read.
std::vector<std::string> idle_metric_warnings(const std::vector<MetricRequest>& requests);

}  // namespace hysteron::experiments
