// Measures how much relief of a part of the cloth is seen in pictures of a run's folder.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

struct Archived;

// Implements `render DIR --render.part NAME`, where NAME is a metric of the run's scene that is measured on a
// part.  It computes the local deviation of lightness (render/local_deviation.h) where that part is seen, at
// the last kept instant that is not after the metric's `from` (else the first one), at the ends of cycles and
// at the end, and writes lightness.csv and the pictures with everything beside the part faded, part-0.png,
// ....  Looks and light are those of the line.  Throws Error::invalid_input for a page of several runs, a
// name that is no metric with a part, cloth that is not the kept one, and pictures that show too little of
// the part.
void draw_part_relief(const CommandLine& line, const std::filesystem::path& file, const Archived& kept,
                      Setup setup, const std::string& name);

}  // namespace hysteron::experiments
