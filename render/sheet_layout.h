// Where the parts of a comparison's sheet are: columns in blocks, captions, margins; decided before anything
// is drawn.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "render/comparison_sheet.h"

namespace hysteron::render {

inline constexpr float kSheetLine = 1.65f;   // from baseline to baseline, in letters
inline constexpr float kSheetTitle = 1.35f;  // letters of the title
inline constexpr double kMaxEnlarged = 1.5;  // of a picture on the page: more shows its pixels

inline constexpr float kInsetFraction = 0.28f;  // of a cell's shorter side
inline constexpr float kLoopKey = 10;           // side of what says what insets are, in letters

using SheetPlaces = std::vector<std::size_t>;  // of columns

// Where things are; decided before anything is drawn.
struct SheetPage {
  int width, gap, margin, cell_width;  // [pixels]; `margin` is that of times
  std::size_t numbers;                 // behind a name, or below it
  int name_lines;                      // of the name that takes the most
  bool numbers_below;                  // where no number finds room behind a name, or a name takes two lines
  float letters;
  std::vector<SheetPlaces> blocks;
  std::vector<int> row_height;  // of pictures, and of notes below them
  std::vector<int> note_height;
  bool names_loops;  // at the foot: insets are too small for it
  bool families;
  int title_lines, note_lines, foot;

  int line() const { return static_cast<int>(std::lround(kSheetLine * letters)); }
  int caption_lines() const { return name_lines + (numbers_below ? 1 : 0); }
  int left(std::size_t place) const { return gap + margin + static_cast<int>(place) * (cell_width + gap); }
  int head() const {
    return 2 * gap + title_lines * static_cast<int>(std::lround(kSheetTitle * kSheetLine * letters)) +
           note_lines * line();
  }
  int block_height() const {
    int height = (families ? line() : 0) + caption_lines() * line() + gap / 2;
    for (int row : row_height) height += row + gap;
    return height + gap;
  }
  int height() const { return head() + static_cast<int>(blocks.size()) * block_height() + foot; }
  double aspect() const { return 1.0 * width / height(); }
};

// Broken between words; a word longer than the room stays whole.
std::vector<std::string> broken(const std::string& text, float letters, float room);
// Of the mark before a name.
float mark_width(const ComparisonColumn& column, float letters);
// A name that is too long is broken before its keys and values: "linear", "+fabric.damping", "=1e-3".
std::vector<std::string> name_lines(const ComparisonColumn& column, float letters, int cell_width);
// What stands before numbers, and as many of them.
std::string with_numbers(std::string text, const ComparisonColumn& column, std::size_t numbers);
// Rows have a scale each, or one that stands for all at the foot.
bool has_one_scale(const ComparisonSheet& sheet);
// For words in the margin, whose last letter keeps off the pictures.
float phase_room(const SheetPage& page);
// That which leaves least to be wished for.
SheetPage best_page(const ComparisonSheet& sheet);

}  // namespace hysteron::render
