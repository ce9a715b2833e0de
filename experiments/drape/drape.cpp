// `hysteron drape`: a disc of cloth, held on a smaller disc, hangs over its rim; the drape coefficient is the
// share of the free ring that its shadow still covers (Cusick 1968; BS 5058, ISO 9073-9; JIS L 1096).
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "experiments/drape/apparatus.h"
#include "experiments/drape/outline_plots.h"
#include "experiments/workbench/app/case.h"
#include "experiments/workbench/pages/closing_summary.h"
#include "experiments/workbench/session/session.h"
#include "render/caption.h"
#include "sim/base/error.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/mesh_files.h"
#include "sim/scene/shown_key.h"

namespace hysteron::experiments {
namespace {

using D = DrapeParams;
// clang-format off
const KeyRow<DrapeParams> kRows[] = {
    {"drape.standard", at<&D::standard>, "", any(), "sizes and release of a standard: a specimen of 30 cm on a disc of 18 cm, lowered; or of 25.4 cm on 12.7 cm, shaken three times and read after a minute; cloth.radius and other drape keys that are given win"},
    {"drape.release", at<&D::release>, "", any(), "how the overhanging ring is released: a plate below it sinks; all at once; the plate sinks, lifts it flat again and sinks a second time; or it sinks, and pedestal and disc shake the specimen"},
    {"drape.folds", at<&D::folds>, "", between(0, 100), "dropped: so many waves, 2 mm high, raise the ring at the start and become its folds, the same under every method; 0: folds form by themselves"},
    {"drape.disc", at<&D::disc>, "m", positive(), "radius of the pedestal"},
    {"drape.lowering", at<&D::lowering>, "s", positive(), "time in which the plate sinks"},
    {"drape.pause", at<&D::pause>, "s", at_least(0), "relifted: how long the ring hangs at rest before the plate lifts it; its outline then is the first of two"},
    {"drape.shakes", at<&D::shakes>, "", between(1, 100), "shaken: how often it goes up and down"},
    {"drape.stroke", at<&D::stroke>, "m", positive(), "shaken: how far up"},
    {"drape.period", at<&D::period>, "s", positive(), "shaken: time of one up and down"},
    {"drape.wait", at<&D::wait>, "s", at_least(0), "time at rest until the shadow is read, in which laws relax that do"},
    {"drape.offset", at<&D::offset>, "m", at_least(0), "of the specimen's middle from the pedestal's axis, less than drape.disc and than the width of the ring"},
    {"drape.curl", at<&D::curl>, "1/m", between(-20, 20), "curvature along warp with which the specimen is at rest, positive where its rim stands up"},
    {"drape.uneven", at<&D::uneven>, "", between(0, 0.5), "standard deviation over the mean of a rigidity in bending that varies along the cloth, drawn by the seed"},
    {"drape.uneven-length", at<&D::uneven_length>, "m", between(1e-3, 1), "over which that rigidity stays alike"},
    {"drape.still", at<&D::still>, "m/s", positive(), "the motion ends when no vertex moves faster from one look at it to the next, thirty a second; then the equilibrium nearby is sought"},
};
// clang-format on

constexpr int kDirections = 3600;     // number of rays of the outline
constexpr double kProminence = 2e-3;  // least height of a fold in the outline [m]
constexpr int kShadowPixels = 1000;
constexpr double kFreeMotion = 0.6;  // least time before the specimen counts as settled [s]
// Lowering time of the plate with --quick [s].  A ring that follows it within 0.6 s folds 1.1 % of the edges
// of 1,000 triangles too sharply for them, within 1 s half as many; after other releases the cloth moves
// faster anyway.
constexpr double kQuickLowering = 0.6, kGentleQuickLowering = 1;

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  // This integrator has the least numerical damping (docs/integrators.md).
  scene.integrator = Integrator::tr_bdf2;
  scene.step = 1.0 / 120;
  scene.cloth.shape = ClothOutline::disc;
  scene.cloth.radius = 0.15;
  scene.triangles = 6000;
  scene.seconds = 3.4;  // time after the plate's
  // The drape is a shape at rest: air would only affect the way to it, and linear drag fits a single speed.
  scene.air_drag = 0;
  // The coefficient is the same to 0.001 % as with 1e-6 and 1e-9 m/s; the step changes it a hundred times
  // more.
  scene.newton_residual = 1e-3;
  scene.newton_velocity = 1e-5;
  // With ten times this tolerance, numerical damping doubles; with a third, the coefficient stays within 0.05
  // points.
  scene.tolerance = 1e-5;
  setup.options.camera_direction = {0.3, -1.0, 0.5};
  setup.options.camera_fov = 24;
  return setup;
}

std::vector<FixedKey> fixed_keys() {
  return {{"cloth.position", "the specimen lies in the middle of the pedestal"}};
}

// Disables the tolerance for other integrators: less accurate ones would need tiny steps to keep it.
void keep_the_step(Scene& scene) {
  if (scene.integrator != Integrator::tr_bdf2 && !is_given(scene, "tolerance")) scene.tolerance = 0;
}

// Throws unless the disc is smaller than the specimen, which otherwise has no free ring.
void check_disc(const Scene& scene, const DrapeParams& choice, const Specimen& specimen) {
  if (choice.disc < specimen.radius) return;
  const std::string file = rest_file(scene);
  const std::string of = file.empty() ? "cloth.radius = " + number_text(specimen.radius) + " m"
                                      : fmt::format("{:.4g} m, the radius of mesh {}", specimen.radius, file);
  throw Error::invalid_input("drape.disc = " + number_text(choice.disc) + " m must be < " + of)
      .with_key("drape.disc", number_text(choice.disc));
}

// Throws unless the specimen's middle lies on the pedestal and its rim hangs over all around: otherwise it
// slips off, or parts of the ring are missing.
void check_offset(const DrapeParams& choice, const Specimen& specimen) {
  const double ring = specimen.radius - choice.disc;
  if (choice.offset < std::min(choice.disc, ring)) return;
  const std::string why = choice.disc <= ring
                              ? "drape.disc: the specimen's middle would lie beside the pedestal"
                              : "the width of its ring: the pedestal would stand out from under the specimen";
  throw Error::invalid_input("drape.offset = " + number_text(choice.offset) + " m must be < " +
                             number_text(std::min(choice.disc, ring), 4) + " m, " + why)
      .with_key("drape.offset", number_text(choice.offset));
}

// Lays the specimen on the pedestal, in the scene and in the cloth.
Specimen lay_on_pedestal(Scene& scene, const DrapeParams& choice, Cloth& cloth) {
  const Specimen specimen = disc_specimen(scene, cloth);
  check_disc(scene, choice, specimen);
  check_offset(choice, specimen);
  const Eigen::Vector3d before = scene.cloth.position;
  add_apparatus(scene, choice, specimen);
  for (Eigen::Vector3d& x : cloth.start) x += scene.cloth.position - before;
  seed_folds(cloth.start, choice, specimen.radius);
  return specimen;
}

// Throws if the number is beyond what a shadow can cover: the specimen has then slipped off or burst.
void check_coefficient(double percent) {
  if (is_drape_coefficient(percent)) return;
  throw Error::simulation(
      fmt::format("the shadow covers {:.4g} % of the ring, which must be 0 to 101: the specimen has left "
                  "the pedestal or was torn apart by its motion (a shorter step may keep it together)",
                  percent));
}

// Draws the cloth's shadow from above with the rims of the pedestal and of the flat specimen, and returns the
// drape coefficient of its dark area [%].
double shadow_coefficient(Session& session, const DrapeParams& choice, double radius) {
  double metres = 0;
  render::Image shadow = session.pictures()->silhouette(1.08 * radius, kShadowPixels, metres);
  const double found = drape_coefficient(render::covered_area(shadow, metres), choice.disc, radius);
  const std::string rest_warning = not_at_rest_warning(session.run().metrics());
  const std::string text =
      fmt::format("{}, law {}\nshadow from above: drape coefficient {:.1f} %{}", session.scene().fabric.name,
                  session.scene().law, found, rest_warning.empty() ? "" : "\n" + rest_warning);
  render::draw_caption(shadow, text, render::Corner::top_left);
  render::draw_scale_bar(shadow, metres, render::Corner::bottom_left);
  session.pictures()->write(session.run().path("shadow.png"), std::move(shadow));
  return found;
}

// Testers stand upright on earth.
bool has_usual_gravity(const Scene& scene) {
  constexpr double kNear = 0.05;  // [m/s^2]; gravity on earth deviates less from 9.81
  return (scene.gravity - Eigen::Vector3d(0, 0, -9.81)).norm() <= kNear;
}

// Returns "--fabric.b2, --fabric.k0" if flags have changed the measured fabric; "" otherwise.
std::string changed_numbers(const Scene& scene) {
  std::vector<std::string> flags;
  for (const auto& [key, origin] : scene.origin)
    if (key.starts_with("fabric.") && key != "fabric.name" && origin.starts_with("--fabric."))
      flags.push_back(origin);
  return join(flags, ", ");
}

// Returns why the published drape is of another test than this one, and of which; "" if it is comparable.
std::string other_drape_message(const Scene& scene, const DrapeParams& choice, double radius) {
  const std::string tester = other_tester_message(scene.fabric, choice, radius);
  const auto& published = scene.fabric.published;
  if (!tester.empty() || (!published.contains("drape-coefficient") && !published.contains("node-count")))
    return tester;
  if (!has_usual_gravity(scene)) return "is of a tester that stands upright on earth: without --gravity";
  const std::string changed = changed_numbers(scene);
  return changed.empty() ? "" : "is of " + scene.fabric.name + " without " + changed;
}

bool is_of_this_tester(const PublishedNumber& number, const Scene& scene, const DrapeParams& choice,
                       double radius) {
  return is_own_tester(number, choice, radius) && has_usual_gravity(scene);
}

void plot_series(Session& session, const DrapeParams& choice, double radius) {
  const auto csv = session.run().path("metrics.csv");
  render::Plot drape{
      "Drape coefficient, " + session.scene().fabric.name, {"time [s]"}, {"drape coefficient [%]"}};
  drape.series = {render::series_from_csv(csv, "time", "drape_coefficient", "simulated")};
  drape.series[0].color = session.law_color();
  const auto published = session.scene().fabric.published.find("drape-coefficient");
  if (published != session.scene().fabric.published.end() &&
      is_of_this_tester(published->second, session.scene(), choice, radius)) {
    const double value = published->second.value;
    drape.series.push_back({"measured, " + published->second.provenance.source,
                            {0, drape.series[0].x.back()},
                            {value, value},
                            render::Series::Style::dashed});
  }
  session.plot("plot_drape", drape);
  render::Plot energy{"Where the energy went", {"time [s]"}, {"energy [J]"}};
  for (const char* term :
       {"kinetic", "bending", "bending_friction", "contact_friction", "air", "viscous", "integrator_inertia"})
    energy.series.push_back(render::series_from_csv(csv, "time", term, term));
  session.plot("plot_energy", energy);
}

void draw_maps(Session& session) {
  Pictures& pictures = *session.pictures();
  const std::string what = session.scene().fabric.name + ", law " + session.scene().law;
  for (const char* look : {"curvature", "friction"})
    pictures.picture_file(session.run().path(std::string(look) + ".png"), look, what);
}

void limit_to_quick(Setup& setup) {
  setup.scene.triangles = std::min(setup.scene.triangles, 1000);
  setup.scene.seconds = std::min(setup.scene.seconds, 0.4);
  setup.options.fps = std::min(setup.options.fps, 10.0);
}

// Sets up the run; a standard replaces the defaults of the other keys.
Setup set_up_drape(const CommandLine& line, D& choice) {
  const auto with = [&](const D& of, const CommandLine& line) {
    Setup default_setup = defaults();
    default_setup.scene.cloth.radius = specimen_radius(of.standard);
    choice = of;
    return set_up(line, std::move(default_setup), bind(kRows, choice), [&](Setup& setup) {
      limit_to_quick(setup);
      choice.lowering = std::min(
          choice.lowering, choice.release == DrapeRelease::lowered ? kGentleQuickLowering : kQuickLowering);
    });
  };
  CommandLine undecided = line;
  undecided.listed.push_back("drape.release");  // the standard may set it
  with({}, undecided);
  return with(drape_by_standard(choice.standard), line);
}

// Records numbers published for this tester, or names the tester they are of.
void note_published(Run& run, const Scene& scene, const DrapeParams& choice, double radius) {
  for (const auto& [name, number] : scene.fabric.published) {
    if (!is_of_this_tester(number, scene, choice, radius)) continue;
    if (name == "drape-coefficient") run.metric("published_drape_coefficient_percent", number.value);
    if (name == "node-count") run.metric("published_node_count", number.value);
  }
  const std::string message = other_drape_message(scene, choice, radius);
  if (!message.empty()) run.metric("published_drape", message);
}

// The readings of the specimen as time goes on.
struct Draping {
  double covered = 0;                  // the coefficient when it was watched last [%]
  double change = 0;                   // of it since the time before [%]
  std::vector<double> first_radius{};  // of the outline before the ring is lifted again [m]; empty: it is not

  std::optional<Outline> first() const {
    return first_radius.empty() ? std::nullopt : std::optional(Outline{first_radius});
  }
};

class DrapeCase : public Case {
 public:
  explicit DrapeCase(const CommandLine& line);
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  void begin(Session& session) const;
  void note_coefficient(Run& run, const DrapeOutlines& outlines, bool settled) const;
  void draw(Session& session, const DrapeOutlines& outlines) const;

  DrapeParams choice_;
  std::string tilt_;   // warns of a specimen that does not lie level; "" if it does
  double radius_ = 0;  // of the specimen [m]
  Draping draping_;
};

DrapeCase::DrapeCase(const CommandLine& line) {
  setup = set_up_drape(line, choice_);
  Scene& scene = setup.scene;
  keep_the_step(scene);
  if (!is_given(scene, "seconds")) scene.seconds += choice_.released();
  tilt_ = tilt_warning(scene);
  cloth = make_cloth(scene);
  radius_ = lay_on_pedestal(scene, choice_, *cloth).radius;
  make_uneven(cloth->mesh, choice_, static_cast<unsigned>(scene.seed));
}

void DrapeCase::begin(Session& session) const {
  Run& run = session.run();
  if (!tilt_.empty()) run.warn(tilt_);
  if (const double released = choice_.released(); setup.scene.seconds < released)
    run.warn(shown(setup.scene, "seconds", setup.scene.seconds, "s") +
             " ends before the specimen is released, after " + number_text(released, 4) +
             " s: what is read is not its drape");
  session.reserve({"outline.csv"}, {"shadow.png", "curvature.png", "friction.png", "plot_outline",
                                    "plot_drape", "plot_energy"});
  DrapeParams choice = choice_;
  run.note("drape", to_json(bind(kRows, choice))["drape"]);
  run.note("specimen_radius_m", radius_);
}

RunPlan DrapeCase::plan(Session& session) {
  begin(session);
  const float r = static_cast<float>(radius_);
  RunPlan plan;
  plan.title = "Drape: " + setup.scene.fabric.name + ", law " + setup.scene.law;
  plan.bounds = {{-r, -r, -0.6f * r}, {r, r, 0.02f}};
  plan.floor = -static_cast<float>(kPedestalHeight);
  plan.columns = {"drape_coefficient [%]", "node_count"};
  const auto outline_at = [&session](const Snapshot& m) {
    return outline_from_above(session.cloth().mesh, m.x, kDirections);
  };
  plan.watch = [this, outline_at](const Snapshot& m) {
    const double percent = drape_coefficient(outline_at(m).area(), choice_.disc, radius_);
    draping_.change = percent - draping_.covered;
    draping_.covered = percent;
  };
  plan.measure = [this, outline_at](const Snapshot& m) -> std::vector<double> {
    const Outline outline = outline_at(m);
    return {drape_coefficient(outline.area(), choice_.disc, radius_),
            static_cast<double>(outline.nodes(kProminence))};
  };
  if (choice_.is_relifted())
    plan.instants = {{choice_.first_rest(), [this, outline_at](const Snapshot& m) {
                        draping_.first_radius = outline_at(m).radius;
                      }}};
  plan.settled = [this](const Snapshot& m) {
    return m.time > choice_.released() + kFreeMotion && m.fastest < choice_.still;
  };
  plan.to_rest = true;
  plan.wait = choice_.wait;
  plan.progress = [this](const Snapshot& m) {
    return fmt::format("t = {:.3f} s  drape coefficient {:.1f} %  fastest {:.4f} m/s", m.time,
                       draping_.covered, m.fastest);
  };
  plan.serialise = [this](Archive& archive) {
    archive(draping_.covered);
    archive(draping_.first_radius);
  };
  return plan;
}

void DrapeCase::conclude(Session& session) {
  const DrapeOutlines outlines{
      outline_from_above(session.cloth().mesh, session.simulation().positions(), kDirections),
      draping_.first()};
  Run& run = session.run();
  note_coefficient(run, outlines, session.is_settled());
  write_outlines(run, outlines);
  note_published(run, setup.scene, choice_, radius_);
  if (session.pictures()) draw(session, outlines);
}

void DrapeCase::note_coefficient(Run& run, const DrapeOutlines& outlines, bool settled) const {
  const Outline& outline = outlines.last;
  const double percent = drape_coefficient(outline.area(), choice_.disc, radius_);
  check_coefficient(percent);
  run.metric("drape_coefficient_percent", percent);
  run.metric("node_count", outline.nodes(kProminence));
  run.metric("settled", settled);
  run.metric("settling_limit_m_per_s", choice_.still);
  // Bringing the cloth to rest has moved it by this, the most that its last motion could still have changed.
  if (setup.scene.is_implicit()) run.metric("rest_shift_percent", draping_.change);
  if (outlines.first) run.metric("outline_overlap", overlap(*outlines.first, outline));
}

void DrapeCase::draw(Session& session, const DrapeOutlines& outlines) const {
  plot_outlines(session, choice_, radius_, outlines);
  plot_series(session, choice_, radius_);
  const double shadow = shadow_coefficient(session, choice_, radius_);
  // A shadow may leave the possible range by less than its pixels; the metric is then null.
  session.run().metric("shadow_drape_coefficient_percent",
                       is_drape_coefficient(shadow) ? MetricValue(shadow) : MetricValue());
  draw_maps(session);
  session.pictures()->also_from({0, -0.02f, 1}, "from above, at the end");
}

}  // namespace

Experiment drape() {
  return {.name = "drape",
          .question = "Cusick's drape test: a disc of cloth over a pedestal",
          .case_of = case_of<DrapeCase>,
          .simulates = true,
          .own_keys = own_key_descriptions<kRows>,
          .defaults = defaults,
          .fixed_keys = fixed_keys,
          .compared = true,
          .plot_columns = plot_histories,
          .conditions = {{"drape.folds", "drape.release = dropped"},
                         {"drape.uneven-length", "drape.uneven > 0"},
                         {"drape.pause", "drape.release = relifted"},
                         {"drape.lowering", "drape.release != dropped"},
                         {"drape.shakes | drape.stroke | drape.period", "drape.release = shaken"}},
          .headlines = {.all = {{"drape_coefficient_percent", "drape coefficient", "%", "{:.1f}"},
                                {"published_drape_coefficient_percent", "published coefficient", "%",
                                 "{:.1f}", 1, kNoErrors},
                                {"node_count", "folds", "", "{:.0f}"},
                                {"published_node_count", "published folds", "", "{:.0f}", 1, kNoErrors},
                                {"outline_overlap", "of both outlines are the same", "%", "{:.1f}", 100},
                                {"published_drape", "the published drape", "", "", 1, kNoErrors}},
                        .release = "drape.release",
                        .paths = {"lowered", "dropped"}}};
}

}  // namespace hysteron::experiments
