// `hysteron crease` measures crease recovery (ISO 2313, AATCC 66): a specimen is folded, loaded, let go, and
// opens again.  With `--law all`, or several laws separated by commas, it compares them on one page.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "experiments/crease/protractor.h"
#include "experiments/crease/specimen.h"
#include "experiments/specimens/cantilever_strip.h"
#include "experiments/workbench/app/case.h"
#include "experiments/workbench/app/fixed_keys.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/session.h"
#include "experiments/workbench/session/variant_page.h"
#include "sim/base/archive.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

using C = CreaseParams;
// clang-format off
const KeyRow<C> kRows[] = {
    {"crease.fold", at<&C::fold>, "", any(), "how it is folded: flat under a plate, softly around a rod, or a pleat that is pulled straight"},
    {"crease.release", at<&C::release>, "", any(), "slow: the plate rises within crease.lift, without inertia, from equilibrium to equilibrium; quick: within 0.1 s, in motion, damped by fabric.damping and air-drag"},
    {"crease.standard", at<&C::standard>, "", any(), "load and times of a standard, with steps that grow: both 5 min under the load and 5 min to recover, ISO 2313 10 N, AATCC 66 500 g; other crease keys that are given win"},
    {"crease.force", at<&C::force>, "N", positive(), "force of the plate"},
    {"crease.radius", at<&C::radius>, "m", positive(), "radius of the rod"},
    {"crease.pleat", at<&C::pleat>, "degree", between(5, 175), "angle between the limbs of the pleat at rest"},
    {"crease.hold", at<&C::hold>, "s", positive(), "time under the full load"},
    {"crease.lift", at<&C::lift>, "s", positive(), "slow release: time in which the plate rises"},
    {"crease.recovery", at<&C::recovery>, "s", positive(), "time to recover"},
    {"crease.grow-after", at<&C::grow_after>, "s", at_least(0), "time t of rest, under the load or after release, after which a step is twice as long; steps grow as 1 + t over it; 0: they do not grow"},
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
  // The residual is relative to the clamp's force without the plate's 10 N: with 1e-6 the angle is the same
  // to 0.1 degree.
  scene.newton_residual = 1e-3;
  scene.newton_velocity = 1e-6;
  scene.contact_stiffness = 1e9;  // plates bear 10 N: the layers are to yield, not the contact
  setup.options.fps = 30;
  setup.options.camera_direction = {-0.1, -1.0, 0.45};  // shows the profile, but not edge-on
  setup.options.camera_fov = 22;
  return setup;
}

std::vector<FixedKey> fixed_keys() {
  std::vector<FixedKey> keys = unused_but(
      "cloth.",
      {"cloth.shape", "cloth.length", "cloth.width", "cloth.position", "cloth.rotation", "cloth.warp-angle"},
      "the specimen is one flat strip");
  keys.insert(keys.end(), {{"cloth.shape", "the specimen is a strip"},
                           {"cloth.position", "the specimen lies where it is folded"},
                           {"cloth.rotation", "the specimen lies along x, where it is folded"},
                           {"mesh", "its mesh has its finest columns along the crease", true},
                           {"seed", "no part of its mesh is drawn at random", true},
                           {"seconds", "crease.hold, crease.lift and crease.recovery say how long it takes"},
                           {"pin", "a clamp and a moving pin hold the specimen"},
                           {"obstacle", "crease.fold says what it is folded with"}});
  return keys;
}

// Sets defaults for a quick release, which needs inertia, steps whose numerical damping is small beside the
// fabric's, and a solver of matching accuracy.
void let_go_quickly(Scene& scene) {
  if (!is_given(scene, "integrator")) scene.integrator = Integrator::bdf2;
  if (!is_given(scene, "step")) scene.step = 1.0 / 960;
  if (!is_given(scene, "newton-residual")) scene.newton_residual = 1e-6;
}

// The values that are read off the specimen as time goes on.
struct Recovered {
  double opening = NAN;                // [degree]
  double force = 0;                    // force of the plate before it rises [N]
  double time = 0;                     // time of the last reading [s]
  std::vector<double> seconds, angle;  // time since release [s]; opening then [degree]
  std::optional<LawOfCrease> law;      // only for elements that are triangles

  double angle_at(double since) const;
  void serialise(Archive& archive);
};

// Interpolates the opening in logarithmic time between the recorded instants; NaN before and after them.
double Recovered::angle_at(double since) const {
  const auto after = std::lower_bound(seconds.begin(), seconds.end(), since * (1 - 1e-9));
  const auto i = after - seconds.begin();
  if (after == seconds.end() || i == 0) return NAN;
  const double fraction = std::log(since / seconds[i - 1]) / std::log(seconds[i] / seconds[i - 1]);
  return angle[i - 1] + fraction * (angle[i] - angle[i - 1]);
}

void Recovered::serialise(Archive& archive) {
  archive(opening);
  archive(force);
  archive(time);
  archive(seconds);
  archive(angle);
  if (law) law->serialise(archive);
}

// Returns the row that turns a curvature tensor (K_xx, K_yy, sqrt2 K_xy) along warp and weft into the
// curvature along the strip.
Eigen::Vector3d strip_component(const Scene& scene) {
  const double angle = scene.cloth.warp_angle * std::numbers::pi / 180;
  const double warp = std::cos(angle), weft = -std::sin(angle);  // components of the strip's direction
  return {warp * warp, weft * weft, std::numbers::sqrt2 * warp * weft};
}

// Returns the curvature of each triangle along the strip [1/m]; `tensors` holds three values per triangle.
std::vector<double> along_strip(const Scene& scene, const std::vector<double>& tensors) {
  const Eigen::Vector3d component = strip_component(scene);
  std::vector<double> along(tensors.size() / 3);
  for (std::size_t f = 0; f < along.size(); ++f)
    along[f] = component.dot(Eigen::Map<const Eigen::Vector3d>(&tensors[3 * f]));
  return along;
}

// Returns the largest curvature of an element [1/m], along the strip if the elements are triangles.
double largest_curvature(const Scene& scene, Simulation& simulation) {
  std::vector<double> curvature = simulation.curvature();
  if (simulation.dimension() == 3) curvature = along_strip(scene, curvature);
  double largest = 0;
  for (const double k : curvature) largest = std::max(largest, std::abs(k));
  return largest;
}

// True while the plate rests on the specimen, up to its release.
bool plate_is_on(const Crease& crease, double time) {
  return time > crease.times.folded && time <= crease.times.released + crease.scene.step / 2;
}

// Reads the specimen at an instant and adds to what was recovered.
void read_specimen(const Crease& crease, const Snapshot& m, Simulation& simulation, Recovered& recovered) {
  const double half_step = crease.scene.step / 2, passed = m.time - recovered.time;
  const bool let_go = m.time > crease.times.lifted + half_step;
  recovered.time = m.time;
  if (plate_is_on(crease, m.time)) recovered.force = crease.plate_force(m.x, m.time);
  if (recovered.law && !let_go)
    recovered.law->bend(along_strip(crease.scene, simulation.curvature()), passed);
  if (recovered.law && let_go) recovered.law->let_go(passed);
  recovered.opening = crease.opening(m.x);
  if (!let_go) return;
  recovered.seconds.push_back(m.time - crease.times.lifted);
  recovered.angle.push_back(recovered.opening);
}

// Published crease recovery angles, mean of warp and weft: Fashion and Textiles 2017, s40691-017-0104-2,
// Table 13 (sums of both directions there; quoted second-hand).
std::vector<render::Series> published(double end) {
  using Style = render::Series::Style;
  constexpr double kPlain = 155.0 / 2, kMinResin = 199.0 / 2, kMaxResin = 236.0 / 2;  // [degree]
  const char* grey = "#777777";
  return {{"cotton, plain (published)", {0, end}, {kPlain, kPlain}, Style::dashed, grey, 1.2},
          {"cotton, resin-finished", {0, end}, {kMinResin, kMinResin}, Style::dashed, "#B0A070", 1.2},
          {"", {0, end}, {kMaxResin, kMaxResin}, Style::dashed, "#B0A070", 1.2}};
}

// Plots the opening after release, with published angles where a plate was used.
TablePlot opening_plot(const std::string& title, const C& choice, double end) {
  TablePlot plot{"plot_opening",
                 {title, {"time [s]"}, {"angle between the limbs [degree]", false, 0, 180}},
                 "metrics.csv",
                 "time",
                 "opening"};
  if (choice.fold == CreaseFold::plate) plot.plot.series = published(end);
  return plot;
}

// Plots the angle against logarithmic time, with published angles for its end.
TablePlot recovery_plot(const std::string& title, const C& choice) {
  using Style = render::Series::Style;
  TablePlot plot{
      "plot_recovery",
      {title, {"time since the load went [s]", true}, {"angle between the limbs [degree]", false, 0, 180}},
      "recovery.csv",
      "time since the load went",
      "opening"};
  if (choice.standard != CreaseStandard::none)
    for (const render::Series& line : published(choice.recovery))
      plot.plot.series.push_back({line.label, {line.x.back()}, {line.y.back()}, Style::points, line.color});
  return plot;
}

constexpr const char* kSinceRelease = "time since the load went [s]";
constexpr const char* kRecoveryCaption =
    "The angle between the limbs, 180 degrees if the specimen is flat again, over the logarithm of the time "
    "since "
    "the load went: friction and set keep what they keep, relaxing branches give it back in time.";

void write_recovery(Run& run, const Recovered& recovered) {
  Table table(std::vector<std::string>{kSinceRelease, "opening [degree]"});
  for (std::size_t i = 0; i < recovered.seconds.size(); ++i)
    table.row({recovered.seconds[i], recovered.angle[i]});
  table.write(run.path("recovery.csv"));
  run.manifest().curves = {
      {"plot_recovery", "recovery.csv", kSinceRelease, "opening [degree]", false, kRecoveryCaption, true}};
}

void limit_to_quick(Setup& setup) { setup.scene.triangles = std::min(setup.scene.triangles, 500); }

// Sets up the run; a standard replaces the defaults of the other keys.
Setup set_up_crease(const CommandLine& line, C& choice) {
  Setup setup = set_up(line, defaults(), bind(kRows, choice), limit_to_quick);
  if (choice.standard != CreaseStandard::none) {
    choice = by_standard(choice.standard);
    setup = set_up(line, defaults(), bind(kRows, choice), limit_to_quick);
  }
  if (choice.release == CreaseRelease::quick && choice.grow_after > 0)
    throw Error::invalid_input(
        "crease.release = quick moves, and its steps cannot grow: crease.grow-after = 0, or "
        "crease.release = slow")
        .with_key("crease.grow-after", "");
  return setup;
}

class CreaseCase : public Case {
 public:
  explicit CreaseCase(const CommandLine& line);
  void prepare() override;
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  bool is_pressed() const { return choice_.fold == CreaseFold::plate; }
  void fold_specimen();
  render::Box bounds() const;
  void note_angles(Session& session) const;
  void draw_plots(Session& session, const CreasedStrip& strip) const;

  C choice_;
  Scene flat_;        // before the specimen is folded
  double plate_ = 0;  // height at which the plate's underside stops [m]
  Crease crease_;
  Recovered recovered_;
};

CreaseCase::CreaseCase(const CommandLine& line) {
  setup = set_up_crease(line, choice_);
  if (choice_.release == CreaseRelease::quick) let_go_quickly(setup.scene);
  flat_ = setup.scene;
  if (is_pressed()) plate_ = 2 * flat_.fabric.thickness;  // until prepare() has found it
  fold_specimen();
  if (choice_.fold != CreaseFold::pleat)  // a pleated cloth is not flat at rest
    probe_unless_told(setup.options, {setup.scene.cloth.length / 2, setup.scene.cloth.width / 2});
}

void CreaseCase::fold_specimen() {
  crease_ = is_pressed()                      ? creased(flat_, choice_, plate_)
            : choice_.fold == CreaseFold::rod ? wrapped(flat_, choice_)
                                              : pleated(flat_, choice_);
  if (choice_.grow_after > 0)
    crease_.time_steps = growing_steps(crease_.times, crease_.scene.step, choice_.grow_after);
  setup.scene = crease_.scene;
  cloth = crease_.cloth;
}

// Loads the plate to find where it stops.
void CreaseCase::prepare() {
  if (!is_pressed()) return;
  plate_ = loaded_plate(flat_, choice_);
  fold_specimen();
}

// A pressed specimen lies on the ground; a soft fold swings freely, below its clamp as well.
render::Box CreaseCase::bounds() const {
  const float length = static_cast<float>(crease_.scene.cloth.length),
              width = static_cast<float>(crease_.scene.cloth.width);
  const bool on_ground = crease_.scene.obstacle.size() == 2;
  return {{-0.05f * length, 0, (on_ground ? 0 : -0.35f) * length},
          {length, width, (on_ground ? 0.65f : 0.85f) * length}};
}

RunPlan CreaseCase::plan(Session& session) {
  session.reserve({"profile.csv", "limbs.csv"}, {"plot_opening", "plot_protractor"});
  if (choice_.grow_after > 0) session.reserve({"recovery.csv"}, {"plot_recovery"});
  if (session.simulation().dimension() == 3 && has_strip_curve(crease_.scene))
    recovered_.law.emplace(crease_);
  RunPlan plan;
  plan.title = "Crease: " + setup.scene.fabric.name + ", law " + setup.scene.law;
  plan.bounds = bounds();
  plan.floor = plan.bounds.low.z();
  plan.time_steps = crease_.time_steps;
  plan.columns = {"opening [degree]", "plate_force [N]"};
  plan.watch = [this, &session](const Snapshot& m) {
    read_specimen(crease_, m, session.simulation(), recovered_);
  };
  plan.measure = [this](const Snapshot& m) -> std::vector<double> {
    return {crease_.opening(m.x), plate_is_on(crease_, m.time) ? crease_.plate_force(m.x, m.time) : 0};
  };
  plan.progress = [this](const Snapshot& m) {
    return fmt::format("t = {:.3f} s  opening {:.1f} degree", m.time, crease_.opening(m.x));
  };
  plan.serialise = [this](Archive& archive) { recovered_.serialise(archive); };
  return plan;
}

void CreaseCase::conclude(Session& session) {
  note_angles(session);
  const CreasedStrip strip =
      creased_strip(setup.scene.law, session.law_color(), crease_, session.simulation().positions());
  write_profile(session.run(), strip);
  if (session.pictures()) draw_plots(session, strip);
}

void CreaseCase::note_angles(Session& session) const {
  Run& run = session.run();
  run.metric("recovery_angle_deg", recovered_.opening);
  run.metric("law_recovery_angle_deg", recovered_.law ? recovered_.law->opening() : NAN);
  if (!recovered_.angle.empty()) run.metric("release_angle_deg", recovered_.angle.front());
  if (choice_.standard != CreaseStandard::none)
    run.metric("recovery_angle_15_s_deg", recovered_.angle_at(15));
  if (choice_.grow_after > 0) write_recovery(run, recovered_);
  run.metric("residual_curvature_per_m", largest_curvature(crease_.scene, session.simulation()));
  if (!is_pressed()) return;
  run.metric("plate_force_N", recovered_.force);
  run.metric("plate_height_m", plate_);
}

void CreaseCase::draw_plots(Session& session, const CreasedStrip& strip) const {
  const std::string& law = setup.scene.law;
  const std::string what = setup.scene.fabric.name + ", law " + law;
  session.plot("plot_protractor", protractor_plot("Angle between the limbs at the end, " + what, {strip}));
  draw(session.run(), opening_plot("Opening after release, " + what, choice_, crease_.times.end), law);
  if (choice_.grow_after > 0)
    draw(session.run(), recovery_plot("Recovery after release, " + what, choice_), law);
}

VariantPage variants_page(const CommandLine& line, std::vector<Variant>&) {
  C choice;
  const Setup setup = set_up_crease(line, choice);
  const bool pressed = choice.fold == CreaseFold::plate;
  const double end = pressed ? creased(setup.scene, choice, 2 * setup.scene.fabric.thickness).times.end : 0;
  return {"Crease recovery",
          setup,
          to_json(bind(kRows, choice)),
          {"recovery_angle_deg", "release_angle_deg", "law_recovery_angle_deg", "plate_force_N"},
          choice.grow_after > 0 ? std::vector{recovery_plot("", choice)}
                                : std::vector{opening_plot("", choice, end)}};
}

}  // namespace

Experiment crease() {
  return {.name = "crease",
          .question = "crease recovery (ISO 2313): fold, load, release",
          .case_of = case_of<CreaseCase>,
          .simulates = true,
          .own_keys = own_key_descriptions<kRows, page_keys>,
          .defaults = defaults,
          .page = variants_page,
          .fixed_keys = fixed_keys,
          .compared = true,
          .plot_columns = plot_protractor,
          .conditions = {{"crease.force", "crease.fold = plate"},
                         {"crease.lift", "crease.fold = plate and crease.release = slow"},
                         {"crease.radius", "crease.fold = rod"},
                         {"crease.pleat", "crease.fold = pleat"}},
          .headlines = {
              .all = {{"recovery_angle_deg", "recovery angle", "degree", "{:.1f}"},
                      {"release_angle_deg", "at once after release", "degree", "{:.1f}"},
                      {"recovery_angle_15_s_deg", "15 s after it", "degree", "{:.1f}"},
                      {"law_recovery_angle_deg", "that of the law alone", "degree", "{:.1f}", 1, kNoErrors},
                      {"residual_curvature_per_m", "residual curvature", "1/m", "{:.4g}"}},
              .own_mesh = true}};
}

}  // namespace hysteron::experiments
