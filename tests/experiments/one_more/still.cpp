// This experiment is a cloth that nothing moves, in one folder, whose line in the catalogue the build adds
// (one_more_test.cpp).
#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/session/session.h"
#include "render/camera.h"

namespace hysteron::experiments {
namespace {

Setup defaults() {
  Setup setup;
  setup.scene = default_scene();
  setup.scene.triangles = 32;
  setup.scene.seconds = 0.02;
  return setup;
}

int run_still(const CommandLine& line) {
  Session session(line, set_up(line, defaults()));
  if (session.is_over()) return 0;
  RunPlan plan;
  plan.bounds = render::bounding_box(flat_points(session.cloth().start));
  plan.columns = {"corner_height [m]"};
  plan.measure = [](const Snapshot& m) { return std::vector{m.x[0].z()}; };
  plan.progress = [](const Snapshot& m) { return "t = " + std::to_string(m.time) + " s"; };
  session.simulate(plan);
  session.run().metric("stillness_m", session.scene().step);
  session.finish("Still");
  return 0;
}

}  // namespace

Experiment still() {
  return {.name = "still",
          .question = "a cloth that nothing moves",
          .run = run_still,
          .simulates = true,
          .defaults = defaults,
          .compared = true,
          .headlines = {.all = {{"stillness_m", "stillness", "mm", "{:.3f}", 1e3}}}};
}

}  // namespace hysteron::experiments
