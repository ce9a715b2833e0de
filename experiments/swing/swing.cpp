// `hysteron swing`: a strip clamped at one end is held out straight and let go; it swings under gravity and
// comes to rest.  The ledger distinguishes what stops it: friction in bending, viscosity or the integrator.
#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <utility>

#include "experiments/specimens/clamped_mesh.h"
#include "experiments/swing/clamped_sheet.h"
#include "experiments/workbench/app/case.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/record.h"
#include "experiments/workbench/session/session.h"
#include "sim/identification/decay_shape.h"

namespace hysteron::experiments {
namespace {

constexpr double kOnion = 0.5;    // time span of the swing in one picture: there and back [s]
constexpr double kProbed = 0.06;  // distance of the probe from the clamp, over the length

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  // This mesh and step err by 0.4 % of the length in `hysteron accuracy`, problem swing: the cheapest within
  // 1 %.
  scene.integrator = Integrator::bdf2;
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = 0.09;
  scene.cloth.width = 0.03;
  scene.mesh = "unionjack";
  scene.triangles = 1000;
  scene.seconds = 6;  // until swings are small enough to show how they decay
  scene.step = 1.0 / 240;
  scene.fabric.damping = 1e-5;
  scene.origin.erase("fabric.damping");  // a default of this experiment, which no file has said
  setup.options.fps = 30;
  setup.options.camera_direction = {0.2, -1.0, 0.3};
  setup.options.camera_fov = 24;
  return setup;
}

// Smallest counted swing between two reversals, over the length, so that amplitudes end at half of it, 0.45
// mm of the strip by default.  Time steps change a reversal by some 1e-6 of it; below its lowest threshold a
// law of eight stops with k0 = 8/m rings at 0.1 mm.
constexpr double kMinTurn = 0.01;
// Largest amplitude for fits, over the free length: with viscosity alone, whose decay is exponential when
// small, larger amplitudes fall with exponents of 1.5 and more; below, with 1.1.
constexpr double kSmallSwing = 0.5;

constexpr const char* kDecayCaption =
    "Amplitude of the free end against time: half of a turning point's distance to the mean of its "
    "neighbours, and "
    "the shape that describes it best. Friction that saturates makes a line that ends in a hyperbola, "
    "saturated friction a line, friction that has not saturated a hyperbola, viscosity an exponential.";
// Writes turns.csv with a row for each amplitude.
void write_turns(Run& run, const std::vector<Amplitude>& amplitudes) {
  TimeSeriesWriter file(run.path("turns.csv"), {"turn", "time [s]", "amplitude [mm]"});
  for (const Amplitude& a : amplitudes) file.row({1.0 * a.turn, a.time, 1e3 * a.value});
  file.finish();
}

// Returns the largest distance of amplitudes down to a fifth of the first from their nearest line, over the
// first: cloth's swings are reported to fall along a line so far (Matsudaira & Zhang 1996).  NaN for fewer
// than three.
double line_departure(const std::vector<Amplitude>& amplitudes, const Decay& decay) {
  constexpr double kFifth = 0.2;
  std::vector<Amplitude> large;
  for (std::size_t i = decay.first;
       i < amplitudes.size() && amplitudes[i].value >= kFifth * amplitudes[decay.first].value; ++i)
    large.push_back(amplitudes[i]);
  if (large.size() < 3) return NAN;
  const DecayFit line = line_through(large);
  double farthest = 0;
  for (const Amplitude& a : large)
    farthest = std::max(farthest, std::abs(a.value - line.first + line.rate * (a.time - large[0].time)));
  return farthest / large[0].value;
}

void note_decay(Run& run, const std::vector<Amplitude>& amplitudes, const Decay& decay) {
  run.metric("decay_shape", enum_name(decay.shape));
  run.metric("decay_amplitudes_count", decay.used);
  if (decay.used >= kMinAmplitudes) run.metric("decay_per_turn_percent", 100 * decay.per_turn);
  for (const auto& [percent, key] : {std::pair{50, "decay_per_half_period_percent_at_50"},
                                     std::pair{10, "decay_per_half_period_percent_at_10"}}) {
    const double loss = half_period_loss(amplitudes, decay.first, percent / 100.0);
    if (std::isfinite(loss)) run.metric(key, 100 * loss);
  }
  if (decay.fits.empty()) return;
  run.metric("decay_margin", decay.margin);
  const double first = amplitudes[decay.first].value;
  run.metric("decay_rms_percent", 100 * decay.best().rms / first);
  if (decay.shape == DecayShape::saturating) {
    run.metric("decay_knee_fraction", decay.knee_fraction());
    run.metric("decay_saturated_rate_mm_per_s", 1e3 * decay.best().rate);
    run.metric("decay_stiffening", decay.best().stiffening);
  }
  if (decay.shape == DecayShape::two_step) {
    run.metric("decay_step_fraction", decay.step_fraction());
    run.metric("decay_first_rate_mm_per_s", 1e3 * decay.best().rate);
    run.metric("decay_second_rate_mm_per_s", 1e3 * decay.best().last_rate);
  }
  if (const double departure = line_departure(amplitudes, decay); std::isfinite(departure))
    run.metric("decay_line_departure_percent", 100 * departure);
}

// Plots amplitudes against time with the best fit, over the amplitudes that it was made from.
void plot_decay(Session& session, const std::vector<Amplitude>& amplitudes, const Decay& decay) {
  constexpr int kDrawn = 200;
  constexpr const char* kFitColor = "#222222";
  if (amplitudes.empty()) return;
  render::Plot plot{"Amplitude against time, " + session.scene().fabric.name + ", law " + session.scene().law,
                    {"time [s]"},
                    {"amplitude of the free end [mm]"}};
  render::Series simulated{"simulated", {}, {}, render::Series::Style::points, session.law_color()};
  for (const Amplitude& a : amplitudes) simulated.add(a.time, 1e3 * a.value);
  plot.series = {simulated};
  if (decay.shape != DecayShape::unknown && !decay.fits.empty()) {
    render::Series fit{"fitted, " + enum_name(decay.shape), {}, {}, render::Series::Style::line, kFitColor};
    const double from = amplitudes[decay.first].time, whole = amplitudes.back().time - from;
    for (int i = 0; i <= kDrawn; ++i) {
      fit.add(from + whole * i / kDrawn, 1e3 * decay.best().at(whole * i / kDrawn));
    }
    plot.series.push_back(fit);
  }
  session.plot("plot_decay", plot);
  plot.y.logarithmic = true;
  session.plot("plot_decay_log", plot);
}

void plot(Session& session) {
  const auto csv = session.run().path("metrics.csv");
  const std::string what = session.scene().fabric.name + ", law " + session.scene().law;
  render::Plot tip{"Height of the free end, " + what, {"time [s]"}, {"height over the clamp [cm]"}};
  tip.series = {render::series_from_csv(csv, "time", "tip_height", "simulated")};
  tip.series[0].color = session.law_color();
  for (double& z : tip.series[0].y) z *= 100;
  session.plot("plot_tip", tip);
  render::Plot energy{"Where the energy went, " + what, {"time [s]"}, {"energy [J]"}};
  for (const char* term : {"kinetic", "bending", "bending_friction", "viscous", "integrator_inertia"})
    energy.series.push_back(render::series_from_csv(csv, "time", term, term));
  session.plot("plot_energy", energy);
}

void limit_to_quick(Setup& setup) {
  setup.scene.triangles = std::min(setup.scene.triangles, 300);
  setup.scene.seconds = std::min(setup.scene.seconds, 0.4);
  setup.options.fps = std::min(setup.options.fps, 20.0);
}

// Clamps the cloth unless the scene has pins of its own.  Generated meshes have a column of vertices on
// either side of the clamp's end; of others, all vertices up to there are held.
std::optional<Cloth> clamp(const CommandLine& line, Setup& setup) {
  Scene& scene = setup.scene;
  if (!scene.pin.empty()) return {};
  if (is_flat_rectangle(scene)) {
    decide(line, setup, unused_by_clamped_meshes());
    Cloth cloth = clamp_at(scene, kClampedLength);
    throw_if_gravity_bends_nothing(scene, cloth.mesh);
    return cloth;
  }
  clamp_low_end(scene);
  return {};
}

class SwingCase : public Case {
 public:
  explicit SwingCase(const CommandLine& line);
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  bool has_own_pins_ = false;  // the scene holds the cloth itself
  SheetPlacement sheet_;
  std::vector<double> times_, swing_;  // by step: time [s], the free end along the swing's direction [m]
};

SwingCase::SwingCase(const CommandLine& line) {
  setup = set_up(line, defaults(), {}, limit_to_quick);
  has_own_pins_ = !setup.scene.pin.empty();
  cloth = clamp(line, setup);
  if (is_flat_rectangle(setup.scene))
    probe_unless_told(setup.options,
                      {kClampedLength + kProbed * setup.scene.cloth.length, setup.scene.cloth.width / 2});
}

RunPlan SwingCase::plan(Session& session) {
  const Scene& scene = setup.scene;
  session.reserve({"turns.csv"}, {"plot_decay", "plot_decay_log", "plot_tip", "plot_energy"});
  if (!has_own_pins_)
    if (const std::string warning = long_side_warning(scene, session.cloth().mesh); !warning.empty())
      session.run().warn(warning);
  sheet_ = sheet_placement(scene, session.cloth(), !has_own_pins_);
  RunPlan plan;
  plan.title = "Swing: " + scene.fabric.name + ", law " + scene.law;
  plan.bounds = sheet_.bounds();
  plan.columns = {"tip_x [m]", "tip_height [m]"};
  const int tip = sheet_.tip, clamp = sheet_.clamp;
  plan.measure = [=](const Snapshot& m) -> std::vector<double> {
    return {m.x[tip].x(), m.x[tip].z() - m.x[clamp].z()};
  };
  plan.each_step = [this](const Snapshot& m) {
    times_.push_back(m.time);
    swing_.push_back(sheet_.swing(m.x));
  };
  plan.serialise = [this](Archive& archive) {
    archive(times_);
    archive(swing_);
  };
  plan.progress = [=](const Snapshot& m) {
    return fmt::format("t = {:.3f} s  tip at {:.4f}, {:.4f} m", m.time, m.x[tip].x(), m.x[tip].z());
  };
  return plan;
}

void SwingCase::conclude(Session& session) {
  const Ledger ledger = session.simulation().ledger();
  Run& run = session.run();
  const double smallest = kMinTurn * sheet_.length;
  const auto turns = turning_points(times_, swing_, smallest);
  const std::vector<Amplitude> amplitudes =
      turning_amplitudes(turning_points(times_, swing_, smallest, kSwingRipple));
  const Decay decay = decay_between_amplitudes(amplitudes, kSmallSwing * (sheet_.length - kClampedLength));
  run.metric("turns", turns.size());
  const Scene& scene = setup.scene;
  if (scene.gravity.isZero(0) || scene.integrator == Integrator::quasi_static)
    run.warn("nothing swings without gravity and inertia (gravity, integrator = bdf2)");
  note_decay(run, amplitudes, decay);
  write_turns(run, amplitudes);
  run.manifest().curves = {{"plot_decay", "turns.csv", "time [s]", "amplitude [mm]", false, kDecayCaption,
                            false, "decay_knee_fraction"}};
  run.metric("bending_friction_J", ledger.bending_friction);
  run.metric("viscous_J", ledger.viscous);
  run.metric("integrator_J", ledger.integrator());
  if (!session.pictures()) return;
  session.pictures()->begin_with_onion_skin(kOnion);
  plot(session);
  plot_decay(session, amplitudes, decay);
}

}  // namespace

Experiment swing() {
  return {.name = "swing",
          .question = "a clamped strip, released: energy lost to friction",
          .case_of = case_of<SwingCase>,
          .simulates = true,
          .defaults = defaults,
          .compared = true,
          .onion = kOnion,
          .headlines = {
              .all = {{"decay_shape", "decay", "", "", 1, kNoErrors},
                      {"decay_knee_fraction", "friction saturates above", "%", "{:.0f}", 100},
                      {"decay_per_half_period_percent_at_50",
                       "lost in half a period at a half of the amplitude", "%", "{:.1f}"},
                      {"decay_per_half_period_percent_at_10",
                       "lost in half a period at a tenth of the amplitude", "%", "{:.1f}"},
                      {"decay_per_turn_percent", "mean loss in half a period of the run", "%", "{:.1f}"},
                      {"decay_step_fraction", "second line of decay begins at", "%", "{:.0f}", 100},
                      {"turns", "turns", "", "{:.0f}", 1, kNoErrors},
                      {"bending_friction_J", "lost to friction in bending", "mJ", "{:.4g}", 1e3},
                      {"viscous_J", "lost to viscosity", "mJ", "{:.4g}", 1e3, kNoErrors}}}};
}

}  // namespace hysteron::experiments
