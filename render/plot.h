// Line plots, drawn by gnuplot (a process of its own) as PNG and SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::render {

struct Series {
  std::string label;  // name in the key; an empty one is left out
  std::vector<double> x, y;
  enum class Style { line, points, line_and_points, dashed, bars, rings } style = Style::line;
  std::string color{};  // "#RRGGBB"; empty: the next of a palette that colour-blind eyes can tell apart
  double line_width = 2.2;
  std::vector<double>
      spread{};  // half the height of a band around each y, pale in the series' colour; empty: none

  void add(double at, double value) { x.push_back(at), y.push_back(value); }
};

// A named point.
struct Mark {
  std::string text;
  double x, y;
  double dx = 1, dy = 0;          // offset of the text from the point [letters]; dx < 0: the text ends there
  std::string color = "#222222";  // colour of text and dot
  bool dot = true;
};

struct Axis {
  std::string label;  // label with its unit: "curvature [1/m]"
  bool logarithmic = false;
  double low = 0, high = 0;               // range; low == high: from the data
  std::vector<std::string> categories{};  // names at 0, 1, 2, ... along x instead of numbers
};

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series{};
  int width = 960, height = 640;  // size of the PNG [pixels]
  bool equal_scales = false;      // one unit is as long along x as along y, for outlines
  std::vector<Mark> marks{};
  bool axes_at_zero = false;  // lines through the origin replace the grid
  bool key_inside = false;    // key in a corner, key_corner(); else lines have labels at their ends
  double bar_width = 0.8;     // width of bars in units of x
  std::string note{};         // a line below the title
};

// An SI prefix and its factor: "m" and 1e-3 for numbers from 1e-3 to below 1; zero has none.
struct SiPrefix {
  const char* prefix = "";
  double factor = 1;
};
SiPrefix si_prefix(double value);

// Reads two columns of a CSV file, chosen by their names in the first line (the part before " [unit]"
// suffices). Error::invalid_input if the file or a column is missing or a cell is no number (the line is
// named); empty cells are gaps.
Series series_from_csv(const std::filesystem::path& csv, const std::string& x, const std::string& y,
                       const std::string& label);

// Returns the corner in which a key of all labels covers the least of the data, in gnuplot's words: "right
// bottom" if others are no better.
std::string key_corner(const Plot& plot);

// Returns the errors of bars as a vertical line each from value - error to value + error at 0, 1, 2, ...; an
// error that is not finite has none.
Series bar_errors(const std::vector<double>& values, const std::vector<double>& errors);

// Returns series of bars, a group at each category: `values` by series and category, `labels` by series.
// Numbers that are not finite make no bar.
std::vector<Series> grouped_bars(const std::vector<std::string>& labels,
                                 const std::vector<std::vector<double>>& values, double bar_width);

// Writes BASE.png, BASE.svg and, where gnuplot can, BASE.pdf, each whole or not at all.  Numbers that are not
// finite make gaps.  Several series have their labels at the right, in their colours, each at the height at
// which its line ends; one alone has none.  Axes in N, J, m, s, Pa and their products take a prefix where all
// their numbers are small. Error::system if gnuplot is missing (install gnuplot-nox) or fails;
// Error::invalid_input if there is nothing to draw or x and y differ in length.
void write_plot(const std::filesystem::path& base, const Plot& plot);

}  // namespace hysteron::render
