// One question under several laws, fabrics or integrators, on one page: a column each, a row for each moment.
//
//   experiment + flags -> columns (a process each, in OUT/<name>/) -> pictures at common times ->
//   OUT/sheet.png
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/compare/comparison_captions.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/compare/comparison_table.h"
#include "experiments/workbench/compare/law_page.h"
#include "experiments/workbench/compare/matching.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

struct CompareChoice {
  std::string laws, fabrics, integrators;
  std::string to;  // column that others differ from; "": no such rows
  std::string difference = "picture";
  int rows = 4;
  bool no_outlines = false;
  int jobs = 0;
  bool resume = false;
  std::string match = "energy";
  double match_curvature = 100;  // [1/m], the KES tester's reading point
  std::string video = "none";
};

using C = CompareChoice;
// clang-format off
const KeyRow<CompareChoice> kRows[] = {
    {"laws", at<&C::laws>, "", any(), "", "columns: laws apart by commas, or all; each may carry further keys, linear+fabric.damping=1e-3; default linear,pabst,obrien,narain,kim,dahl,prandtl"},
    {"fabrics", at<&C::fabrics>, "", any(), "", "columns: fabrics apart by commas, or all"},
    {"integrators", at<&C::integrators>, "", any(), "", "columns: integrators apart by commas, or all"},
    {"compare.to", at<&C::to>, "", any(), "", "column that is subtracted from the others, in rows of their own"},
    {"compare.difference", at<&C::difference>, "", any(), "picture | curvature", "what compare.to subtracts"},
    {"compare.rows", at<&C::rows>, "", between(1, 64), "", "moments on the page"},
    {"compare.no-outlines", at<&C::no_outlines>, "", any(), "", "no row of outlines over each other"},
    {"compare.jobs", at<&C::jobs>, "", between(0, 64), "", "columns that run at a time; 0: one for each GPU, or for each core"},
    {"resume", at<&C::resume>, "", any(), "", "keeps columns that the same program has finished in this folder"},
    {"compare.match", at<&C::match>, "", any(), "fabric | small-strain | energy", "what is equal between laws: the fabric's numbers, the stiffness at rest, or the work to bend to compare.match-curvature"},
    {"compare.match-curvature", at<&C::match_curvature>, "1/m", positive(), "", "to which energy is matched"},
    {"compare.video", at<&C::video>, "", any(), "none | mp4 | gif", "a film of the columns side by side, where ffmpeg is there"},
};
// clang-format on

constexpr const char* kLaws = "linear,pabst,obrien,narain,kim,dahl,prandtl";
constexpr const char* kCompared[] = {"drape", "swing", "crease", "fold", "crumple"};

// Flags that are the page's own; all others are the columns'.
bool is_own(const std::string& path) {
  static const std::vector<std::string> kNames = {"laws", "fabrics", "integrators", "out",
                                                  "json", "quiet",   "resume",      "threads"};
  return path.starts_with("compare.") || std::find(kNames.begin(), kNames.end(), path) != kNames.end();
}

// The line as the experiment itself would get it: lists become its --law, --fabric and --integrator.
CommandLine line_of_columns(const CommandLine& line, const CompareChoice& choice) {
  CommandLine inner = line;
  inner.names.clear();
  const std::string what = line.names.front();
  inner.experiment =
      std::find(std::begin(kCompared), std::end(kCompared), what) != std::end(kCompared) ? what : "swing";
  std::erase_if(inner.flags, [](const Flag& f) { return is_own(f.path); });
  if (inner.experiment != what) inner.flags.push_back({"scene", what});
  if (!choice.fabrics.empty()) inner.flags.push_back({"fabric", choice.fabrics});
  if (!choice.integrators.empty()) inner.flags.push_back({"integrator", choice.integrators});
  const bool others = !choice.fabrics.empty() || !choice.integrators.empty();
  const std::string laws =
      !choice.laws.empty() || others ? choice.laws : last_text(inner.flags, "law", kLaws);
  if (!laws.empty()) inner.flags.push_back({"law", laws});
  return inner;
}

LawRequest law_of(const Fabric& fabric, const CommandLine& line, const std::string& law) {
  LawRequest request{law, fabric.virgin_curve(), {}};
  for (const Flag& flag : line.flags)
    if (flag.path == "param")
      request.parameters[flag.text.substr(0, flag.text.find('='))] =
          flag.text.substr(flag.text.find('=') + 1);
  return request;
}

std::string exactly(double value) { return fmt::format("{:.17g}", value); }

// The fabric of a column before any matching, and its law.
struct ColumnFabric {
  Fabric fabric;
  std::string law;
};

ColumnFabric fabric_of(const CommandLine& line) {
  Setup setup{default_scene(), {}};
  const std::string file = last_text(line.flags, "scene", "");
  if (!file.empty()) apply_scene_file(setup.scene, file, {});
  std::vector<Flag> of_fabric;
  for (const Flag& flag : line.flags)
    if (flag.path.starts_with("fabric")) of_fabric.push_back(flag);
  apply_flags(setup.scene, of_fabric);
  return {setup.scene.fabric, last_text(line.flags, "law", setup.scene.law)};
}

CommandLine with(CommandLine line, const LawVariant& variant) {
  line.flags = with_later(line.flags, variant.flags);
  return line;
}

// Flags that make the column as stiff as `to` on the same fabric.  Its viscosity, fabric.damping times b1,
// goes with it.
std::vector<Flag> matched(const CommandLine& inner, const LawVariant& variant, const std::string& to,
                          const CompareChoice& choice, double& scale) {
  scale = 1;
  const Match match = match_named(choice.match);
  if (match == Match::fabric) return {};
  const CommandLine line = with(inner, variant);
  const auto [fabric, law] = fabric_of(line);
  scale = matching_scale(law_of(fabric, line, law), law_of(fabric, line, to), match, choice.match_curvature);
  return {{"fabric.b1", exactly(scale * fabric.b1)}, {"fabric.b2", exactly(scale * fabric.b2)}};
}

// Colours mean the same in all columns, though fabrics have different transition curvatures.
Flag shared_range(const CommandLine& inner, const std::vector<LawVariant>& variants) {
  double k0 = 0;
  for (const LawVariant& variant : variants) k0 = std::max(k0, fabric_of(with(inner, variant)).fabric.k0);
  return {"curvature-range", last_text(inner.flags, "curvature-range", exactly(2 * k0))};
}

// What the experiment is asked for beside what it would be asked for alone.
std::vector<Flag> asked_for_the_page(const CommandLine& inner, const CompareChoice& choice,
                                     const std::filesystem::path& out, bool is_reference) {
  std::vector<Flag> flags = {{"plain", "true"}};
  std::string look = last_text(inner.flags, "look", "cloth");
  if (!choice.no_outlines) look += ",silhouette";
  if (!choice.to.empty() && choice.difference == "curvature") {
    if (is_reference)
      flags.push_back({"export", "ply"});
    else
      look += ",difference", flags.push_back({"reference", (out / choice.to).string()});
  }
  flags.push_back({"look", look});
  if (last_text(inner.flags, "size", "").empty()) flags.push_back({"size", "840x630"});
  return flags;
}

std::vector<std::string> words_of(const CommandLine& line) {
  std::vector<std::string> words = {line.experiment};
  for (const Flag& flag : line.flags) words.push_back("--" + flag.path + "=" + flag.text);
  return words;
}

struct Plan {
  std::vector<CommandLine> lines;  // of the columns
  std::vector<SweepColumn> columns;
  std::vector<double> scales;
  std::string reference;  // law that stiffness is matched to
  std::size_t laws = 0;   // different ones
  int to = -1;            // the column that is subtracted, -1: none
  std::string varied;     // "law", where columns differ by it alone
};

Plan plan_of(const CommandLine& inner, const CompareChoice& choice, const std::filesystem::path& out) {
  Plan plan;
  const std::vector<LawVariant> variants = variants_of(inner);
  std::set<std::string> laws;
  for (const LawVariant& variant : variants) {
    const std::string law = last_text(variant.flags, "law", "");
    if (plan.reference != "prandtl") plan.reference = law;
    laws.insert(law);
  }
  plan.laws = laws.size();
  const Flag range = shared_range(inner, variants);
  plan.varied = varied_of(variants);
  for (const LawVariant& variant : variants) {
    double scale = 1;
    std::vector<Flag> own = variant.flags;
    for (const Flag& flag : matched(inner, variant, plan.reference, choice, scale)) own.push_back(flag);
    SweepColumn column;
    column.name = variant.name.empty() ? inner.experiment : variant.name;
    if (column.name == choice.to) plan.to = static_cast<int>(plan.columns.size());
    own.push_back(range);
    for (const Flag& flag : asked_for_the_page(inner, choice, out, column.name == choice.to))
      own.push_back(flag);
    plan.lines.push_back(inner);
    plan.lines.back().flags = with_later(inner.flags, own);
    column.words = words_of(plan.lines.back());
    column.folder = out / column.name;
    plan.columns.push_back(std::move(column));
    plan.scales.push_back(scale);
  }
  if (!choice.to.empty() && plan.to < 0)
    throw Error::request("compare.to = " + choice.to + " is no column (--compare.to)");
  return plan;
}

// "Swing: cotton-broad, bdf2": what all columns share.
std::string title_of(const CommandLine& line, const std::vector<SweepColumn>& columns) {
  std::string title = line.names[0];
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  const auto shared = [&](const auto& read) {
    std::string text;
    for (const SweepColumn& c : columns) {
      if (!c.manifest) continue;
      const std::string own = read(c.manifest->scene);
      if (!text.empty() && own != text) return std::string();
      text = own;
    }
    return text;
  };
  std::string what;
  for (const std::string& text : {shared([](const SceneRecord& s) { return s.fabric.name; }),
                                  shared([](const SceneRecord& s) { return s.law.value_or(""); }),
                                  shared([](const SceneRecord& s) { return s.integrator; })})
    if (!text.empty()) what += (what.empty() ? ": " : ", ") + text;
  return title + what;
}

void write_table(Run& run, const Plan& plan) {
  std::vector<ComparisonRow> rows;
  for (const SweepColumn& c : plan.columns) {
    rows.push_back({c.name, c.manifest ? c.manifest->metrics : Metrics(), c.stopped});
  }
  write_comparison_table(run, plan.varied, rows);
}

std::vector<std::string> notes_of(const CompareChoice& choice, const Plan& plan) {
  if (plan.laws < 2) return {};
  if (choice.match == "fabric")
    return {"No stiffness is matched: a difference between laws may be one of stiffness alone."};
  const std::string equal = choice.match == "energy"
                                ? fmt::format("work to bend from flat to {:g} 1/m", choice.match_curvature)
                                : "stiffness at rest";
  std::string note = fmt::format("Matched to {}: equal {}; b1, b2 times", plan.reference, equal);
  for (std::size_t c = 0; c < plan.columns.size(); ++c)
    note += fmt::format("{} {:.3g} ({})", c ? "," : "", plan.scales[c], plan.columns[c].name);
  return {note};
}

int explain_columns(const Plan& plan) {
  for (std::size_t c = 0; c < plan.lines.size(); ++c) {
    std::cout << plan.columns[c].name << ":" << std::endl;
    experiment_named(plan.lines[c].experiment).run(plan.lines[c]);
  }
  return 0;
}

// Where another's files stand, that is said before the columns run.
void claim_files(Run& run, bool with_images) {
  for (const char* name : {"table.csv", "report.html"}) run.path(name);
  if (!with_images) return;
  for (const char* name : {"sheet.png", "README.md"}) run.path(name);
}

std::vector<KeyDescription> own_keys() {
  CompareChoice choice;
  std::vector<KeyDescription> keys = descriptions(bind(kRows, choice));
  for (const char* name : {"drape", "crease", "fold", "crumple"}) {
    const auto more = experiment_named(name).own_keys();
    keys.insert(keys.end(), more.begin(), more.end());
  }
  return keys;
}

int run_compare(const CommandLine& line) {
  if (line.names.size() != 1)
    throw Error::request("needs what to compare: drape, swing, crease, fold, crumple or a scene");
  CompareChoice choice;
  Options options;
  const Keys own = bind(kRows, choice), general = bind_options(options);
  for (const Flag& flag : line.flags)
    for (const Keys* keys : {&own, &general})
      for (const BoundKey& key : *keys)
        if (key.description.path == flag.path)
          assign(key, parse_text(key.description, flag.text), "--" + flag.path);
  if (options.out.empty())
    options.out = "out/compare-" + std::filesystem::path(line.names[0]).stem().string();

  if (!choice.to.empty()) choice.to = column_name(choice.to);
  const CommandLine inner = line_of_columns(line, choice);
  Plan plan = plan_of(inner, choice, options.out);
  if (options.explain) return explain_columns(plan);
  SweepJobs jobs{choice.jobs, std::stoi(last_text(line.flags, "threads", "0")), choice.resume,
                 last_text(inner.flags, "device", "auto") != "cpu",
                 choice.difference == "curvature" ? plan.to : -1};
  Json keys = {{"compared", inner.experiment}, {"match", choice.match}};
  for (std::size_t c = 0; c < plan.columns.size(); ++c)
    keys["columns"].push_back({{"name", plan.columns[c].name}, {"stiffness_times", plan.scales[c]}});
  Run run(line, options, keys);
  claim_files(run, !options.no_images);
  run_columns(
      plan.columns, jobs, [&](const SweepColumn& c) { run.progress(c.name + ": " + outcome_of(c)); },
      [&](const std::string& line) { run.progress(line); });
  write_table(run, plan);
  if (!options.no_images) {
    const ComparisonPage page{title_of(line, plan.columns),
                              notes_of(choice, plan),
                              choice.rows,
                              options.looks().front(),
                              plan.to,
                              choice.difference == "curvature",
                              !choice.no_outlines,
                              choice.video};
    const auto stage = run.stage("render");
    draw_comparison_page(run, page, plan.columns);
    plot_comparison(run, page.title, plan.columns);
    write_comparison_captions(run, page, inner.experiment, line.command, plan.columns);
  }
  run.finish();
  write_report(run.folder());
  return 0;
}

}  // namespace

Experiment compare() {
  return {.name = "compare",
          .question = "one scene under several laws, fabrics or integrators, on one page",
          .run = run_compare,
          .simulates = true,
          .own_keys = own_keys,
          .names = "drape|swing|crease|fold|crumple|SCENE"};
}

}  // namespace hysteron::experiments
