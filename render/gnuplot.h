// Pieces of gnuplot scripts that plots and grids of panels share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot.h"

namespace hysteron::render::gnuplot {

// Writes a number that gnuplot reads back exactly; NaN for what is not finite.
std::string number(double value);

// Quotes a text in which nothing is markup, as a gnuplot string and as a column of a data block.
std::string label_text(const std::string& text);
std::string data_text(const std::string& text);

// Throws Error::invalid_input, naming `base`, if there are no maps, panels or series to draw.
void require_something(const std::filesystem::path& base, std::size_t count);
// Throws Error::invalid_input, naming `base`, if there is no series, or one without as many x as y.
void require_drawable(const std::filesystem::path& base, const std::vector<Series>& series);

// Writes the data blocks `$series<first>`, `$series<first + 1>`, ... that plot_command() refers to.
std::string data_blocks(const std::vector<Series>& series, std::size_t first = 0);
std::string plot_command(const std::vector<Series>& series, std::size_t first = 0);

// Returns true if a logarithmic axis between these is too short for powers of ten alone: less than two
// decades.
bool is_short(double low, double high);

// Returns "set xlabel", logarithmic scale and, where one is given, the range; `name` is "x" or "y".
std::string axis_commands(const char* name, const Axis& axis);

// Returns "set label" for each mark, numbered from 1.
std::string mark_commands(const std::vector<Mark>& marks);

// Runs `prologue`, then `drawing` once for BASE.png, once for BASE.svg and, where gnuplot can, for BASE.pdf;
// PNG and SVG appear both or not at all. Throws Error::system if gnuplot is missing or fails.
void write_both(const std::filesystem::path& base, int width, int height, const std::string& prologue,
                const std::string& drawing);

// Properties of this machine's gnuplot, found by a plot that goes nowhere.
struct Trial {
  std::string version{};    // "5.4 patchlevel 4"
  bool writes_pdf = false;  // false: plots are PNG and SVG alone
  std::string failure{};    // why gnuplot fails, "gnuplot cannot be started"; empty if it draws
  bool has_letters = true;  // true if gnuplot finds a font
};
Trial try_gnuplot();

// The layout that grids of panels share: the places of panels and of the texts around them.

struct PanelPage {
  int count, columns;             // number of panels, and of panels in a row
  int panel_width, panel_height;  // size of a panel [pixels]
  int left, right, top, bottom;   // margins around the grid [pixels]
  int gap_x, gap_y;               // gaps between panels [pixels]; a panel's title fits into gap_y

  int rows() const { return (count + columns - 1) / columns; }
  int width() const { return left + columns * (panel_width + gap_x) - gap_x + right; }
  int height() const { return top + rows() * (panel_height + gap_y) - gap_y + bottom; }
  // These return fractions of the page from pixels counted from its upper left corner.
  double across(double pixels) const { return pixels / width(); }
  double up(double pixels_from_top) const { return 1 - pixels_from_top / height(); }
  std::string point(double x, double y) const;  // "screen 0.1,0.9"

  bool first_column(int index) const { return index % columns == 0; }
  bool lowest(int index) const { return index + columns >= count; }
  // Returns "set lmargin" and the others that put the next plot into panel `index`.
  std::string margins(int index) const;
};

// Returns "set label" with a text in which nothing is markup; `place` is in gnuplot's syntax, and `style` is
// appended.
std::string text_at(const std::string& text, const std::string& place, const std::string& style);

// Returns the labels of a page: title and subtitle over the grid, the axes' labels below and beside it.
std::string page_texts(const PanelPage& page, const std::string& title, const std::string& subtitle,
                       const std::string& x_label, const std::string& y_label);

}  // namespace hysteron::render::gnuplot
