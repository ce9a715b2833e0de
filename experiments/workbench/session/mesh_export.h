// Exports the meshes of a run, OUT/mesh/0000.obj and so on, or their positions in one file.
#pragma once

#include <optional>

#include "experiments/workbench/session/mitsuba_scene.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

class MeshExport : public Observer {
 public:
  // Returns the files that it writes, for Run::reserve().
  static std::vector<std::string> files(MeshFormat format);
  void begin(Session& session) override;
  // Writes one instant in the format of `--export`: none; obj; ply with the curvature at each vertex; vtk
  // with the fields of vertices and, if elements are faces, those of faces, and cloth.pvd with the times;
  // mitsuba, ply with a scene beside it that draws it; pc2, all instants in one file beside an OBJ of the
  // first.
  void record(Session& session, const Snapshot& instant) override;
  void serialise(Archive& archive) override { archive(times_); }

 private:
  void write_scene(Session& session, std::size_t number, const Snapshot& instant);

  std::optional<PictureView> view_;  // only for format mitsuba
  float side_ = 0;                   // side of the cloth's triangles [m]
  std::vector<double> times_;        // times of the written meshes [s]
};

}  // namespace hysteron::experiments
