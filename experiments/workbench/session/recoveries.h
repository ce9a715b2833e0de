// Classifies each bending element of a cloth by how far it was bent before it was let go: the chapter's three
// cases of recovery (sim/bending/laws/recovery.h), which `law` and `kes` count at every reversal.
#pragma once

#include <array>
#include <vector>

#include "experiments/workbench/session/session.h"
#include "sim/base/archive.h"
#include "sim/scene/scene.h"

namespace hysteron::experiments {

// It sees the cloth at watched instants only: a peak between two of them is missed, and nothing is kept on
// the device.  The reversal that counts is the last one from past Ma, with the largest moment of the time
// spent there; the tremor of a crease at rest has smaller moments, which lie on its recovery branch.
class Recoveries : public Observer {
 public:
  explicit Recoveries(const Scene& scene);

  bool counts() const { return counts_; }  // true if the law has the three cases
  void watch(Session& session, const Snapshot& instant) override;
  // Records the elements by case, and the curvature that they would keep if let go now: by the law, and by
  // the closed form for a first reversal from the virgin curve (which a longer history only resembles).
  void finish(Session& session, const std::string& title) override;
  // Takes the law's `moment`, with `dimension` components per element [N].
  void see(const std::vector<double>& moment, int dimension);
  void serialise(Archive& archive) override {
    archive(before_);
    archive(peak_);
  }
  // Returns the number of elements by case: elastic (never past Ma), partial slip, full slip.
  std::array<long, 3> cases() const;

 private:
  VirginCurve curve_;
  bool counts_ = false;
  std::vector<double> before_;  // moments at the previous instant [N]
  std::vector<double> peak_;    // per element [N]; 0 if never past Ma
};

}  // namespace hysteron::experiments
