// Lists the variants of a comparison: one experiment under each of several laws, with each of several fabrics
// or integrators.
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// The differences of a variant from the line: a law, a fabric, further flags.
struct Variant {
  std::string name;
  std::vector<Flag> flags;
};

// Returns every combination of what --fabric, --law and --integrator name, each `all` or names separated by
// commas.  A name may have further keys of its own: "linear+fabric.damping=1e-3".  If nothing is a list there
// is one variant, without a name if nothing is named.  Throws Error::invalid_input if two are the same.
std::vector<Variant> named_variants(const CommandLine& line);
// Returns the name of a variant and of its folder: files go by their stems, "../mine/wool.toml" by "wool".
std::string column_name(const std::string& text);
// Returns the name if a file system allows it; a longer one is cut, and made distinct by a hash of the whole.
std::string folder_name(const std::string& name);
// Returns the one key in which they differ: "law", "fabric", "integrator"; "column" if there are several.
std::string varied_key(const std::vector<Variant>& variants);
// Returns the flags and behind them the later ones, which replace those of the same key.
std::vector<Flag> override_flags(std::vector<Flag> flags, const std::vector<Flag>& later);
// Returns the line of that variant.
CommandLine with_variant(CommandLine line, const Variant& variant);
// `without_lists` returns the line without lists, with which the page itself is set up.
CommandLine without_lists(const CommandLine& line);
bool lists_fabrics(const CommandLine& line);

// Returns the flag --camera.box around everything that the cloth of any variant passes through; none if the
// experiment frames all alike, or if the line draws no pictures or sets what they frame.
std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants);

// Returns the flags of columns whose pictures are cells of a page: without text and, if they show cloth and
// the line does not override it, on white.
std::vector<Flag> for_sheets(const CommandLine& line);

}  // namespace hysteron::experiments
