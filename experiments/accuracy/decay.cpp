// Problem decay: free vibrations of a clamped strip show how much amplitude bending friction and viscosity
// take, and how much the integrator.
#include <cmath>

#include "experiments/accuracy/accuracy.h"
#include "experiments/accuracy/free_decay.h"

namespace hysteron::experiments {
namespace {

constexpr int kCycles = 20;
constexpr int kParts =
    400;  // number of parts of the strip in the energy balance; its loss is then known to 1e-5
constexpr DecayKind kKinds[] = {DecayKind::hyperbolic, DecayKind::linear, DecayKind::exponential};

// Returns the kind of decay, which Setting::load numbers from 0.
DecayKind decay_kind(const MethodSetting& setting) { return kKinds[std::lround(setting.load)]; }

MethodSetting base_setting(DecayKind kind, const Effort& effort) {
  const Scene scene = decay_scene(kind);
  MethodSetting base;
  base.factor = kind == DecayKind::hyperbolic ? "base" : "kind";
  base.law = scene.law;
  base.integrator = Integrator::bdf2;
  base.device = effort.device;
  base.triangles = effort.quick ? 32 : 128;
  base.step = decay_period(scene) / (effort.quick ? 150 : 200);
  base.load = static_cast<double>(kind);
  return base;
}

// Adds a setting with `times` the base's step.  The semi-implicit integrator takes its step from the mesh.
void vary_step(const MethodSetting& base, Integrator integrator, double times,
               std::vector<MethodSetting>& list) {
  list.push_back(varied(base, "step", [&](MethodSetting& s) { s.integrator = integrator, s.step *= times; }));
}

// Adds every factor for the hyperbolic kind, and only time and size for the others.
void vary_all(const MethodSetting& base, std::vector<MethodSetting>& list) {
  list.push_back(base);
  vary(list, base, "integrator", &MethodSetting::integrator,
       {Integrator::semi_implicit, Integrator::implicit});
  for (double times : {2.0, 0.5}) vary_step(base, Integrator::bdf2, times, list);
  vary(list, base, "size", &MethodSetting::triangles, {32, 192});
  if (decay_kind(base) != DecayKind::hyperbolic) return;
  list.push_back(varied(base, "integrator", [](MethodSetting& s) {
    s.integrator = Integrator::semi_implicit, s.implicit_every = ImplicitEvery::step;
  }));
  vary_step(base, Integrator::bdf2, 4, list);
  for (double times : {4.0, 0.5}) vary_step(base, Integrator::implicit, times, list);
  vary(list, base, "size", &MethodSetting::triangles, {64});
  vary(list, base, "mesh", &MethodSetting::mesh,
       {MeshFamily::aligned, MeshFamily::aligned45, MeshFamily::flipped, MeshFamily::equilateral,
        MeshFamily::random});
  vary(list, base, "element", &MethodSetting::element, {BendingElement::hinge});
}

void vary_a_few(const MethodSetting& base, std::vector<MethodSetting>& list) {
  list.push_back(base);
  if (decay_kind(base) != DecayKind::hyperbolic) return;
  vary(list, base, "integrator", &MethodSetting::integrator, {Integrator::semi_implicit});
  vary_step(base, Integrator::implicit, 3, list);
}

Found solve(const MethodSetting& setting) {
  Found found;
  const Scene scene = with(setting, decay_scene(decay_kind(setting)));
  const auto amplitudes =
      amplitudes_by_energy(decaying_bend(scene), mode_curvatures(kParts), decay_first_amplitude(), kCycles);
  found.reference = 1 - amplitudes.back() / amplitudes.front();
  const CantileverStrip flat = overhang(scene, decay_length());
  found.triangles = flat.cloth.mesh.faces();
  const auto simulation = make_simulation(flat.scene, bent_in_first_mode(flat));
  const auto start = std::chrono::steady_clock::now();
  found.value = measure_decay(*simulation, flat, kCycles).loss();
  note_cost(*simulation, flat.scene, start, found);
  found.error = std::abs(found.value / found.reference - 1);
  return found;
}

}  // namespace

Problem decay_problem(const Effort& effort) {
  Problem problem{"decay",
                  "Free vibrations of a clamped strip: amplitude lost in 20 cycles",
                  "|lost amplitude over that of the energy balance - 1|",
                  "energy balance of the first mode with the closed areas of the law's loops",
                  {},
                  solve};
  for (DecayKind kind : kKinds)
    (effort.quick ? vary_a_few : vary_all)(base_setting(kind, effort), problem.settings);
  return problem;
}

}  // namespace hysteron::experiments
