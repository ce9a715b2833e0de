// Writes runs of this program as a Snakemake workflow: independent jobs, and what is made of all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// A job's resources for a scheduler.
struct JobResources {
  int cores = 1;
  int memory = 1000;  // [MB]
  int gpus = 0;
  int minutes = 60;  // limit of wall clock [min]
};

struct WorkflowJob {
  std::string name;  // name of its mark, OUT/jobs/NAME
  std::vector<std::string>
      words;  // command line after the program's name; kThreads stands for the cores it gets
  JobResources resources;
};
inline constexpr const char* kThreads = "{threads}";

struct Workflow {
  std::filesystem::path out;
  std::vector<WorkflowJob> jobs;
  std::string product;                // file of OUT that represents the whole
  std::vector<std::string> collects;  // words that write it, after all jobs
};

// Writes FOLDER/Snakefile and FOLDER/slurm/config.yaml, as in assets/snakemake, and their configuration
// FOLDER/config.json.  The jobs run this program in this working folder.  Throws Error::system.
void write_workflow(const std::filesystem::path& folder, const Workflow& workflow);

// Returns the command that starts it: "cd FOLDER && snakemake ...".
std::string starting_text(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
