// The cloth at material points, as a time series (--probe): probes.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/session.h"
#include "render/loop_inset.h"
#include "sim/mesh/material_point.h"

namespace hysteron::experiments {

// Has an experiment's own place be probed [m on the flat cloth], unless the options name others or none.
void probe_unless_told(Options& options, const Eigen::Vector2d& at);

// Where the points are, and what the solver knows of the bending element that they are in: the face that
// contains them, or, of element `hinge`, the hinge at its nearest edge.  In a face K and M are tensors in its
// warp-weft frame: their warp, weft and twist components are K_xx, K_yy and K_xy.
class Probes : public Observer {
 public:
  // `text`: "x,y[;x,y...]" [m], on the flat cloth; "" and "none": no probes.  `dimension`: of the elements.
  // Throws Error::invalid_input for other texts, cloth that is not flat at rest and points beside it, with
  // where it lies.
  Probes(const std::string& text, const ClothMesh& mesh, int dimension);

  bool empty() const { return all_.empty(); }
  // "probe1 at (0.1, 0.2) m: triangle 345", a line each.
  std::string text() const;

  // What begin() and plot() write, for Run::reserve().
  std::vector<std::string> files() const;
  std::vector<std::string> plots() const;
  // Opens probes.csv.  Throws Error::system where it cannot be written, as the others do.
  void begin(Session& session) override;
  void record(Session& session, const Snapshot& instant) override;
  void close() override;
  // For comparisons, behind the curves that the experiment has named itself: height and curvature against
  // time, moment against curvature.
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override;
  // Moment against curvature of the first point so far, in the direction in which it has bent most.
  render::Path loop() const;

  // Height and curvature of all points against time, moments against curvatures.  `what`: "wool, law linear".
  void plot(Run& run, const std::string& what) const;

 private:
  struct Probe {
    std::string name;    // "probe1"
    Eigen::Vector2d at;  // on the flat cloth [m]
    MaterialPoint point;
    int element;
  };

  std::vector<std::string> columns() const;
  std::vector<std::string> directions() const;  // "_warp", "_weft"; "" of a hinge

  const ClothMesh& mesh_;
  int dimension_;
  std::vector<Probe> all_;
  std::optional<Record> series_;
  std::vector<render::Path> loops_;  // of the first point, one a direction
};

}  // namespace hysteron::experiments
