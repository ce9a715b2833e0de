// What each unknown of a fabric explains of a drape: one at a time at both ends of its range.
#include "experiments/validate/spread.h"

#include <cmath>

#include "experiments/validate/drapes.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

// A drape that is told one thing more, on several meshes.
struct Trial {
  std::string number, value;  // "shear", "30"
  Drape drape;
  double coefficient = NAN, error = NAN;  // mean of the meshes and its standard error [%]
};

std::vector<Trial> trials_of(const FabricFile& file, const ValidateFlags& flags) {
  const Drape nominal = nominal_drape(file.fabric.name, flags);
  std::vector<Trial> trials = {{"as its file says", "", nominal}};
  for (const auto& [key, range] : file.range)
    for (const double end : {range.low, range.high}) {
      Sample sample = {{key, end}};
      keep_what_was_measured(file.fabric, sample);
      trials.push_back({key, number_text(end), nominal});
      trials.back().drape.further = flags_of(sample);
    }
  Drape other = nominal;
  const bool shaken = nominal.standard == "jis";
  other.standard = shaken ? "iso9073" : "jis";
  other.release = shaken ? "lowered" : "shaken";
  trials.push_back({"tester", other.standard, other});
  Drape finer = nominal;
  finer.triangles *= 4;
  trials.push_back({"mesh", std::to_string(finer.triangles), finer});
  return trials;
}

void run_trial(Trial& trial, int number, const ValidateFlags& flags, Run& run) {
  std::vector<double> coefficients;
  for (int draw = 1; draw <= flags.draws; ++draw) {
    Drape drape = trial.drape;
    drape.varied = "budget-" + std::to_string(number) + "-" + std::to_string(draw);
    drape.further.push_back({"seed", std::to_string(draw)});
    drape.further.push_back({"no-images", "true"});
    run_drape(drape, flags, run);
    trial.drape.metrics = drape.metrics;
    coefficients.push_back(drape.coefficient());
  }
  trial.coefficient = mean_of(coefficients);
  trial.error = spread_of(coefficients) / std::sqrt(flags.draws);
}

void draw_budget(Run& run, const std::string& fabric, const std::vector<Trial>& trials) {
  render::Plot plot{
      "What moves the drape of " + fabric + ", one unknown at a time", {""}, {"drape coefficient [%]"}};
  render::Series low{"low end of its range", {}, {}, render::Series::Style::points};
  render::Series high{"high end, other tester, finer mesh", {}, {}, render::Series::Style::points};
  for (std::size_t i = 1; i < trials.size(); ++i) {
    const bool second = trials[i].number == trials[i - 1].number,
               single = !second && (i + 1 == trials.size() || trials[i + 1].number != trials[i].number);
    if (!second) plot.x.categories.push_back(trials[i].number);
    render::Series& series = second || single ? high : low;
    series.x.push_back(static_cast<double>(plot.x.categories.size() - 1));
    series.y.push_back(trials[i].coefficient);
  }
  const double last = static_cast<double>(plot.x.categories.size()) - 1,
               measured = trials[0].drape.published();
  plot.series = {{"as its file says", {0, last}, {trials[0].coefficient, trials[0].coefficient}},
                 {"measured", {0, last}, {measured, measured}, render::Series::Style::dashed, "#000000"},
                 low,
                 high};
  run.plot("plot_budget_" + fabric, plot);
}

}  // namespace

void write_budget(const ValidateFlags& flags, Run& run) {
  CsvFile file(
      run.path("budget.csv"),
      "fabric,number,value,meshes,mean drape coefficient [%],standard error [%],change [%],published [%]");
  for (const std::string& fabric : split(flags.fabrics)) {
    std::vector<Trial> trials = trials_of(read_fabric(fabric, "--fabrics"), flags);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      Trial& trial = trials[i];
      run_trial(trial, static_cast<int>(i), flags, run);
      file.row({fabric, trial.number, trial.value, flags.draws, trial.coefficient, trial.error,
                trial.coefficient - trials[0].coefficient, trial.drape.published()});
      if (i > 0)
        run.metric(fabric + "." + trial.number + "=" + trial.value + ".change_percent",
                   trial.coefficient - trials[0].coefficient);
    }
    if (!flags.options.no_images) draw_budget(run, fabric, trials);
  }
  file.commit();
}

}  // namespace hysteron::experiments
