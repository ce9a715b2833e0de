// One simulated run from set-up to manifest: what every experiment shares.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pictures/pictures.h"
#include "experiments/workbench/session/crossings.h"
#include "experiments/workbench/session/interrupts.h"
#include "experiments/workbench/session/mesh_export.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/recoveries.h"
#include "render/camera.h"
#include "render/plot.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// What is known of an instant that is recorded.
struct Snapshot {
  double time;                            // [s]
  const std::vector<Eigen::Vector3d>& x;  // positions [m]
  double fastest;  // largest displacement since the last instant over the time between [m/s]
};

// The experiment's own part of a run.
struct RunPlan {
  render::Box bounds;                // framed by the pictures [m]
  bool wanders = false;              // the scene may lead the cloth beyond: a trial widens them
  std::optional<float> floor;        // height of the visible ground [m]
  std::vector<std::string> columns;  // own columns of metrics.csv, with units
  std::function<std::vector<double>(const Snapshot&)> measure;
  std::function<bool(const Snapshot&)> settled;  // ends the run early
  // Of every step, where they are not all the scene's [s]; one that is longer ends in an instant of its own.
  std::vector<double> time_steps;
  bool to_rest = false;  // at the end, without inertia, on to the equilibrium nearby, where that can be
  double wait = 0;  // then, for laws that relax: so long at rest, by steps that grow with the time passed [s]
  std::function<bool(const Snapshot&)> pictured;  // which instants are drawn and exported; empty: all of them
  std::function<std::string(const Snapshot&)> progress;
  // What the experiment has collected in measure() and its like, for checkpoints; empty: it takes none.
  std::function<void(Archive&)> visit;
};

// Prints what the scene includes and leaves out, with bytes and loops (--explain).
void explain(const Cloth& cloth, const Simulation& simulation);

class Session {
 public:
  // Builds the cloth, unless the experiment brings its own, and the simulation; makes the run's folder.
  Session(const CommandLine& line, const Setup& setup, std::optional<Cloth> cloth = {});

  // There is nothing to simulate: --explain or --dump-scene, which is done already, or --resume of a complete
  // run.
  bool is_over() const {
    return setup_.options.explain || !setup_.options.dump_scene.empty() || is_complete_;
  }
  Run& run() { return *run_; }
  const Cloth& cloth() const { return cloth_; }
  const Scene& scene() const { return setup_.scene; }
  Simulation& simulation() { return *simulation_; }
  Pictures* pictures() { return pictures_.get(); }  // null with --no-images

  // Refuses what Run::reserve() does: the experiment's own files, and what it draws, if it draws.
  void reserve(const std::vector<std::string>& files, const std::vector<std::string>& drawn = {});
  // Simulates, records and draws, an instant per 1/fps, until the time is over or the question is settled,
  // and then to rest if the question asks for it.  Returns whether it is settled or, then, at rest.
  bool simulate(const RunPlan& question);
  void plot(const std::string& name, const render::Plot& plot) { run_->plot(name, plot); }
  // Metrics that every simulated run has, the manifest, the report.
  void finish(const std::string& title);

 private:
  // An instant of the series: its row, pictures and checks.
  Snapshot record(const RunPlan& question, Record& series, const std::vector<Eigen::Vector3d>& x,
                  double fastest, const std::string& left);
  render::Box framed(const RunPlan& question);
  long steps_of(const RunPlan& question) const;
  double go_to_next_instant(const RunPlan& question);
  bool run_to_end(const RunPlan& question, Record& series);
  bool find_rest(const RunPlan& question, Record& series);  // resting.cpp
  // resuming.cpp
  void check_existing_run();
  std::vector<std::string> kept_files() const;
  bool takes_checkpoints(const RunPlan& question) const;
  void visit(Archive& archive, const RunPlan& question, Record& series);
  bool go_on(const RunPlan& question, Record& series);
  void take_checkpoint(const RunPlan& question, Record& series);
  void pause(const RunPlan& question, Record& series, const Interrupts& interrupts);
  void drop_checkpoint();
  void watch_crossings();
  void see_crossings(const std::vector<Eigen::Vector3d>& x);
  void note_crossings();
  std::string opening_words(const RunPlan& question) const;
  void watch_folds(const std::vector<Eigen::Vector3d>& x);
  void note_folds();
  void note_integrator(const Ledger& ledger);
  void note_device_work();
  void note_deep_contact();
  void note_slack_hands();
  void note_convergence();

  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  CommandLine line_;
  Setup setup_;
  Cloth cloth_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Run> run_;
  std::unique_ptr<Pictures> pictures_;
  std::vector<double> rest_angle_;
  Probes probes_;
  MeshExport meshes_;
  Recoveries recoveries_;
  std::unique_ptr<Crossings> crossings_;  // null where they are not counted
  double folded_ = 0;                     // largest share of sharply folded edges
  double stretched_ = 0;                  // largest principal stretch minus 1, of the instants recorded
  bool is_complete_ = false;
  std::string state_;               // of the checkpoint to go on from; empty: none, or gone on
  std::vector<double> resumed_at_;  // [s]
  std::chrono::steady_clock::time_point checkpoint_taken_ = begun_;  // or begun
};

}  // namespace hysteron::experiments
