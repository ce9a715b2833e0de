// Maps of a table: its rows by the values of an x and a y column, a panel for those of others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render/heat_map.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {

struct MapColumns {
  std::vector<std::string> panels;  // whose values title a map: "implicit, prandtl"
  std::string x, y;
};

// Adds the table's maps and its values along both axes to a page, in the order in which they come; `cell`
// makes one of the numbers of its rows.
void add_maps(render::HeatMaps& page, const Table& table, const MapColumns& columns,
              const std::function<render::HeatMapCell(const std::vector<std::size_t>& rows)>& cell);

}  // namespace hysteron::experiments
