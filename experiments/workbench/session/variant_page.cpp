#include "experiments/workbench/session/variant_page.h"

#include <algorithm>
#include <iterator>

#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/comparison_page.h"
#include "experiments/workbench/pages/report.h"
#include "experiments/workbench/pictures/archived_geometry.h"
#include "experiments/workbench/session/driver.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

const KeyRow<SweepJobs> kPageRows[] = {
    {"batch", at<&SweepJobs::batch>, "", between(1, kLargestBatch), kBatchDoc}};

// Removes the page's keys from the line and returns them.
SweepJobs taken_from(CommandLine& line) {
  SweepJobs jobs{.tolerates_failures = true};
  for (const BoundKey& key : bind(kPageRows, jobs))
    std::erase_if(line.flags, [&](const Flag& flag) {
      if (flag.path != key.description.path) return false;
      assign(key, flag.value, flag.name());
      return true;
    });
  return jobs;
}

// Draws a comparison of the last instants of the columns that have one, and plots.
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
  run.reserve({"sheet.png", kArchivedSheet});
  for (const TablePlot& plot : page.plots) run.reserve({plot.name});
}

std::vector<Variant> in_one_frame(const CommandLine& line, std::vector<Variant> variants) {
  std::vector<Flag> shared = shared_framing(line, variants);
  std::ranges::copy(for_sheets(line), std::back_inserter(shared));
  for (Variant& variant : variants) std::ranges::copy(shared, std::back_inserter(variant.flags));
  return variants;
}

}  // namespace

std::vector<KeyDescription> page_keys() { return key_descriptions(kPageRows); }

int run_variants(const CommandLine& given, int (*once)(const CommandLine&),
                 VariantPage (*first_page)(const CommandLine&, std::vector<Variant>&)) {
  CommandLine line = given;
  SweepJobs jobs = taken_from(line);
  std::vector<Variant> variants = named_variants(line);
  if (variants.size() == 1) return once(line);
  VariantPage page = first_page(without_lists(line), variants);
  const Scene& scene = page.setup.scene;
  if (page.setup.options.checkpoint > 0)
    throw Error::invalid_input("--checkpoint is of single runs: name one law, fabric, integrator");
  if (!lists_fabrics(line)) page.title += ", " + scene.fabric.name;
  std::vector<ChildRun> columns;
  for (const Variant& variant : in_one_frame(line, variants))
    columns.push_back(child_run(variant.name, line, variant.flags, page.setup.options.out));
  if (page.setup.options.explain) {
    explain_columns(columns);
    return 0;
  }
  check_batch(columns, jobs.batch);
  check_columns(columns);
  page.keys["fabric"] = to_json(scene)["fabric"];  // for variants that name none
  for (const Variant& variant : variants) page.keys["variants"].push_back(variant.name);
  Run run(line, page.setup.options, page.keys);
  reserve_page(run, page);
  jobs.threads = scene.threads;
  jobs.resume = page.setup.options.resume;
  jobs.gpu = scene.device != DeviceChoice::cpu;
  run_columns(run, columns, jobs);
  write_comparison_table(run, varied_key(variants), columns, page.metrics);
  for (const ChildRun& column : columns)
    if (column.exit_code == 1) throw Error::system(column.name + ": " + column.stopped);
  if (!page.setup.options.no_images) draw_page(run, page, columns);
  finish_with_report(run);
  return 0;
}

}  // namespace hysteron::experiments
