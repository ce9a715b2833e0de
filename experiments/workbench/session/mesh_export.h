// The meshes of a run, OUT/mesh/0000.obj and so on, or their positions in one file.
#pragma once

#include <optional>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/session/mitsuba_scene.h"
#include "sim/base/archive.h"
#include "sim/scene/cloth.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class MeshExport {
 public:
  // What it writes, for Run::reserve().
  static std::vector<std::string> files(const std::string& format);
  // What pictures of format mitsuba show, before the first instant.
  void stage(const MitsubaView& view, const Scene& scene) {
    view_ = view;
    scene_ = scene;
  }
  // One instant in the format of `--export`: none; obj; ply with the curvature at each vertex; vtk with the
  // fields of vertices and, where elements are faces, those of faces, and cloth.pvd with the times; mitsuba,
  // ply with a scene beside it that draws it; pc2, all instants in one file beside an OBJ of the first.
  void write(Run& run, const std::string& format, const Cloth& cloth, Simulation& simulation,
             const std::vector<Eigen::Vector3d>& x);
  void visit(Archive& archive) { archive(times_); }

 private:
  void write_scene(Run& run, std::size_t number, double time);

  std::optional<MitsubaView> view_;  // of format mitsuba
  std::optional<Scene> scene_;
  float side_ = 0;             // of the cloth's triangles [m]
  std::vector<double> times_;  // of the meshes so far [s]
};

}  // namespace hysteron::experiments
