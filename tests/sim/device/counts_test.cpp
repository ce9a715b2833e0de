// How often a step turns to its device: launches, waits and allocations as counts, which no machine's speed
// changes.
#include <gtest/gtest.h>

#include "sim/device/device_counts.h"
#include "sim/time/back_end.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

DeviceCounts counted_step(Simulation& simulation) {
  const DeviceCounts before = device_counts;
  simulation.advance(1);
  simulation.wait();
  return {device_counts.loops - before.loops, device_counts.synchronizations - before.synchronizations,
          device_counts.allocations - before.allocations};
}

TEST(Probe, Print) {
  for (const char* integrator : {"semi-implicit", "implicit", "explicit", "bdf2"})
    for (double tol : {1e-4, 1e-12}) {
      Scene scene = test::hanging_square(200);
      scene.integrator = integrator;
      scene.law = "prandtl";
      scene.solver_tolerance = tol;
      if (scene.is_implicit()) scene.step = 5e-3;
      const test::Trial trial(scene);
      auto s = trial.simulation();
      for (int i = 0; i < 6; ++i) {
        const double it = s->solver_iterations() * s->steps(), nw = s->newton_iterations() * s->steps();
        const auto c = counted_step(*s);
        printf("%s %g loops %ld sync %ld alloc %ld pcg %g newton %g\n", integrator, tol, c.loops,
               c.synchronizations, c.allocations, s->solver_iterations() * s->steps() - it,
               s->newton_iterations() * s->steps() - nw);
      }
    }
}

}  // namespace
}  // namespace hysteron
