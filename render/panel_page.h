// The page that grids of panels share: where each panel stands, and the texts around them, for gnuplot.
#pragma once

#include <string>

namespace hysteron::render::gnuplot {

struct PanelPage {
  int count, columns;             // panels, and how many in a row
  int panel_width, panel_height;  // [pixels]
  int left, right, top, bottom;   // [pixels] around the grid
  int gap_x, gap_y;               // [pixels] between panels; a panel's title fits into gap_y

  int rows() const { return (count + columns - 1) / columns; }
  int width() const { return left + columns * (panel_width + gap_x) - gap_x + right; }
  int height() const { return top + rows() * (panel_height + gap_y) - gap_y + bottom; }
  // Parts of the page, from pixels counted from its upper left corner.
  double across(double pixels) const { return pixels / width(); }
  double up(double pixels_from_top) const { return 1 - pixels_from_top / height(); }
  std::string point(double x, double y) const;  // "screen 0.1,0.9"

  bool first_column(int index) const { return index % columns == 0; }
  bool lowest(int index) const { return index + columns >= count; }
  // "set lmargin" and the others that put the next plot into panel `index`.
  std::string margins(int index) const;
};

// "set label" with a text in which nothing is markup; `place` as gnuplot writes it, `style` what follows.
std::string text_at(const std::string& text, const std::string& place, const std::string& style);

// Title and subtitle over the grid, the axes' labels below and beside it.
std::string page_texts(const PanelPage& page, const std::string& title, const std::string& subtitle,
                       const std::string& x_label, const std::string& y_label);

}  // namespace hysteron::render::gnuplot
