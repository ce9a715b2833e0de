// A page that compares: one experiment under each of several laws, with each of several fabrics or
// integrators, in folders of their names.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/workbench/app/run.h"
#include "render/image.h"
#include "render/plot.h"

namespace hysteron::experiments {

// What came of one variant.
struct LawOutcome {
  std::string caption;                                  // its numbers, below its picture after its name
  std::vector<std::pair<std::string, double>> numbers;  // by metric; the same ones for every law
  std::vector<render::Series> series;                   // one for each of the page's plots
  std::optional<render::Image> picture;
};

// What differs from the line: a law, a fabric, further flags.
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

// What --fabric, --law and --integrator name, each `all` or names apart by commas: every combination of them.
// A name may carry further keys for itself: "linear+fabric.damping=1e-3". One variant, without a name where
// nothing is named, where none is a list.  Throws Error::request where two are the same.
std::vector<LawVariant> variants_of(const CommandLine& line);
// Of a variant that a list calls so, and of its folder: files go by their stems, "../mine/wool.toml" by
// "wool".
std::string column_name(const std::string& text);
// The one key in which they differ: "law", "fabric", "integrator"; "column" where it is several.
std::string varied_of(const std::vector<LawVariant>& variants);
// The flags and behind them the later ones, which take the place of those that set the same.
std::vector<Flag> with_later(std::vector<Flag> flags, const std::vector<Flag>& later);
// The line without lists: what the page itself is set up with.
CommandLine without_lists(const CommandLine& line);

// "what, fabric", or "what" where fabrics are listed.
std::string page_title(const std::string& what, const CommandLine& line, const Setup& setup);

// Runs the page: OUT/<law>/ as the experiment alone would write it; table.csv, sheet.png and the plots for
// all, each number as the metric <law>.<name>.  A law whose run cannot go on has its message in the table.
// `keys`: what else the manifest keeps.  Returns the exit code.
int compare_laws(const CommandLine& line, const Setup& setup, const Json& keys, LawPage page);

}  // namespace hysteron::experiments
