// Several plots on one page, each with axes and a key of its own, drawn by gnuplot as PNG and SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot.h"

namespace hysteron::render {

struct PagePlot {
  Plot plot;                      // the page sets its width and height
  std::string key = "top right";  // place of the key in gnuplot's words; "off": none
};

struct PlotPage {
  std::string title, subtitle;
  std::vector<PagePlot> plots;  // plots row by row
  int columns = 2;
  int plot_width = 480, plot_height = 350;  // size of a plot [pixels], without titles and axes
};

// Writes BASE.png and BASE.svg, each whole or not at all.  Error::system and Error::invalid_input as
// write_plot().
void write_plot_page(const std::filesystem::path& base, const PlotPage& page);

}  // namespace hysteron::render
