// Error against run time: problems with references of their own, each solved by many settings that differ
// from one base in one factor at a time; and what follows from solved settings: which are worth their time,
// and the orders at which errors fall.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {

// One way to solve a problem.
struct Setting {
  std::string factor = "base";  // what it varies: mesh, size, element, law, integrator, step, tolerance, ...
  std::string mesh = "unionjack", law = "linear";
  BendingElement element = BendingElement::shape;
  Integrator integrator = Integrator::quasi_static;
  ImplicitEvery implicit_every = ImplicitEvery::substep;
  ForceConvention force = ForceConvention::energy;
  Precision precision = Precision::fp64;
  DeviceChoice device = DeviceChoice::cpu;
  int triangles = 0;               // asked for; the mesh may have a few others
  double step = 0, tolerance = 0;  // [s], [m]
  double load = 0;                 // of problems that have several: heaviness Gamma, decay's kind; else 0
};

// `base` with one factor changed.
template <class Change>
Setting varied(Setting base, const std::string& factor, const Change& change) {
  base.factor = factor;
  change(base);
  return base;
}

// Adds one to the list for each value of a factor that is a member of the setting.
template <class T>
void vary(std::vector<Setting>& list, const Setting& base, const std::string& factor, T Setting::*member,
          const std::vector<std::type_identity_t<T>>& values) {
  for (const T& value : values) list.push_back(varied(base, factor, [&](Setting& s) { s.*member = value; }));
}

// What came of it.
struct Found {
  double value = 0, reference = 0;  // of what the problem asks for
  double error = 0;                 // as the problem defines it, no sign, 0.01 is 1 %
  double uncertainty = 0;           // of the reference, in the error's unit; 0: beyond the digits that count
  int triangles = 0;
  long steps = 0;         // substeps, or parts of steps, or equilibria
  double seconds = 0;     // wall clock of the simulation, without set-up and reference
  std::size_t bytes = 0;  // that the simulation holds on its device
  std::string failed;     // why there is no number; else empty
};

struct Problem {
  std::string name;       // "sag"
  std::string title;      // of the plot
  std::string error;      // what `error` is
  std::string reference;  // where the reference comes from
  std::vector<Setting> settings;
  std::function<Found(const Setting&)>
      solve;                        // may throw Error::invalid_input, Error::simulation: noted as failed
  std::string load = "load";        // what Setting::load is
  bool reference_per_mesh = false;  // errors on different meshes, or sizes, say nothing about each other
};

// Which of a problem's settings are wanted.
struct Effort {
  bool quick = false;                       // a few of them: seconds instead of minutes
  DeviceChoice device = DeviceChoice::cpu;  // of the base
};

// A scene with the setting's choices; what the setting does not say is the scene's.
Scene with(const Setting& setting, Scene scene);

// Steps and bytes of a simulation, and the seconds since `start`, when it was begun.
void note_cost(Simulation& simulation, const Scene& scene, std::chrono::steady_clock::time_point start,
               Found& found);

// A motion that settings differ in: its scene for a mesh, its size, and what to read off it.
struct MotionQuestion {
  std::function<Scene(const Setting&)> scene;
  double length = 0, sampling = 0;  // [m], [s]
  double reference_step = 0;        // of the references by bdf2, one per mesh and size [s]
  std::function<double(const Cloth&, const std::vector<Eigen::Vector3d>&)> value;
};
// Gives the problem its solve(): error is the distance of the positions at sampled times from those of a run
// of the same mesh with very small steps.
void ask_for_motion(const MotionQuestion& question, Problem& problem);

Problem sag_problem(const Effort& effort);     // heavy strips against the elastica
Problem droop_problem(const Effort& effort);   // what remains of the sag with friction, unloaded
Problem bend_problem(const Effort& effort);    // loop of a strip in pure bending against the law's own
Problem buckle_problem(const Effort& effort);  // critical heaviness
Problem decay_problem(const Effort& effort);   // free vibrations against the laws of decay
Problem swing_problem(const Effort& effort);   // smooth motion: order in time
Problem crease_problem(const Effort& effort);  // motion through reversals

struct Solved {
  Setting setting;
  Found found;
};

// A problem's settings, in their order, solved.
struct Solution {
  Problem problem;
  std::vector<Solved> solved;

  // Whether the setting answers the same question as the base: the same law and load, and the same mesh where
  // each mesh has a reference of its own.
  bool comparable(const Setting& setting) const;
};

// Indices of the comparable settings that no other one beats in both error and time, fastest first.
std::vector<std::size_t> pareto_front(const Solution& solution);

// The fastest comparable setting with at most this error.
std::optional<std::size_t> cheapest(const Solution& solution, double error);

// Between two settings that differ in nothing but size or step.
struct Order {
  std::string in;           // space | time
  std::string group;        // what they share
  double from = 0, to = 0;  // cells' size relative to the coarsest of the group; or steps [s]
  double error_from = 0, error_to = 0;
  double order = 0;
};
std::vector<Order> observed_orders(const Solution& solution);

// "bdf2, 1/120 s", "shape, random, 512 triangles": what the problem's settings differ in.
std::string describe(const Solution& solution, const Setting& setting);
// A curve of the plot: neither size nor step.
std::string curve_label(const Solution& solution, const Setting& setting);

}  // namespace hysteron::experiments
