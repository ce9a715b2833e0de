// Exports a run as one animated file, OUT/mesh/cloth.usda or cloth.glb, with its bodies and the pictures'
// camera.
#pragma once

#include <optional>

#include "experiments/workbench/animation/animated_scene.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

// While the run goes on, positions are kept in a point cache beside the file, mesh/cloth.pc2: a killed
// process leaves it, and a continued run goes on from it.  At the end of a run, also of one that ends early,
// the file is written from the cache, which is removed when the run's results are complete.
class AnimationExport : public Observer {
 public:
  // True if it writes this format of `--export`.
  static bool writes(MeshFormat format);
  // Returns the files that it writes, for Run::reserve().
  static std::vector<std::string> files(MeshFormat format);

  ~AnimationExport() override;
  void begin(Session& session) override;
  // Records one instant; one that is not later than the last replaces it.
  void record(Session& session, const Snapshot& instant) override;
  void close() override;
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override { archive(times_); }

 private:
  void write();
  void leave_out_what_does_not_fit();
  void warn_of_many_targets() const;

  Run* run_ = nullptr;
  MeshFormat format_ = MeshFormat::none;
  AnimatedScene scene_;
  std::vector<double> times_;  // times of the recorded instants [s]
  bool is_written_ = false;
};

}  // namespace hysteron::experiments
