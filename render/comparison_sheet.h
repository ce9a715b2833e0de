// One page on which methods stand side by side: a column each, a row for each moment, one scale of colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/caption.h"
#include "render/image.h"

namespace hysteron::render {

struct ComparisonCell {
  Image image;          // empty: the cell stays white
  std::string caption;  // a line below it; may be empty
};

struct ComparisonRow {
  std::string label;  // a line over the row
  std::vector<ComparisonCell> cells;
};

struct ComparisonColumn {
  std::string name;
  std::vector<std::string> numbers;  // lines below the last row
  Rgb8 color{38, 40, 44};            // of the mark before the name: that of its outlines
};

struct ComparisonSheet {
  std::string title;
  std::vector<std::string> notes;  // lines below the title
  std::vector<ComparisonColumn> columns;
  std::vector<ComparisonRow> rows;  // one cell a column
  std::vector<ComparisonRow> more;  // below the numbers, as many cells as they like
  std::vector<ColorBar> bars;       // side by side at the foot
  double metres_per_pixel = 0;      // of the cells' images: a scale bar stands at the foot; 0: none
  std::string scale_note;           // in which plane it holds
  int cell_width = 420;             // [pixels]
};

// Error::request if there are no columns, or a row has another number of cells.
Image draw_comparison(const ComparisonSheet& sheet);

// The outline of a silhouette, black on white, drawn over `target` of the same size; `width` in pixels.
// Error::request if the sizes differ.
void draw_outline(Image& target, const Image& silhouette, const Rgb8& color, int width);

}  // namespace hysteron::render
