// `hysteron compare` shows an experiment under several laws, fabrics or integrators on one page, with a
// column for each and a row for each instant.
//
//   experiment + flags -> columns (a process each, in OUT/<name>/) -> pictures at common times ->
//   OUT/sheet.png
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/compare/plan.h"
#include "experiments/compare/tuning.h"
#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/scene_source.h"
#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/compare/film.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "experiments/workbench/session/driver.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

using C = CompareParams;
// clang-format off
const KeyRow<CompareParams> kRows[] = {
    {"laws", at<&C::laws>, "", any(), "columns: laws separated by commas, or all; each may carry further keys, as in linear+fabric.damping=1e-3; default linear,pabst,obrien,narain,kim,dahl,prandtl"},
    {"fabrics", at<&C::fabrics>, "", any(), "columns: fabrics separated by commas, or all"},
    {"integrators", at<&C::integrators>, "", any(), "columns: integrators separated by commas, or all"},
    {"compare.to", at<&C::to>, "", any(), "column to subtract from the others, in rows of their own"},
    {"compare.difference", at<&C::difference>, "", any(), "what compare.to subtracts"},
    {"compare.rows", at<&C::rows>, "", between(1, 64), "instants on the page"},
    {"compare.times", at<&C::times>, "s", at_least(0), "these instants on the page, a row each, in place of compare.rows: of each the picture nearest to it"},
    {"compare.metrics", at<&C::metrics>, "", any(), "metrics separated by commas: what the table, the numbers below the columns and the bars show, in this order; without it the table has all, the page those of the experiment"},
    {"compare.no-outlines", at<&C::no_outlines>, "", any(), "no row that lays the outlines over each other"},
    {"compare.jobs", at<&C::jobs>, "", between(0, 64), "how many columns run at a time; 0: one for each GPU, or for each core"},
    {"batch", at<&C::batch>, "", between(1, kLargestBatch), kBatchDoc},
    {"compare.match", at<&C::match>, "", any(), "what all laws have in common: the fabric's numbers, the stiffness at rest, or the work to bend to compare.match-curvature"},
    {"compare.match-curvature", at<&C::match_curvature>, "1/m", positive(), "curvature up to which the work is matched"},
    {"compare.video", at<&C::video>, "", any(), "a film of the columns side by side, OUT/film.mp4 ..., if ffmpeg is installed: none | mp4 | webp (without loss) | gif, or several, separated by commas"},
    {"compare.video-size", at<&C::video_size>, "MB", positive(), "of a film's file, at most: the quality of MP4, then its width give way"},
    {"compare.title", at<&C::title>, "", any(), "of the page, before the fabric that all columns have"},
    {"compare.names", at<&C::names>, "", any(), "what stands over the columns on the page, separated by commas, in place of their names"},
    {"compare.tune", at<&C::tune>, "", any(), "KEY=LOW:HIGH: the first column's KEY is bisected between these, before all columns run, until its compare.tune-metric is the second column's; KEY=NUMBER on stdout"},
    {"compare.tune-metric", at<&C::tune_metric>, "", any(), "what compare.tune makes equal: METRIC, or METRIC=METRIC of the second column"},
};
// clang-format on

// Returns "Swing: cotton-broad", with the fabric and the law that all columns share; after a user's title
// only the fabric.
std::string comparison_title(const CommandLine& line, const std::string& own,
                             const std::vector<ChildRun>& columns) {
  std::string title = own.empty() ? line.positionals[0] : own;
  if (own.empty()) title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  const auto shared = [&](const char* key) {
    std::string text;
    for (const ChildRun& c : columns) {
      if (!c.manifest) continue;
      const std::string value = c.manifest->text(key);
      if (!text.empty() && value != text) return std::string();
      text = value;
    }
    return text;
  };
  std::vector<std::string> all = {shared("fabric.name")};
  if (own.empty()) all.push_back(shared("law"));
  std::erase(all, "");
  return title + (all.empty() ? "" : ": " + join(all, ", "));
}

// Says what the columns are matched to; nothing if laws cannot differ in stiffness by their own
// definitions.
std::vector<std::string> comparison_notes(const CompareParams& choice, const Plan& plan) {
  const bool scaled = std::ranges::any_of(plan.scales, [](double scale) { return scale != 1; });
  if (plan.laws < 2 && !scaled) return {};
  if (choice.match == Match::fabric)
    return {"No stiffness is matched: a difference between laws may be one of stiffness alone."};
  const std::string equal = choice.match == Match::energy
                                ? fmt::format("work to bend from flat to {:g} 1/m", choice.match_curvature)
                                : "stiffness at rest";
  const std::vector<std::string> names = column_names(plan.columns, split(choice.names));
  std::string note = fmt::format("Matched to {}{}: equal {}{}; b1, b2 times", plan.reference,
                                 plan.has_reference ? "" : ", which is no column", equal,
                                 plan.has_faces ? ", the mean of bends to face and back" : "");
  for (std::size_t c = 0; c < plan.columns.size(); ++c)
    note += fmt::format("{} {:.3g} ({})", c ? "," : "", plan.scales[c], names[c]);
  return {note};
}

// Reserves the page's files before the columns run.
void claim_files(Run& run, bool with_images) {
  for (const char* name : {"table.csv", "report.html"}) run.path(name);
  if (!with_images) return;
  for (const char* name : {"sheet.png", kArchivedSheet}) run.path(name);
}

std::vector<KeyDescription> own_keys() {
  std::vector<KeyDescription> keys = key_descriptions(kRows);
  for (const Experiment& experiment : experiments()) {
    if (!experiment.compared) continue;
    auto more = experiment.own_keys();
    std::erase_if(more, [](const KeyDescription& key) { return key.path == "batch"; });  // the page's key
    keys.insert(keys.end(), more.begin(), more.end());
  }
  return keys;
}

// Reads the page's own flags; all others are left to the columns.
void read_flags(const CommandLine& line, CompareParams& choice, Options& options) {
  const Keys own = bind(kRows, choice), general = bind_options(options);
  for (const Flag& flag : line.flags)
    for (const Keys* keys : {&own, &general})
      for (const BoundKey& key : *keys)
        if (key.description.path == flag.path) assign(key, flag.value, flag.name());
  KeyValues values = key_values(own);
  values.merge(key_values(general));
  refuse_unread_flags(line, values);
  if (options.out.empty())
    options.out = "out/compare-" + std::filesystem::path(line.positionals[0]).stem().string();
  if (!choice.to.empty()) choice.to = folder_name(column_name(choice.to));
}

// Takes the options of pictures from the scene's file if no flag sets them.
void take_scene_options(CommandLine& inner, Options& options) {
  const Options of_scene = setup_of_file(inner).options;
  const bool draws = last_text(inner.flags, "no-images", of_scene.no_images ? "true" : "false") != "true";
  options.no_images = !draws;
  if (!draws) inner.flags.push_back({"no-images", true});
  if (last_text(inner.flags, "look", "").empty() && of_scene.look != options.look) {
    options.look = of_scene.look;
    inner.flags.push_back({"look", of_scene.look});
  }
  if (last_text(inner.flags, "size", "").empty() && of_scene.size != options.size)
    inner.flags.push_back({"size", of_scene.size});
}

// Throws without pictures: the columns' curvatures are subtracted as their pictures are drawn, from those
// that the first one keeps.
void check_difference(const CompareParams& choice, bool with_images) {
  if (with_images || choice.to.empty() || choice.difference != Difference::curvature) return;
  throw Error::invalid_input(
      "compare.difference = curvature needs pictures, and no-images draws none: leave one of both out "
      "(--compare.difference)")
      .with_key("compare.difference", enum_name(choice.difference));
}

// Throws unless there is a name for each column.
void check_names(const CompareParams& choice, const std::vector<ChildRun>& columns) {
  const std::size_t named = split(choice.names).size();
  if (named == 0 || named == columns.size()) return;
  throw Error::invalid_input(fmt::format("compare.names = {} must be as many names as there are columns, {} "
                                         "(--compare.names)",
                                         choice.names, columns.size()))
      .with_key("compare.names", choice.names);
}

// How far other draws of the mesh are from the columns shown: of the first headline that was repeated for it,
// or that none was; "" of experiments whose meshes do not decide.
std::string draws_note(const Experiment& experiment, const CompareParams& choice, const Plan& plan) {
  if (!experiment.by_chance) return "";
  const std::vector<std::string> names = column_names(plan.columns, split(choice.names));
  for (const Headline& headline : experiment.headlines.all) {
    std::vector<std::string> each;
    for (std::size_t c = 0; c < plan.columns.size(); ++c) {
      const Metrics metrics = plan.columns[c].metrics();
      const MetricValue mean = metrics[std::string(headline.metric) + kDrawMean],
                        error = metrics[std::string(headline.metric) + kDrawError];
      if (mean.is_number() && error.is_number())
        each.push_back(fmt::format("{} {:.3g} ± {:.2g}", names[c], headline.scale * mean.number(),
                                   headline.scale * error.number()));
    }
    if (!each.empty())
      return fmt::format("One draw of several meshes is shown; {} [{}] over all: {} (standard deviation)",
                         headline.words, headline.unit, join(each, ", "));
  }
  return "One draw of the mesh is shown: others fold elsewhere (--errors says how far apart they are).";
}

std::vector<std::string> page_notes(const Experiment& experiment, const CompareParams& choice,
                                    const Plan& plan) {
  std::vector<std::string> notes = comparison_notes(choice, plan);
  notes.push_back(draws_note(experiment, choice, plan));
  notes.push_back(integrators_note(plan.columns, split(choice.names)));
  std::erase(notes, "");
  return notes;
}

void draw_page(Run& run, const CommandLine& line, const std::string& experiment, const CompareParams& choice,
               const Options& options, const Plan& plan) {
  const ComparisonPage page{.title = comparison_title(line, choice.title, plan.columns),
                            .notes = page_notes(experiment_named(experiment), choice, plan),
                            .names = split(choice.names),
                            .rows = choice.rows,
                            .times = choice.times,
                            .metrics = split(choice.metrics),
                            .look = options.looks().front(),
                            .to = plan.to,
                            .curvature = choice.difference == Difference::curvature,
                            .onion = experiment_named(experiment).onion,
                            .outlines = !choice.no_outlines,
                            .films = film_formats("compare.video", choice.video),
                            .film_bytes = 1e6 * choice.video_size};
  const auto stage = run.stage("render");
  draw_comparison_page(run, page, plan.columns);
  plot_comparison(run, page, plan.columns);
  if (const auto plot_more = experiment_named(experiment).plot_columns) plot_more(run, page, plan.columns);
}

// Throws Error::invalid_input for a name that is no metric of any column, listing those that exist.  If no
// column is complete, not all metrics are known, and none is refused.
void check_metrics(const std::vector<ChildRun>& columns, const std::vector<std::string>& names) {
  if (std::none_of(columns.begin(), columns.end(), [](const ChildRun& c) { return c.stopped.empty(); }))
    return;
  const std::vector<std::string> known =
      metrics_in(columns, [](const MetricValue& value) { return value.is_numeric() || value.is_text(); });
  for (const std::string& name : names)
    if (!std::count(known.begin(), known.end(), name))
      throw Error::invalid_input("compare.metrics = " + name + " must be among " + join(known, ", ") +
                                 "; --resume keeps the columns that have run (--compare.metrics)")
          .with_key("compare.metrics", name);
}

// Throws for metrics that no column has, before anything is touched, if every column is complete.
void check_known_metrics(std::vector<ChildRun> columns, const std::vector<std::string>& names) {
  if (names.empty() || !std::ranges::all_of(columns, load_cached_run)) return;
  check_metrics(columns, names);
}

int run_compare(const CommandLine& line) {
  if (line.positionals.size() != 1)
    throw Error::invalid_input("needs what to compare: " + compared_experiments());
  if (const std::string file = last_text(line.flags, "dump-scene", ""); !file.empty())
    throw Error::invalid_input("dump-scene = " + file +
                               " is one file, and every column has a scene of its own: dump that of the "
                               "experiment with the column's flags")
        .with_key("dump-scene", file);
  CompareParams choice;
  Options options;
  read_flags(line, choice, options);
  CommandLine inner = line_of_columns(line, choice);
  take_scene_options(inner, options);
  check_difference(choice, !options.no_images);
  film_formats("compare.video", choice.video);
  std::vector<Variant> variants = named_variants(inner);
  if (options.explain) {
    explain_columns(comparison_plan(inner, variants, choice, options.out).columns);
    return 0;
  }
  Plan plan = comparison_plan(inner, variants, choice, options.out);
  check_names(choice, plan.columns);
  check_batch(plan.columns, choice.batch);
  check_columns(plan.columns);
  if (!options.no_images && !choice.times.empty()) check_times(choice.times, plan.columns);
  SweepJobs jobs{choice.jobs, std::stoi(last_text(line.flags, "threads", "0")), options.resume,
                 last_text(inner.flags, "device", "auto") != "cpu", -1};
  jobs.batch = choice.batch;
  Json keys = {{"compared", inner.experiment}, {"match", enum_name(choice.match)}};
  if (!choice.times.empty()) keys["times"] = choice.times;
  if (!choice.metrics.empty()) keys["metrics"] = split(choice.metrics);
  const bool tunes = !choice.tune.empty() || !choice.tune_metric.empty();
  if (tunes)
    check_tuning(inner, variants, choice, options);
  else
    check_known_metrics(plan.columns, split(choice.metrics));
  Run run(line, options, keys);
  claim_files(run, !options.no_images);
  if (tunes) {
    const bool is_subtracted = choice.to == variants[0].name;
    keys["tuned"] = tune_first_column(run, inner, variants, choice, jobs, options);
    if (is_subtracted) choice.to = variants[0].name;
    plan = comparison_plan(inner, variants, choice, options.out);
  }
  if (choice.difference == Difference::curvature) jobs.first = plan.to;
  for (std::size_t c = 0; c < plan.columns.size(); ++c)
    keys["columns"].push_back({{"name", plan.columns[c].name}, {"stiffness_times", plan.scales[c]}});
  if (choice.match != Match::fabric) keys["matched_to"] = plan.reference;
  run.manifest().keys = std::make_shared<const Json>(keys);
  for (const std::string& note : comparison_notes(choice, plan)) run.progress(note);
  run_columns(run, plan.columns, jobs, split(choice.metrics));
  check_metrics(plan.columns, split(choice.metrics));
  write_comparison_table(run, plan.varied, plan.columns, split(choice.metrics));
  if (!options.no_images) draw_page(run, line, inner.experiment, choice, options, plan);
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment compare() {
  return {.name = "compare",
          .question = "one scene under several laws, fabrics or integrators, on one page",
          .run = run_compare,
          .simulates = true,
          .own_keys = own_keys,
          .positionals = "EXPERIMENT|SCENE",
          .conditions = {{"compare.difference", "compare.to"},
                         {"compare.rows", "not compare.times"},
                         {"compare.match-curvature", "compare.match = energy"},
                         {"compare.video-size", "compare.video != none"},
                         {"compare.tune-metric", "compare.tune"}}};
}

}  // namespace hysteron::experiments
