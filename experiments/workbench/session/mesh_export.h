// The meshes of a run, OUT/mesh/0000.obj and so on, or all of them in one file.
#pragma once

#include <optional>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/session/animation.h"
#include "experiments/workbench/session/mitsuba_scene.h"
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
  // ply with a scene beside it that draws it; gltf, whose file finish() writes.
  void write(Run& run, const std::string& format, const Cloth& cloth, Simulation& simulation,
             const std::vector<Eigen::Vector3d>& x);
  // After the last instant, or what there is of a run that ends early: mesh/cloth.glb where the format is
  // gltf.
  void finish(Run& run, const Cloth& cloth) const;
  void visit(Archive& archive);

 private:
  void write_scene(Run& run, std::size_t number, double time);

  std::optional<MitsubaView> view_;  // of format mitsuba
  std::optional<Scene> scene_;
  float side_ = 0;             // of the cloth's triangles [m]
  std::vector<double> times_;  // of the meshes so far [s]
  Animation animation_;
};

}  // namespace hysteron::experiments
