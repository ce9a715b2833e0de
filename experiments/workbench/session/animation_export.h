// A run as one animated file, OUT/mesh/cloth.usda or cloth.glb, with its bodies and the pictures' camera.
#pragma once

#include <optional>

#include "experiments/workbench/animation/animated_scene.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"

namespace hysteron::experiments {

// Positions are kept in a point cache beside it, mesh/cloth.pc2, while the run goes on: of a process that is
// killed it is what there is, and a run that goes on does so from it.  The file is written from it at the end
// of a run, also of one that ends early, and the point cache goes when the run's results are there.
class AnimationExport : public Observer {
 public:
  // Whether it writes this format of `--export`.
  static bool writes(const std::string& format);
  // What it writes, for Run::reserve().
  static std::vector<std::string> files(const std::string& format);

  ~AnimationExport() override;
  void begin(Session& session) override;
  // One instant; one that is not later than the last takes its place.
  void record(Session& session, const Snapshot& instant) override;
  void close() override;
  void finish(Session& session, const std::string& title) override;
  void serialise(Archive& archive) override { archive(times_); }

 private:
  void write();
  void leave_out_what_does_not_fit();
  void warn_of_many_targets() const;

  Run* run_ = nullptr;
  std::string format_;
  AnimatedScene scene_;
  std::vector<double> times_;  // of the instants so far [s]
  bool is_written_ = false;
};

}  // namespace hysteron::experiments
