// A page that compares laws: one experiment under each of them, in folders of their names.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/run.h"
#include "render/image.h"
#include "render/plot.h"

namespace hysteron::experiments {

// What came of one law.
struct LawOutcome {
  std::string caption;                                  // its name and numbers, below its picture
  std::vector<std::pair<std::string, double>> numbers;  // by metric; the same ones for every law
  std::vector<render::Series> series;                   // one for each of the page's plots
  std::optional<render::Image> picture;
};

// A law, or the law with further flags under a name of its own.
struct LawVariant {
  std::string name;
  std::vector<Flag> flags;
};

struct LawPage {
  std::string title;
  std::vector<LawVariant> laws;
  std::vector<std::pair<std::string, render::Plot>> plots;  // by file name, still without series
  std::function<LawOutcome(const CommandLine&)> once;       // the experiment, under the line's law
};

// The laws that --law names: `all`, or names apart by commas; one name that is not `all` is one entry.
std::vector<LawVariant> laws_of(const CommandLine& line);

// Runs the page: OUT/<law>/ as the experiment alone would write it; table.csv, sheet.png and the plots for
// all, each number as the metric <law>.<name>.  A law whose run cannot go on has its message in the table.
// `keys`: what else the manifest keeps.  Returns the exit code.
int compare_laws(const CommandLine& line, const Setup& setup, const Json& keys, LawPage page);

}  // namespace hysteron::experiments
