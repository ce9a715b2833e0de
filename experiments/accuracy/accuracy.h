// Error against run time: each problem has an independent reference and is solved by many settings that
// differ from one base in one factor at a time.  The solved settings give the Pareto front of error and time,
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

// A setting is one way to solve a problem.
struct MethodSetting {
  std::string factor =
      "base";  // the factor it varies: mesh, size, element, law, integrator, step, tolerance, ...
  MeshFamily mesh = MeshFamily::unionjack;
  std::string law = "linear";
  BendingElement element = BendingElement::shape;
  Integrator integrator = Integrator::quasi_static;
  ImplicitEvery implicit_every = ImplicitEvery::substep;
  ForceConvention force = ForceConvention::energy;
  Precision precision = Precision::fp64;
  DeviceChoice device = DeviceChoice::cpu;
  int triangles = 0;               // requested number; the mesh may have a few more or fewer
  double step = 0, tolerance = 0;  // [s], [m]
  double load = 0;  // varied load where a problem has one: heaviness Gamma, kind of decay; else 0
};

// Returns `base` with one factor changed.
template <class Change>
MethodSetting varied(MethodSetting base, const std::string& factor, const Change& change) {
  base.factor = factor;
  change(base);
  return base;
}

// Adds one setting to the list for each value of a factor that is a member of the setting.
template <class T>
void vary(std::vector<MethodSetting>& list, const MethodSetting& base, const std::string& factor,
          T MethodSetting::*member, const std::vector<std::type_identity_t<T>>& values) {
  for (const T& value : values)
    list.push_back(varied(base, factor, [&](MethodSetting& s) { s.*member = value; }));
}

// The result of solving a problem with a setting.
struct Found {
  double value = 0, reference = 0;  // the quantity that the problem compares
  double error = 0;                 // relative error as the problem defines it, unsigned: 0.01 is 1 %
  double uncertainty = 0;           // error of the reference, in the same unit; 0: below rounding
  int triangles = 0;
  long steps = 0;         // number of substeps, of parts of steps, or of equilibria
  double seconds = 0;     // wall clock of the simulation, without set-up and reference
  std::size_t bytes = 0;  // memory that the simulation holds on its device
  std::string failed;     // why there is no number; empty if there is one
};

struct Problem {
  std::string name;       // as on the command line: "sag"
  std::string title;      // title of the plot
  std::string error;      // how `error` is defined
  std::string reference;  // where the reference value comes from
  std::vector<MethodSetting> settings;
  std::function<Found(const MethodSetting&)>
      solve;                        // Error::invalid_input and Error::simulation are recorded as failures
  std::string load = "load";        // what Setting::load means
  bool reference_per_mesh = false;  // true: errors on different meshes, or sizes, are not comparable
};

// Effort says which of a problem's settings are solved, and where.
struct Effort {
  bool quick = false;                       // solves a few of them, in seconds instead of minutes
  DeviceChoice device = DeviceChoice::cpu;  // device of the base setting
};

// Returns the scene with the setting's choices; keys that the setting does not have stay the scene's.
Scene with(const MethodSetting& setting, Scene scene);

// Stores the simulation's number of steps, its bytes, and the seconds passed since `start` in `found`.
void note_cost(Simulation& simulation, const Scene& scene, std::chrono::steady_clock::time_point start,
               Found& found);

// A motion whose settings are compared: its scene for a setting, its length and sampling, and the value read
// off it.
struct MotionQuestion {
  std::function<Scene(const MethodSetting&)> scene;
  double length = 0, sampling = 0;  // [m], [s]
  double reference_step = 0;        // step of the reference runs by bdf2, one run per mesh and size [s]
  std::function<double(const Cloth&, const std::vector<Eigen::Vector3d>&)> value;
};
// Gives the problem its solve(): the error is the distance of the positions at sampled times from those of a
// run on the same mesh with very small steps.
void ask_for_motion(const MotionQuestion& question, Problem& problem);

Problem sag_problem(const Effort& effort);     // compares sagging strips with the elastica
Problem droop_problem(const Effort& effort);   // compares the sag that friction leaves after unloading
Problem bend_problem(const Effort& effort);    // compares a strip's loop in pure bending with the law's own
Problem buckle_problem(const Effort& effort);  // compares the critical heaviness with beam theory
Problem decay_problem(const Effort& effort);   // compares free vibrations with the laws of decay
Problem swing_problem(const Effort& effort);   // measures the order in time of a smooth motion
Problem crease_problem(const Effort& effort);  // measures the error of a motion through reversals

struct Solved {
  MethodSetting setting;
  Found found;
};

// A problem with its settings, in their order, and what each gave.
struct Solution {
  Problem problem;
  std::vector<Solved> solved;

  // True if the setting answers the same question as the base: it has the same law and load, and the same
  // mesh where each mesh has a reference of its own.
  bool comparable(const MethodSetting& setting) const;
};

// Returns the indices of the comparable settings that no other one beats in both error and time, fastest
// first.
std::vector<std::size_t> pareto_front(const Solution& solution);

// Returns the index of the fastest comparable setting with at most this error.
std::optional<std::size_t> cheapest(const Solution& solution, double error);

// The observed order between two settings that differ in nothing but size or step.
struct Order {
  std::string in;           // "space" or "time"
  std::string group;        // the choices that both settings share
  double from = 0, to = 0;  // cell size relative to the coarsest of the group; or step [s]
  double error_from = 0, error_to = 0;
  double order = 0;
};
std::vector<Order> observed_orders(const Solution& solution);

// Names the factors in which the problem's settings differ: "bdf2, 1/120 s", "shape, random, 512 triangles".
std::string describe(const Solution& solution, const MethodSetting& setting);
// Names the setting's curve in the plot, without its size and step.
std::string curve_label(const Solution& solution, const MethodSetting& setting);

}  // namespace hysteron::experiments
