// What is read from a specimen while it is folded again and again.
#pragma once

#include <string>
#include <vector>

#include "experiments/fold/material.h"
#include "experiments/fold/specimen.h"
#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {

struct FoldReading {
  double recovery_angle = 180;  // less the largest turn of the residual curvature [degree]
  double set = 0;               // residual curvature of the crown [1/m]
  double lowest = 0;            // point of the cloth now, below the clamps [mm]
  double sag = 0;               // the same at the last return [mm]
  MaterialReading material;     // of the crown, at the last chosen cycle
};

// Watches instants that --fps does not move; writes a row of cycles.csv at each return and of material.csv at
// the chosen ones.
class FlexingMachine {
 public:
  FlexingMachine(const Fold& fold, Session& session);

  // Columns of metrics.csv: distance between the clamps; curvature of the crown; the law's moment there,
  // driven alone through the crown's curvatures.
  static std::vector<std::string> columns();
  std::vector<double> measure(const Snapshot& instant) const;
  void watch(const Snapshot& instant);
  // Both ends of the stroke in cycles 1, 10, 100, ... and the last; the end.
  bool pictured(double time) const;
  std::string progress(const Snapshot& instant) const;
  void finish();
  void serialise(Archive& archive);  // all that has been read

  const FoldReading& reading() const { return reading_; }
  const std::vector<render::Series>& loops() const { return loops_; }  // of the crown, in pictured cycles

 private:
  void add_to_loops();
  void end_cycle(int cycle);

  const Fold& fold_;
  Session& session_;
  FoldGauge gauge_;
  LawWalk material_;
  Record cycles_, materials_;
  int count_ = 0;          // watched instants so far
  LawPoint crown_;         // the law's, at the crown
  double curvature_ = 0;   // of the crown now [1/m]
  double largest_ = 0;     // in this cycle [1/m]
  double lost_ = 0;        // by bending friction before this cycle [J]
  double crown_lost_ = 0;  // by the law at the crown before this cycle [J/m^2]
  double time_ = 0;        // of the last watched instant [s]
  FoldReading reading_;
  int ended_ = 0;  // cycles
  std::vector<render::Series> loops_;
};

}  // namespace hysteron::experiments
