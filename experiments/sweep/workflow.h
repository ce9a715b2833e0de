// A study as a Snakemake workflow: a job for each run or for a few, and one that makes the table.
#pragma once

#include <filesystem>

#include "experiments/sweep/study.h"

namespace hysteron::experiments {

// FOLDER/Snakefile and FOLDER/slurm/config.yaml, as in assets/snakemake; FOLDER/config.json, what they are
// asked for, and FOLDER/runs.txt, a name a line.  The jobs run this program in this working folder and write
// to `out`.  Throws Error::machine.
void write_workflow(const std::filesystem::path& folder, const Study& study,
                    const std::filesystem::path& out);

}  // namespace hysteron::experiments
