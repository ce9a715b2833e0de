#include "experiments/law_page.h"

#include <cmath>

#include "experiments/comma_list.h"
#include "experiments/csv.h"
#include "experiments/report.h"
#include "render/contact_sheet.h"
#include "render/png_writer.h"
#include "sim/atomic_file.h"
#include "sim/bending/law_parameters.h"
#include "sim/error.h"

namespace hysteron::experiments {
namespace {

struct Finding {
  std::string law, failed;
  LawOutcome outcome;
};

// The same line for one law, into a folder of its name.
CommandLine line_of(const CommandLine& line, const LawVariant& law, const std::filesystem::path& folder) {
  CommandLine one = line;
  std::erase_if(one.flags,
                [](const Flag& f) { return f.path == "law" || f.path == "out" || f.path == "json"; });
  one.flags.insert(one.flags.end(), law.flags.begin(), law.flags.end());
  one.flags.push_back({"out", (folder / law.name).string()});
  one.command += " (" + law.name + ")";
  return one;
}

std::string cell(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::isfinite(value) ? text : "";
}

void write_table(Run& run, const std::vector<Finding>& all) {
  std::vector<std::string> header = {"law"};
  for (const Finding& f : all)
    if (header.size() == 1)
      for (const auto& [name, value] : f.outcome.numbers) header.push_back(name);
  AtomicFile file(run.path("table.csv").string());
  std::vector<std::string> titles = header;
  titles.push_back("failed");
  file.stream() << row_of(titles);
  for (const Finding& f : all) {
    std::vector<std::string> row(header.size(), "");
    row[0] = f.law;
    for (std::size_t i = 0; i < f.outcome.numbers.size(); ++i) row[i + 1] = cell(f.outcome.numbers[i].second);
    row.push_back(f.failed);
    file.stream() << row_of(row);
    for (const auto& [name, value] : f.outcome.numbers)
      if (std::isfinite(value)) run.metric(f.law + "." + name, value);
  }
  file.commit();
}

void draw(Run& run, const LawPage& page, const std::vector<Finding>& all) {
  std::vector<render::SheetEntry> entries;
  for (const Finding& f : all)
    if (f.outcome.picture) entries.push_back({*f.outcome.picture, f.outcome.caption});
  if (!entries.empty())
    render::write_png(run.path("sheet.png"), render::contact_sheet(entries, {page.title}),
                      render::PngEffort::best);
  for (std::size_t p = 0; p < page.plots.size(); ++p) {
    render::Plot plot = page.plots[p].second;
    for (const Finding& f : all) {
      if (p >= f.outcome.series.size()) continue;
      constexpr std::size_t kColors = 7;  // of the palette: then they come again, dashed
      render::Series series = f.outcome.series[p];
      series.label = f.law;
      if (plot.series.size() >= kColors) series.style = render::Series::Style::dashed;
      plot.series.push_back(std::move(series));
    }
    if (!plot.series.empty())
      run.plot(page.plots[p].first, [&](const auto& base) { render::write_plot(base, plot); });
  }
}

}  // namespace

std::vector<LawVariant> laws_of(const CommandLine& line) {
  std::string text;
  for (const Flag& flag : line.flags)
    if (flag.path == "law") text = flag.text;
  std::vector<std::string> names = split(text);
  if (text == "all") {
    names.clear();
    for (const auto& law : law_catalogue()) names.push_back(law.name);
  }
  std::vector<LawVariant> laws;
  for (const std::string& name : names) laws.push_back({name, {{"law", name}}});
  return laws;
}

int compare_laws(const CommandLine& line, const Setup& setup, const Json& keys, LawPage page) {
  Options options = setup.options;
  if (options.explain) {
    for (const LawVariant& law : page.laws) page.once(line_of(line, law, {}));
    return 0;
  }
  if (options.out.empty()) options.out = "out/" + line.experiment;
  Json all_keys = keys;
  all_keys["fabrics"] = setup.scene.fabric.name;
  for (const LawVariant& law : page.laws) all_keys["laws"].push_back(law.name);
  Run run(line, options, all_keys);
  std::vector<Finding> all;
  for (const LawVariant& law : page.laws) {
    Finding finding{law.name, {}, {}};
    try {
      finding.outcome = page.once(line_of(line, law, run.folder()));
    } catch (const Error& error) {
      if (error.exit_code() == 1) throw;
      finding.failed = error.what();
    }
    run.progress(law.name + ": " + (finding.failed.empty() ? finding.outcome.caption : finding.failed));
    all.push_back(std::move(finding));
    write_table(run, all);
  }
  if (!options.no_images) draw(run, page, all);
  run.path("report.html");
  run.finish();
  write_report(run.folder());
  return 0;
}

}  // namespace hysteron::experiments
