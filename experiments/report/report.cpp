// `hysteron report`: a run's folder, or a folder of runs, as one page.
#include <iostream>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/check.h"
#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// As of `hysteron diff`: two things that were compared are not the same.
constexpr int kStale = 4;

struct ReportFlags {
  bool check = false, self_contained = false;
};

// clang-format off
const KeyRow<ReportFlags> kRows[] = {
    {"check", at<&ReportFlags::check>, "", any(), "", "write nothing; exit 4 if DIR's page, or a report.html below it, is missing or stale"},
    {"self-contained", at<&ReportFlags::self_contained>, "", any(), "", "embed pictures instead of linking them: a page that can be sent alone"},
};
// clang-format on

// "results/" as "results", so that messages and paths read well.
fs::path folder_of(const std::string& name) {
  const fs::path path = fs::path(name).lexically_normal();
  const fs::path folder = path.has_filename() || !path.has_parent_path() ? path : path.parent_path();
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw Error::request("no folder " + name);
  return folder;
}

int check(const fs::path& folder) {
  const std::vector<StalePage> stale = stale_pages(folder);
  for (const StalePage& page : stale) {
    std::cerr << "hysteron report: " << page.page.string()
              << (page.missing ? " is missing; write it" : " is not what its folder says now; write it again")
              << ": hysteron report " << page.folder.string() << std::endl;
  }
  return stale.empty() ? 0 : kStale;
}

int run_report(const CommandLine& line) {
  ReportFlags flags;
  set_keys(line, bind(kRows, flags));
  if (line.names.empty()) throw Error::request("needs the folder of a run or of runs: hysteron report DIR");
  if (flags.check && flags.self_contained)
    throw Error::request("--check is of pages that link their pictures: leave out --self-contained");
  const PageForm form = flags.self_contained ? PageForm::self_contained : PageForm::linked;
  int exit_code = 0;
  for (const std::string& name : line.names) {
    const fs::path folder = folder_of(name);
    if (flags.check) {
      exit_code = std::max(exit_code, check(folder));
    } else {
      const bool one_run = has_manifest(folder);
      std::cout << (one_run ? write_report(folder, form) : write_gallery(folder, form)).string() << std::endl;
    }
  }
  return exit_code;
}

}  // namespace

Experiment report() {
  return {
      .name = "report",
      .question = "write a run's folder as one page, report.html; a folder of runs as a gallery, index.html",
      .run = run_report,
      .own_keys = own_keys_of<kRows>,
      .names = "DIR"};
}

}  // namespace hysteron::experiments
