// Crease recovery (ISO 2313, AATCC 66): a specimen is folded, loaded, let go, and opens again; with
// `--law all`, or several laws separated by commas, each of them, on one page.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/crease/specimen.h"
#include "experiments/workbench/compare/variant_page.h"
#include "experiments/workbench/session/session.h"

namespace hysteron::experiments {
namespace {

using C = CreaseChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"crease.fold", at<&C::fold>, "", any(), "plate | rod | pleat", "how it is folded: flat under a plate, softly around a rod, or a pleat that is pulled straight"},
    {"crease.release", at<&C::release>, "", any(), "slow | quick", "slow: the plate rises within crease.lift, without inertia, from equilibrium to equilibrium; quick: within 0.1 s, in motion, damped by fabric.damping and air-drag"},
    {"crease.force", at<&C::force>, "N", positive(), "", "force of the plate"},
    {"crease.radius", at<&C::radius>, "m", positive(), "", "radius of the rod"},
    {"crease.pleat", at<&C::pleat>, "degree", between(5, 175), "", "angle between the limbs of the pleat at rest"},
    {"crease.hold", at<&C::hold>, "s", positive(), "", "time under the full load"},
    {"crease.lift", at<&C::lift>, "s", positive(), "", "slow release: time in which the plate rises"},
    {"crease.recovery", at<&C::recovery>, "s", positive(), "", "time to recover"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = Integrator::quasi_static;
  scene.step = 1.0 / 120;
  scene.self_contact = true;
  scene.cloth.length = 0.04;
  scene.cloth.width = 0.015;
  scene.triangles = 1600;
  scene.gravity.setZero();
  scene.air_drag = 1;
  // Of what the clamp carries, without the plate's 10 N: with 1e-6 the angle is the same to 0.1 degree.
  scene.newton_residual = 1e-3;
  scene.newton_velocity = 1e-6;
  scene.contact_stiffness = 1e9;  // of plates, which bear 10 N: what they press are the layers
  setup.options.fps = 30;
  setup.options.camera_direction = {0.25, -1.0, 0.2};
  setup.options.camera_fov = 22;
  return setup;
}

// A quick release needs inertia, and steps whose own damping is small beside the fabric's, solved as well as
// that.
void let_go_quickly(Scene& scene) {
  if (!scene.origin.contains("integrator")) scene.integrator = Integrator::bdf2;
  if (!scene.origin.contains("step")) scene.step = 1.0 / 960;
  if (!scene.origin.contains("newton-residual")) scene.newton_residual = 1e-6;
}

// What is read off the specimen as time goes on.
struct Recovered {
  double opening = NAN;  // [degree]
  double force = 0;      // of the plate before it goes [N]
};

// Curvature along the strip that was largest in each triangle, with its sign [1/m].
void keep_largest(Simulation& simulation, std::vector<double>& largest) {
  const int d = simulation.dimension();
  const std::vector<double> curvature = simulation.curvature();
  largest.resize(curvature.size() / d);
  for (std::size_t e = 0; e < largest.size(); ++e)
    if (std::abs(curvature[d * e]) > std::abs(largest[e])) largest[e] = curvature[d * e];
}

Question question_of(Session& session, const Crease& crease, std::vector<double>& largest,
                     Recovered& recovered) {
  Question question;
  const float length = static_cast<float>(crease.scene.cloth.length),
              width = static_cast<float>(crease.scene.cloth.width);
  // A specimen that is pressed lies on the ground; a soft fold swings freely, below its clamp as well.
  const bool pressed = crease.scene.obstacle.size() == 2;
  const float low = (pressed ? 0 : -0.35f) * length;
  question.bounds = {{-0.05f * length, 0, low}, {length, width, (pressed ? 0.5f : 0.85f) * length}};
  question.floor = low;
  question.columns = {"opening [degree]", "plate_force [N]"};
  question.measure = [&](const Snapshot& m) -> std::vector<double> {
    const bool plate =
        m.time > crease.times.folded && m.time <= crease.times.released + crease.scene.step / 2;
    const double force = plate ? crease.plate_force(m.x, m.time) : 0;
    if (plate) recovered.force = force;
    if (m.time <= crease.times.released + crease.scene.step / 2) keep_largest(session.simulation(), largest);
    recovered.opening = crease.opening(m.x);
    return {recovered.opening, force};
  };
  question.progress = [&](const Snapshot& m) {
    return fmt::format("t = {:.3f} s  opening {:.1f} degree", m.time, recovered.opening);
  };
  question.visit = [&](Archive& archive) {
    archive(largest);
    archive(recovered);
  };
  return question;
}

// Crease recovery angles in print, mean of warp and weft: Fashion and Textiles 2017, s40691-017-0104-2, Table
// 13 (sums of both directions there; quoted second-hand).
std::vector<render::Series> published(double end) {
  using Style = render::Series::Style;
  constexpr double kPlain = 155.0 / 2, kLeastResin = 199.0 / 2, kMostResin = 236.0 / 2;  // [degree]
  const char* grey = "#777777";
  return {{"cotton, plain (published)", {0, end}, {kPlain, kPlain}, Style::dashed, grey, 1.2},
          {"cotton, resin-finished", {0, end}, {kLeastResin, kLeastResin}, Style::dashed, "#B0A070", 1.2},
          {"", {0, end}, {kMostResin, kMostResin}, Style::dashed, "#B0A070", 1.2}};
}

// The opening after release, and where a plate was on it what is in print.
TablePlot opening_plot(const std::string& title, const C& choice, double end) {
  TablePlot plot{"plot_opening",
                 {title, {"time [s]"}, {"angle between the limbs [degree]", false, 0, 180}},
                 "metrics.csv",
                 "time",
                 "opening"};
  if (choice.fold == "plate") plot.plot.series = published(end);
  return plot;
}

void limit_to_quick(Setup& setup) { setup.scene.triangles = std::min(setup.scene.triangles, 500); }

void crease_once(const CommandLine& line) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice), limit_to_quick);
  if (choice.release == "quick") let_go_quickly(setup.scene);
  const bool pressed = choice.fold == "plate";
  const double plate = !pressed                ? 0.0
                       : setup.options.explain ? 2 * setup.scene.fabric.thickness
                                               : loaded_plate(setup.scene, choice);
  const Crease crease = pressed                ? creased(setup.scene, choice, plate)
                        : choice.fold == "rod" ? wrapped(setup.scene, choice)
                                               : pleated(setup.scene, choice);
  setup.scene = crease.scene;
  Session session(line, setup, crease.cloth);
  if (session.is_over()) return;
  Recovered recovered;
  std::vector<double> largest, left;
  session.simulate(question_of(session, crease, largest, recovered));
  keep_largest(session.simulation(), left);
  Run& run = session.run();
  run.metric("recovery_angle_deg", recovered.opening);
  run.metric("law_recovery_angle_deg",
             session.simulation().dimension() == 3 ? crease.opening_of_law(largest) : NAN);
  const auto [least, most] = std::minmax_element(left.begin(), left.end());
  run.metric("residual_curvature_per_m", std::max(-*least, *most));
  if (pressed) {
    run.metric("plate_force_N", recovered.force);
    run.metric("plate_height_m", plate);
  }
  const std::string what = setup.scene.fabric.name + ", law " + setup.scene.law;
  if (session.pictures())
    draw(run, opening_plot("Opening after release, " + what, choice, crease.times.end), setup.scene.law);
  session.finish("Crease: " + what);
}

VariantPage page_of(const CommandLine& line, std::vector<Variant>&) {
  C choice;
  const Setup setup = set_up(line, defaults(), bind(kRows, choice));
  const bool pressed = choice.fold == "plate";
  const double end = pressed ? creased(setup.scene, choice, 2 * setup.scene.fabric.thickness).times.end : 0;
  return {"Crease recovery",
          setup,
          to_json(bind(kRows, choice)),
          {"recovery_angle_deg", "law_recovery_angle_deg", "plate_force_N"},
          [](const Metrics& m) {
            return fmt::format("{:.0f} deg (law alone {:.0f})", m.number("recovery_angle_deg"),
                               m.number("law_recovery_angle_deg"));
          },
          {opening_plot("", choice, end)}};
}

int run_crease(const CommandLine& line) { return run_variants(line, crease_once, page_of); }

}  // namespace

Experiment crease() {
  return {.name = "crease",
          .question = "crease recovery (ISO 2313): fold, load, release",
          .run = run_crease,
          .simulates = true,
          .own_keys = own_keys_of<kRows>,
          .defaults = defaults};
}

}  // namespace hysteron::experiments
