#include "experiments/report/marked_numbers.h"

#include <algorithm>

#include "experiments/report/number_source.h"
#include "experiments/workbench/pages/pictures.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kOpen = "<!-- n: ", kClose = " -->", kEnd = "<!-- /n -->";

// A Markdown file with the numbers that it should have.
struct Current {
  fs::path file;
  std::string text;
  std::vector<StaleNumber> stale;
};

// "." and ".." by their names; others as they were given, so that messages read well.
fs::path named(const fs::path& folder) {
  return folder.filename() == "." || folder.filename() == ".." ? fs::canonical(folder) : folder;
}

std::vector<fs::path> pages_in(const fs::path& root) {
  std::vector<fs::path> pages;
  if (is_there(root / "README.md")) pages.push_back(root / "README.md");
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(root / "docs", none))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [in_folder, in_path] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return in_folder == folder.end();
}

Current current(const fs::path& file, const fs::path& root, const fs::path& results) {
  Current page{file, whole_file(file, "cannot read " + file.string()), {}};
  std::string& text = page.text;
  int line = 1;
  std::size_t counted = 0;
  for (std::size_t at = 0; (at = text.find(kOpen, at)) != text.npos;) {
    line += static_cast<int>(std::count(text.begin() + counted, text.begin() + at, '\n'));
    counted = at;
    const std::string place = file.string() + ":" + std::to_string(line) + ": ";
    const std::size_t last = std::min(text.find('\n', at), text.size()), source = at + kOpen.size();
    const std::size_t close = text.find(kClose, source), number = close + kClose.size();
    const std::size_t end = close < last ? text.find(kEnd, number) : text.npos;
    if (end >= last)
      throw Error::request(place +
                           "a number that opens with <!-- n: must end with <!-- /n --> in the same line");
    if (text.find_first_not_of(" \n", text.rfind('\n', at) + 1) == at)
      throw Error::request(place + "a line must not begin with <!--, which ends a paragraph of Markdown");
    const std::string words = text.substr(source, close - source), found = text.substr(number, end - number);
    try {
      at = number;
      if (!is_below((root / path_in(words)).lexically_normal(), results)) continue;
      const std::string expected = number_from(words, root);
      if (expected != found) page.stale.push_back({file, line, expected, found});
      text.replace(number, end - number, expected);
    } catch (const Error& error) {
      throw Error::request(place + words + ": " + error.what());
    }
  }
  return page;
}

std::vector<Current> current_pages(const fs::path& results) {
  const fs::path folder = named(results);
  std::vector<Current> pages;
  for (const fs::path& file : pages_in(folder.parent_path()))
    pages.push_back(current(file, folder.parent_path(), folder));
  return pages;
}

}  // namespace

std::vector<StaleNumber> stale_numbers(const fs::path& results) {
  std::vector<StaleNumber> stale;
  for (const Current& page : current_pages(results))
    stale.insert(stale.end(), page.stale.begin(), page.stale.end());
  return stale;
}

std::vector<fs::path> write_numbers(const fs::path& results) {
  std::vector<fs::path> written;
  for (const Current& page : current_pages(results)) {
    if (page.stale.empty()) continue;
    AtomicFile file(page.file.string());
    file.stream() << page.text;
    file.commit();
    written.push_back(page.file);
  }
  return written;
}

}  // namespace hysteron::experiments
