#include "experiments/workbench/compare/variant_page.h"

#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/kept_geometry.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

struct PageChoice {
  int batch = 1;
};
const KeyRow<PageChoice> kRows[] = {
    {"batch", at<&PageChoice::batch>, "", between(1, kLargestBatch), "", kBatchDoc}};

// Takes the page's keys off the line.
PageChoice taken_from(CommandLine& line) {
  PageChoice choice;
  for (const BoundKey& key : bind(kRows, choice))
    std::erase_if(line.flags, [&](const Flag& flag) {
      if (flag.path != key.description.path) return false;
      assign(key, parse_text(key.description, flag.text), "--" + flag.path);
      return true;
    });
  return choice;
}

// A comparison of the columns' last instants, of those that have one; plots.
void draw_page(Run& run, const VariantPage& page, const std::vector<ChildRun>& columns) {
  std::vector<ChildRun> shown;
  for (const ChildRun& column : columns) {
    if (!column.stopped.empty())
      run.warn(column.name + " is missing on the page's sheet and plots: " + column.stopped);
    else if (has_frames(column))
      shown.push_back(column);
  }
  if (!shown.empty())
    draw_comparison_page(run,
                         {.title = page.title,
                          .rows = 1,
                          .metrics = page.metrics,
                          .look = page.setup.options.looks().front(),
                          .picture = page.picture,
                          .outlines = false},
                         shown);
  for (TablePlot plot : page.plots) {
    plot.plot.title = page.title;
    draw(run, plot, columns);
  }
}

void reserve_page(const Run& run, const VariantPage& page) {
  run.reserve({"table.csv"});
  if (page.setup.options.no_images) return;
  run.reserve({"sheet.png", kKeptSheet});
  for (const TablePlot& plot : page.plots) run.reserve({plot.name});
}

std::vector<Variant> in_one_frame(const CommandLine& line, std::vector<Variant> variants) {
  const std::vector<Flag> framing = shared_framing(line, variants);
  for (Variant& variant : variants) {
    variant.flags.insert(variant.flags.end(), framing.begin(), framing.end());
    const std::vector<Flag> plain = for_sheets(line);
    variant.flags.insert(variant.flags.end(), plain.begin(), plain.end());
  }
  return variants;
}

}  // namespace

std::vector<KeyDescription> page_keys() { return key_descriptions(kRows); }

int run_variants(const CommandLine& given, void (*once)(const CommandLine&),
                 VariantPage (*first_page)(const CommandLine&, std::vector<Variant>&)) {
  CommandLine line = given;
  const PageChoice choice = taken_from(line);
  std::vector<Variant> variants = named_variants(line);
  if (variants.size() == 1) return once(line), 0;
  VariantPage page = first_page(without_lists(line), variants);
  const Scene& scene = page.setup.scene;
  if (page.setup.options.checkpoint > 0)
    throw Error::invalid_input("--checkpoint is of single runs: name one law, fabric, integrator");
  if (!lists_fabrics(line)) page.title += ", " + scene.fabric.name;
  std::vector<ChildRun> columns;
  for (const Variant& variant : in_one_frame(line, variants))
    columns.push_back(child_run(variant.name, line, variant.flags, page.setup.options.out));
  if (page.setup.options.explain) return explain_columns(columns), 0;
  check_batch(columns, choice.batch);
  page.keys["fabric"] = to_json(scene)["fabric"];  // of variants that name none
  for (const Variant& variant : variants) page.keys["variants"].push_back(variant.name);
  Run run(line, page.setup.options, page.keys);
  reserve_page(run, page);
  const SweepJobs jobs{.threads = scene.threads,
                       .resume = page.setup.options.resume,
                       .gpu = scene.device != DeviceChoice::cpu,
                       .tolerates_failures = true,
                       .batch = choice.batch};
  run_comparison(run, varied_key(variants), columns, jobs, page.metrics);
  for (const ChildRun& column : columns)
    if (column.exit_code == 1) throw Error::system(column.name + ": " + column.stopped);
  if (!page.setup.options.no_images) draw_page(run, page, columns);
  finish_with_report(run);
  return 0;
}

}  // namespace hysteron::experiments
