// `hysteron report`: a run's folder, or a folder of runs, as one page; what documentation takes from runs and
// from the tables of keys.
#include <iostream>

#include "experiments/report/key_tables.h"
#include "experiments/report/marked_numbers.h"
#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/app/run_folder.h"
#include "experiments/workbench/pages/check.h"
#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

struct ReportFlags {
  bool check = false, self_contained = false;
};

// clang-format off
const KeyRow<ReportFlags> kRows[] = {
    {"check", at<&ReportFlags::check>, "", any(), "", "write nothing; exit 4 if DIR's page, a report.html below it, a number that the documentation beside it takes from it, or a table of keys is missing or stale"},
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

std::ostream& complain() { return std::cerr << "hysteron report: "; }

bool are_pages_stale(const fs::path& folder) {
  const std::vector<StalePage> stale = stale_pages(folder);
  for (const StalePage& page : stale) {
    complain() << page.page.string()
               << (page.missing ? " is missing; write it"
                                : " is not what its folder says now; write it again")
               << ": hysteron report " << page.folder.string() << std::endl;
  }
  return !stale.empty();
}

bool are_numbers_stale(const fs::path& results) {
  const std::vector<StaleNumber> stale = stale_numbers(results);
  for (const StaleNumber& number : stale) {
    complain() << number.file.string() << ":" << number.line << ": \"" << number.found << "\" must be \""
               << number.expected << "\"; write it again: hysteron report " << results.string() << std::endl;
  }
  return !stale.empty();
}

bool are_keys_stale(const fs::path& folder, const std::vector<KeyPage>& pages) {
  bool any = false;
  for (const KeyPage& page : pages) {
    if (!page.stale) continue;
    complain() << page.file.string()
               << ": its tables of keys or exit codes are not what --help says now; write them again: "
               << "hysteron report " << folder.string() << std::endl;
    any = true;
  }
  return any;
}

int check(const fs::path& folder) {
  const std::vector<KeyPage> documentation = key_pages(folder);
  if (!documentation.empty()) return are_keys_stale(folder, documentation) ? kDiffers : 0;
  const bool pages = are_pages_stale(folder), numbers = !has_manifest(folder) && are_numbers_stale(folder);
  return pages || numbers ? kDiffers : 0;
}

void write_keys(const std::vector<KeyPage>& documentation) {
  for (const KeyPage& page : documentation) {
    AtomicFile file(page.file.string());
    file.stream() << page.text;
    file.commit();
    std::cout << page.file.string() << std::endl;
  }
}

void write(const fs::path& folder, PageForm form) {
  const std::vector<KeyPage> documentation = key_pages(folder);
  if (!documentation.empty()) return write_keys(documentation);
  if (has_manifest(folder)) {
    const FolderLock still(folder);  // a run that is not over writes this page itself
    std::cout << write_report(folder, form).string() << std::endl;
    return;
  }
  std::cout << write_gallery(folder, form).string() << std::endl;
  for (const fs::path& page : write_numbers(folder)) std::cout << page.string() << std::endl;
}

int run_report(const CommandLine& line) {
  ReportFlags flags;
  set_keys(line, bind(kRows, flags));
  if (line.names.empty()) throw Error::request("needs the folder of a run or of runs: hysteron report DIR");
  if (flags.check && flags.self_contained)
    throw Error::request("--check is of pages that link their pictures: leave out --self-contained")
        .of("self-contained", "true");
  const PageForm form = flags.self_contained ? PageForm::self_contained : PageForm::linked;
  int exit_code = 0;
  for (const std::string& name : line.names) {
    const fs::path folder = folder_of(name);
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
      .question =
          "write a run's folder as one page, report.html; a folder of runs as a gallery, index.html, and "
          "its numbers in the README.md and docs/ beside it; the tables of keys in a folder of documentation",
      .run = run_report,
      .own_keys = own_keys_of<kRows>,
      .names = "DIR",
      .differs = "what is checked is missing or stale (--check)"};
}

}  // namespace hysteron::experiments
