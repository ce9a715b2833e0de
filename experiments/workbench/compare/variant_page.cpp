#include "experiments/workbench/compare/variant_page.h"

#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/kept_page.h"
#include "experiments/workbench/compare/shared_framing.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
#include "render/contact_sheet.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

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

// "" where there is none.
fs::path picture_of(const VariantPage& page, const SweepColumn& column) {
  if (!page.picture.empty())
    return is_there(column.folder / page.picture) ? column.folder / page.picture : fs::path();
  const std::vector<fs::path> frames = files_ending(column.folder / "frames", ".png");
  return frames.empty() ? fs::path() : frames.back();
}

// As a comparison of the columns' last instants.
void keep(Run& run, const VariantPage& page, const std::vector<SweepColumn>& columns) {
  const ComparisonPage kept{.title = page.title,
                            .notes = {},
                            .rows = 1,
                            .times = {},
                            .metrics = page.metrics,
                            .look = page.setup.options.looks().front(),
                            .outlines = false,
                            .video = "none"};
  std::vector<std::vector<int>> frames;
  for (const SweepColumn& column : columns) {
    const auto& drawn = column.manifest ? column.manifest->frames : std::nullopt;
    const int count = drawn && column.stopped.empty() ? static_cast<int>(drawn->instants.size()) : 0;
    frames.push_back(count > 0 ? std::vector<int>{count - 1} : std::vector<int>{});
  }
  keep_page(run, kept, columns, frames);
}

void draw_page(Run& run, const VariantPage& page, const std::vector<SweepColumn>& columns) {
  std::vector<render::SheetEntry> entries;
  for (const SweepColumn& column : columns) {
    const fs::path picture = column.stopped.empty() ? picture_of(page, column) : fs::path();
    if (!column.stopped.empty())
      run.warn(column.name + " is missing on the page's sheet and plots: " + column.stopped);
    if (!picture.empty())
      entries.push_back({render::read_png(picture), column.name + ": " + page.caption(column.metrics())});
  }
  if (!entries.empty())
    render::write_png(run.path("sheet.png"), render::contact_sheet(entries, {page.title}),
                      render::PngEffort::best);
  keep(run, page, columns);
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
  for (Variant& variant : variants) variant.flags.insert(variant.flags.end(), framing.begin(), framing.end());
  return variants;
}

}  // namespace

std::vector<KeyDescription> page_keys() { return descriptions_of(kRows); }

int run_variants(const CommandLine& given, void (*once)(const CommandLine&),
                 VariantPage (*page_of)(const CommandLine&, std::vector<Variant>&)) {
  CommandLine line = given;
  const PageChoice choice = taken_from(line);
  std::vector<Variant> variants = variants_of(line);
  if (variants.size() == 1) return once(line), 0;
  VariantPage page = page_of(without_lists(line), variants);
  const Scene& scene = page.setup.scene;
  if (page.setup.options.checkpoint > 0)
    throw Error::request("--checkpoint is of single runs: name one law, fabric, integrator");
  if (!lists_fabrics(line)) page.title += ", " + scene.fabric.name;
  std::vector<SweepColumn> columns;
  for (const Variant& variant : in_one_frame(line, variants))
    columns.push_back(column_of(variant.name, line, variant.flags, page.setup.options.out));
  if (page.setup.options.explain) return explain_columns(columns), 0;
  check_batch(columns, choice.batch);
  page.keys["fabric"] = to_json(scene)["fabric"];  // of variants that name none
  for (const Variant& variant : variants) page.keys["variants"].push_back(variant.name);
  Run run(line, page.setup.options, page.keys);
  reserve_page(run, page);
  const SweepJobs jobs{.threads = scene.threads,
                       .resume = page.setup.options.resume,
                       .gpu = scene.device != DeviceChoice::cpu,
                       .go_on = true,
                       .batch = choice.batch};
  run_comparison(run, varied_of(variants), columns, jobs, page.metrics);
  for (const SweepColumn& column : columns)
    if (column.exit_code == 1) throw Error::machine(column.name + ": " + column.stopped);
  if (!page.setup.options.no_images) draw_page(run, page, columns);
  finish_with_report(run);
  return 0;
}

}  // namespace hysteron::experiments
