// Pieces of gnuplot scripts that plots and grids of panels share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot.h"

namespace hysteron::render::gnuplot {

// A number that gnuplot reads back exactly; NaN for what is not finite.
std::string number(double value);

// A text as a gnuplot string in which nothing is markup; and the same as a column of a data block.
std::string label_text(const std::string& text);
std::string data_text(const std::string& text);

// Throws Error::request, naming `base`, if there is no series, or one without as many x as y.
void require_drawable(const std::filesystem::path& base, const std::vector<Series>& series);

// `$series<first>`, `$series<first + 1>`, ...: the numbers that plot_command() refers to.
std::string data_blocks(const std::vector<Series>& series, std::size_t first = 0);
std::string plot_command(const std::vector<Series>& series, std::size_t first = 0);

// Whether a logarithmic axis between these is too short for powers of ten alone: less than two decades.
bool is_short(double low, double high);

// "set xlabel", logarithmic scale and, where one is given, the range; `name` is "x" or "y".
std::string axis_commands(const char* name, const Axis& axis);

// "set label" for each mark, numbered from 1.
std::string mark_commands(const std::vector<Mark>& marks);

// Runs `prologue`, then `drawing` once for BASE.png, once for BASE.svg and, where gnuplot can, for BASE.pdf;
// the first two appear, or none. Throws Error::machine if gnuplot is missing or fails.
void write_both(const std::filesystem::path& base, int width, int height, const std::string& prologue,
                const std::string& drawing);

}  // namespace hysteron::render::gnuplot
