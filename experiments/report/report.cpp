// `hysteron report` writes a page on a run's folder, or on a folder of runs.
#include <algorithm>
#include <iostream>

#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run_files.h"
#include "experiments/workbench/app/run_folder.h"
#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct ReportFlags {
  bool check = false, self_contained = false;
};

// clang-format off
const KeyRow<ReportFlags> kRows[] = {
    {"check", at<&ReportFlags::check>, "", any(), "write nothing; exit 4 if DIR's page or a report.html below it is missing or stale"},
    {"self-contained", at<&ReportFlags::self_contained>, "", any(), "embed pictures instead of linking them: a page that can be sent alone"},
};
// clang-format on

// Returns "results/" as "results", so that messages and paths read well.
fs::path named_folder(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  const fs::path folder = path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw Error::invalid_input("no folder " + name);
  return folder;
}

int check(const fs::path& folder) {
  const std::vector<StalePage> stale = stale_pages(folder);
  for (const StalePage& page : stale) {
    std::cerr << "hysteron report: " << page.page.string()
              << (page.missing ? " is missing; write it" : " is not what its folder says now; write it again")
              << ": hysteron report " << page.folder.string() << std::endl;
  }
  return stale.empty() ? 0 : kDiffers;
}

void write(const fs::path& folder, PageForm form) {
  const bool of_a_run = has_manifest(folder);
  require_own_file(folder / (of_a_run ? "report.html" : "index.html"), kOwnPage, "a page", "");
  if (of_a_run) {
    const FolderLock still(folder);  // an unfinished run will write this page itself
    std::cout << write_report(folder, form).string() << std::endl;
  } else {
    std::cout << write_gallery(folder, form).string() << std::endl;
  }
}

int run_report(const CommandLine& line) {
  ReportFlags flags;
  set_keys(line, bind(kRows, flags));
  if (line.positionals.empty())
    throw Error::invalid_input("needs the folder of a run or of runs: hysteron report DIR");
  if (flags.check && flags.self_contained)
    throw Error::invalid_input("--check is of pages that link their pictures: leave out --self-contained")
        .with_key("self-contained", "true");
  const PageForm form = flags.self_contained ? PageForm::self_contained : PageForm::linked;
  int exit_code = 0;
  for (const std::string& name : line.positionals) {
    const fs::path folder = named_folder(name);
    if (flags.check)
      exit_code = std::max(exit_code, check(folder));
    else
      write(folder, form);
  }
  return exit_code;
}

}  // namespace

Experiment report() {
  return {
      .name = "report",
      .question = "write a run's folder as one page, report.html; a folder of runs as a gallery, index.html",
      .run = run_report,
      .own_keys = own_key_descriptions<kRows>,
      .positionals = "DIR",
      .differs = "what is checked is missing or stale (--check)"};
}

}  // namespace hysteron::experiments
