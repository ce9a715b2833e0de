#include "experiments/workbench/pages/check.h"

#include <algorithm>
#include <optional>

#include "experiments/workbench/app/manifest_file.h"
#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::optional<std::string> page_text(const fs::path& file) {
  if (!is_there(file)) return std::nullopt;
  return whole_file(file, "cannot read " + file.string());
}

// Folders below this one with a report.html, by name.
std::vector<fs::path> reports_below(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, failure)) {
    if (entry.path().filename() == "report.html" && entry.path().parent_path() != folder)
      found.push_back(entry.path().parent_path());
  }
  if (failure) throw Error::system("cannot read the folder " + folder.string() + ": " + failure.message());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<StalePage> stale_pages(const fs::path& folder) {
  std::vector<StalePage> stale;
  const auto check = [&](const fs::path& of, const char* name, const std::string& page) {
    const std::optional<std::string> written = page_text(of / name);
    if (!written || *written != page) stale.push_back({of / name, of, !written});
  };
  if (has_manifest(folder)) {
    check(folder, "report.html", report_page(folder));
  } else {
    check(folder, "index.html", gallery_page(folder));
  }
  for (const fs::path& run : reports_below(folder)) check(run, "report.html", report_page(run));
  return stale;
}

}  // namespace hysteron::experiments
