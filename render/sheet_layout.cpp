#include "render/sheet_layout.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hysteron::render {
namespace {

constexpr double kTallest = 0.5, kWidest = 3, kPleasant = 1.5;  // least, largest and best aspect of a page
constexpr int kScaleLines = 3;  // lines of a row's scale: a blank one, its bar, its length
constexpr const char* kBetween = " · ";

bool cuts_a_name(const ComparisonSheet& sheet, float letters, int cell_width) {
  for (const ComparisonColumn& column : sheet.columns)
    for (const std::string& line : name_lines(column, letters, cell_width))
      if (mark_width(column, letters) + text_width(line, letters) > static_cast<float>(cell_width))
        return true;
  return false;
}

// Returns the width of the widest caption [pixels]: a mark with so many numbers, behind the name if `named`.
float widest_caption(const ComparisonSheet& sheet, std::size_t numbers, float letters, bool named) {
  float widest = 0;
  for (const ComparisonColumn& column : sheet.columns)
    widest =
        std::max(widest, mark_width(column, letters) +
                             text_width(with_numbers(named ? column.name : "", column, numbers), letters));
  return widest;
}

std::size_t most_numbers(const ComparisonSheet& sheet) {
  std::size_t most = 0;
  for (const ComparisonColumn& column : sheet.columns) most = std::max(most, column.numbers.size());
  return most;
}

// Groups columns by family, in the order of the families' first columns.
std::vector<SheetPlaces> column_families(const ComparisonSheet& sheet) {
  std::vector<SheetPlaces> families;
  for (std::size_t c = 0; c < sheet.columns.size(); ++c) {
    const auto same = [&](const SheetPlaces& f) {
      return sheet.columns[f[0]].family == sheet.columns[c].family;
    };
    const auto found = std::find_if(families.begin(), families.end(), same);
    found == families.end() ? families.push_back({c}) : found->push_back(c);
  }
  return families;
}

// A family that does not fit behind another begins a block; one that fits into none is spread evenly.
std::vector<SheetPlaces> family_blocks(const ComparisonSheet& sheet, std::size_t beside) {
  std::vector<SheetPlaces> blocks;
  if (sheet.columns.size() <= beside) {
    blocks.emplace_back();
    for (std::size_t c = 0; c < sheet.columns.size(); ++c) blocks[0].push_back(c);
    return blocks;
  }
  for (const SheetPlaces& family : column_families(sheet)) {
    if (!blocks.empty() && blocks.back().size() + family.size() <= beside) {
      blocks.back().insert(blocks.back().end(), family.begin(), family.end());
      continue;
    }
    const std::size_t parts = (family.size() + beside - 1) / beside;
    const std::size_t size = sheet.in_sequence ? beside : (family.size() + parts - 1) / parts;
    for (std::size_t i = 0; i < family.size(); i += size)
      blocks.emplace_back(family.begin() + static_cast<std::ptrdiff_t>(i),
                          family.begin() + static_cast<std::ptrdiff_t>(std::min(i + size, family.size())));
  }
  return blocks;
}

int sheet_margin(const ComparisonSheet& sheet, float letters) {
  float widest = 0;
  for (const auto* rows : {&sheet.rows, &sheet.further_rows})
    for (const ComparisonRow& row : *rows) {
      widest = std::max(widest, text_width(row.time, letters));
      for (const std::string& word : broken(row.phase, letters, 0))
        widest = std::max(widest, text_width(word, letters));
    }
  if (widest == 0) return 0;
  return static_cast<int>(std::min(widest, 0.16f * static_cast<float>(sheet.width)) + letters);
}

std::vector<int> row_heights(const ComparisonSheet& sheet, int cell_width) {
  std::vector<int> heights;
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    double height = 1;
    for (const ComparisonColumn& column : sheet.columns)
      if (const Image& image = column.cells[r].image; !image.empty())
        height = std::max(height, image.height() * std::min(kMaxEnlarged, 1.0 * cell_width / image.width()));
    heights.push_back(static_cast<int>(std::lround(height)));
  }
  return heights;
}

// Returns the width of the pictures in row r [m]; 0 for a row without scale or pictures.
double metres_across(const ComparisonSheet& sheet, std::size_t r) {
  for (const ComparisonColumn& column : sheet.columns)
    if (const Image& image = column.cells[r].image; !image.empty())
      return sheet.rows[r].metres_per_pixel * image.width();
  return 0;
}

bool has_small_loops(const ComparisonSheet& sheet, const SheetPage& page) {
  for (const ComparisonColumn& column : sheet.columns)
    for (const ComparisonCell& cell : column.cells)
      if (!cell.loop.empty() &&
          !names_loop_axes(kInsetFraction * static_cast<float>(page.cell_width), page.letters))
        return true;
  return false;
}

SheetPage page_with(const ComparisonSheet& sheet, std::size_t beside) {
  SheetPage page{};
  page.width = sheet.width;
  page.letters = sheet_letters(sheet.width);
  page.gap = std::max(4, sheet.width / 120);
  page.margin = sheet_margin(sheet, page.letters);
  page.blocks = family_blocks(sheet, beside);
  std::size_t columns = 1;
  for (const SheetPlaces& block : page.blocks) columns = std::max(columns, block.size());
  if (page.blocks.size() > 1) columns = std::max(columns, beside);
  page.cell_width = (page.width - page.margin - page.gap) / static_cast<int>(columns) - page.gap;
  page.families = page.blocks.size() > 1 && column_families(sheet).size() > 1;
  const auto fitting_numbers = [&](bool named) {
    std::size_t numbers = most_numbers(sheet);
    while (numbers > 0 &&
           widest_caption(sheet, numbers, page.letters, named) > static_cast<float>(page.cell_width))
      --numbers;
    return numbers;
  };
  page.name_lines = 1;
  for (const ComparisonColumn& column : sheet.columns)
    page.name_lines =
        std::max(page.name_lines, static_cast<int>(name_lines(column, page.letters, page.cell_width).size()));
  page.numbers = page.name_lines == 1 ? fitting_numbers(true) : 0;
  if (page.numbers == 0) {
    page.numbers = fitting_numbers(false);
    page.numbers_below = page.numbers > 0;
  }
  page.row_height = row_heights(sheet, page.cell_width);
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    const bool noted = std::ranges::any_of(
        sheet.columns, [&](const ComparisonColumn& column) { return !column.cells[r].note.empty(); });
    page.note_height.push_back(noted ? page.line() : 0);
    page.row_height[r] += page.note_height[r];
  }
  // Rows of low pictures are as high as the texts in the margin.
  const int scale_lines = has_one_scale(sheet) ? 0 : kScaleLines;
  const auto lines = [&](const ComparisonRow& row) {
    return static_cast<int>(1 + broken(row.phase, page.letters, phase_room(page)).size()) +
           (row.metres_per_pixel > 0 ? scale_lines : 0);
  };
  for (std::size_t r = 0; page.margin > 0 && r < sheet.rows.size(); ++r) {
    int most = lines(sheet.rows[r]);
    for (const ComparisonRow& row : sheet.further_rows) most = std::max(most, lines(row));
    page.row_height[r] = std::max(page.row_height[r], page.line() * most);
  }
  const float room = static_cast<float>(page.width - 2 * page.gap);
  page.title_lines = static_cast<int>(broken(sheet.title, kSheetTitle * page.letters, room).size());
  for (const std::string& note : sheet.notes)
    page.note_lines += static_cast<int>(broken(note, page.letters, room).size());
  const bool scale = sheet.rows[0].metres_per_pixel > 0 && has_one_scale(sheet);
  page.names_loops = has_small_loops(sheet, page);
  const float foot = page.names_loops ? kLoopKey + 1 : !sheet.bars.empty() ? 6.5f : scale ? 3.f : 0.f;
  page.foot = static_cast<int>(foot * page.letters);
  return page;
}

// The penalty of a page counts an aspect that is not allowed, names that are cut, headline numbers that found
// no room, empty places.
double want(const ComparisonSheet& sheet, const SheetPage& page) {
  const double aspect = page.aspect();
  double want = 10 * std::max({0.0, std::log(aspect / kWidest), std::log(kTallest / aspect)});
  std::size_t columns = 1;
  for (const SheetPlaces& block : page.blocks) columns = std::max(columns, block.size());
  const double places = static_cast<double>(columns * page.blocks.size());
  const double empty = 1 - static_cast<double>(sheet.columns.size()) / places;
  want += sheet.in_sequence ? 2 * empty : empty;
  if (sheet.in_sequence) return want + std::abs(std::log(aspect / kPleasant));
  if (cuts_a_name(sheet, page.letters, page.cell_width)) want += 5;
  if (page.numbers < std::min<std::size_t>(1, most_numbers(sheet))) want += 3;
  return want + 0.3 * static_cast<double>(page.blocks.size() - 1);
}

}  // namespace

std::vector<std::string> broken(const std::string& text, float letters, float room) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::string longer = lines.empty() ? word : lines.back() + " " + word;
    if (!lines.empty() && text_width(longer, letters) <= room)
      lines.back() = longer;
    else
      lines.push_back(word);
  }
  return lines;
}

std::string with_numbers(std::string text, const ComparisonColumn& column, std::size_t numbers) {
  for (std::size_t i = 0; i < std::min(numbers, column.numbers.size()); ++i)
    text += (text.empty() ? "" : kBetween) + column.numbers[i];
  return text;
}

float mark_width(const ComparisonColumn& column, float letters) { return column.color ? 1.6f * letters : 0; }

std::vector<std::string> name_lines(const ComparisonColumn& column, float letters, int cell_width) {
  const float room = static_cast<float>(cell_width) - mark_width(column, letters);
  std::vector<std::string> lines = {""};
  for (std::size_t start = 0; start < column.name.size();) {
    const std::size_t end = std::min(column.name.find_first_of("+=", start + 1), column.name.size());
    const std::string part = column.name.substr(start, end - start);
    if (!lines.back().empty() && text_width(lines.back() + part, letters) > room) lines.emplace_back();
    lines.back() += part;
    start = end;
  }
  return lines;
}

bool has_one_scale(const ComparisonSheet& sheet) {
  constexpr double kSame = 0.02;
  double first = 0;
  for (std::size_t r = 0; r < sheet.rows.size(); ++r) {
    const double across = metres_across(sheet, r);
    if (across == 0) continue;
    if (first > 0 && std::abs(across - first) > kSame * first) return false;
    first = across;
  }
  return true;
}

float phase_room(const SheetPage& page) { return static_cast<float>(page.margin) - page.letters; }

SheetPage best_page(const ComparisonSheet& sheet) {
  if (sheet.beside > 0) return page_with(sheet, static_cast<std::size_t>(sheet.beside));
  const std::size_t most = std::min<std::size_t>(kMaxBeside, sheet.columns.size());
  SheetPage best = page_with(sheet, most);
  for (std::size_t beside = most - 1; beside >= 1; --beside) {
    const SheetPage page = page_with(sheet, beside);
    if (want(sheet, page) < want(sheet, best)) best = page;
  }
  return best;
}

}  // namespace hysteron::render
