#include "experiments/workbench/compare/variant_page.h"

#include <optional>

#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/comparison.h"
#include "experiments/workbench/compare/kept_page.h"
#include "experiments/workbench/compare/shared_framing.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
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

// The page's own, or the last of the column's frames; "" where there is none.
fs::path shown_picture(const VariantPage& page, const ChildRun& column) {
  if (!column.stopped.empty() || !has_frames(column)) return {};
  const fs::path file = page.picture.empty() ? picture_of(column, column.manifest->frames->looks.at(0).name,
                                                          instants(column).size() - 1)
                                             : column.folder / page.picture;
  return is_there(file) ? file : fs::path();
}

// Its end, a picture a column; nothing where no column has one.
std::optional<render::ComparisonSheet> sheet_of(const VariantPage& page,
                                                const std::vector<ChildRun>& columns) {
  render::ComparisonSheet sheet;
  sheet.title = page.title;
  sheet.rows.emplace_back();
  const std::vector<render::ComparisonColumn> heads = heads_of(columns, page.metrics);
  const ProbedLoops loops(columns);
  Crop crop;
  for (const ChildRun& column : columns)
    if (!shown_picture(page, column).empty()) crop.include(instants(column).back());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const fs::path picture = shown_picture(page, columns[c]);
    if (picture.empty()) continue;
    sheet.columns.push_back(heads[c]);
    sheet.columns.back().cells = {
        {crop.of(render::read_png(picture)), "", loops.at(c, instants(columns[c]).back().time)}};
    sheet.rows[0].metres_per_pixel = columns[c].manifest->frames->metres_per_pixel;
  }
  sheet.scale_note = "at the cloth's middle";
  if (sheet.columns.empty()) return {};
  return sheet;
}

// As a comparison of the columns' last instants.
void keep(Run& run, const VariantPage& page, const std::vector<ChildRun>& columns) {
  const ComparisonPage kept{.title = page.title,
                            .notes = {},
                            .rows = 1,
                            .times = {},
                            .metrics = page.metrics,
                            .look = page.setup.options.looks().front(),
                            .outlines = false,
                            .video = "none"};
  std::vector<std::vector<int>> frames;
  for (const ChildRun& column : columns) {
    const auto& drawn = column.manifest ? column.manifest->frames : std::nullopt;
    const int count = drawn && column.stopped.empty() ? static_cast<int>(drawn->instants.size()) : 0;
    frames.push_back(count > 0 ? std::vector<int>{count - 1} : std::vector<int>{});
  }
  keep_page(run, kept, columns, frames);
}

void draw_page(Run& run, const VariantPage& page, const std::vector<ChildRun>& columns) {
  for (const ChildRun& column : columns)
    if (!column.stopped.empty())
      run.warn(column.name + " is missing on the page's sheet and plots: " + column.stopped);
  if (const auto sheet = sheet_of(page, columns))
    render::write_png(run.path("sheet.png"), render::draw_comparison(*sheet), render::PngEffort::best);
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
  for (Variant& variant : variants) {
    variant.flags.insert(variant.flags.end(), framing.begin(), framing.end());
    const std::vector<Flag> plain = for_sheets(line);
    variant.flags.insert(variant.flags.end(), plain.begin(), plain.end());
  }
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
    throw Error::invalid_input("--checkpoint is of single runs: name one law, fabric, integrator");
  if (!lists_fabrics(line)) page.title += ", " + scene.fabric.name;
  std::vector<ChildRun> columns;
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
  for (const ChildRun& column : columns)
    if (column.exit_code == 1) throw Error::system(column.name + ": " + column.stopped);
  if (!page.setup.options.no_images) draw_page(run, page, columns);
  finish_with_report(run);
  return 0;
}

}  // namespace hysteron::experiments
