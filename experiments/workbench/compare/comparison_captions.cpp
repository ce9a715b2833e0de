#include "experiments/workbench/compare/comparison_captions.h"

#include <algorithm>
#include <filesystem>

#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/pages/gallery_about.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/simulated_run.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// "" of a metric that no page shows.
std::string metric_meaning(const std::string& metric) {
  for (const ShownNumber& number : shown_numbers())
    if (number.metric == metric) return number.meaning;
  return "";
}

// In the order in which they are shown, those that a column shows.
std::string numbers_text(const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  std::string text;
  for (const std::string& key : shown_metrics(columns, page.metrics)) {
    const std::string meaning = metric_meaning(key);
    text += (text.empty() ? "Numbers behind the names: " : "; ") + split_unit(key).text() +
            (meaning.empty() ? "" : ", " + meaning);
  }
  return text.empty() ? "" : text + "; all others are in table.csv.";
}

std::string rows_text(const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  std::string text;
  for (const std::string& instant : shown_instants(page, columns))
    text += (text.empty() ? "" : "; ") + instant;
  text = "Rows: " + text + " (each column's picture nearest to that time, in look " + page.look +
         ", from one camera).";
  if (page.to >= 0) {
    const std::string& to = columns[static_cast<std::size_t>(page.to)].name;
    text += page.curvature ? " Below each, its curvature less that of " + to +
                                 " at the same vertex and instant, on its own shape; its root mean square."
                           : " Below each, its difference to " + to + ", in colours.";
  }
  if (page.outlines && columns.size() < 5)
    text += " Last column: the outlines of all, laid over each other, in the columns' colours.";
  for (const ChildRun& c : columns)
    for (const Curve& curve : c.manifest ? c.manifest->curves : std::vector<Curve>{})
      if (curve.plot.starts_with("plot_probe1_moment"))
        return text +
               " In the corners moment M against curvature κ at the probed place up to this instant, "
               "a dot where it is now; in grey that of prandtl.";
  return text;
}

std::string columns_text(const std::vector<ChildRun>& columns) {
  std::string text;
  for (const ChildRun& c : columns)
    text += (text.empty() ? "Columns: " : ", ") + c.name +
            (c.stopped.empty() ? "" : " (stopped: " + c.stopped + ")");
  return text + ".";
}

std::string facts_text(const std::vector<ChildRun>& columns) {
  std::vector<std::string> names;
  std::vector<const Manifest*> manifests;
  for (const ChildRun& c : columns)
    if (c.manifest) names.push_back(c.name), manifests.push_back(&*c.manifest);
  return run_facts(names, manifests);
}

// "plot_tip_height.png" is "tip height".
std::string plotted(const std::string& stem) {
  std::string what = split_unit(stem.substr(std::string("plot_").size())).name;
  std::replace(what.begin(), what.end(), '_', ' ');
  return what;
}

// What a plot shows: the runs' own words for their curves, the meaning of a metric, or a series.
std::string shown_in(const std::string& stem, const ComparisonPage& page,
                     const std::vector<ChildRun>& columns) {
  for (const ChildRun& c : columns)
    if (c.manifest)
      for (const Curve& curve : c.manifest->curves)
        if (curve.plot == stem) return curve.caption;
  const std::string metric = stem.substr(std::string("plot_").size()), meaning = metric_meaning(metric);
  if (!meaning.empty()) return "A bar for each column: " + meaning + ".";
  if (std::count(page.metrics.begin(), page.metrics.end(), metric))
    return "A bar for each column: " + plotted(stem) + ".";
  return first_upper(plotted(stem)) + " against time, a line for each column.";
}

}  // namespace

void write_comparison_captions(Run& run, const ComparisonPage& page, const std::string& experiment,
                               const std::string& command, const std::vector<ChildRun>& columns) {
  std::vector<FigureCaption> figures = {
      {"sheet.png", page.title,
       joined({first_upper(experiment_question(experiment)) + ".", columns_text(columns),
               rows_text(page, columns), numbers_text(page, columns), joined(page.notes, " "),
               facts_text(columns),
               origin_words(command, columns.front().manifest ? &*columns.front().manifest : nullptr)},
              " ")}};
  std::vector<std::string> plots;
  for (const fs::path& file : files_ending(run.folder(), ".png"))
    if (is_plot(file)) plots.push_back(file.stem().string());
  for (const std::string& stem : plots) {
    figures.push_back({stem + ".png", page.title + ": " + plotted(stem),
                       joined({shown_in(stem, page, columns), columns_text(columns),
                               "Runs, numbers and command are those of sheet.png."},
                              " ")});
  }
  write_captions(run.path("README.md"), page.title,
                 "What the figures of this folder show, in words from the runs' manifests.", figures);
}

}  // namespace hysteron::experiments
