// What each part of a scene's model costs: steps of scenes as they are, and without one part each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/bench/hard_scenes.h"
#include "experiments/bench/wall_clock.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// One way to leave something out.
struct Omission {
  const char* part;
  std::function<bool(const Scene&)> is_there;
  std::function<void(Scene&)> leave_out;
};

// Self-contact, obstacles, friction of contact, hysteresis of bending (the law becomes `linear`), its
// fatigue, friction in the plane, damping of bending, drag of the air.
std::vector<Omission> omissions();

struct PartsChoice {
  double after = 0.1;  // simulated from the start before steps are timed [s]
  int steps = 9;       // that are timed, each by itself
};

// A row for the scene as it is and one for each part that it has, without that part: memory and, per step,
// launches, waits, iterations and time; `measured` hears of every one at once.  The energy ledger is kept
// always: its row is the first one less the memory of the ledger and the loops that keep nothing else.  Where
// a scene stops, and where the budget is used up, a row says why, and its numbers are not known.
std::vector<Metrics> cost_of_parts(const HardScene& scene, const PartsChoice& choice, const Budget& budget,
                                   const std::function<void(const Metrics&)>& measured);

}  // namespace hysteron::experiments
