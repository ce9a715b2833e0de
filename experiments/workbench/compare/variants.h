// What a comparison compares: one experiment under each of several laws, with each of several fabrics or
// integrators.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// What differs from the line: a law, a fabric, further flags.
struct Variant {
  std::string name;
  std::vector<Flag> flags;
};

// What --fabric, --law and --integrator name, each `all` or names separated by commas: every combination of
// them. A name may carry further keys for itself: "linear+fabric.damping=1e-3".  One variant, without a name
// where nothing is named, where none is a list.  Throws Error::invalid_input where two are the same.
std::vector<Variant> named_variants(const CommandLine& line);
// Of a variant that a list calls so, and of its folder: files go by their stems, "../mine/wool.toml" by
// "wool".
std::string column_name(const std::string& text);
// The same name where a file system takes it; a longer one is cut, and told apart by a hash of the whole.
std::string folder_name(const std::string& name);
// The one key in which they differ: "law", "fabric", "integrator"; "column" where it is several.
std::string varied_key(const std::vector<Variant>& variants);
// The flags and behind them the later ones, which take the place of those that set the same.
std::vector<Flag> with_later(std::vector<Flag> flags, const std::vector<Flag>& later);
// The line of that variant.
CommandLine with_variant(CommandLine line, const Variant& variant);
// The line without lists: what the page itself is set up with.
CommandLine without_lists(const CommandLine& line);
bool lists_fabrics(const CommandLine& line);

// The flag --camera.box of what the cloth of any variant passes through; none where the experiment frames all
// alike, the line draws no pictures, or says itself what they frame.
std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants);

// Flags of columns whose pictures are cells of a page: without letters and, where they show cloth and the
// line does not say otherwise, on white.
std::vector<Flag> for_sheets(const CommandLine& line);

}  // namespace hysteron::experiments
