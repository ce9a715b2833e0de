// `hysteron validate` compares the model with measurements: Cusick's drape of the fabrics that publish both a
// KES pair and a drape coefficient, with their uncertain numbers drawn from their ranges and one at a time at
// the ends of these; and recorded loops, decay, drapes and folds as a figure.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "experiments/validate/budget.h"
#include "experiments/validate/figure.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/compare/sweep_columns.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/choice.h"

namespace hysteron::experiments {
namespace {

using F = ValidateFlags;
// clang-format off
const KeyRow<F> kRows[] = {
    {"parts", at<&F::parts>, "", any(), "separated by commas: spread (drapes with uncertain numbers), budget (what each uncertain number explains), figure (of recorded results)"},
    {"recorded", at<&F::recorded>, "", any(), "folder of results that the part `figure` draws"},
    {"standard", at<&F::standard>, "", any(), "of the drapes: the tester that the fabric's file names, or one for all"},
    {"fabrics", at<&F::fabrics>, "", any(), "those that publish a drape coefficient, separated by commas"},
    {"laws", at<&F::law>, "", any(), "of the drapes; one"},
    {"device", at<&F::device>, "", any(), "of the drapes"},
    {"triangles", at<&F::triangles>, "", between(100, 1e6), "of the disc; a budget has four times as many, too"},
    {"step", at<&F::step>, "s", positive(), "of the drapes"},
    {"tolerance", at<&F::tolerance>, "m", at_least(0), "of the parts of a step, as --tolerance of drape"},
    {"samples", at<&F::samples>, "", between(2, 1000), "of a fabric's uncertain numbers, from the ranges that its file states"},
    {"draws", at<&F::draws>, "", between(2, 1000), "meshes of each drape in a budget"},
    {"seed", at<&F::seed>, "", any(), "of the samples"},
    {"jobs", at<&F::jobs>, "", between(0, 64), "how many processes at a time; 0: one for each GPU, or for each core"},
    {"batch", at<&F::batch>, "", between(1, kLargestBatch), kBatchDoc},
    {"resume", at<&F::resume>, "", any(), "keeps the drapes that have run whose request, program and files are the same"},
    {"seconds", at<&F::seconds>, "s", at_least(0), "longest simulated time of a drape; 0: as drape has it"},
};
// clang-format on

Keys option_keys(F& flags) { return with_output_options(bind(kRows, flags), flags.options); }

// Throws if two fabrics have one name, under which their drapes would be stored.
void check_fabrics(const std::string& list) {
  std::map<std::string, std::string> files;
  for (const std::string& given : listed_names("fabrics", list)) {
    const std::string name = read_fabric(given, "--fabrics").fabric.name;
    if (const auto [other, is_new] = files.emplace(name, given); !is_new)
      throw Error::invalid_input("fabrics = " + list + ": " + other->second + " and " + given +
                                 " are both named " + name + ": give one another name (--fabrics)")
          .with_key("fabrics", list);
  }
}

void check_parts(const F& flags) {
  static const std::vector<std::string> kParts = {"spread", "budget", "figure"};
  for (const std::string& part : listed_names("parts", flags.parts)) check_choice("parts", part, kParts);
  if (split(flags.law).size() != 1)
    throw Error::invalid_input("laws = " + flags.law + " must be one law").with_key("laws", flags.law);
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
  if (requested("spread") || requested("budget")) check_fabrics(flags.fabrics);
  if (requested("figure")) check_recorded(flags.recorded);
  Run run(line, flags.options, to_json(bind(kRows, flags)));
  run.reserve({"predictions.csv", "spread.csv", "effects.csv", "budget.csv"});
  if (requested("spread")) predict_spread(flags, run);
  if (requested("budget")) write_budget(flags, run);
  if (requested("figure")) draw_recorded(flags.recorded, run);
  finish_with_report(run);
  return 0;
}

}  // namespace

Experiment validate() {
  return {.name = "validate",
          .question = "the model against measurements: loops, decay, drapes, folds",
          .run = run_validate,
          .own_keys = own_key_descriptions<option_keys>,
          .conditions = {{"recorded", "parts = figure"},
                         {"standard | fabrics | laws | device | triangles | step | tolerance | seconds | "
                          "jobs | batch | resume",
                          "parts = spread | budget"},
                         {"samples | seed", "parts = spread"},
                         {"draws", "parts = budget"}}};
}

}  // namespace hysteron::experiments
