// The maps of outcomes as pictures.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/stability/output.h"
#include "render/heat_map.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

// Apart for colour-blind eyes and in grey (Okabe & Ito 2008, lightened so that numbers can be read on them).
const std::vector<render::CellKind> kKinds = {{"ended", "#BFE3D5"},
                                              {"retried", "#F5E27A"},
                                              {"refused, with the reason", "#C9C9C9"},
                                              {"diverged", "#D55E00"}};

constexpr const char* kBendingColor = "#0072B2";
constexpr const char* kMembraneColor = "#8E3B76";

int kind_of(Outcome outcome) {
  return static_cast<int>(std::find(std::begin(kOutcomes), std::end(kOutcomes), outcome) -
                          std::begin(kOutcomes));
}

// Explicit substeps per step, or by how much the energy grew.
std::string text_of(const Finding& finding) {
  if (finding.outcome == Outcome::refused) return "";
  if (finding.outcome == Outcome::diverged) {
    if (finding.energy_growth <= kLargestGrowth) return "∞";  // broken off between two looks
    if (!(finding.energy_growth < 100)) return "≫";
    return fmt::format("×{:.{}f}", finding.energy_growth, finding.energy_growth < 10 ? 1 : 0);
  }
  return finding.substeps > 1 ? std::to_string(finding.substeps) : "";
}

// Where a value stands between the ticks, in cells; logarithmic, and beyond the ends as between the last two.
double place_on(const SweepAxis& axis, double value) {
  const std::vector<double>& at = axis.values;
  std::size_t i = 0;
  while (i + 2 < at.size() && value > at[i + 1]) ++i;
  return i + std::log(value / at[i]) / std::log(at[i + 1] / at[i]);
}

struct StepLine {
  std::vector<double> x, bending, membrane;  // in cells
};

// The program's bounds on an explicit step, at every column.
StepLine step_line(const Sweep& sweep, int variant) {
  StepLine line;
  for (std::size_t column = 0; column < sweep.x.ticks.size(); ++column) {
    Attempt attempt = sweep.at(variant, static_cast<int>(column), 0);
    attempt.scene.integrator = Integrator::explicit_euler;
    attempt.scene.device = DeviceChoice::cpu;
    attempt.scene.step = 1e-12;  // any step is allowed that is short enough
    StepLimits limits{NAN, NAN};
    try {
      limits = make_simulation(attempt.scene, make_cloth(attempt.scene))->limits();
    } catch (const Error& error) {
      if (error.exit_code() == 1) throw;  // else the map shows the refusal
    }
    line.x.push_back(static_cast<double>(column));
    line.bending.push_back(place_on(sweep.y, limits.bending_step));
    line.membrane.push_back(place_on(sweep.y, limits.membrane_step));
  }
  return line;
}

std::vector<render::Series> lines_of(const StepLine& line, const std::string& integrator) {
  std::vector<render::Series> lines = {{.label = "bound on explicit bending",
                                        .x = line.x,
                                        .y = line.bending,
                                        .color = kBendingColor,
                                        .line_width = 2.4}};
  if (integrator == "explicit") {
    lines.push_back({.label = "bound on all forces explicit",
                     .x = line.x,
                     .y = line.membrane,
                     .style = render::Series::Style::dashed,
                     .color = kMembraneColor,
                     .line_width = 2.4});
  }
  return lines;
}

// "semi-implicit, prandtl: 3 refused, 1 diverged"
std::string title_of(const std::string& integrator, const std::string& variant,
                     const std::vector<const Cell*>& cells) {
  std::string title = integrator + ", " + variant, counts;
  for (Outcome outcome : {Outcome::retried, Outcome::refused, Outcome::diverged}) {
    const auto n = std::count_if(cells.begin(), cells.end(),
                                 [&](const Cell* cell) { return cell->finding.outcome == outcome; });
    if (n) counts += (counts.empty() ? ": " : ", ") + std::to_string(n) + " " + name_of(outcome);
  }
  return title + counts;
}

render::HeatMap map_of(const Sweep& sweep, const std::string& integrator, int variant,
                       const std::vector<const Cell*>& cells) {
  render::HeatMap map{title_of(integrator, sweep.variants[variant], cells), {}};
  map.rows.assign(sweep.y.ticks.size(), std::vector<render::HeatMapCell>(sweep.x.ticks.size()));
  for (const Cell* cell : cells)
    map.rows[cell->row][cell->column] = {kind_of(cell->finding.outcome), text_of(cell->finding)};
  return map;
}

render::HeatMaps page_of(const Sweep& sweep) {
  render::HeatMaps page{sweep.title,
                        "Number: explicit substeps per step; of diverged cells: growth of the energy (≫: "
                        "above 100, ∞: not finite).",
                        {sweep.x.label, sweep.x.ticks},
                        {sweep.y.label, sweep.y.ticks},
                        kKinds,
                        {}};
  page.cell_width = page.x.ticks.size() > 10 ? 40 : 46;
  page.cell_height = page.y.ticks.size() > 10 ? 24 : 34;
  return page;
}

// The word's place in the list, at whose end it is put if it is new.
std::size_t place_in(std::vector<std::string>& list, const std::string& word) {
  const auto found = std::find(list.begin(), list.end(), word);
  if (found == list.end()) return list.push_back(word), list.size() - 1;
  return found - list.begin();
}

render::HeatMaps limit_page(const std::vector<MeasuredLimit>& limits) {
  render::HeatMaps page{"Explicit bending: largest stable step, measured, over the bound in use",
                        "Square of 128 triangles, shaken.  Number: measured limit / bound.",
                        {"mesh", {}},
                        {"element", {}},
                        {{"bound too large (< 1)", "#D55E00"},
                         {"1 to 2", "#BFE3D5"},
                         {"bound more than 2 times too careful", "#F5E27A"}},
                        {}};
  std::vector<std::string> conditions;
  const auto row_of = [](const LimitCase& of) {
    return name_of(of.element) + (of.held ? ", held" : ", free");
  };
  for (const MeasuredLimit& limit : limits)
    place_in(page.x.ticks, limit.of.mesh), place_in(page.y.ticks, row_of(limit.of));
  for (const MeasuredLimit& limit : limits) {
    const std::size_t map = place_in(conditions, limit.of.condition.name);
    page.maps.resize(conditions.size());
    page.maps[map].title = limit.of.condition.name;
    page.maps[map].rows.resize(page.y.ticks.size(), std::vector<render::HeatMapCell>(page.x.ticks.size()));
    page.maps[map].rows[place_in(page.y.ticks, row_of(limit.of))][place_in(page.x.ticks, limit.of.mesh)] = {
        limit.ratio() < 1    ? 0
        : limit.ratio() <= 2 ? 1
                             : 2,
        fmt::format("{:.2f}", limit.ratio())};
  }
  page.columns = 2;
  page.cell_width = 92;
  return page;
}

}  // namespace

void draw_maps(Run& run, const std::vector<Sweep>& sweeps, const std::vector<Cell>& cells) {
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    const Sweep& sweep = sweeps[s];
    render::HeatMaps page = page_of(sweep);
    std::vector<StepLine> lines;
    for (std::size_t v = 0; sweep.step_limits && v < sweep.variants.size(); ++v)
      lines.push_back(step_line(sweep, static_cast<int>(v)));
    std::vector<const Cell*> part;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].sweep != static_cast<int>(s)) continue;
      part.push_back(&cells[i]);
      if (part.size() < sweep.x.ticks.size() * sweep.y.ticks.size()) continue;
      const int variant = cells[i].variant;
      page.maps.push_back(map_of(sweep, cells[i].integrator, variant, part));
      if (sweep.step_limits) page.maps.back().lines = lines_of(lines[variant], cells[i].integrator);
      part.clear();
    }
    page.columns = static_cast<int>(page.maps.size() / sweep.variants.size());
    run.plot("plot_" + sweep.name,
             [&](const std::filesystem::path& base) { render::write_heat_maps(base, page); });
  }
}

void draw_limits(Run& run, const std::vector<MeasuredLimit>& limits) {
  const auto page = limit_page(limits);
  run.plot("plot_explicit-limit",
           [&](const std::filesystem::path& base) { render::write_heat_maps(base, page); });
}

}  // namespace hysteron::experiments
