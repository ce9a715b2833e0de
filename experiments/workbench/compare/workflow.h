// Runs of this program as a Snakemake workflow: jobs that know nothing of each other, and what is made of
// all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::experiments {

// What a scheduler is told of a job.
struct JobResources {
  int cores = 1;
  int memory = 1000;  // [MB]
  int gpus = 0;
  int minutes = 60;  // of wall clock
};

struct WorkflowJob {
  std::string name;  // of its mark, OUT/jobs/NAME
  std::vector<std::string>
      words;  // of its command line after the program's name; kThreads: the cores it gets
  JobResources resources;
};
inline constexpr const char* kThreads = "{threads}";

struct Workflow {
  std::filesystem::path out;
  std::vector<WorkflowJob> jobs;
  std::string product;                // file of OUT that stands for the whole
  std::vector<std::string> collects;  // words that write it, after all jobs
};

// FOLDER/Snakefile and FOLDER/slurm/config.yaml, as in assets/snakemake, and FOLDER/config.json, what they
// are asked for.  The jobs run this program in this working folder.  Throws Error::system.
void write_workflow(const std::filesystem::path& folder, const Workflow& workflow);

// "cd FOLDER && snakemake ...": how it is started.
std::string starting_words(const std::filesystem::path& folder);

}  // namespace hysteron::experiments
