#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/report.h"
#include "tests/fuzz/formats.h"

namespace hysteron::fuzz {
namespace {
namespace fs = std::filesystem;

// File systems write one that is overwritten to the disk at once.
void copy_anew(const fs::path& file, const fs::path& copy) {
  fs::remove(copy);
  fs::copy_file(file, copy);
}

// Makes a run's folder beside the file, with a copy of it under a name of its own.
fs::path placed(const fs::path& file, const char* name) {
  const fs::path folder = file.parent_path() / "results" / "run";
  fs::create_directories(folder);
  copy_anew(file, folder / name);
  return folder;
}

// A whole manifest stands beside tables.
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
            copy_anew(kManifest, placed(file, "table.csv") / "manifest.json");
            experiments::report_page(placed(file, "metrics.csv"));
            experiments::gallery_page(file.parent_path() / "results");
          }}};
}

}  // namespace

std::vector<Format> pages() { return {page(), table()}; }

}  // namespace hysteron::fuzz
