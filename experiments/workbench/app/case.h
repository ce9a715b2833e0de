// One case of an experiment that simulates cloth: what a command line asks it to simulate, to measure and to
// conclude.
#pragma once

#include <memory>
#include <optional>

#include "experiments/workbench/app/experiment.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

struct RunPlan;
class Session;

// An experiment makes one of its cases from a command line; its constructor throws what the experiment
// refuses.  run_experiment() (session/driver.h) does all else with it, for every experiment alike: --explain,
// --dump-scene, the metrics that a scene requests, the frame of pictures, --resume, the run's folder.
class Case {
 public:
  Case() = default;
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;
  virtual ~Case() = default;

  Setup setup;                        // scene as it is simulated, and options
  std::optional<Cloth> cloth{};       // specimen, if the scene does not describe it; empty: make_cloth(scene)
  std::optional<CommandLine> line{};  // as the manifest records it, if other than given

  // Simulates what scene and cloth depend on, and changes them.  It is left out where the scene is only
  // checked or explained.
  virtual void prepare() {}
  // Returns what is measured while the cloth is simulated.  It begins the run: it warns, reserves the files
  // that are written later (Session::reserve), and does what comes before the first step.  The plan may refer
  // to the case and the session, which outlive it.
  virtual RunPlan plan(Session& session) = 0;
  // Writes metrics, tables and plots after the last step.
  virtual void conclude(Session& session) = 0;
};

// For Experiment::case_of.
template <class Own>
std::unique_ptr<Case> case_of(const CommandLine& line) {
  return std::make_unique<Own>(line);
}

}  // namespace hysteron::experiments
