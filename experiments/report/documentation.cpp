#include "experiments/report/documentation.h"

#include <algorithm>

#include "experiments/report/key_tables.h"
#include "experiments/report/linked_numbers.h"
#include "experiments/report/table_blocks.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::vector<fs::path> pages_in(const fs::path& folder) {
  std::vector<fs::path> pages;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  if (failure) throw Error::system("cannot read the folder " + folder.string() + ": " + failure.message());
  std::sort(pages.begin(), pages.end());
  return pages;
}

// Behind the fenced block, the comment or the code span that begins at `at`; `at` if none does.
std::size_t end_of_code(const std::string& text, std::size_t at) {
  std::string close = text.compare(at, 4, "<!--") == 0 ? "-->" : "";
  std::size_t inside = at + 4;
  if (text[at] == '`') {
    inside = std::min(text.find_first_not_of('`', at), text.size());
    close = text.substr(at, inside - at);
    if (close.size() >= 3) close = "\n" + close;
  }
  const std::size_t end = close.empty() ? text.npos : text.find(close, inside);
  return end == text.npos ? std::max(at, close.empty() ? at : inside) : end + close.size();
}

}  // namespace

int line_at(const std::string& text, std::size_t place) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + place, '\n'));
}

std::string without_code(const std::string& text) {
  std::string prose = text;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_code(text, at);
    for (std::size_t i = at; i < end; ++i)
      if (prose[i] != '\n') prose[i] = ' ';
    at = std::max(end, at + 1);
  }
  return prose;
}

bool is_documentation(const fs::path& folder) {
  const std::vector<fs::path> pages = pages_in(folder);
  return std::any_of(pages.begin(), pages.end(),
                     [](const fs::path& page) { return page.filename() != "README.md"; });
}

std::vector<Page> documentation(const fs::path& folder) {
  std::vector<fs::path> files = pages_in(folder);
  const fs::path readme = (folder / ".." / "README.md").lexically_normal();
  if (fs::exists(readme)) files.insert(files.begin(), readme);
  std::vector<Page> pages;
  for (const fs::path& file : files) {
    Page page{file, whole_file(file, "cannot read " + file.string()), {}};
    write_numbers(page);  // first, since tables may move lines
    write_tables(page);
    write_keys(page);
    std::stable_sort(page.faults.begin(), page.faults.end(),
                     [](const Fault& a, const Fault& b) { return a.line < b.line; });
    pages.push_back(std::move(page));
  }
  return pages;
}

}  // namespace hysteron::experiments
