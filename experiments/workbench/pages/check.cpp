#include "experiments/workbench/pages/check.h"

#include <algorithm>
#include <optional>

#include "experiments/workbench/pages/gallery.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pages/page.h"
#include "experiments/workbench/pages/pictures.h"
#include "experiments/workbench/pages/report.h"
#include "render/image.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

const std::string kPicture = "data:image/png;base64,";

// A page without its embedded pictures, and those.
struct Parts {
  std::string text;
  std::vector<std::string> pictures;  // base64
};

Parts parts_of(const std::string& page) {
  Parts parts;
  std::size_t at = 0;
  for (std::size_t found; (found = page.find(kPicture, at)) != page.npos;) {
    const std::size_t begin = found + kPicture.size(), end = std::min(page.find('"', begin), page.size());
    parts.text.append(page, at, begin - at);
    parts.pictures.push_back(page.substr(begin, end - begin));
    at = end;
  }
  parts.text.append(page, at);
  return parts;
}

bool same_pixels(const std::string& a, const std::string& b) {
  if (a == b) return true;
  try {
    return render::decode_png(from_base64(a), "a page") == render::decode_png(from_base64(b), "a page");
  } catch (const Error&) {
    return false;  // no picture any more
  }
}

std::optional<std::string> text_of(const fs::path& file) {
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
  if (failure) throw Error::machine("cannot read the folder " + folder.string() + ": " + failure.message());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

bool same_page(const std::string& a, const std::string& b) {
  if (a == b) return true;
  const Parts mine = parts_of(a), other = parts_of(b);
  return mine.text == other.text && std::equal(mine.pictures.begin(), mine.pictures.end(),
                                               other.pictures.begin(), other.pictures.end(), same_pixels);
}

std::vector<StalePage> stale_pages(const fs::path& folder) {
  std::vector<StalePage> stale;
  const auto check = [&](const fs::path& of, const char* name, const std::string& page) {
    const std::optional<std::string> written = text_of(of / name);
    if (!written || !same_page(*written, page)) stale.push_back({of / name, of, !written});
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
