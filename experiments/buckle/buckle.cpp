// `hysteron buckle`: a strip clamped at one end buckles under its own weight, upright on its clamp, or
// sideways from level on its edge.  It measures how heavy the strip must be, compares this with beam theory,
// and draws the strip as it buckles.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/specimens/buckling.h"
#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/app/case.h"
#include "experiments/workbench/session/session.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

struct BuckleParams {
  Buckling kind = Buckling::upright;
  double width = 0;
};
using B = BuckleParams;
// clang-format off
const KeyRow<B> kRows[] = {
    {"buckle.kind", at<&B::kind>, "", any(), "upright: stands on its clamp; edge: clamped level, width vertical; law = linear unless named. Gamma is the weight times L^3/b2, b2 along warp whatever the strip's direction"},
    {"buckle.width", at<&B::width>, "", between(0, 0.25), "over the length, of the strip whose threshold is measured; 0: 1/10 upright, 1/80 on edge. cloth.width is that of the pictured one"},
};
// clang-format on

constexpr double kVisibleTilt = 0.02;  // smallest tilt that counts as buckled [rad]
constexpr double kPictured = 1.3;      // largest weight in the pictures, over the reference

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.law = "linear";
  scene.integrator = Integrator::quasi_static;
  scene.cloth.shape = ClothOutline::strip;
  scene.cloth.length = 0.1;
  scene.cloth.width = 0.01;
  scene.mesh = "unionjack";
  scene.triangles = 640;
  scene.step = 0.05;
  scene.device = DeviceChoice::cpu;
  setup.options.fps = 20;
  setup.options.camera_direction = {0.8, -1.0, 0.6};
  setup.options.camera_fov = 24;
  return setup;
}

std::vector<FixedKey> fixed_keys() {
  std::vector<FixedKey> keys = decided_by_clamped_strips();
  const char* weight = "the strip's weight grows through that of theory, whatever it was";
  keys.insert(keys.end(), {{"cloth.rotation", "buckle.kind says how the strip stands"},
                           {"integrator", "it looks for equilibria (quasi-static)"},
                           {"fabric.density", weight},
                           {"gravity", weight},
                           {"seconds", weight},
                           {"ramp", weight},
                           {"unload", weight}});
  return keys;
}

// Returns the bounds of a strip that starts at its clamp at `position` and may bend down to its side.
render::Box strip_bounds(const BucklingStrip& strip, double width, const Eigen::Vector3d& position) {
  const float l = static_cast<float>(strip.length), b = static_cast<float>(width);
  render::Box box{{0, -0.5f * l, -0.35f * l}, {l, 0.05f * l, b}};
  if (strip.kind == Buckling::upright) box = {{-0.85f * l, 0, 0}, {0.1f * l, b, l}};
  if (strip.kind == Buckling::upright && strip.side.x() > 0) box = {{-0.1f * l, 0, 0}, {0.85f * l, b, l}};
  box.low += position.cast<float>();
  box.high += position.cast<float>();
  return box;
}

// Returns the scene with the measured strip's width in place of the pictured one's.
Scene measured_scene(Scene scene, const BuckleParams& choice) {
  const double default_width = choice.kind == Buckling::upright ? 0.1 : 1.0 / 80;
  scene.cloth.width = scene.cloth.length * (choice.width > 0 ? choice.width : default_width);
  return scene;
}

Southwell measure(const Scene& scene, Buckling kind, double length, Session& session) {
  const auto stage = session.run().stage("solve");
  const BucklingStrip strip = measured_strip(scene, kind, length);
  const auto simulation = make_simulation(strip.scene, strip.cloth);
  Southwell found = approach_threshold(strip, *simulation);
  session.run().progress(
      fmt::format("critical Gamma {:.4f} (weight L^3/b2, b2 along warp) from {} states, "
                  "{} triangles",
                  found.critical_gamma, found.gamma.size(), strip.cloth.mesh.faces()));
  return found;
}

// Returns the columns of the Southwell plot, whose last part is a straight line in Gamma to the `power`:
// Gamma, deflection, load and load over deflection.
std::vector<Column> southwell_columns(const Southwell& found, int power) {
  std::vector<Column> columns = {{"gamma [1]", found.gamma},
                                 {"deflection [1]", found.deflection},
                                 {power == 1 ? "load [1]" : "load squared [1]", {}},
                                 {"load over deflection [1]", {}}};
  for (std::size_t k = 0; k < found.gamma.size(); ++k) {
    columns[2].values.push_back(std::pow(found.gamma[k], power));
    columns[3].values.push_back(found.gamma[k] / found.deflection[k]);
  }
  return columns;
}

// Returns the curve through the last three states down to the threshold: load over deflection = (1 -
// x/critical)/(a + b x), x the load to its power.
render::Series fitted(const Southwell& found, int power) {
  constexpr int kPoints = 40;
  const double critical = std::pow(found.critical_gamma, power);
  const std::size_t n = found.gamma.size();
  const auto x = [&](std::size_t k) { return std::pow(found.gamma[k], power); };
  const auto rest = [&](std::size_t k) {
    return (1 - x(k) / critical) * found.deflection[k] / found.gamma[k];
  };
  const double slope = (rest(n - 1) - rest(n - 2)) / (x(n - 1) - x(n - 2));
  render::Series series{"fitted, extrapolated", {}, {}, render::Series::Style::dashed};
  for (int k = 0; k <= kPoints; ++k) {
    const double at = x(n - 3) + (critical - x(n - 3)) * k / kPoints;
    series.add(at, (1 - at / critical) / (rest(n - 1) + slope * (at - x(n - 1))));
  }
  return series;
}

void plot(Session& session, const Southwell& found, double reference, int power) {
  const std::vector<Column> columns = southwell_columns(found, power);
  const std::vector<double>&x = columns[2].values, &y = columns[3].values;
  render::Plot southwell{"Southwell plot, law " + session.scene().law,
                         {power == 1 ? "Gamma" : "square of Gamma"},
                         {"Gamma/(deflection over length)"}};
  southwell.x.high = 1.15 * std::pow(std::max(found.critical_gamma, reference), power);
  southwell.y.high = 1.1 * *std::max_element(y.begin(), y.end());
  southwell.series = {{"simulated", x, y, render::Series::Style::points, session.law_color()},
                      fitted(found, power)};
  southwell.marks = {{"theory", std::pow(reference, power), 0, -1, 1}};
  session.plot("plot_southwell", southwell);
  render::Plot bending{
      "Buckling of the pictured strip, tilted by 0.02", {"Gamma"}, {"deflection over length"}};
  bending.series = {
      render::series_from_csv(session.run().path("metrics.csv"), "gamma", "deflection", "simulated")};
  bending.series[0].color = session.law_color();
  session.plot("plot_deflection", bending);
}

void limit_to_quick(Setup& setup) { setup.scene.triangles = std::min(setup.scene.triangles, 320); }

class BuckleCase : public Case {
 public:
  explicit BuckleCase(const CommandLine& line);
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  B choice_;
  double length_ = 0;     // free length, which bends [m]
  Scene measured_;        // with the width of the strip whose threshold is measured
  double reference_ = 0;  // Gamma of theory
  BucklingStrip pictured_;
  Southwell found_;
  double last_ = 0;  // deflection of the pictured strip over its length
};

BuckleCase::BuckleCase(const CommandLine& line) {
  setup = set_up(line, defaults(), bind(kRows, choice_), limit_to_quick);
  length_ = setup.scene.cloth.length;
  measured_ = measured_scene(setup.scene, choice_);
  reference_ = reference_gamma(choice_.kind, measured_);
  pictured_ = buckling_strip(setup.scene, choice_.kind, length_, kVisibleTilt, kPictured);
  setup.scene = pictured_.scene;
  cloth = pictured_.cloth;
}

// Measures the threshold first, on a strip of its own; the session's strip is for pictures.
RunPlan BuckleCase::plan(Session& session) {
  session.reserve({"southwell.csv"}, {"plot_southwell", "plot_deflection"});
  found_ = measure(measured_, choice_.kind, length_, session);
  Table(southwell_columns(found_, power_of_load(choice_.kind))).write(session.run().path("southwell.csv"));
  const Scene& scene = setup.scene;
  RunPlan plan;
  plan.title = "Buckling, " + enum_name(choice_.kind) + ": law " + scene.law;
  plan.bounds = strip_bounds(pictured_, scene.cloth.width, scene.cloth.position);
  plan.columns = {"gamma [1]", "deflection [1]"};
  const auto gamma = [this](double time) { return reference_ * time; };  // that of theory acts after 1 s
  plan.measure = [this, gamma](const Snapshot& m) -> std::vector<double> {
    last_ = pictured_.deflection(m.x) / pictured_.length;
    return {gamma(m.time), last_};
  };
  plan.progress = [this, gamma](const Snapshot& m) {
    return fmt::format("Gamma {:.3f}  the end has moved by {:.4f} of the length", gamma(m.time), last_);
  };
  return plan;
}

void BuckleCase::conclude(Session& session) {
  Run& run = session.run();
  run.metric("critical_gamma", found_.critical_gamma);
  run.metric("reference_gamma", reference_);
  run.metric("error_percent", 100 * (found_.critical_gamma / reference_ - 1));
  run.metric("clamp_effect_percent", 100 * fraction_of_width(choice_.kind, measured_, length_));
  if (session.pictures()) plot(session, found_, reference_, power_of_load(choice_.kind));
}

}  // namespace

Experiment buckle() {
  return {
      .name = "buckle",
      .question = "strip that buckles under its own weight, upright or on its edge",
      .case_of = case_of<BuckleCase>,
      .simulates = true,
      .own_keys = own_key_descriptions<kRows>,
      .defaults = defaults,
      .fixed_keys = fixed_keys,
      .conditions = {{"seed", "mesh = random"}},
      .headlines = {.all = {{"critical_gamma", "critical gamma (weight L^3/b2, b2 along warp)", "", "{:.3f}"},
                            {"reference_gamma", "that of theory", "", "{:.3f}", 1, kNoErrors}},
                    .equilibria = true}};
}

}  // namespace hysteron::experiments
