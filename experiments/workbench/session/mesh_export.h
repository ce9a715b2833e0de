// The meshes of a run, OUT/mesh/0000.obj and so on.
#pragma once

#include "experiments/workbench/app/run.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class MeshExport {
 public:
  // One instant in the format of `--export`: none; obj; ply with the curvature at each vertex; vtk with the
  // fields of vertices and, where elements are faces, those of faces, and cloth.pvd with the times.
  void write(Run& run, const std::string& format, const Cloth& cloth, Simulation& simulation,
             const std::vector<Eigen::Vector3d>& x);
  void visit(Archive& archive);

 private:
  std::vector<double> times_;  // of the meshes so far [s]
};

}  // namespace hysteron::experiments
