#include "experiments/validate/budget.h"

#include <algorithm>
#include <cmath>

#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"

namespace hysteron::experiments {
namespace {

// The columns of budget.csv.
constexpr const char* kMean = "mean drape coefficient [%]";
constexpr const char* kError = "standard error [%]";
constexpr const char* kChange = "change [%]";
constexpr const char* kPublished = "published [%]";

// A row of budget.csv.  Coefficients [%] are means over the meshes.
struct BudgetRow {
  std::string fabric, number, value;
  int meshes = 0;
  double coefficient = NAN, error = NAN;  // mean and its standard error
  double change = NAN, published = NAN;   // difference from the nominal row
};

// Returns the plot of one fabric's rows, the first of which is nominal.
render::Plot budget_plot(const std::vector<BudgetRow>& rows) {
  render::Plot plot{
      "Drape of " + rows.at(0).fabric + ", one unknown at a time", {""}, {"drape coefficient [%]"}};
  render::Series low{"low end of a range", {}, {}, render::Series::Style::points};
  render::Series high{"high end, or as named", {}, {}, render::Series::Style::points};
  render::Series errors{"standard error", {}, {}, render::Series::Style::line, "#888888"};
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const bool second = rows[i].number == rows[i - 1].number,
               single = !second && (i + 1 == rows.size() || rows[i + 1].number != rows[i].number);
    if (!second) plot.x.categories.push_back(rows[i].number);
    render::Series& series = second || single ? high : low;
    series.add(static_cast<double>(plot.x.categories.size() - 1), rows[i].coefficient);
    for (const double sign : {-1., 1., double(NAN)}) {  // NaN makes a gap between bars
      errors.add(series.x.back(), rows[i].coefficient + sign * rows[i].error);
    }
  }
  const double last = static_cast<double>(plot.x.categories.size()) - 1, nominal = rows[0].coefficient,
               measured = rows[0].published;
  plot.series = {
      {"as its file says", {0, last}, {nominal, nominal}}, {"measured", {}, {}}, errors, low, high};
  if (!std::isnan(measured))
    plot.series[1] = {"measured", {0, last}, {measured, measured}, render::Series::Style::dashed, "#000000"};
  std::erase_if(plot.series, [](const render::Series& series) { return series.x.empty(); });
  plot.key_inside = true;
  constexpr double kRoomForTheKey = 10, kAir = 2;  // [%]
  plot.y.low = plot.y.high = std::isnan(measured) ? nominal : measured;
  for (const BudgetRow& row : rows) {
    plot.y.low = std::min(plot.y.low, row.coefficient);
    plot.y.high = std::max(plot.y.high, row.coefficient + kAir);
  }
  plot.y.low -= kRoomForTheKey;
  return plot;
}

Drape with_swapped_standard(Drape drape) {
  const bool shaken = drape.standard == DrapeStandard::jis;
  drape.standard = shaken ? DrapeStandard::iso9073 : DrapeStandard::jis;
  drape.release = shaken ? DrapeRelease::lowered : DrapeRelease::shaken;
  drape.measured = measured_on(drape.standard, read_fabric(drape.fabric, "--fabrics").fabric);
  return drape;
}

// Returns the drapes of trial `number`, one for each mesh.
std::vector<Drape> trial_drapes(const Trial& trial, std::size_t number, int draws) {
  std::vector<Drape> drapes;
  for (int draw = 1; draw <= draws; ++draw) {
    Drape& drape = drapes.emplace_back(trial.drape);
    drape.varied = "budget-" + std::to_string(number) + "-" + std::to_string(draw);
    drape.further.push_back({"seed", std::to_string(draw)});
    drape.further.push_back({"no-images", "true"});
  }
  return drapes;
}

}  // namespace

std::vector<Trial> budget_trials(const std::string& fabric, const ValidateFlags& flags) {
  const FabricFile file = read_fabric(fabric, "--fabrics");
  const Drape nominal = nominal_drape(fabric, flags);
  std::vector<Trial> trials = {{"as its file says", "", nominal}};
  for (const auto& [key, range] : uncertain_numbers(file))
    for (const double end : {range.low, range.high}) {
      Sample sample = {{key, end}};
      keep_what_was_measured(file.fabric, sample);
      trials.push_back({key, number_text(end), nominal});
      trials.back().drape.further = drape_flags(sample);
    }
  const Drape other = with_swapped_standard(nominal);
  trials.push_back({"tester", enum_name(other.standard), other});
  Drape finer = nominal;
  finer.triangles *= 4;
  trials.push_back({"mesh", std::to_string(finer.triangles), finer});
  return trials;
}

void write_budget(const ValidateFlags& flags, Run& run) {
  Table table({"fabric", "number", "value", "meshes", kMean, kError, kChange, kPublished});
  for (const std::string& given : split(flags.fabrics)) {
    const std::vector<Trial> trials = budget_trials(given, flags);
    const std::string fabric = trials[0].drape.label;
    std::vector<Drape> all;
    for (std::size_t t = 0; t < trials.size(); ++t)
      for (Drape& drape : trial_drapes(trials[t], t, flags.draws)) all.push_back(std::move(drape));
    run_drapes(all, flags, run);
    std::vector<BudgetRow> rows;
    for (const Trial& trial : trials) {
      const Drape* drapes = &all[rows.size() * static_cast<std::size_t>(flags.draws)];
      std::vector<double> coefficients;
      for (int draw = 0; draw < flags.draws; ++draw) coefficients.push_back(drapes[draw].coefficient());
      BudgetRow& row = rows.emplace_back(
          BudgetRow{fabric, trial.number, trial.value, flags.draws, mean_value(coefficients),
                    sample_deviation(coefficients) / std::sqrt(flags.draws), NAN, drapes->published()});
      row.change = row.coefficient - rows[0].coefficient;
      table.row(
          {fabric, row.number, row.value, row.meshes, row.coefficient, row.error, row.change, row.published});
      if (rows.size() > 1)
        run.metric(fabric + "." + row.number + "=" + row.value + ".change_percent", row.change);
    }
    if (!flags.options.no_images) run.plot("plot_budget_" + fabric, budget_plot(rows));
  }
  table.write(run.path("budget.csv"));
}

}  // namespace hysteron::experiments
