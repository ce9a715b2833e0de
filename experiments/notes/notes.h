// Notes are the last lines of a run on the terminal, like a compiler's: they say what its result means and
// what to do next.  They are made from the manifest alone, change no file and are absent with --quiet and
// --json.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

inline constexpr std::size_t kMostNotes = 3;  // most users read no more

using Notes = std::vector<std::string>;  // the most important first

// Returns at most kMostNotes notes, a line each; none if there is nothing to say.
Notes notes_on(const Manifest& manifest);

// Formats "note: without --errors ..." for each note on the run in that folder.
std::string closing_notes(const std::filesystem::path& folder);

// Returns an option of the run or of its experiment, such as "drape.disc"; 0 if there is none.
double option_number(const Manifest& manifest, const std::string& path);

// True if the metric exists and is a number.
bool has_number(const Manifest& manifest, const std::string& metric);

// Returns those of the fabric's `keys` whose numbers its file calls assumed, in this order.
std::vector<std::string> assumed_of(const Manifest& manifest, const std::vector<std::string>& keys);

// Joins words: "k0", "k0 and shear", "k0, shear and bias-bending".
std::string enumerated(const std::vector<std::string>& names);

// True if only friction keeps a deformation: the fabric has no permanent set and no relaxing branch.
bool has_friction_alone(const Manifest& manifest);

// Returns a note on the errors of a metric that --errors can measure, with `name` in words: that they are
// unknown, or which of them is the largest and how to reduce it.  "" if the run has no such number.
std::string errors_note(const Manifest& manifest, const std::string& metric, const std::string& name);

// Each of these notes on one experiment, without a limit on their number.
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
