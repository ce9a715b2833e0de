// The layout of a comparison's sheet, decided before anything is drawn: columns in blocks, captions, margins.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "render/comparison_sheet.h"

namespace hysteron::render {

inline constexpr float kSheetLine = 1.65f;   // distance of baselines, in letters
inline constexpr float kSheetTitle = 1.35f;  // size of the title's letters, in letters
inline constexpr double kMaxEnlarged = 1.5;  // largest enlargement of a picture: more shows its pixels

inline constexpr float kInsetFraction = 0.28f;  // side of an inset, of a cell's width or twice its height
inline constexpr float kLoopKey = 10;           // side of the insets' key, in letters

using SheetPlaces = std::vector<std::size_t>;  // indices of columns

// The sizes and places of everything on a page.
struct SheetPage {
  int width, gap, margin, cell_width;  // [pixels]; `margin` is the width of the column of times
  std::size_t numbers;                 // how many numbers stand behind a name, or below it
  int name_lines;                      // lines of the longest name
  bool numbers_below;                  // true if no number fits behind a name, or a name takes two lines
  float letters;
  std::vector<SheetPlaces> blocks;
  std::vector<int> row_height;  // height of each row's pictures and the notes below them [pixels]
  std::vector<int> note_height;
  bool names_loops;  // the foot names the axes of insets that are too small for it
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

// Breaks a text between words; a word longer than the room [pixels] stays whole.
std::vector<std::string> broken(const std::string& text, float letters, float room);
// Returns the width of the mark before a name [pixels].
float mark_width(const ComparisonColumn& column, float letters);
// Returns a name in lines; one that is too long is broken before its keys and values: "linear",
// "+fabric.damping", "=1e-3".
std::vector<std::string> name_lines(const ComparisonColumn& column, float letters, int cell_width);
// Appends the first `numbers` of a column's numbers to a text.
std::string with_numbers(std::string text, const ComparisonColumn& column, std::size_t numbers);
// Returns true if one scale at the foot stands for all rows.
bool has_one_scale(const ComparisonSheet& sheet);
// Returns the room for words in the margin [pixels], whose last letter keeps off the pictures.
float phase_room(const SheetPage& page);
// Returns the layout with the least penalty.
SheetPage best_page(const ComparisonSheet& sheet);

}  // namespace hysteron::render
