// The last lines of a run on the terminal: what its result means and what to do next, as a compiler's notes
// say it.  They are made from the manifest alone, change no file and are absent with --quiet and --json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

inline constexpr std::size_t kMostNotes = 3;  // more are not read

using Notes = std::vector<std::string>;  // the most important first

// At most kMostNotes of them, a line each; none where there is nothing to say.
Notes notes_on(const Manifest& manifest);

// "note: without --errors ..." for each of them, of the run in that folder.
std::string closing_notes(const std::filesystem::path& folder);

// An option of the run or of its experiment, "drape.disc"; 0 where it has none.
double option_number(const Manifest& manifest, const std::string& path);

// Whether a metric is there and a number.
bool has_number(const Manifest& manifest, const std::string& metric);

// Keys of the fabric whose numbers its file calls assumed, of these, in this order.
std::vector<std::string> assumed_of(const Manifest& manifest, const std::vector<std::string>& keys);

// "k0", "k0 and shear", "k0, shear and bias-bending".
std::string enumerated(const std::vector<std::string>& names);

// Whether the fabric has nothing but friction that keeps a deformation: no permanent set, no relaxing branch.
bool has_friction_alone(const Manifest& manifest);

// Of a metric that --errors can repeat, `name` in words: that its errors are not known, or which of them is
// the largest and what makes it smaller.  "" where the run has no such number.
std::string errors_note(const Manifest& manifest, const std::string& metric, const std::string& name);

// Notes on one experiment each, as many as there are.
Notes drape_notes(const Manifest& manifest);
Notes swing_notes(const Manifest& manifest);
Notes crease_notes(const Manifest& manifest);
Notes fold_notes(const Manifest& manifest);
Notes crumple_notes(const Manifest& manifest);
Notes cantilever_notes(const Manifest& manifest);
Notes buckle_notes(const Manifest& manifest);
Notes scene_notes(const Manifest& manifest);
Notes kes_notes(const Manifest& manifest);
Notes fit_notes(const Manifest& manifest);
Notes validate_notes(const Manifest& manifest);
Notes compare_notes(const Manifest& manifest);
Notes sweep_notes(const Manifest& manifest);

}  // namespace hysteron::experiments
