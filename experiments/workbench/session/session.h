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
#include "render/camera.h"
#include "render/plot.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

class Checkpoints;
class Probes;
class Session;

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
  // What the experiment has collected in measure() and its like, for checkpoints.
  std::function<void(Archive&)> serialise = [](Archive&) {};
};

// What watches a run: a series of numbers, pictures, a count, doubts.  The session calls all of them in the
// order of one list, and knows nothing else of them.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void begin(Session&) {}                    // before the first instant
  virtual void step(Session&) {}                     // before the steps to the next one
  virtual void record(Session&, const Snapshot&) {}  // an instant
  virtual void close() {}                            // after the last one: its series can be read
  // After the experiment's own results: metrics, warnings and entries of the manifest.
  virtual void finish(Session&, const std::string& /*title*/) {}
  virtual void serialise(Archive&) {}  // what it has collected, for checkpoints
};

using Observers = std::vector<std::unique_ptr<Observer>>;
// Of every run, in the order of their calls: metrics.csv, whose row the experiment measures, probes,
// pictures, which show a probe's loop, what the solver says, crossings, folds, recoveries, meshes, errors,
// checkpoints, which go when all else is there.  Refuses files that Run::reserve() does.
Observers session_observers(Session& session, std::unique_ptr<Probes> probes,
                            std::unique_ptr<Checkpoints> checkpoints);

// Prints what the scene includes and leaves out, with bytes and loops (--explain).
void explain(const Cloth& cloth, const Simulation& simulation);

// The scene as the experiment of that line changes it, without the run; nothing where it simulates no cloth.
// Throws what the run would throw before its first step.
std::optional<Scene> planned_scene(CommandLine line);

class Session {
 public:
  // Builds the cloth, unless the experiment brings its own, and the simulation; makes the run's folder.
  Session(const CommandLine& line, const Setup& setup, std::optional<Cloth> cloth = {});

  // There is nothing to simulate: --explain or --dump-scene, which is done already, or --resume of a complete
  // run.
  bool is_over() const { return !run_; }
  Run& run() { return *run_; }
  const CommandLine& line() const { return line_; }
  const Setup& setup() const { return setup_; }
  const Scene& scene() const { return setup_.scene; }
  const Cloth& cloth() const { return cloth_; }
  Simulation& simulation() { return *simulation_; }
  const RunPlan& plan() const { return *plan_; }         // while it is simulated
  const render::Box& bounds() const { return bounds_; }  // framed by the pictures [m]
  bool is_pictured(const Snapshot& instant) const {      // drawn and exported
    return !plan_->pictured || plan_->pictured(instant);
  }
  Pictures* pictures() { return pictures_.get(); }  // null with --no-images
  void draw_by(std::unique_ptr<Pictures> pictures) { pictures_ = std::move(pictures); }

  // Refuses what Run::reserve() does: the experiment's own files, and what it draws, if it draws.
  void reserve(const std::vector<std::string>& files, const std::vector<std::string>& drawn = {});
  // Simulates, records and draws, an instant per 1/fps, until the time is over or the question is settled,
  // and then to rest if the question asks for it.  Returns whether it is settled or, then, at rest.
  bool simulate(const RunPlan& plan);
  void plot(const std::string& name, const render::Plot& plot) { run_->plot(name, plot); }
  // Metrics that every simulated run has, the manifest, the report.
  void finish(const std::string& title);
  // All that outlives an instant; files of the run first.
  void serialise(Archive& archive);

 private:
  void describe_start();
  // An instant of the series.  Returns whether the question is settled.
  bool record(const std::vector<Eigen::Vector3d>& x, double fastest, const std::string& left);
  render::Box framed();
  long steps() const;
  double go_to_next_instant();
  bool run_to_end();
  bool find_rest();
  std::string opening_words() const;

  const std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  CommandLine line_;
  Setup setup_;
  Cloth cloth_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<Run> run_;  // null where there is nothing to simulate
  std::unique_ptr<Pictures> pictures_;
  Observers observers_;
  const RunPlan* plan_ = nullptr;
  render::Box bounds_;
  long recorded_ = 0;  // instants
};

}  // namespace hysteron::experiments
