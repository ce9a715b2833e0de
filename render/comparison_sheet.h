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
  LoopInset loop{};    // inset, placed where it hides nothing in its row; empty: none
  Image busy{};        // picture that the inset must not hide; empty: the image
};

struct ComparisonColumn {
  std::string name;
  std::vector<std::string> numbers;     // headline numbers behind the name, or below it, as many as fit
  std::optional<Rgb8> color{};          // colour of the mark before the name
  std::string family{};                 // columns of one family stand together; "" on a page without families
  std::vector<ComparisonCell> cells{};  // one per row
};

struct ComparisonRow {
  std::string time, phase;      // texts in the margin
  double metres_per_pixel = 0;  // scale of the row's pictures [m]; 0: no scale bar
};

struct ComparisonSheet {
  std::string title;
  std::vector<std::string> notes{};  // lines below the title
  std::vector<ComparisonRow> rows{};
  std::vector<ComparisonColumn> columns{};
  std::vector<ColorBar> bars{};  // colour bars below all pictures
  std::string scale_note{};      // says in which plane scale bars hold
  std::string loop_note{};       // second line of the insets' key
  int width = kSheetWidth;       // width of the page [pixels]
  int beside = 0;                // columns beside each other, at most kMaxBeside; 0: the best number
  std::vector<ComparisonRow> further_rows{};  // rows of a film's other pictures: the margin fits them
  bool in_sequence = false;  // columns are instants, in blocks that bring the page near 3 : 2

  static constexpr int kSheetWidth = 1676;  // twice the width of a repository's front page
};

inline constexpr int kMaxBeside = 5;
// Returns the height of capitals on a page: 1/84 of its width, rounded up [pixels].
float sheet_letters(int width);

// Error::invalid_input if there are no columns or rows, a column has another number of cells than there are
// rows, or less than 32 pixels are left for a cell.
Image draw_comparison(const ComparisonSheet& sheet);

// Fades a cell into the page if most of its border is nearly white: everything outside `kept`, the box of the
// cloth (left, top, right, bottom in shares of the picture), turns white toward each side over as much room
// as there is, at most a fifth of the picture.
using PictureBox = std::array<double, 4>;
inline constexpr PictureBox kAllButABorder = {0.04, 0.04, 0.96, 0.96};
void fade_to_page(Image& image, const PictureBox& kept = kAllButABorder);

// Draws the outline of a silhouette, black on white, over `target` of the same size; `width` is in pixels,
// and `dotted` leaves gaps, where another has the colour already.  Error::invalid_input if the sizes differ.
void draw_outline(Image& target, const Image& silhouette, const Rgb8& color, int width, bool dotted = false);

}  // namespace hysteron::render
