// The maps of outcomes as pictures.
#include <algorithm>

#include "experiments/stability/output.h"
#include "render/heat_map.h"

namespace hysteron::experiments {
namespace {

// Apart for colour-blind eyes and in grey (Okabe & Ito 2008, lightened so that numbers can be read on them).
const std::vector<render::CellKind> kKinds = {{"ended", "#BFE3D5"},
                                              {"retried", "#F5E27A"},
                                              {"refused, with the reason", "#C9C9C9"},
                                              {"diverged", "#D55E00"}};

int kind_of(Outcome outcome) {
  return static_cast<int>(std::find(std::begin(kOutcomes), std::end(kOutcomes), outcome) -
                          std::begin(kOutcomes));
}

render::HeatMap map_of(const Sweep& sweep, const std::string& integrator, int variant,
                       const std::vector<const Cell*>& cells) {
  render::HeatMap map{integrator + ", " + sweep.variants[variant], {}};
  map.rows.assign(sweep.y.ticks.size(), std::vector<render::HeatMapCell>(sweep.x.ticks.size()));
  for (const Cell* cell : cells)
    map.rows[cell->row][cell->column] = {
        kind_of(cell->finding.outcome),
        cell->finding.substeps > 1 ? std::to_string(cell->finding.substeps) : ""};
  return map;
}

render::HeatMaps page_of(const Sweep& sweep) {
  render::HeatMaps page{sweep.title,
                        "Number: explicit substeps per step.",
                        {sweep.x.label, sweep.x.ticks},
                        {sweep.y.label, sweep.y.ticks},
                        kKinds,
                        {}};
  page.cell_width = page.x.ticks.size() > 10 ? 40 : 46;
  page.cell_height = page.y.ticks.size() > 10 ? 24 : 34;
  return page;
}

}  // namespace

void draw_maps(Run& run, const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells) {
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    const Sweep& sweep = sweeps[s];
    render::HeatMaps page = page_of(sweep);
    std::vector<const Cell*> part;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].sweep != static_cast<int>(s)) continue;
      part.push_back(&cells[i]);
      if (part.size() < sweep.x.ticks.size() * sweep.y.ticks.size()) continue;
      page.maps.push_back(map_of(sweep, cells[i].integrator, cells[i].variant, part));
      part.clear();
    }
    page.columns = static_cast<int>(page.maps.size() / sweep.variants.size());
    run.plot("plot_" + sweep.name,
             [&](const std::filesystem::path& base) { render::write_heat_maps(base, page); });
  }
}

}  // namespace hysteron::experiments
