// Fold counts of drapes against those of real cloth: a coefficient alone does not tell whether a drape looks
// like one.
#include "experiments/validate/drapes.h"

#include <algorithm>
#include <map>

#include "render/plot.h"

namespace hysteron::experiments {
namespace {

// What was counted on real drapes of one fabric.
struct RealDrapes {
  double coefficient, deviation;  // mean and standard deviation [%]
  int fewest, most;               // folds
};

// Of ten fabrics, 300 mm on 180 mm: Gong, Mao, Wang 2024, a public set of meshes of 584 drapes of 25 fabrics,
// outlines counted with a prominence of 3 mm.  By rising coefficient.
const std::vector<RealDrapes>& real_drapes() {
  static const std::vector<RealDrapes> kAll = {
      {16.4, 1.0, 10, 14}, {20.4, 0.5, 10, 11}, {30.3, 1.0, 8, 9}, {48.3, 3.3, 7, 10}, {57.4, 6.2, 6, 8},
      {70.1, 5.9, 6, 9},   {77.8, 2.0, 6, 9},   {81.9, 9.2, 3, 5}, {90.6, 1.2, 4, 6},  {91.2, 1.9, 2, 3},
  };
  return kAll;
}

// The range of folds that real drapes of this coefficient [%] have: between those of the two fabrics around
// it.
struct FoldRange {
  double fewest, most;
};
FoldRange real_folds(double coefficient) {
  const std::vector<RealDrapes>& all = real_drapes();
  const auto above =
      std::find_if(all.begin(), all.end(), [&](const RealDrapes& d) { return d.coefficient > coefficient; });
  const RealDrapes& high = above == all.end() ? all.back() : *above;
  const RealDrapes& low = above == all.begin() ? all.front() : *(above - 1);
  return {static_cast<double>(std::min(low.fewest, high.fewest)),
          static_cast<double>(std::max(low.most, high.most))};
}

}  // namespace

void compare_folds(Run& run, const std::vector<Drape>& drapes, bool pictures) {
  render::Plot plot{"Folds of drapes, simulated and real", {"drape coefficient [%]"}, {"folds"}};
  for (const RealDrapes& real : real_drapes()) {
    const double low = real.coefficient - real.deviation, high = real.coefficient + real.deviation;
    plot.series.push_back(
        {&real == &real_drapes().front() ? "584 real drapes (Gong, Mao, Wang 2024)" : "",
         {low, high, high, low, low},
         {real.fewest - 0.2, real.fewest - 0.2, real.most + 0.2, real.most + 0.2, real.fewest - 0.2},
         render::Series::Style::line,
         "#999999"});
  }
  std::map<std::string, std::vector<const Drape*>> by_column;
  for (const Drape& drape : drapes) by_column[drape.fabric + "-" + drape.law].push_back(&drape);
  for (const auto& [column, all] : by_column) {
    render::Series series{
        all.front()->fabric + ", " + all.front()->law, {}, {}, render::Series::Style::points};
    int within = 0;
    for (const Drape* drape : all) {
      const double folds = drape->number("node_count");
      const FoldRange range = real_folds(drape->coefficient());
      within += folds >= range.fewest && folds <= range.most;
      series.x.push_back(drape->coefficient());
      series.y.push_back(folds);
    }
    run.metric(column + ".folds_as_real_percent", 100.0 * within / static_cast<double>(all.size()));
    plot.series.push_back(series);
  }
  if (pictures) run.plot("plot_folds", plot);
}

}  // namespace hysteron::experiments
