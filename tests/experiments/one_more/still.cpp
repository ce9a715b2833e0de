// This experiment is a cloth that nothing moves, in one folder, whose line in the catalogue the build adds
// (one_more_test.cpp).
#include "experiments/workbench/app/case.h"
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

class StillCase : public Case {
 public:
  explicit StillCase(const CommandLine& line) { setup = set_up(line, defaults()); }
  RunPlan plan(Session& session) override {
    RunPlan plan;
    plan.title = "Still";
    plan.bounds = render::bounding_box(flat_points(session.cloth().start));
    plan.columns = {"corner_height [m]"};
    plan.measure = [](const Snapshot& m) { return std::vector{m.x[0].z()}; };
    plan.progress = [](const Snapshot& m) { return "t = " + std::to_string(m.time) + " s"; };
    return plan;
  }
  void conclude(Session& session) override { session.run().metric("stillness_m", session.scene().step); }
};

}  // namespace

Experiment still() {
  return {.name = "still",
          .question = "a cloth that nothing moves",
          .case_of = case_of<StillCase>,
          .simulates = true,
          .defaults = defaults,
          .compared = true,
          .headlines = {.all = {{"stillness_m", "stillness", "mm", "{:.3f}", 1e3}}}};
}

}  // namespace hysteron::experiments
