// Sweeps of two numbers: a property of the fabric against the step.
#include <algorithm>
#include <cmath>

#include "experiments/stability/stability.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

constexpr double kSide = 0.2;  // [m]

// An axis whose ticks stand for numbers, ascending.
struct NumberAxis {
  render::CellAxis axis;
  std::vector<double> values;
};

// 1e-8, "1e-8": a decade a tick.
NumberAxis decades(const std::string& label, int from, int to, int every) {
  NumberAxis decades{{label, {}}, {}};
  for (int e = from; e <= to; e += every) {
    decades.values.push_back(std::pow(10.0, e));
    decades.axis.ticks.push_back(e >= 0 && e <= 2 ? number_text(decades.values.back())
                                                  : "1e" + std::to_string(e));
  }
  return decades;
}

NumberAxis steps(bool quick) {
  if (quick) return {{"step", {"0.1 ms", "1/60 s"}}, {1e-4, 1.0 / 60}};
  return {{"step", {"0.01 ms", "0.1 ms", "1 ms", "1/240 s", "1/60 s", "1/24 s"}},
          {1e-5, 1e-4, 1e-3, 1.0 / 240, 1.0 / 60, 1.0 / 24}};
}

Pin pin_at(double x, double y) {
  Pin pin;
  pin.select = "nearest";
  pin.point = {x, y, 0};
  return pin;
}

// A square held level by two corners and let go: it swings down, folds and sways.
Scene falling_square() {
  Scene scene = default_scene("cotton-broad-k50");
  scene.cloth.length = kSide;
  scene.triangles = 128;
  scene.pin = {pin_at(0, kSide), pin_at(kSide, kSide)};
  return scene;
}

Sweep against_step(const std::string& name, const std::string& title, const NumberAxis& x,
                   const SweepChoice& choice, void (*set)(Scene&, double)) {
  const NumberAxis y = steps(choice.quick);
  Sweep sweep{name, title, x.axis, y.axis, choice.few_laws(), {}};
  sweep.at = [set, x = x.values, y = y.values, laws = sweep.variants](int variant, int column, int row) {
    Scene scene = falling_square();
    set(scene, x[column]);
    scene.step = y[row];
    scene.law = laws[variant];
    return Attempt{scene};
  };
  return sweep;
}

}  // namespace

Sweep bending_sweep(const SweepChoice& choice) {
  return against_step("bending-step", "Bending rigidity b2 (b1 = 3.1 b2) against the step",
                      decades("bending rigidity b2 [N m]", -8, -1, choice.quick ? 7 : 1), choice,
                      [](Scene& scene, double b2) {
                        scene.fabric.b1 *= b2 / scene.fabric.b2;
                        scene.fabric.b2 = b2;
                      });
}

Sweep membrane_sweep(const SweepChoice& choice) {
  return against_step("membrane-step",
                      "Membrane stiffness of warp and weft (shear: 6 % of it) against the step",
                      decades("membrane stiffness [N/m]", 0, 7, choice.quick ? 7 : 1), choice,
                      [](Scene& scene, double stiffness) {
                        scene.fabric.shear *= stiffness / scene.fabric.warp;
                        scene.fabric.warp = scene.fabric.weft = stiffness;
                      });
}

Sweep density_sweep(const SweepChoice& choice) {
  return against_step("density-step", "Density against the step",
                      decades("density [kg/m²]", -2, 1, choice.quick ? 3 : 1), choice,
                      [](Scene& scene, double density) { scene.fabric.density = density; });
}

// M0 stays, so that k0 -> 0 is Coulomb friction beside b2; from the fabric's own k0 on b1 stays, so that
// k0 -> infinity is elastic with b1.
Sweep friction_sweep(const SweepChoice& choice) {
  return against_step("friction-step",
                      "Curvature k0 at which friction saturates (below 50/m at the same M0) against the step",
                      decades("k0 [1/m]", -3, 5, choice.quick ? 8 : 1), choice, [](Scene& scene, double k0) {
                        Fabric& f = scene.fabric;
                        if (k0 < f.k0) f.b1 = f.b2 + (f.b1 - f.b2) * f.k0 / k0;
                        f.k0 = k0;
                      });
}

}  // namespace hysteron::experiments
