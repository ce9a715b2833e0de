// One page of pictures beside each other: methods, fabrics or instants as columns, a row for each instant.
// Columns that do not fit beside each other stand in blocks; letters are set after the pictures have got
// their size, so that they can be read wherever the page is shown in its width.
//
//            ■ linear · 180°   ■ narain · 16°   ■ prandtl · 116°
//   0.47 s      [picture]         [picture]         [picture]
//   1.90 s      [picture]         [picture]         [picture]
//   |--| 2 cm
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "render/caption.h"
#include "render/image.h"
#include "render/loop_inset.h"

namespace hysteron::render {

struct ComparisonCell {
  Image image{};       // empty: the cell stays white
  std::string note{};  // a few words below the picture, "stopped at 0.90 s"
  LoopInset loop{};    // where it hides nothing of any cell of its row; empty: none
  Image busy{};        // what the inset keeps off, of a film all pictures over each other; empty: the image
};

struct ComparisonColumn {
  std::string name;
  std::vector<std::string> numbers;     // behind the name, or below it where none finds room; as many as do
  std::optional<Rgb8> color{};          // of the mark before the name
  std::string family{};                 // columns of one family stand together; "" of a page without families
  std::vector<ComparisonCell> cells{};  // one a row
};

struct ComparisonRow {
  std::string time, phase;      // in the margin
  double metres_per_pixel = 0;  // of the row's pictures; 0: without a scale bar
};

struct ComparisonSheet {
  std::string title;
  std::vector<std::string> notes{};  // below the title
  std::vector<ComparisonRow> rows{};
  std::vector<ComparisonColumn> columns{};
  std::vector<ColorBar> bars{};  // below all pictures
  std::string scale_note{};      // in which plane scale bars hold
  std::string loop_note{};       // behind what insets are
  int width = kSheetWidth;       // [pixels]
  int beside = 0;                // columns beside each other; 0: as many as go well, at most five
  std::vector<ComparisonRow> further_rows{};  // of a film's other pictures: their margins are as wide
  bool in_sequence = false;  // columns are instants: blocks of any number that brings the page near 3 : 2

  static constexpr int kSheetWidth = 1676;  // twice the width of a repository's front page
};

inline constexpr int kMaxBeside = 5;
// Capitals' height on a page: 1/84 of its width, rounded up [pixels].
float sheet_letters(int width);

// Error::invalid_input if there are no columns or rows, a column has another number of cells than there are
// rows, or less than 32 pixels are left for a cell.
Image draw_comparison(const ComparisonSheet& sheet);

// Cells without edges: where most of a picture's border is nearly white, what lies around `kept`, the box of
// the cloth (left, top, right, bottom in shares of the picture), goes over into the page, and what is left of
// shadows there: along each side as softly as there is room, within a fifth of the picture at most.
using PictureBox = std::array<double, 4>;
inline constexpr PictureBox kAllButABorder = {0.04, 0.04, 0.96, 0.96};
void fade_to_page(Image& image, const PictureBox& kept = kAllButABorder);

// The outline of a silhouette, black on white, drawn over `target` of the same size; `width` in pixels;
// `dotted`: with gaps, where another has the colour already.  Error::invalid_input if the sizes differ.
void draw_outline(Image& target, const Image& silhouette, const Rgb8& color, int width, bool dotted = false);

}  // namespace hysteron::render
