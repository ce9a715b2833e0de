// Crease recovery (ISO 2313, AATCC 66): a specimen is folded, loaded, let go, and opens again; with
// `--law all`, or several laws apart by commas, each of them, on one page.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "experiments/comma_list.h"
#include "experiments/creased.h"
#include "experiments/csv.h"
#include "experiments/report.h"
#include "experiments/session.h"
#include "sim/atomic_file.h"
#include "sim/bending/law_parameters.h"
#include "sim/error.h"

namespace hysteron::experiments {
namespace {

using C = CreaseChoice;
// clang-format off
const KeyRow<C> kRows[] = {
    {"crease.force", at<&C::force>, "N", positive(), "", "of the plate"},
    {"crease.hold", at<&C::hold>, "s", positive(), "", "time under the whole load"},
    {"crease.recovery", at<&C::recovery>, "s", positive(), "", "time to recover"},
};
// clang-format on

Setup defaults() {
  Setup setup;
  Scene& scene = setup.scene = default_scene();
  scene.integrator = "implicit";
  scene.step = 1.0 / 240;
  scene.self_contact = true;
  scene.cloth.length = 0.04;
  scene.cloth.width = 0.015;
  scene.triangles = 1600;
  scene.gravity.setZero();
  scene.air_drag = 1;
  scene.newton_velocity = 1e-6;
  scene.contact_stiffness = 1e9;  // plates: 10 N sink 7 % of a thickness into them
  setup.options.fps = 30;
  setup.options.camera_direction = {0.25, -1.0, 0.2};
  setup.options.camera_fov = 22;
  return setup;
}

// What came of one law.
struct Recovered {
  std::string law;
  std::vector<double> time, opening;  // [s], [degree]
  double force = 0;                   // of the plate before it goes [N]
  double of_law = NAN;                // opening that the law alone would leave [degree]
  std::optional<render::Image> picture{};
  std::string failed{};
};

// Largest curvature along the strip that each triangle has had [1/m].
void keep_largest(Simulation& simulation, std::vector<double>& largest) {
  const int d = simulation.dimension();
  const std::vector<double> curvature = simulation.curvature();
  largest.resize(curvature.size() / d);
  for (std::size_t e = 0; e < largest.size(); ++e) largest[e] = std::max(largest[e], curvature[d * e]);
}

Question question_of(Session& session, const Crease& crease, std::vector<double>& largest,
                     Recovered& recovered) {
  Question question;
  const float length = static_cast<float>(crease.scene.cloth.length),
              width = static_cast<float>(crease.scene.cloth.width);
  question.bounds = {{-0.05f * length, 0, 0}, {length, width, 0.5f * length}};
  question.floor = 0.0f;
  question.columns = {"opening [degree]", "plate_force [N]"};
  question.measure = [&](const Moment& m) -> std::vector<double> {
    const bool plate =
        m.time > crease.times.folded && m.time <= crease.times.released + crease.scene.step / 2;
    const double force = plate ? crease.plate_force(m.x, m.time) : 0;
    if (plate) recovered.force = force;
    if (m.time <= crease.times.released + crease.scene.step / 2) keep_largest(session.simulation(), largest);
    recovered.time.push_back(m.time);
    recovered.opening.push_back(crease.opening(m.x));
    return {recovered.opening.back(), force};
  };
  question.progress = [&](const Moment& m) {
    char text[100];
    std::snprintf(text, sizeof text, "t = %.3f s  opening %.1f degree", m.time, recovered.opening.back());
    return std::string(text);
  };
  return question;
}

std::string caption_of(const Recovered& recovered) {
  char text[120];
  std::snprintf(text, sizeof text, "%s: %.0f deg (law alone %.0f)", recovered.law.c_str(),
                recovered.opening.back(), recovered.of_law);
  return text;
}

Recovered crease_once(const CommandLine& line) {
  C choice;
  Setup setup = set_up(line, defaults(), bind(kRows, choice));
  if (setup.options.quick) setup.scene.triangles = std::min(setup.scene.triangles, 500);
  const double plate =
      setup.options.explain ? 2 * setup.scene.fabric.thickness : loaded_plate(setup.scene, choice);
  const Crease crease = creased(setup.scene, choice, plate);
  setup.scene = crease.scene;
  Session session(line, setup, crease.cloth);
  Recovered recovered{setup.scene.law, {}, {}};
  if (session.only_explain()) return recovered;
  std::vector<double> largest;
  session.simulate(question_of(session, crease, largest, recovered));
  if (session.simulation().dimension() == 3) recovered.of_law = crease.opening_of_law(largest);
  std::vector<double> left;
  keep_largest(session.simulation(), left);
  Run& run = session.run();
  run.metric("recovery_angle_deg", recovered.opening.back());
  run.metric("law_recovery_angle_deg", recovered.of_law);
  run.metric("residual_curvature_per_m", *std::max_element(left.begin(), left.end()));
  run.metric("plate_force_N", recovered.force);
  run.metric("plate_height_m", plate);
  if (session.pictures()) {
    recovered.picture =
        session.pictures()->picture("cloth", session.pictures()->camera(), caption_of(recovered));
    render::Plot plot{"Opening after release, " + setup.scene.fabric.name + ", law " + setup.scene.law,
                      {"time [s]"},
                      {"angle between the limbs [degree]", false, 0, 180}};
    plot.series = {{setup.scene.law, recovered.time, recovered.opening}};
    session.plot("plot_opening", plot);
  }
  session.finish("Crease: " + setup.scene.fabric.name + ", law " + setup.scene.law);
  return recovered;
}

std::vector<std::string> laws_of(const CommandLine& line) {
  std::string text;
  for (const Flag& flag : line.flags)
    if (flag.path == "law") text = flag.text;
  if (text != "all") return split(text);
  std::vector<std::string> names;
  for (const auto& law : law_catalogue()) names.push_back(law.name);
  return names;
}

// The same line for one law, into a folder of that name.
CommandLine with_law(const CommandLine& line, const std::string& law, const std::filesystem::path& folder) {
  CommandLine one = line;
  std::erase_if(one.flags,
                [](const Flag& f) { return f.path == "law" || f.path == "out" || f.path == "json"; });
  one.flags.push_back({"law", law});
  one.flags.push_back({"out", (folder / law).string()});
  one.command += " (law " + law + ")";
  return one;
}

void write_table(Run& run, const std::vector<Recovered>& all) {
  AtomicFile file(run.path("table.csv").string());
  file.stream() << "law,recovery angle [degree],of the law alone [degree],plate [N],failed\n";
  for (const Recovered& r : all) {
    const auto text = [](double value) {
      return std::isfinite(value) ? std::to_string(value) : std::string();
    };
    file.stream() << row_of({r.law, r.failed.empty() ? text(r.opening.back()) : "", text(r.of_law),
                             r.failed.empty() ? text(r.force) : "", r.failed});
    if (r.failed.empty()) run.metric(r.law + ".recovery_angle_deg", r.opening.back());
  }
  file.commit();
}

void draw(Run& run, const std::vector<Recovered>& all, const std::string& title) {
  std::vector<render::SheetEntry> entries;
  render::Plot plot{title, {"time [s]"}, {"angle between the limbs [degree]", false, 0, 180}};
  for (const Recovered& r : all) {
    if (!r.failed.empty()) continue;
    if (r.picture) entries.push_back({*r.picture, caption_of(r)});
    constexpr std::size_t kColors = 7;  // of the palette: then they come again, dashed
    const bool again = plot.series.size() >= kColors;
    plot.series.push_back(
        {r.law, r.time, r.opening, again ? render::Series::Style::dashed : render::Series::Style::line});
  }
  if (!entries.empty())
    render::write_png(run.path("sheet.png"), render::contact_sheet(entries, {title}),
                      render::PngEffort::best);
  if (!plot.series.empty())
    run.plot("plot_opening", [&](const auto& base) { render::write_plot(base, plot); });
}

int crease_laws(const CommandLine& line, const std::vector<std::string>& laws) {
  C choice;
  CommandLine first = line;
  std::erase_if(first.flags, [](const Flag& f) { return f.path == "law"; });
  const Setup setup = set_up(first, defaults(), bind(kRows, choice));
  Json keys = to_json(bind(kRows, choice));
  keys["fabrics"] = setup.scene.fabric.name;
  keys["laws"] = laws;
  Options options = setup.options;
  if (options.explain) {
    for (const std::string& law : laws) crease_once(with_law(line, law, {}));
    return 0;
  }
  if (options.out.empty()) options.out = "out/crease";
  Run run(line, options, keys);
  std::vector<Recovered> all;
  for (const std::string& law : laws) {
    Recovered recovered{law, {}, {}};
    try {
      recovered = crease_once(with_law(line, law, run.folder()));
    } catch (const Error& error) {
      if (error.exit_code() == 1) throw;
      recovered.failed = error.what();
    }
    all.push_back(std::move(recovered));
    run.progress(all.back().failed.empty() ? caption_of(all.back()) : law + ": " + all.back().failed);
    write_table(run, all);
  }
  if (!options.no_images) draw(run, all, "Crease recovery, " + setup.scene.fabric.name);
  run.path("report.html");
  run.finish();
  write_report(run.folder());
  return 0;
}

}  // namespace

std::vector<KeyDescription> crease_keys() {
  C choice;
  return descriptions(bind(kRows, choice));
}

int crease(const CommandLine& line) {
  const std::vector<std::string> laws = laws_of(line);
  if (laws.size() > 1) return crease_laws(line, laws);
  crease_once(line);
  return 0;
}

}  // namespace hysteron::experiments
