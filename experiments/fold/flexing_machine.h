// Records a specimen while it is folded again and again.
#pragma once

#include <string>
#include <vector>

#include "experiments/fold/material.h"
#include "experiments/fold/specimen.h"
#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

struct FoldReading {
  double recovery_angle = 180;  // 180 degrees less the largest angle of the residual curvature [degree]
  double set = 0;               // residual curvature of the crown [1/m]
  double lowest = 0;            // current lowest point of the cloth, below the clamps [mm]
  double sag = 0;               // the lowest point at the last return [mm]
  MaterialReading material;     // reading of the crown, at the last chosen cycle
};

// Watches instants that do not depend on --fps; writes a row of cycles.csv at each return and of material.csv
// at the chosen ones.
class FlexingMachine {
 public:
  FlexingMachine(const Fold& fold, Session& session);

  // The columns of metrics.csv are the distance between the clamps, the curvature of the crown, and the
  // moment there of the law alone, driven through the crown's curvatures.
  static std::vector<std::string> columns();
  std::vector<double> measure(const Snapshot& instant) const;
  void watch(const Snapshot& instant);
  // True at both ends of the stroke in cycles 1, 10, 100, ... and the last, and at the end.
  bool pictured(double time) const;
  std::string progress(const Snapshot& instant) const;
  void finish();
  void serialise(Archive& archive);  // saves everything read so far

  const FoldReading& reading() const { return reading_; }
  // Moment over curvature at the crown, in pictured cycles.
  const std::vector<render::Series>& loops() const { return loops_; }

 private:
  void add_to_loops();
  void end_cycle(int cycle);

  const Fold& fold_;
  Session& session_;
  FoldGauge gauge_;
  LawWalk material_;
  TimeSeriesWriter cycles_, materials_;
  int count_ = 0;          // number of watched instants
  LawPoint crown_;         // state of the law at the crown
  double curvature_ = 0;   // current curvature of the crown [1/m]
  double largest_ = 0;     // largest curvature in this cycle [1/m]
  double lost_ = 0;        // loss by bending friction before this cycle [J]
  double crown_lost_ = 0;  // loss of the law at the crown before this cycle [J/m^2]
  double time_ = 0;        // time of the last watched instant [s]
  FoldReading reading_;
  int ended_ = 0;  // number of completed cycles
  std::vector<render::Series> loops_;
};

}  // namespace hysteron::experiments
