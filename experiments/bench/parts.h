// What each part of a scene's model costs: steps of scenes as they are, and without one part each.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/bench/hard_scenes.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// One way to leave something out.
struct Omission {
  const char* part;
  std::function<bool(const Scene&)> is_there;
  std::function<void(Scene&)> leave_out;
};

// Self-contact, obstacles, friction of contact, hysteresis (the law becomes `linear`), fatigue, damping of
// bending, drag of the air.
std::vector<Omission> omissions();

// A row for the scene as it is and one for each part that it has, without that part: memory and, per step,
// launches, waits, iterations and time.  Each simulates `after` seconds from the start, then as many steps
// (at least one) as are timed.  Where one stops, its row says why, and its numbers are not known.
std::vector<Metrics> cost_of_parts(const HardScene& scene, double after, int steps);

}  // namespace hysteron::experiments
