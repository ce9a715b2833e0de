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
  std::string subtitle;  // explains the colours; series' own labels are not drawn
  Axis x, y;             // axes of all panels; low == high: range of all panels' data
  std::vector<Panel> panels;
  int columns = 4;
  int panel_width = 400, panel_height = 300;  // size of a panel [pixels], without titles and axes
};

// Writes BASE.png and BASE.svg, each whole or not at all.  Data beyond a given range are cut off.
// Error::system and Error::invalid_input as in write_plot().
void write_panels(const std::filesystem::path& base, const Panels& grid);

}  // namespace hysteron::render
