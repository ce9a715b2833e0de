// One simulated run from set-up to manifest, which every experiment shares.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/workbench/app/law_family.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pictures/pictures.h"
#include "render/camera.h"
#include "render/color_map.h"
#include "render/plot.h"
#include "sim/time/simulation.h"
#include "sim/time/timetable.h"

namespace hysteron::experiments {

class Checkpoints;
class Probes;
class Session;

// The state at an instant that is recorded, watched, or the end of a step.
struct Snapshot {
  double time;                            // [s]
  const std::vector<Eigen::Vector3d>& x;  // positions [m]
  // Largest displacement since the last instant of its kind over the time between [m/s]; NaN in each_step().
  double fastest;
};

// The experiment's own part of a run.
//
// Three functions are called while it is simulated, each of them at the start and at the end, too:
//   measure     at the instants of --fps, for the row of metrics.csv that belongs to a picture
//   watch       at instants of the experiment's own, `watch_rate`, independent of --fps
//   each_step   after every step
// and `instants` at times of their own.
// No result may depend on the rate of pictures: all that becomes a metric, or ends the run, is collected in
// watch(), each_step() or instants, or read from the simulation when simulate() has returned; measure() only
// shows it.  If several are due at one instant, each_step() is called first, then instants, and measure()
// last.  serialise() covers what they collect.  each_step() costs a copy of all positions a step, which is
// noticeable on a GPU.
struct RunPlan {
  std::string title;                 // of the run's pictures and report: "Drape: wool, law prandtl"
  render::Box bounds;                // box framed by the pictures [m], unless the experiment has a `frame`
  std::optional<float> floor;        // height of the visible ground [m]
  std::vector<std::string> columns;  // the experiment's columns of metrics.csv, with units
  std::function<std::vector<double>(const Snapshot&)> measure;
  std::function<void(const Snapshot&)> watch;
  double watch_rate = 0;  // [1/s]; 0: the experiment's default of --fps, whatever fps is
  std::function<void(const Snapshot&)> each_step;
  // An instant independent of either rate, which is looked at once: at the first end of a step not before its
  // time, so never if its time is after the end; its speed is NaN.
  struct Instant {
    double time;  // [s]
    std::function<void(const Snapshot&)> look;
  };
  std::vector<Instant> instants;
  std::function<bool(const Snapshot&)> settled;  // ends the run early; called at watched instants
  // Length of every step, if they are not all the scene's [s]; each longer one ends in an instant of its own.
  std::vector<double> time_steps;
  bool to_rest = false;  // continues without inertia to the equilibrium nearby, if possible
  double wait = 0;       // then, for laws that relax, time at rest by growing steps [s]
  // Selects the drawn and exported instants; empty: all of them.
  std::function<bool(const Snapshot&)> pictured;
  std::function<std::string(const Snapshot&)> progress;
  // Serialises what the experiment has collected in watch() and the like, for checkpoints.
  std::function<void(Archive&)> serialise = [](Archive&) {};
};

// An observer watches a run: a series of numbers, pictures, a count, warnings.  The session calls all
// observers in the order of one list, and knows nothing else of them.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void begin(Session&) {}                    // before the first instant
  virtual void step(Session&) {}                     // before the steps to the next instant
  virtual void watch(Session&, const Snapshot&) {}   // at an instant independent of --fps, for results
  virtual void record(Session&, const Snapshot&) {}  // at an instant of --fps, for series and pictures
  virtual void close() {}                            // after the last instant, so that its series can be read
  // Is called after the experiment's own results, for metrics, warnings and entries of the manifest.
  virtual void finish(Session&, const std::string& /*title*/) {}
  virtual void serialise(Archive&) {}  // saves what it has collected, for checkpoints
};

using Observers = std::vector<std::unique_ptr<Observer>>;
// Returns the observers of every run, in the order of their calls: metrics.csv, whose row the experiment
// measures, probes, pictures, which show a probe's loop, solver statistics, crossings, folds, recoveries,
// meshes, errors, an animation, whose kept positions a checkpoint needs, and checkpoints, which are removed
// when all else exists.  Refuses files that Run::reserve() does.
Observers session_observers(Session& session, std::unique_ptr<Probes> probes,
                            std::unique_ptr<Checkpoints> checkpoints);

// A simulation that is recorded in a folder.
class Session {
 public:
  // Takes the run's folder, in which files of an interrupted run are `kept`.  All others outlive the session.
  Session(const CommandLine& line, const Setup& setup, const Cloth& cloth, Simulation& simulation,
          const std::vector<std::string>& kept);
  // Has the run watched by the observers of every run.
  void observe(std::unique_ptr<Probes> probes, std::unique_ptr<Checkpoints> checkpoints);

  Run& run() { return run_; }
  const CommandLine& line() const { return line_; }
  const Setup& setup() const { return setup_; }
  const Scene& scene() const { return setup_.scene; }
  const Cloth& cloth() const { return cloth_; }
  Simulation& simulation() { return simulation_; }
  const RunPlan& plan() const { return *plan_; }         // only while it is simulated
  const render::Box& bounds() const { return bounds_; }  // box framed by the pictures [m]
  bool is_pictured(const Snapshot& instant) const {      // true if drawn and exported
    return !plan_->pictured || plan_->pictured(instant);
  }
  Pictures* pictures() { return pictures_.get(); }  // null with --no-images
  void draw_by(std::unique_ptr<Pictures> pictures) { pictures_ = std::move(pictures); }

  // Refuses as Run::reserve() does: the experiment's own files, and those of its pictures, if it draws.
  void reserve(const std::vector<std::string>& files, const std::vector<std::string>& drawn = {});
  // Simulates, watches, records and draws, until the time is over or the question is settled, and then to
  // rest if the plan asks for it.
  void simulate(const RunPlan& plan);
  bool is_settled() const { return settled_; }  // then: true if it is settled or, if asked for, at rest
  // Writes a plot; a line below the title says that all is simulated, unless a label does.
  void plot(const std::string& name, render::Plot plot);
  // Returns the colour of the scene's law in plots: "#RRGGBB".
  std::string law_color() const { return render::hex(color_of_law(scene().law)); }
  // Writes the metrics that every simulated run has, the manifest, and the report.
  void finish(const std::string& title);
  // Serialises all that outlives an instant; files of the run first.
  void serialise(Archive& archive);

 private:
  void describe_start();
  void warn_of_triangle_count();
  // The cloth's positions at the last instant of a kind.
  struct Before {
    long step = 0;
    std::vector<Eigen::Vector3d> x;  // [m]
  };

  double fastest_since(Before& before, const std::vector<Eigen::Vector3d>& x) const;
  // Handles an instant at which results are made.  Returns true if the question is settled.
  bool watch(const Snapshot& instant);
  // Handles an instant of the series and its picture.
  void record(const Snapshot& instant, const std::string& left);
  void note_rounded_instants();
  render::Box framed();
  // Takes the steps to the next instant of any kind.
  void go_on();
  // Calls what is due after these steps.  Returns true if the question is settled.
  bool look(const std::string& left);
  bool run_to_end();
  bool find_rest();
  std::string opening_text() const;

  const CommandLine& line_;
  const Setup& setup_;
  const Cloth& cloth_;
  Simulation& simulation_;
  Run run_;
  std::unique_ptr<Pictures> pictures_;
  Observers observers_;
  const RunPlan* plan_ = nullptr;
  render::Box bounds_;
  Timetable timetable_{0, 1};
  double watch_rate_ = 0;            // [1/s]
  std::vector<long> instant_steps_;  // by instant of the plan: the step that ends in it
  bool has_begun_ = false, settled_ = false;
  Before recorded_, watched_;
};

}  // namespace hysteron::experiments
