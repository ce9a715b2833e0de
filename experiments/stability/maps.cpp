// Sweeps of two numbers: a property of the fabric against the step.
#include <cmath>

#include "experiments/stability/stability.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

struct NumberSweep {
  const char *name, *title, *label;
  int from, to;                 // powers of ten of the property
  void (*set)(Scene&, double);  // sets the property
};

const NumberSweep kNumberSweeps[] = {
    {"bending-step", "Bending rigidity b2 (b1 = 3.1 b2) against the step", "bending rigidity b2 [N m]", -8,
     -1,
     [](Scene& scene, double b2) {
       scene.fabric.b1 *= b2 / scene.fabric.b2;
       scene.fabric.b2 = b2;
     }},
    {"membrane-step", "Membrane stiffness of warp and weft (shear: 6 % of it) against the step",
     "membrane stiffness [N/m]", 0, 7,
     [](Scene& scene, double stiffness) {
       scene.fabric.shear *= stiffness / scene.fabric.warp;
       scene.fabric.warp = scene.fabric.weft = stiffness;
     }},
    {"density-step", "Density against the step", "density [kg/m²]", -2, 1,
     [](Scene& scene, double density) { scene.fabric.density = density; }},
    // M0 is kept, so that k0 -> 0 is Coulomb friction beside b2; from the fabric's own k0 on b1 is kept, so
    // that k0 -> infinity is elastic with b1.
    {"friction-step", "Curvature k0 at which friction saturates (below 50/m at the same M0) against the step",
     "k0 [1/m]", -3, 5,
     [](Scene& scene, double k0) {
       Fabric& f = scene.fabric;
       if (k0 < f.k0) f.b1 = f.b2 + (f.b1 - f.b2) * f.k0 / k0;
       f.k0 = k0;
     }},
};

struct NamedStep {
  const char* name;
  double seconds;
  bool quick = false;
};
constexpr NamedStep kSteps[] = {{"0.01 ms", 1e-5},      {"0.1 ms", 1e-4, true},     {"1 ms", 1e-3},
                                {"1/240 s", 1.0 / 240}, {"1/60 s", 1.0 / 60, true}, {"1/24 s", 1.0 / 24}};

std::string decade_name(int exponent) {
  const bool short_enough = exponent >= 0 && exponent <= 2;
  return short_enough ? number_text(std::pow(10.0, exponent)) : "1e" + std::to_string(exponent);
}

// Returns a square that is held level by two corners and let go: it swings down, folds and sways.
Scene falling_square() {
  constexpr double kLength = 0.2;  // [m]
  Scene scene = default_scene("cotton-broad-k50");
  scene.seconds = 1e30;  // longer than any run
  scene.cloth.length = kLength;
  scene.triangles = 128;
  for (const double x : {0.0, kLength}) {
    Pin& pin = scene.pin.emplace_back();
    pin.select = PinSelection::nearest;
    pin.point = {x, kLength, 0};
  }
  return scene;
}

// Returns a sweep with a map for each variant; `vary` applies the variant to a scene that has its value and
// its step.
Sweep against_step(const NumberSweep& of, const SweepParams& choice, const std::vector<std::string>& variants,
                   const std::function<void(Scene& scene, int variant)>& vary) {
  Sweep sweep{of.name, of.title, {of.label, {}}, {"step", {}}, variants, {}};
  std::vector<double> values, steps;
  for (int e = of.from; e <= of.to; e += choice.quick ? of.to - of.from : 1) {
    values.push_back(std::pow(10.0, e));
    sweep.x.ticks.push_back(decade_name(e));
  }
  for (const NamedStep& step : kSteps) {
    if (choice.quick && !step.quick) continue;
    steps.push_back(step.seconds);
    sweep.y.ticks.push_back(step.name);
  }
  sweep.at = [set = of.set, values, steps, vary](int variant, int column, int row) {
    Attempt attempt{falling_square()};
    set(attempt.scene, values[column]);
    attempt.scene.step = steps[row];
    vary(attempt.scene, variant);
    return attempt;
  };
  return sweep;
}

// Returns the sweep of the chapter's method, with the printed force and with the energy-consistent one.
Sweep chapter_sweep(const SweepParams& choice) {
  NumberSweep of = kNumberSweeps[0];
  of.name = "chapter-method";
  of.title = "The chapter's method: bending rigidity b2 (b1 = 3.1 b2) against the step";
  Sweep sweep =
      against_step(of, choice, {"printed force", "force of the energy"}, [](Scene& scene, int variant) {
        apply_scene_file(scene, "chapter-method");
        if (variant == 1) scene.force = ForceConvention::energy;
      });
  sweep.integrators = {enum_name(Integrator::semi_implicit)};
  return sweep;
}

}  // namespace

std::vector<Sweep> number_sweeps(const SweepParams& choice) {
  std::vector<Sweep> sweeps;
  const std::vector<std::string> laws = choice.few_laws();
  for (const NumberSweep& of : kNumberSweeps)
    sweeps.push_back(
        against_step(of, choice, laws, [laws](Scene& scene, int variant) { scene.law = laws[variant]; }));
  sweeps.push_back(chapter_sweep(choice));
  return sweeps;
}

}  // namespace hysteron::experiments
