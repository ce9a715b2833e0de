// Small multiples: a grid of panels with common axes, drawn by gnuplot as PNG and SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/plot.h"

namespace hysteron::render {

struct Panel {
  std::string title;
  std::vector<Series> series;
  std::vector<std::string> notes = {};    // lines of text in the upper left corner
  std::vector<std::string> remarks = {};  // lines of text in the lower right corner
};

struct Panels {
  std::string title;
  std::string subtitle;  // what colours mean; series' own labels are not drawn
  Axis x, y;             // of all panels; low == high: from all panels' data
  std::vector<Panel> panels;
  int columns = 4;
  int panel_width = 400, panel_height = 300;  // [pixels], without titles and axes
};

// Writes BASE.png and BASE.svg, each whole or not at all.  What lies beyond a given range is cut off.
// Error::system and Error::invalid_input as write_plot().
void write_panels(const std::filesystem::path& base, const Panels& grid);

}  // namespace hysteron::render
