#include "experiments/workbench/compare/workflow.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/app/run_files.h"
#include "sim/base/atomic_file.h"
#include "sim/base/whole_file.h"
#include "sim/scene/assets.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// The files of a workflow, and a mark in each.
constexpr std::pair<const char*, const char*> kFiles[] = {{"Snakefile", "# Runs of hysteron as jobs"},
                                                          {"slurm/config.yaml", "# Snakemake's profile"},
                                                          {"config.json", "\"working_folder\""}};
}  // namespace

void write_workflow(const fs::path& folder, const Workflow& workflow) {
  for (const auto& [name, mark] : kFiles) require_own_file(folder / name, mark, "a workflow's", "snakemake");
  make_folders(folder / "slurm");
  const fs::path shipped = assets_folder() / "snakemake";
  for (const char* name : {"Snakefile", "slurm/config.yaml"})
    write_text(folder / name, whole_file(shipped / name));
  Json jobs = Json::object();
  for (const auto& [name, words, needs] : workflow.jobs)
    jobs[name] = {{"words", words},
                  {"cores", needs.cores},
                  {"memory_mb", needs.memory},
                  {"gpus", needs.gpus},
                  {"minutes", needs.minutes}};
  const Json config = {{"hysteron", fs::read_symlink("/proc/self/exe").string()},
                       {"working_folder", fs::current_path().string()},
                       {"out", fs::absolute(workflow.out).lexically_normal().string()},
                       {"product", workflow.product},
                       {"collects", workflow.collects},
                       {"jobs", jobs}};
  write_text(folder / "config.json", config.dump(1) + "\n");
}

std::string starting_text(const fs::path& folder) {
  return "cd " + folder.string() +
         " && snakemake --cores all --keep-going --rerun-incomplete, or snakemake --profile slurm";
}

}  // namespace hysteron::experiments
