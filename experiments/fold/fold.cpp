// Repeated folding (De Mattia flexing, ISO 7854): what is left of a fabric's bending friction after many
// folds, and what they leave in the cloth; with `--law all`, or several laws apart by commas, each on one
// page.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/fold/flexing_machine.h"
#include "experiments/fold/material.h"
#include "experiments/workbench/compare/law_page.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pages/simulated_run.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_parameters.h"

namespace hysteron::experiments {
namespace {

using C = FoldChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"fold.cycles", at<&C::cycles>, "", between(1, 10'000'000), "", "how often it is folded; default 100"},
    {"fold.period", at<&C::period>, "s", positive(), "", "of a cycle; default 1"},
    {"fold.stroke", at<&C::stroke>, "", between(0.05, 0.95), "", "of the moving clamp over the length between the clamps; default 0.4"},
    {"fold.fatigue", at<&C::fatigue>, "J/m^2", at_least(0), "", "fatigue.dc of laws that know it, unless --param gives one; 0: no fatigue; default 5"},
    {"fold.law-alone", at<&C::law_alone>, "", any(), "", "no cloth: the law alone, bent to fold.curvature and back"},
    {"fold.curvature", at<&C::curvature>, "1/m", positive(), "", "largest one of the law alone; default 150"},
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

struct Request {
  Setup setup;
  C choice;
  bool own_fatigue = false;  // fatigue.dc is given as a parameter of the law
  Json keys;
};

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
  give_fatigue(scene, request.choice);
  request.keys = to_json(own);
  return request;
}

std::string law_words(const Scene& scene) {
  return scene.law + (scene.param.contains("fatigue.dc") ? " with fatigue" : "");
}

std::string what(const Scene& scene) { return scene.fabric.name + ", law " + law_words(scene); }

render::Axis cycles_axis() { return {"cycles", true}; }
render::Axis friction_axis() { return {"2HB [mN]"}; }

// The last cycle as metrics and for the page; the first number, with its `unit`, stands in the caption.
LawOutcome note(Run& run, std::vector<std::pair<std::string, double>> numbers, const char* unit) {
  LawOutcome outcome;
  outcome.caption = fmt::format("{:.3g} {}", numbers[0].second, unit);
  for (const auto& [name, value] : numbers) run.metric(name, value);
  outcome.numbers = std::move(numbers);
  return outcome;
}

Question question_of(const Fold& fold, FlexingMachine& folding) {
  const float width = static_cast<float>(fold.scene.cloth.width), free = static_cast<float>(fold.free_length),
              grip = (static_cast<float>(fold.scene.cloth.length) - free) / 2;
  Question question;
  question.bounds = {{-grip, 0, -free}, {free + grip, width, grip / 2}};
  question.columns = FlexingMachine::columns();
  question.measure = [&](const Snapshot& m) { return folding.measure(m); };
  question.pictured = [&](const Snapshot&) { return folding.pictured(); };
  question.progress = [&](const Snapshot& m) { return folding.progress(m); };
  return question;
}

// One series for each of the page's plots.
std::vector<render::Series> series_of(Session& session, const FlexingMachine& folding) {
  const auto style = render::Series::Style::line_and_points;
  render::Series width = render::series_from_csv(session.run().path("material.csv"), "cycle", "2HB", "");
  for (double& newton : width.y) newton *= 1e3;
  width.style = style;
  return {{"", folding.cycle(), folding.recovery_angle(), style}, width};
}

// Of the figures over cycles, which both the cloth and the law alone have.
FigureCaption width_caption(const Scene& scene) {
  return {
      "plot_2HB.png", "2HB, " + what(scene),
      "Width of the material's moment-curvature loop over cycles on a logarithmic scale: what fatigue, or "
      "slip, leaves of the friction in bending."};
}

std::vector<FigureCaption> captions_of_cloth(const Scene& scene, const FoldChoice& choice) {
  const std::string name = what(scene), cycles = std::to_string(choice.cycles);
  return {
      {"plot_recovery.png", "Recovery angle over " + cycles + " folds, " + name,
       "A strip flexed between two clamps (De Mattia, ISO 7854): the angle between its limbs once it is let "
       "go after a cycle, 180 degrees if it comes back flat; cycles on a logarithmic scale."},
      width_caption(scene),
      {"plot_loop.png", "Loops of the crown, " + name,
       "Moment of the law against the curvature of the strip's most bent place in single cycles."}};
}

void plot(Session& session, const FlexingMachine& folding, const std::vector<render::Series>& series) {
  const std::string name = what(session.scene());
  session.plot("plot_recovery",
               {"Recovery angle, " + name, cycles_axis(), {"recovery angle [degree]"}, {series[0]}});
  session.plot("plot_2HB", {"2HB of the crown, " + name, cycles_axis(), friction_axis(), {series[1]}});
  session.plot("plot_loop",
               {"The crown, " + name, {"curvature [1/m]"}, {"moment of the law [mN]"}, folding.loops()});
}

LawOutcome fold_cloth(const CommandLine& line, Request& request) {
  const Fold fold = folded(request.setup.scene, request.choice, request.setup.options.fps);
  request.setup.scene = fold.scene;
  request.setup.options.fps = fold.fps;
  Session session(line, request.setup, fold.cloth);
  if (session.only_explain()) return {};
  Run& run = session.run();
  run.note("fold", request.keys["fold"]);
  if (!request.setup.options.no_images) run.path("README.md");
  FlexingMachine folding(fold, session);
  session.simulate(question_of(fold, folding));
  folding.finish();
  const FoldReading& last = folding.reading();
  LawOutcome outcome = note(run,
                            {{"recovery_angle_deg", last.recovery_angle},
                             {"2HB_N", last.material.loop_width},
                             {"set_curvature_per_m", last.set},
                             {"M0_N", last.material.friction},
                             {"sag_mm", last.sag},
                             {"permanent_set_per_m", last.material.permanent_set},
                             {"let_go_drop_mm", last.lowest}},
                            "deg");
  outcome.series = series_of(session, folding);
  if (session.pictures()) {
    outcome.picture =
        session.pictures()->picture("cloth", session.pictures()->camera(), what(fold.scene) + ", let go");
    plot(session, folding, outcome.series);
  }
  session.finish("Folded " + std::to_string(request.choice.cycles) + " times: " + what(fold.scene));
  if (session.pictures()) write_run_captions(run.folder(), captions_of_cloth(fold.scene, request.choice));
  return outcome;
}

render::Series over_cycles(const std::vector<BendingCycle>& all, double (*value)(const BendingCycle&)) {
  render::Series series{"", {}, {}, render::Series::Style::line_and_points};
  for (const BendingCycle& c : all) {
    series.x.push_back(c.cycle);
    series.y.push_back(value(c));
  }
  return series;
}

void write_cycles(Run& run, const std::vector<BendingCycle>& all) {
  Table table{{{"cycle", {}},
               {"M0 [N]", {}},
               {"2HB [N]", {}},
               {"set_curvature [1/m]", {}},
               {"permanent_set [1/m]", {}},
               {"dissipated [J/m^2]", {}},
               {"dissipated_in_all [J/m^2]", {}}},
              {}};
  for (const BendingCycle& c : all) {
    const double row[] = {static_cast<double>(c.cycle),
                          c.material.friction,
                          c.material.loop_width,
                          c.set,
                          c.material.permanent_set,
                          c.dissipated,
                          c.total};
    for (std::size_t i = 0; i < std::size(row); ++i) table.columns[i].values.push_back(row[i]);
  }
  write_csv(run.path("cycles.csv"), table);
}

render::Axis set_axis() { return {"curvature without moment [1/m]"}; }

LawOutcome fold_law(const CommandLine& line, const Request& request) {
  const Scene& scene = request.setup.scene;
  if (request.setup.options.explain) {
    std::cout << "the law alone: no cloth, nothing on a device\n";
    return {};
  }
  if (request.setup.options.errors)
    throw Error::request("--errors: fold.law-alone has neither a mesh nor a step; only the cloth has errors");
  Json keys = to_json(scene);
  keys.update(request.keys);
  Run run(line, request.setup.options, keys);
  const std::vector<BendingCycle> all = bend_repeatedly(scene, request.choice);
  write_cycles(run, all);
  const BendingCycle& last = all.back();
  LawOutcome outcome = note(run,
                            {{"2HB_N", last.material.loop_width},
                             {"set_curvature_per_m", last.set},
                             {"M0_N", last.material.friction},
                             {"permanent_set_per_m", last.material.permanent_set},
                             {"dissipated_J_per_m2", last.total}},
                            "N");
  outcome.series = {over_cycles(all, [](const BendingCycle& c) { return 1e3 * c.material.loop_width; }),
                    over_cycles(all, [](const BendingCycle& c) { return c.set; })};
  if (!request.setup.options.no_images) {
    const auto draw = [&](const char* name, const render::Plot& plot) {
      run.plot(name, [&](const std::filesystem::path& base) { render::write_plot(base, plot); });
    };
    draw("plot_2HB", {"2HB, " + what(scene), cycles_axis(), friction_axis(), {outcome.series[0]}});
    draw("plot_set", {"Residual curvature, " + what(scene), cycles_axis(), set_axis(), {outcome.series[1]}});
  }
  finish_with_report(run);
  return outcome;
}

LawOutcome fold_once(const CommandLine& line) {
  Request request = read(line);
  return request.choice.law_alone ? fold_law(line, request) : fold_cloth(line, request);
}

// Laws that know fatigue come twice: without it, and with it as NAME-fatigue.
std::vector<LawVariant> with_and_without_fatigue(const std::vector<LawVariant>& laws,
                                                 const std::string& usual) {
  std::vector<LawVariant> all;
  for (const LawVariant& law : laws) {
    const std::vector<std::string> known = law_parameter_names(last_text(law.flags, "law", usual));
    const bool tires = std::find(known.begin(), known.end(), "fatigue.dc") != known.end();
    LawVariant sound = law;
    if (tires) sound.flags.push_back({"fold.fatigue", "0"});
    all.push_back(sound);
    if (tires) all.push_back({law.name + "-fatigue", law.flags});
  }
  return all;
}

int fold_laws(const CommandLine& line, const std::vector<LawVariant>& laws) {
  const CommandLine first = without_lists(line);
  const Request request = read(first);
  const bool as_asked = request.own_fatigue || request.choice.fatigue == 0;
  LawPage page{page_title("Repeated folding", line, request.setup),
               as_asked ? laws : with_and_without_fatigue(laws, request.setup.scene.law),
               {},
               fold_once};
  const std::pair<std::string, render::Plot> width = {"plot_2HB",
                                                      {page.title, cycles_axis(), friction_axis()}};
  if (request.choice.law_alone)
    page.plots = {width, {"plot_set", {page.title, cycles_axis(), set_axis()}}};
  else
    page.plots = {{"plot_recovery", {page.title, cycles_axis(), {"recovery angle [degree]"}}}, width};
  return compare_laws(line, request.setup, request.keys, page);
}

int run_fold(const CommandLine& line) {
  const std::vector<LawVariant> laws = variants_of(line);
  if (laws.size() > 1) return fold_laws(line, laws);
  fold_once(line);
  return 0;
}

}  // namespace

Experiment fold() {
  return {.name = "fold",
          .question = "repeated folding (De Mattia): loops and fatigue",
          .run = run_fold,
          .simulates = true,
          .own_keys = own_keys_of<kRows>,
          .defaults = defaults};
}

}  // namespace hysteron::experiments
