// A strip clamped level at one end sags under its own weight, which grows slowly and is taken away again: how
// far, and what remains, beside the elastica with the same law; and the bending length of ASTM D1388, half
// the overhang whose end hangs 41.5 degrees below the clamp.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/specimens/cantilever_strip.h"
#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/app/decided_keys.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {
namespace {

struct CantileverChoice {
  double gamma = 0;
};
using C = CantileverChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"gamma", at<&C::gamma>, "", at_least(0), "", "weight over stiffness, density g L^3/b2: sets the density, and law = linear unless named; 0: the fabric's own"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = Integrator::quasi_static;
  scene.cloth.shape = "strip";
  scene.cloth.length = 0.1;
  scene.cloth.width = 0.025;  // as cut for ASTM D1388
  scene.mesh = "unionjack";
  // 32 cells along: 0.06 % of the drop, and the cheapest within 0.1 % (`hysteron accuracy`, problem sag).
  scene.triangles = 512;
  scene.ramp = scene.unload = 1;
  scene.step = 0.05;
  scene.device = DeviceChoice::cpu;
  setup.options.fps = 20;
  setup.options.camera_direction = {0.35, -1.0, 0.3};
  setup.options.camera_fov = 24;
  return setup;
}

std::vector<DecidedKey> decided() {
  std::vector<DecidedKey> keys = decided_by_clamped_strips();
  keys.push_back({"seconds", "the weight grows in ramp and goes in unload"});
  return keys;
}

bool names_law(const CommandLine& line) {
  return std::any_of(line.flags.begin(), line.flags.end(), [](const Flag& f) { return f.path == "law"; });
}

// Of the free end over the strip's length.
struct Drops {
  double largest = 0, elastica = 0;  // under the whole weight
  double last = 0;
  void see(double cloth, double curve) {
    last = cloth;
    if (curve > elastica) largest = cloth, elastica = curve;
  }
};

void plot(Session& session) {
  const auto csv = session.run().path("metrics.csv");
  render::Plot drop{"Drop of the free end, " + session.scene().fabric.name + ", law " + session.scene().law,
                    {"share of the weight"},
                    {"drop over length"}};
  drop.series = {render::series_from_csv(csv, "load", "elastica", "elastica"),
                 render::series_from_csv(csv, "load", "drop", "cloth")};
  drop.series[1].style = render::Series::Style::points;
  session.plot("plot_drop", drop);
}

void limit_to_quick(Setup& setup) { setup.scene.triangles = std::min(setup.scene.triangles, 128); }

int run_cantilever(const CommandLine& line) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice), limit_to_quick);
  Scene& scene = setup.scene;
  scene.seconds = scene.ramp + scene.unload;
  if (choice.gamma > 0) {
    decide(line, setup, {{"fabric.density", "gamma says how heavy the strip is"}});
    if (!names_law(line)) scene.law = "linear";
    scene.fabric.density =
        choice.gamma * scene.fabric.b2 / (scene.gravity.norm() * std::pow(scene.cloth.length, 3));
  }
  const double length = scene.cloth.length;  // that hangs over
  const CantileverStrip strip = overhang(scene, length);
  scene = strip.scene;
  Session session(line, setup, strip.cloth);
  if (session.is_over()) return 0;
  session.reserve({}, {"plot_drop"});

  std::vector<double> times, loads;
  for (int k = 1; k <= std::lround(scene.seconds * setup.options.fps); ++k) {
    times.push_back(k / setup.options.fps);
    loads.push_back(load_at(scene, times.back()));
  }
  const std::vector<SaggingStrip> reference = sagging_strips(strip_elastica(scene, length), loads);
  const auto elastica_drop = [&](double time) {
    for (std::size_t k = 0; k < times.size(); ++k)
      if (std::abs(times[k] - time) < scene.step / 2) return reference[k].drop() / length;
    return 0.0;
  };
  Drops drops;
  RunPlan plan;
  const float l = static_cast<float>(length), width = static_cast<float>(scene.cloth.width);
  plan.bounds = {{0, 0, -l}, {1.05f * l, width, 0.1f * l}};
  plan.columns = {"load [1]", "drop [1]", "elastica [1]"};
  plan.measure = [&](const Snapshot& m) -> std::vector<double> {
    const double drop = strip.free_end(m.x).y() / length;
    drops.see(drop, elastica_drop(m.time));
    return {load_at(scene, m.time), drop, elastica_drop(m.time)};
  };
  plan.progress = [&](const Snapshot& m) {
    return fmt::format("load {:.2f}  drop {:.4f} of the length, elastica {:.4f}", load_at(scene, m.time),
                       drops.last, elastica_drop(m.time));
  };
  plan.serialise = [&](Archive& archive) { archive(drops); };
  session.simulate(plan);

  Run& run = session.run();
  run.metric("tip_drop_over_length", drops.largest);
  run.metric("elastica_drop_over_length", drops.elastica);
  run.metric("error_percent", 100 * (drops.largest / drops.elastica - 1));
  if (load_at(scene, scene.seconds) == 0) {
    run.metric("residual_drop_over_length", drops.last);
    run.metric("elastica_residual_drop_over_length", reference.back().drop() / length);
  }
  const double expected = elastica_bending_length(scene);
  run.metric("bending_length_m", cloth_bending_length(scene, expected));
  run.metric("elastica_bending_length_m", expected);
  if (session.pictures()) plot(session);
  session.finish("Cantilever: " + scene.fabric.name + ", law " + scene.law);
  return 0;
}

}  // namespace

Experiment cantilever() {
  return {
      .name = "cantilever",
      .question = "a strip that sags, beside the elastica; bending length (ASTM D1388)",
      .run = run_cantilever,
      .simulates = true,
      .own_keys = own_key_descriptions<kRows>,
      .defaults = defaults,
      .decided = decided,
      .conditions = {{"seed", "mesh = random"}},
      .headlines = {.all = {{"tip_drop_over_length", "tip drop over length", "", "{:.4f}"},
                            {"elastica_drop_over_length", "that of the elastica", "", "{:.4f}", 1, kNoErrors},
                            {"bending_length_m", "bending length", "mm", "{:.2f}", 1e3}}}};
}

}  // namespace hysteron::experiments
