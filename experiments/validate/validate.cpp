// `hysteron validate`: where the model stands against measurements.  Cusick's drape of the fabrics that
// publish both a KES pair and a drape coefficient: with and without hysteresis, let down by a plate and
// dropped, on finer meshes and shorter steps as well; with their uncertain numbers anywhere in their ranges;
// and on several meshes.  Their bending length; KES pairs; measured loops that a fit has predicted.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/validate/budget.h"
#include "experiments/validate/drapes.h"
#include "experiments/validate/figure.h"
#include "experiments/validate/spread.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

using F = ValidateFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"parts", at<&F::parts>, "", any(), "", "separated by commas: pairs (B and 2HB of ten fabrics), drapes (laws, paths, mesh and step), lengths (bending lengths), spread (drapes with uncertain numbers), draws (drapes on several meshes), budget (what each uncertain number explains), figure (of recorded results)"},
    {"loops", at<&F::loops>, "", any(), "", "folder of a `fit --fab`, whose predictions of measured loops join the table"},
    {"recorded", at<&F::recorded>, "", any(), "", "folder of results that the part `figure` draws"},
    {"standard", at<&F::standard>, "", any(), "published | iso9073 | jis", "of the drapes: the tester that the fabric's file names, or one for all"},
    {"fabrics", at<&F::fabrics>, "", any(), "", "those that publish a drape coefficient, separated by commas"},
    {"laws", at<&F::laws>, "", any(), "", "separated by commas"},
    {"device", at<&F::device>, "", any(), "cpu | cuda", "of the drapes"},
    {"triangles", at<&F::triangles>, "", between(100, 1e6), "", "of the disc; four times as many to measure the mesh's share of the error"},
    {"step", at<&F::step>, "s", positive(), "", "halved to measure the step's share of the error"},
    {"tolerance", at<&F::tolerance>, "m", at_least(0), "", "of the parts of a step, as --tolerance of drape; an eighth of it with half the step"},
    {"samples", at<&F::samples>, "", between(2, 1000), "", "of a fabric's uncertain numbers, from the ranges that its file states"},
    {"draws", at<&F::draws>, "", between(2, 1000), "", "meshes, for the mean and the spread of a drape"},
    {"seed", at<&F::seed>, "", any(), "", "of the samples"},
    {"seconds", at<&F::seconds>, "s", at_least(0), "", "longest simulated time of a drape; 0: as drape has it"},
};
// clang-format on

Keys option_keys(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

// Bending length of ASTM D1388, cloth and curve.
void measure_bending_lengths(const F& flags, Run& run) {
  Table table("fabric,law,bending length [m],of the elastica [m],remaining drop over length");
  std::vector<Variant> runs;
  for (const std::string& fabric : split(flags.fabrics))
    for (const std::string& law : split(flags.laws))
      runs.push_back(
          {"cantilever-" + fabric + "-" + law, {{"fabric", fabric}, {"law", law}, {"triangles", "512"}}});
  const std::vector<Manifest> results = run_manifests("cantilever", runs, flags, run);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Metrics& metrics = results[r].metrics;
    const double cloth = metrics.number("bending_length_m"),
                 curve = metrics.number("elastica_bending_length_m");
    table.row({runs[r].flags[0].text, runs[r].flags[1].text, cloth, curve,
               metrics.number("residual_drop_over_length")});
    run.metric(runs[r].name + ".bending_length_m", cloth);
    run.progress(runs[r].name + ": bending length " + number_field(cloth) + " m, elastica " +
                 number_field(curve) + " m");
  }
  table.write(run.path("cantilever.csv"));
}

void check_parts(const F& flags) {
  static const std::vector<std::string> kParts = {"pairs", "drapes", "lengths", "spread",
                                                  "draws", "budget", "figure"};
  for (const std::string& part : split(flags.parts))
    if (!std::count(kParts.begin(), kParts.end(), part))
      throw Error::invalid_input("parts = " + part + " must be " + join(kParts, " | "))
          .with_key("parts", part);
}

int run_validate(const CommandLine& line) {
  F flags;
  set_keys(line, option_keys(flags), [&] {
    flags.triangles = std::min(flags.triangles, 400.0);
    flags.samples = flags.draws = 2;
  });
  check_parts(flags);
  const std::vector<std::string> parts = split(flags.parts);
  const auto requested = [&](const char* part) { return std::count(parts.begin(), parts.end(), part) > 0; };
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  run.reserve({"predictions.csv", "cantilever.csv", "drape.csv", "spread.csv", "draws.csv", "budget.csv"});
  std::vector<Prediction> predictions;
  const auto add = [&](std::vector<Prediction> more) {
    predictions.insert(predictions.end(), more.begin(), more.end());
    write_predictions(run, predictions);  // a run that is cut short keeps what it has found
  };
  if (!flags.loops.empty()) add(predict_loops(flags.loops));
  if (requested("pairs")) add(predict_pairs(run));
  if (requested("spread")) add(predict_spread(flags, run));
  if (requested("draws")) add(predict_draws(flags, run));
  if (requested("budget")) write_budget(flags, run);
  if (requested("drapes")) compare_drapes(flags, run);
  if (requested("figure")) draw_recorded(flags.recorded, run);
  if (requested("lengths")) measure_bending_lengths(flags, run);
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment validate() {
  return {
      .name = "validate",
      .question = "the model against measurements: KES pairs, loops, drape coefficients, bending lengths",
      .run = run_validate,
      .own_keys = own_key_descriptions<option_keys>,
      .headlines = {.all = {{"drape_coefficient_percent", "drape coefficient", "%", "{:.1f}", 1, kNoErrors},
                            {"node_count", "folds", "", "{:.0f}", 1, kNoErrors},
                            {"bending_length_m", "bending length", "mm", "{:.2f}", 1e3, kNoErrors}}}};
}

}  // namespace hysteron::experiments
