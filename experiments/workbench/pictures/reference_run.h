// Another run of the same cloth, whose curvature this one's is compared with.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/cloth_mesh.h"

namespace hysteron::experiments {

class ReferenceRun {
 public:
  // `folder`: of a run with pictures and `--export ply`.  Throws Error::invalid_input if it is none.
  explicit ReferenceRun(std::filesystem::path folder);

  // One a vertex [1/m], at that run's instant nearest to `time` [s]: its last one where it ended before.
  // Throws Error::invalid_input if its triangles are not those of `mesh`.
  std::vector<float> curvature(const ClothMesh& mesh, double time) const;

 private:
  std::filesystem::path folder_;
  std::vector<double> time_;  // of each instant [s]
};

}  // namespace hysteron::experiments
