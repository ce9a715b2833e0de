#include "experiments/sweep/workflow.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/scene/assets.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

void make(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw Error::machine("cannot create the folder " + folder.string() + ": " + failure.message());
}

}  // namespace

void write_workflow(const fs::path& folder, const Study& study, const fs::path& out) {
  make(folder / "slurm");
  const fs::path shipped = assets_folder() / "snakemake";
  for (const char* name : {"Snakefile", "slurm/config.yaml"})
    write_text(folder / name, whole_file(shipped / name, "cannot read " + (shipped / name).string()));
  const auto all = static_cast<int>(study.runs.size());
  const int jobs = (all + study.resources.runs - 1) / study.resources.runs;
  const Json config = {{"hysteron", fs::read_symlink("/proc/self/exe").string()},
                       {"working_folder", fs::current_path().string()},
                       {"study", fs::absolute(study.file).string()},
                       {"out", fs::absolute(out).lexically_normal().string()},
                       {"jobs", jobs},
                       {"cores", study.resources.cores},
                       {"memory_mb", study.resources.memory},
                       {"gpus", study.resources.gpus},
                       {"minutes", study.resources.minutes}};
  write_text(folder / "config.json", config.dump(2) + "\n");
  std::cout << all << " runs in " << jobs << " jobs: cd " << folder.string()
            << " && snakemake --cores all --keep-going --rerun-incomplete, or snakemake --profile slurm\n";
}

}  // namespace hysteron::experiments
