#include "experiments/workbench/compare/table_maps.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace hysteron::experiments {
namespace {

// Where a value stands among those that came before it, of which it becomes the last if it is new.
std::size_t place_in(std::vector<std::string>& values, const std::string& value) {
  const auto at = std::find(values.begin(), values.end(), value);
  const auto place = static_cast<std::size_t>(at - values.begin());
  if (at == values.end()) values.push_back(value);
  return place;
}

}  // namespace

void add_maps(render::HeatMaps& page, const Table& table, const MapColumns& columns,
              const std::function<render::HeatMapCell(const std::vector<std::size_t>& rows)>& cell) {
  std::vector<std::string> titles;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::vector<std::size_t>> cells;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::string title;
    for (const std::string& column : columns.panels)
      title += (title.empty() ? "" : ", ") + table.word(r, column);
    cells[{place_in(titles, title), place_in(page.y.ticks, table.word(r, columns.y)),
           place_in(page.x.ticks, table.word(r, columns.x))}]
        .push_back(r);
  }
  for (std::size_t m = 0; m < titles.size(); ++m) {
    const std::vector<render::HeatMapCell> blank(page.x.ticks.size());
    page.maps.push_back({titles[m], std::vector(page.y.ticks.size(), blank)});
  }
  for (const auto& [place, rows] : cells) {
    const auto& [map, y, x] = place;
    page.maps[map].rows[y][x] = cell(rows);
  }
}

}  // namespace hysteron::experiments
