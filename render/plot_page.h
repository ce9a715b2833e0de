// Several plots on one page, each with axes and a key of its own, drawn by gnuplot as PNG and SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot.h"

namespace hysteron::render {

struct PagePlot {
  Plot plot;                      // its width and height are the page's
  std::string key = "top right";  // where the key stands, in gnuplot's words; "off": nowhere
};

struct PlotPage {
  std::string title, subtitle;
  std::vector<PagePlot> plots;  // row by row
  int columns = 2;
  int plot_width = 480, plot_height = 350;  // [pixels], without titles and axes
};

// Writes BASE.png and BASE.svg, each whole or not at all.  Error::system and Error::invalid_input as
// write_plot().
void write_plot_page(const std::filesystem::path& base, const PlotPage& page);

}  // namespace hysteron::render
