#include "experiments/validate/folds.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

// The coefficients and folds of the real drapes of one fabric.
struct RealDrapes {
  double coefficient, deviation;  // mean and standard deviation [%]
  int fewest, most;               // numbers of folds
};

// Returns the drapes of ten fabrics, 300 mm on 180 mm, by rising coefficient: Gong, Mao, Wang 2024, a public
// set of meshes of 584 drapes of 25 fabrics, outlines counted with a prominence of 3 mm.
const std::vector<RealDrapes>& real_drapes() {
  static const std::vector<RealDrapes> kAll = {
      {16.4, 1.0, 10, 14}, {20.4, 0.5, 10, 11}, {30.3, 1.0, 8, 9}, {48.3, 3.3, 7, 10}, {57.4, 6.2, 6, 8},
      {70.1, 5.9, 6, 9},   {77.8, 2.0, 6, 9},   {81.9, 9.2, 3, 5}, {90.6, 1.2, 4, 6},  {91.2, 1.9, 2, 3},
  };
  return kAll;
}

// Groups the drapes by "FABRIC-LAW".
std::map<std::string, std::vector<CountedDrape>> by_column(const std::vector<CountedDrape>& drapes) {
  std::map<std::string, std::vector<CountedDrape>> columns;
  for (const CountedDrape& drape : drapes) columns[drape.fabric + "-" + drape.law].push_back(drape);
  return columns;
}

// Plots each drape's coefficient and folds over the ranges of real ones.
render::Plot folds_plot(const std::vector<CountedDrape>& drapes) {
  render::Plot plot{
      "Folds of drapes, simulated and real (Gong, Mao, Wang 2024)", {"drape coefficient [%]"}, {"folds"}};
  plot.series = real_drape_boxes("584 real drapes");
  for (const auto& [column, all] : by_column(drapes)) {
    render::Series series{all.front().fabric + ", " + all.front().law, {}, {}, render::Series::Style::points};
    for (const CountedDrape& drape : all) {
      series.add(drape.coefficient, drape.folds);
    }
    plot.series.push_back(series);
  }
  return plot;
}

}  // namespace

FoldRange real_folds(double coefficient) {
  const std::vector<RealDrapes>& all = real_drapes();
  const auto above =
      std::find_if(all.begin(), all.end(), [&](const RealDrapes& d) { return d.coefficient > coefficient; });
  const RealDrapes& high = above == all.end() ? all.back() : *above;
  const RealDrapes& low = above == all.begin() ? all.front() : *(above - 1);
  return {static_cast<double>(std::min(low.fewest, high.fewest)),
          static_cast<double>(std::max(low.most, high.most))};
}

std::vector<CountedDrape> read_counted(const std::filesystem::path& csv) {
  const Table table = read_table(csv);
  std::vector<CountedDrape> all;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    all.push_back({table.word(r, "fabric"), table.word(r, "law"),
                   table.number(r, "drape_coefficient_percent"), table.number(r, "node_count")});
  std::erase_if(all, [](const CountedDrape& drape) { return !std::isfinite(drape.coefficient); });
  return all;
}

std::vector<render::Series> real_drape_boxes(const std::string& label) {
  constexpr double kRoom = 0.2;  // margin in folds, so that a count lies within its box
  std::vector<render::Series> boxes;
  for (const RealDrapes& real : real_drapes()) {
    const double low = real.coefficient - real.deviation, high = real.coefficient + real.deviation,
                 bottom = real.fewest - kRoom, top = real.most + kRoom;
    boxes.push_back({boxes.empty() ? label : "",
                     {low, high, high, low, low},
                     {bottom, bottom, top, top, bottom},
                     render::Series::Style::line,
                     "#999999"});
  }
  return boxes;
}

void compare_folds(Run& run, const std::vector<CountedDrape>& drapes, bool pictures) {
  for (const auto& [column, all] : by_column(drapes)) {
    const auto within = std::count_if(all.begin(), all.end(), [](const CountedDrape& drape) {
      return real_folds(drape.coefficient).has(drape.folds);
    });
    run.metric(column + ".folds_as_real_percent",
               100.0 * static_cast<double>(within) / static_cast<double>(all.size()));
  }
  if (pictures) run.plot("plot_folds", folds_plot(drapes));
}

}  // namespace hysteron::experiments
