// How much relief is seen of a part of the cloth in pictures of a run's folder.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/workbench/app/experiment.h"

namespace hysteron::experiments {

struct Kept;

// `render DIR --render.part NAME`: the local deviation of lightness (render/local_deviation.h) where the part
// that the metric NAME of the run's scene is measured on is seen, at the last kept instant that is not after
// the metric's `from` (else the first one), at the ends of cycles and at the end; lightness.csv and the
// pictures with what is beside the part faded, part-0.png, ....  Looks and light are those of the line.
// Throws Error::invalid_input for a page of several runs, a name that is no metric with a part, cloth that is
// not the kept one, and where the pictures show too little of the part.
void draw_part_relief(const CommandLine& line, const std::filesystem::path& file, const Kept& kept,
                      Setup setup, const std::string& name);

}  // namespace hysteron::experiments
