// `hysteron fold` measures what repeated folding (De Mattia flexing, ISO 7854) leaves of a fabric's bending
// friction, and which set it leaves in the cloth.  With `--law all`, or several laws separated by commas, it
// compares them on one page.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/fold/flexing_machine.h"
#include "experiments/fold/material.h"
#include "experiments/specimens/clamped_mesh.h"
#include "experiments/workbench/app/case.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/session/probes.h"
#include "experiments/workbench/session/variant_page.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/unused_parameters.h"

namespace hysteron::experiments {
namespace {

using C = FoldParams;
// clang-format off
const KeyRow<C> kRows[] = {
    {"fold.cycles", at<&C::cycles>, "", between(1, 10'000'000), "number of folds; default 100"},
    {"fold.period", at<&C::period>, "s", positive(), "duration of a cycle; default 1"},
    {"fold.stroke", at<&C::stroke>, "", between(0.05, 0.95), "stroke of the moving clamp over the length between the clamps; default 0.4"},
    {"fold.fatigue", at<&C::fatigue>, "J/m^2", at_least(0), "fatigue.dc of laws that know it, unless --param gives one; 0: no fatigue; default 5"},
    {"fold.law-alone", at<&C::law_alone>, "", any(), "no cloth: the law alone, bent to fold.curvature and back"},
    {"fold.curvature", at<&C::curvature>, "1/m", positive(), "largest curvature of the law alone; default 150"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = Integrator::implicit;
  scene.step = 1.0 / 80;
  scene.cloth.length = 0.06;
  scene.cloth.width = 0.03;
  scene.mesh = "unionjack";
  scene.triangles = 5000;
  scene.newton_velocity = 1e-4;
  setup.options.fps = 40;
  setup.options.check_intersections = true;
  setup.options.camera_direction = {0.3, -1.0, 0.22};
  setup.options.camera_fov = 22;
  return setup;
}

std::vector<FixedKey> fixed_keys() {
  std::vector<FixedKey> keys = decided_by_clamped_strips();
  keys.insert(keys.end(),
              {{"cloth.position", "the clamps lie along x from the origin"},
               {"cloth.rotation", "the clamps lie along x, one over against the other"},
               {"seconds", "fold.cycles of fold.period and the time after them say how long it takes"},
               {"phase", "cycles are its phases"},
               {"obstacle", "the clamps are its obstacles"}});
  return keys;
}

bool tires(const std::string& law) {
  const std::vector<std::string> known = law_parameter_names(law);
  return std::find(known.begin(), known.end(), "fatigue.dc") != known.end();
}

struct Request {
  Setup setup;
  C choice;
  bool own_fatigue = false;  // fatigue.dc is given as a parameter of the law
  Json keys;
};

// Throws if a dissipation is requested for a law without fatigue.
void check_fatigue(const CommandLine& line, const Request& request) {
  const std::string given = last_text(line.flags, "fold.fatigue", "");
  if (given.empty() || request.choice.fatigue == 0) return;
  const std::string& law = request.setup.scene.law;
  const bool listed = std::count(line.listed.begin(), line.listed.end(), "law") > 0;
  std::string why;
  if (request.own_fatigue) why = "fatigue.dc is a parameter of the law already (--param)";
  if (!listed && !tires(law)) why = "law " + law + " knows no fatigue";
  if (!why.empty())
    throw Error::invalid_input("--fold.fatigue " + given + " is not used: " + why)
        .with_key("fold.fatigue", given);
}

Request read(const CommandLine& line) {
  Request request;
  const Keys own = bind(kRows, request.choice);
  request.setup = set_up(line, defaults(), own, [&](Setup& setup) {
    if (request.choice.law_alone) return;
    setup.scene.triangles = std::min(setup.scene.triangles, 400);
    request.choice.cycles = std::min(request.choice.cycles, 10);
  });
  Scene& scene = request.setup.scene;
  request.own_fatigue = scene.param.contains("fatigue.dc");
  check_fatigue(line, request);
  give_fatigue(scene, request.choice);
  request.keys = to_json(own);
  return request;
}

std::string law_text(const Scene& scene) {
  return scene.law + (scene.param.contains("fatigue.dc") ? " with fatigue" : "");
}

std::string what(const Scene& scene) { return scene.fabric.name + ", law " + law_text(scene); }

using Numbers = std::vector<std::pair<std::string, double>>;

// Returns the readings of the last cycle as metrics; a page shows the first.
Numbers cycle_numbers(const FoldReading& last) {
  return {{"recovery_angle_deg", last.recovery_angle},
          {"2HB_N", last.material.loop_width},
          {"set_curvature_per_m", last.set},
          {"M0_N", last.material.friction},
          {"sag_mm", last.sag},
          {"permanent_set_per_m", last.material.permanent_set},
          {"let_go_drop_mm", last.lowest}};
}

Numbers cycle_numbers(const BendingCycle& last) {
  return {{"2HB_N", last.material.loop_width},
          {"set_curvature_per_m", last.set},
          {"M0_N", last.material.friction},
          {"permanent_set_per_m", last.material.permanent_set},
          {"dissipated_J_per_m2", last.total}};
}

void note(Run& run, const Numbers& numbers) {
  for (const auto& [name, value] : numbers) run.metric(name, value);
}

TablePlot over_cycles(const std::string& name, const render::Plot& plot, const std::string& file,
                      const std::string& y, double scale = 1) {
  return {name, plot, file, "cycle", y, render::Series::Style::line_and_points, scale};
}

// Returns the plots over cycles, of a fabric and law.
std::vector<TablePlot> fold_plots(bool law_alone, const std::string& name) {
  const render::Axis cycles{"cycles", true};
  const render::Plot width{(law_alone ? "2HB, " : "2HB of the crown, ") + name, cycles, {"2HB [mN]"}};
  if (law_alone)
    return {
        over_cycles("plot_2HB", width, "cycles.csv", "2HB", 1e3),
        over_cycles("plot_set", {"Residual curvature, " + name, cycles, {"curvature without moment [1/m]"}},
                    "cycles.csv", "set_curvature")};
  return {over_cycles("plot_recovery", {"Recovery angle, " + name, cycles, {"recovery angle [degree]"}},
                      "cycles.csv", "recovery_angle"),
          over_cycles("plot_2HB", width, "material.csv", "2HB", 1e3)};
}

void plot(Session& session, const FlexingMachine& folding) {
  const std::string name = what(session.scene());
  for (const TablePlot& plot : fold_plots(false, name)) draw(session.run(), plot, session.scene().law);
  session.plot("plot_loop",
               {"The crown, " + name, {"curvature [1/m]"}, {"moment of the law [mN]"}, folding.loops()});
}

class FoldCase : public Case {
 public:
  explicit FoldCase(Request request);
  RunPlan plan(Session& session) override;
  void conclude(Session& session) override;

 private:
  C choice_;
  Json keys_;  // the experiment's own
  Fold fold_;
  std::optional<FlexingMachine> machine_;
};

FoldCase::FoldCase(Request request) : choice_(request.choice), keys_(std::move(request.keys)) {
  setup = std::move(request.setup);
  fold_ = folded(setup.scene, choice_, defaults().options.fps);
  setup.scene = fold_.scene;
  cloth = fold_.cloth;
  setup.options.fps = stroke_rate(setup.options.fps, choice_.period);
  probe_unless_told(setup.options, {fold_.scene.cloth.length / 2, fold_.scene.cloth.width / 2});
}

RunPlan FoldCase::plan(Session& session) {
  session.run().note("fold", keys_["fold"]);
  session.reserve({}, {"plot_recovery", "plot_2HB", "plot_loop"});
  FlexingMachine& machine = machine_.emplace(fold_, session);
  const float width = static_cast<float>(fold_.scene.cloth.width),
              free = static_cast<float>(fold_.free_length),
              clamp_length = (static_cast<float>(fold_.scene.cloth.length) - free) / 2;
  RunPlan plan;
  plan.title = "Folded " + std::to_string(choice_.cycles) + " times: " + what(fold_.scene);
  plan.bounds = {{-clamp_length, 0, -free}, {free + clamp_length, width, clamp_length / 2}};
  plan.columns = FlexingMachine::columns();
  plan.watch = [&](const Snapshot& m) { machine.watch(m); };
  plan.watch_rate = fold_.rate;
  plan.measure = [&](const Snapshot& m) { return machine.measure(m); };
  plan.pictured = [&](const Snapshot& m) { return machine.pictured(m.time); };
  plan.progress = [&](const Snapshot& m) { return machine.progress(m); };
  plan.serialise = [&](Archive& archive) { machine.serialise(archive); };
  return plan;
}

void FoldCase::conclude(Session& session) {
  machine_->finish();
  note(session.run(), cycle_numbers(machine_->reading()));
  if (session.pictures()) plot(session, *machine_);
}

void write_cycles(Run& run, const std::vector<BendingCycle>& all) {
  TimeSeriesWriter file(run.path("cycles.csv"),
                        {"cycle", "M0 [N]", "2HB [N]", "set_curvature [1/m]", "permanent_set [1/m]",
                         "dissipated [J/m^2]", "dissipated_in_all [J/m^2]"});
  for (const BendingCycle& c : all)
    file.row({static_cast<double>(c.cycle), c.material.friction, c.material.loop_width, c.set,
              c.material.permanent_set, c.dissipated, c.total});
  file.finish();
}

// Throws for options that only the cloth has.
void refuse_options_of_cloth(const Options& options) {
  if (options.errors)
    throw Error::invalid_input(
        "--errors: fold.law-alone has neither a mesh nor a step; only the cloth has errors")
        .with_key("errors", "true");
  if (!options.probe.empty())
    throw Error::invalid_input("--probe: fold.law-alone has no cloth").with_key("probe", options.probe);
  if (options.checkpoint > 0 || options.resume)
    throw Error::invalid_input(
        "--checkpoint and --resume: fold.law-alone takes no checkpoints; only the cloth does");
}

std::unique_ptr<Case> cloth_case(const CommandLine& line) {
  Request request = read(line);
  if (!request.choice.law_alone) return std::make_unique<FoldCase>(std::move(request));
  if (!request.setup.options.explain) refuse_options_of_cloth(request.setup.options);
  return nullptr;
}

int fold_law(const CommandLine& line) {
  const Request request = read(line);
  const Scene& scene = request.setup.scene;
  if (request.setup.options.explain) {
    std::cout << "the law alone: no cloth, nothing on a device\n";
    return 0;
  }
  Json keys = to_json(scene);
  keys.update(request.keys);
  Run run(line, request.setup.options, keys);
  for (const std::string& warning : unused_parameter_warnings(scene.law, scene.fabric.virgin_curve(),
                                                              scene.param, LawUse::alone, scene.fabric.name))
    run.warn(warning);
  if (request.choice.curvature * scene.fabric.thickness > 2)
    run.warn("fold.curvature = " + number_text(request.choice.curvature) + " 1/m bends to a radius of " +
             number_text(1000 / request.choice.curvature, 2) +
             " mm, less than half of the fabric's thickness: cloth cannot be bent so far");
  const std::vector<BendingCycle> all = bend_repeatedly(scene, request.choice);
  write_cycles(run, all);
  note(run, cycle_numbers(all.back()));
  if (!request.setup.options.no_images)
    for (const TablePlot& plot : fold_plots(true, what(scene))) draw(run, plot, scene.law);
  finish_with_report(run);
  return 0;
}

// Lists laws with fatigue twice: without it, and with it as NAME-fatigue.  If the line has a flag for it
// (`has_flag`), the others get a flag that disables it.
std::vector<Variant> with_and_without_fatigue(const std::vector<Variant>& laws,
                                              const std::string& default_law, bool has_flag) {
  std::vector<Variant> all;
  for (const Variant& law : laws) {
    const bool twice = tires(last_text(law.flags, "law", default_law));
    Variant sound = law;
    if (twice || has_flag) sound.flags.push_back({"fold.fatigue", 0});
    all.push_back(sound);
    if (twice) all.push_back({law.name + "-fatigue", law.flags});
  }
  return all;
}

VariantPage variants_page(const CommandLine& line, std::vector<Variant>& variants) {
  const Request request = read(line);
  const bool alone = request.choice.law_alone;
  if (!request.own_fatigue && request.choice.fatigue != 0)
    variants = with_and_without_fatigue(variants, request.setup.scene.law,
                                        !last_text(line.flags, "fold.fatigue", "").empty());
  VariantPage page{"Repeated folding", request.setup, request.keys, {}, fold_plots(alone, "")};
  for (const auto& [name, value] : alone ? cycle_numbers(BendingCycle{}) : cycle_numbers(FoldReading{}))
    page.metrics.push_back(name);
  return page;
}

}  // namespace

Experiment fold() {
  return {.name = "fold",
          .question = "repeated folding (De Mattia): loops and fatigue",
          .run = fold_law,
          .case_of = cloth_case,
          .simulates = true,
          .own_keys = own_key_descriptions<kRows, page_keys>,
          .defaults = defaults,
          .page = variants_page,
          .fixed_keys = fixed_keys,
          .compared = true,
          .conditions =
              {{"fold.curvature", "fold.law-alone"},
               {"fold.period", "not fold.law-alone or law = all | chapman | gong | kim | terzopoulos",
                "cloth, or a law that takes time: --law chapman, gong, kim or terzopoulos"},
               {"fold.stroke | cloth. | mesh | triangles | element | membrane. | force | integrator | "
                "step | substeps | implicit-every | solver-tolerance | newton- | tolerance | linear- | "
                "gravity | air-drag | self-contact | contact-stiffness | fps | export | errors. | dump-scene",
                "not fold.law-alone"},
               {"seed", "mesh = random and not fold.law-alone"}},
          .headlines = {.all = {{"recovery_angle_deg", "recovery angle", "degree", "{:.1f}"},
                                {"2HB_N", "2HB", "mN", "{:.4g}", 1e3},
                                {"set_curvature_per_m", "set", "1/m", "{:.4g}"}}}};
}

}  // namespace hysteron::experiments
