// Pictures and sheet of a run's or a recorded folder, drawn again from what it keeps.
#pragma once

#include <filesystem>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

// "" unless the line names one folder that keeps geometry and has no meshes beside it, or such a file itself.
std::filesystem::path kept_geometry_file(const CommandLine& line);

// Draws it into the line's folder; flags win over what the run was drawn with.  A comparison's columns are
// drawn into folders of their own, then its sheet.  Throws Error::invalid_input for a damaged file and for
// looks whose values it does not keep, otherwise what Pictures throws.
void draw_kept(const CommandLine& line, const std::filesystem::path& file);

}  // namespace hysteron::experiments
