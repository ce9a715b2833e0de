// Records the cloth at material points as a time series (--probe): probes.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/session.h"
#include "render/loop_inset.h"
#include "sim/mesh/material_point.h"

namespace hysteron::experiments {

// Sets an experiment's own probe [m on the flat cloth], unless the options name others or none.
void probe_unless_told(Options& options, const Eigen::Vector2d& at);

// Records the points' positions, and curvature and moment of the bending element that contains each: the face
// or, for element `hinge`, the hinge at its nearest edge.  In a face K and M are tensors in its warp-weft
// frame: their warp, weft and twist components are K_xx, K_yy and K_xy.
class Probes : public Observer {
 public:
  // `text` is "x,y[;x,y...]" [m], on the flat cloth; "" and "none" are no probes.  `dimension` is that of the
  // elements.  Throws Error::invalid_input for other texts, for cloth that is not flat at rest, and for
  // points outside it, stating where it lies.
  Probes(const std::string& text, const ClothMesh& mesh, int dimension);

  bool empty() const { return all_.empty(); }
  // Returns "probe1 at (0.1, 0.2) m: triangle 345", a line each.
  std::string text() const;

  // Return the files that begin() and plot() write, for Run::reserve().
  std::vector<std::string> files() const;
  std::vector<std::string> plots() const;
  // Opens probes.csv.  Throws Error::system if it cannot be written, as the others do.
  void begin(Session& session) override;
  void record(Session& session, const Snapshot& instant) override;
  void close() override;
  // Adds curves for comparisons, after those of the experiment: height and curvature against time, moment
  // against curvature.
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override;
  // Returns moment against curvature of the first point so far, in the direction in which it has bent most.
  render::Path loop() const;

  // Plots height and curvature of all points against time, and moments against curvatures.  `what` is "wool,
  // law linear".
  void plot(Run& run, const std::string& what) const;

 private:
  struct Probe {
    std::string name;    // "probe1"
    Eigen::Vector2d at;  // position on the flat cloth [m]
    MaterialPoint point;
    int element;
  };

  std::vector<std::string> columns() const;
  std::vector<std::string> directions() const;  // "_warp", "_weft"; "" for a hinge

  const ClothMesh& mesh_;
  int dimension_;
  std::vector<Probe> all_;
  std::optional<TimeSeriesWriter> series_;
  std::vector<render::Path> loops_;  // paths of the first point, one per direction
};

}  // namespace hysteron::experiments
