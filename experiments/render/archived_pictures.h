// Draws pictures and sheet of a run's or a recorded folder again from the geometry that it keeps.
#pragma once

#include <filesystem>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// Returns the file if the line names one folder that keeps geometry and has no meshes beside it, or such a
// file itself; "" otherwise.
std::filesystem::path archived_geometry_file(const CommandLine& line);

// Draws the file into the line's folder; flags override what the run was drawn with.  A comparison's columns
// are drawn into folders of their own, then its sheet.  Throws Error::invalid_input for a damaged file and
// for looks whose values it does not keep, otherwise what Pictures throws.
void draw_archived(const CommandLine& line, const std::filesystem::path& file);

}  // namespace hysteron::experiments
