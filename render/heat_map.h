// Maps of outcomes: grids of cells, coloured by kind, one panel beside the other, drawn by gnuplot as PNG and
// SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hysteron::render {

struct HeatMapCell {
  int kind = -1;     // index of HeatMaps::kinds; -1: empty
  std::string text;  // text of a few letters in the cell
};

struct HeatMap {
  std::string title;
  std::vector<std::vector<HeatMapCell>> rows;  // rows from below; each as long as the x axis has ticks
};

// An axis of cells, a tick at each.
struct CellAxis {
  std::string label;
  std::vector<std::string> ticks;
};

struct CellKind {
  std::string name;   // name in the legend over the maps
  std::string color;  // "#RRGGBB"
};

struct HeatMaps {
  std::string title;
  std::string subtitle;  // explains the cells' texts
  CellAxis x, y;         // axes of all maps
  std::vector<CellKind> kinds;
  std::vector<HeatMap> maps;
  int columns = 3;
  int cell_width = 46, cell_height = 34;  // size of a cell [pixels]
};

// Writes BASE.png and BASE.svg, each whole or not at all.  Error::invalid_input if there is no map, or one
// whose rows do not fit its axes; other errors as in write_plot().
void write_heat_maps(const std::filesystem::path& base, const HeatMaps& page);

}  // namespace hysteron::render
