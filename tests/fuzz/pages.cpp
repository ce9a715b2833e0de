#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/report.h"
#include "tests/fuzz/formats.h"

namespace hysteron::fuzz {
namespace {
namespace fs = std::filesystem;

// A run's folder beside the file, with a copy of it under a name of its own.
fs::path placed(const fs::path& file, const char* name) {
  const fs::path folder = file.parent_path() / "results" / "run";
  fs::create_directories(folder);
  fs::copy_file(file, folder / name, fs::copy_options::overwrite_existing);
  return folder;
}

// What stands beside tables: a manifest that is whole.
const fs::path kManifest = fs::path(HYSTERON_SEEDS) / "manifest" / "manifest.json";

Format page() {
  return {"page",
          "manifest",
          ".json",
          {[](const fs::path& file) { experiments::report_page(placed(file, "manifest.json")); },
           [](const fs::path& file) {
             placed(file, "again.json");
             experiments::gallery_page(file.parent_path() / "results");
           }}};
}

Format table() {
  return {"table", "csv", ".csv", {[](const fs::path& file) {
            fs::copy_file(kManifest, placed(file, "table.csv") / "manifest.json",
                          fs::copy_options::overwrite_existing);
            experiments::report_page(placed(file, "metrics.csv"));
            experiments::gallery_page(file.parent_path() / "results");
          }}};
}

}  // namespace

std::vector<Format> pages() { return {page(), table()}; }

}  // namespace hysteron::fuzz
