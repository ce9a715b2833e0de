#include "experiments/fit/fab_predictions.h"

#include <algorithm>
#include <cmath>

#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr double kMicroPerCentimetre = 1e4;  // µJ/cm in 1 J/m
constexpr double kBarWidth = 0.27;           // over the distance between groups of three

std::string fitted_on(const FabAnswer& answer, const std::string& direction) {
  std::string cycles;
  for (const int cycle : answer.cycles) cycles += (cycles.empty() ? "" : ", ") + std::to_string(cycle);
  return direction + " " + join(answer.tests, ", ") + " cycle " + cycles;
}

// Returns a fabric with the laws of warp and weft as far as they were identified.
FabFabric fabric_with(const std::vector<FabBending>& bending, const std::vector<FabTension>& tension,
                      double density) {
  FabFabric fabric;
  fabric.density = density;
  if (!bending.empty()) fabric.warp = bending.front().law, fabric.weft = bending[bending.size() > 1].law;
  if (!tension.empty())
    fabric.warp_tension = tension.front().law, fabric.weft_tension = tension[tension.size() > 1].law;
  return fabric;
}

template <class Found>
bool has(const std::vector<Found>& all, const std::string& direction) {
  return std::any_of(all.begin(), all.end(), [&](const Found& one) { return one.direction == direction; });
}

// True if the strip's direction was fitted, or is the bias and both warp and weft were fitted.
template <class Found>
bool can_predict(const std::vector<Found>& all, const std::string& direction) {
  return has(all, direction) || (direction == "B" && has(all, "L") && has(all, "W"));
}

template <class Found>
std::vector<Found> only(const std::vector<Found>& all, const std::string& direction) {
  if (!has(all, direction)) return all;
  std::vector<Found> one;
  for (const Found& found : all)
    if (found.direction == direction) one.push_back(found);
  return one;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool was_fitted(const FabAnswer& answer, const FabLoops& loops, int cycle) {
  return contains(answer.tests, loops.test) &&
         std::find(answer.cycles.begin(), answer.cycles.end(), cycle) != answer.cycles.end();
}

// Returns the noise of records along that direction, or else along the first that was fitted [N].
double noise_of(const FabAnswer& answer, const std::string& direction) {
  std::size_t i = 0;
  for (std::size_t k = 0; k < answer.found.bending.size(); ++k)
    if (answer.found.bending[k].direction == direction) i = k;
  return answer.repeats[i].known() ? answer.repeats[i].noise : answer.found.bending[i].noise;
}

// The same test with the strip turned over, that went the same way; null where there is none.
const ComparedLoops* repeat_of(const FabPrediction& p, const std::vector<FabPrediction>& all) {
  for (const FabPrediction& other : all) {
    const FabLoops &a = p.stops.loops, &b = other.stops.loops;
    if (b.bends() && a.direction == b.direction && a.bends_up() != b.bends_up() && a.cycles() == b.cycles() &&
        std::abs(a.gauge / b.gauge - 1) < kSameGauge)
      return &other.stops;
  }
  return nullptr;
}

void draw_prediction(Run& run, const std::string& fabric, const FabPrediction& p,
                     const std::vector<FabPrediction>& all) {
  const FabLoops& loops = p.stops.loops;
  const std::string name = "plot_" + loops.direction + "_" + loops.test,
                    title = fabric + ", " + loops.name() + ", fitted on " + p.fitted_on;
  if (!loops.bends()) return draw_loops(run, name, title, p.stops);
  std::vector<std::string> kinds;
  for (const bool fitted : p.fitted) kinds.emplace_back(fitted ? "fitted" : "predicted");
  draw_cycles(run, name, title, kinds, p.noise / loops.width, p.stops, repeat_of(p, all));
}

}  // namespace

std::vector<FabPrediction> predict(const FabAnswer& answer) {
  std::vector<FabPrediction> predictions;
  for (const FabLoops& loops : answer.loops) {
    if (!loops.is_usable) continue;
    const std::string& along = loops.direction;
    const FabIdentification& found = answer.found;
    if (loops.bends() ? !can_predict(found.bending, along) : !can_predict(found.tension, along)) continue;
    const auto run_with = [&](const std::vector<FabBending>& bending) {
      const FabFabric fabric = fabric_with(only(bending, along), only(found.tension, along), answer.density);
      return run_fab(loops, fabric.strip("B"));  // halves along one direction are alike
    };
    try {
      FabPrediction p{{loops, run_with(found.bending), true},
                      {loops, run_with(answer.one_stop), true},
                      {},
                      {},
                      noise_of(answer, along)};
      const bool own = has(found.bending, along);
      p.fitted_on = fitted_on(answer, own ? along : "L, W");
      const bool fitted =
          own && std::find(answer.tests.begin(), answer.tests.end(), loops.test) != answer.tests.end();
      for (int cycle = 1; cycle <= loops.cycles(); ++cycle)
        p.fitted.push_back(fitted && std::find(answer.cycles.begin(), answer.cycles.end(), cycle) !=
                                         answer.cycles.end());
      predictions.push_back(std::move(p));
    } catch (const Error& error) {
      if (error.exit_code() != 3) throw;
    }
  }
  return predictions;
}

void write_predictions(Run& run, const std::vector<FabPrediction>& predictions) {
  Table table(
      "loop,fitted on,is fitted,area [uJ/cm],measured area [uJ/cm],error [%],error [uJ/cm],"
      "one stop area [uJ/cm],one stop error [%],force range [N/m],measured force range [N/m],"
      "force range error [%],one stop force range error [%]");
  for (const FabPrediction& p : predictions) {
    const FabLoops& loops = p.stops.loops;
    const BranchForces measured = p.stops.measured_forces();
    for (int cycle = 0; cycle < loops.cycles(); ++cycle) {
      const double seen = kMicroPerCentimetre * loop_area(loops, measured, cycle);
      const double area = kMicroPerCentimetre * loop_area(loops, p.stops.run.force, cycle);
      const double one = kMicroPerCentimetre * loop_area(loops, p.one_stop.run.force, cycle);
      const double range = force_range(p.stops.run.force, cycle), seen_range = force_range(measured, cycle);
      const double one_range = force_range(p.one_stop.run.force, cycle);
      table.row({loops.name() + " cycle " + std::to_string(cycle + 1), p.fitted_on, p.fitted[cycle] ? 1 : 0,
                 area, seen, 100 * (area / seen - 1), area - seen, one, 100 * (one / seen - 1), range,
                 seen_range, 100 * (range / seen_range - 1), 100 * (one_range / seen_range - 1)});
    }
  }
  table.write(run.path("predictions.csv"));
}

void write_compared_loops(Run& run, const std::vector<FabPrediction>& predictions) {
  for (const FabPrediction& p : predictions)
    write_loops(run, "loops_" + p.stops.loops.direction + "_" + p.stops.loops.test + ".csv", p.stops);
}

void draw_predictions(Run& run, const std::string& fabric, const std::vector<FabPrediction>& predictions) {
  std::vector<double> measured, stops, one;
  render::Axis loops{"test, cycle"};
  for (const FabPrediction& p : predictions) {
    draw_prediction(run, fabric, p, predictions);
    if (!p.stops.loops.bends()) continue;
    const BranchForces seen = p.stops.measured_forces();
    for (int cycle = 0; cycle < p.stops.loops.cycles(); ++cycle) {
      loops.categories.push_back(p.stops.loops.name() + "." + std::to_string(cycle + 1) +
                                 (p.fitted[cycle] ? "*" : ""));
      measured.push_back(kMicroPerCentimetre * loop_area(p.stops.loops, seen, cycle));
      stops.push_back(kMicroPerCentimetre * loop_area(p.stops.loops, p.stops.run.force, cycle));
      one.push_back(kMicroPerCentimetre * loop_area(p.stops.loops, p.one_stop.run.force, cycle));
    }
  }
  if (measured.empty()) return;
  render::Plot plot{
      fabric + ": areas of loops; * fitted, all others predicted", loops, {"area per width [µJ/cm]"}};
  plot.width = 1600;
  plot.bar_width = kBarWidth;
  plot.series = render::grouped_bars({"measured", "stops", "one stop"}, {measured, stops, one}, kBarWidth);
  run.plot("plot_areas", plot);
}

namespace {

// True if the strip has the same gauge, the length between the clamps, as in a fitted test.
bool has_fitted_gauge(const FabAnswer& answer, const FabLoops& loops) {
  return std::any_of(answer.tests.begin(), answer.tests.end(), [&](const std::string& test) {
    const FabLoops& fitted = find_loops(answer.loops, loops.direction, test);
    return fitted.bends() && std::abs(loops.gauge / fitted.gauge - 1) < kSameGauge;
  });
}

}  // namespace

HeldOutErrors held_out_errors(const FabAnswer& answer, const std::string& direction, const StopsLaw& law) {
  HeldOutErrors errors;
  for (const FabLoops& loops : answer.loops) {
    if (loops.direction != direction || !loops.bends() || !loops.is_usable) continue;
    if (!has_fitted_gauge(answer, loops)) continue;
    try {
      const ComparedLoops compared(loops, run_fab(loops, {law, law, answer.density}), true);
      const BranchForces measured = compared.measured_forces();
      const auto error = [](double simulated, double seen) { return 100 * std::abs(simulated / seen - 1); };
      for (int cycle = 0; cycle < loops.cycles(); ++cycle) {
        if (was_fitted(answer, loops, cycle + 1)) continue;
        errors.area.push_back(
            error(loop_area(loops, compared.run.force, cycle), loop_area(loops, measured, cycle)));
        errors.range.push_back(error(force_range(compared.run.force, cycle), force_range(measured, cycle)));
      }
    } catch (const Error& failure) {
      if (failure.exit_code() != 3) throw;
      return {};
    }
  }
  return errors;
}

namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? NAN : sum / static_cast<double>(values.size());
}

struct FormRow {
  std::string name;
  HeldOutErrors errors;
};

// Writes the forms of one direction, the requested one first, with the errors that each leaves.
std::vector<FormRow> write_direction(Table& table, const FabAnswer& answer, std::size_t direction) {
  const FabBending& asked = answer.found.bending[direction];
  const Repeats& repeats = answer.repeats[direction];
  std::vector<FabForm> all = {{asked.form_name, asked}};
  all.insert(all.end(), answer.forms[direction].begin(), answer.forms[direction].end());
  std::vector<FormRow> rows;
  for (const FabForm& form : all) {
    const FabBending& found = form.found;
    const FormComparison beside = compare_forms(form, asked, repeats);
    rows.push_back({form.name, held_out_errors(answer, asked.direction, found.law)});
    const HeldOutErrors& errors = rows.back().errors;
    table.row({asked.direction, form.name, static_cast<int>(found.form.size()), found.residual_rms,
               repeats.known() ? Cell(found.residual_rms * asked.noise / repeats.noise) : Cell(""),
               beside.misfit, beside.preference, beside.is_excluded ? "yes" : "no", found.law.spring,
               found.law.friction(), static_cast<int>(errors.area.size()), mean(errors.area),
               mean(errors.range)});
  }
  return rows;
}

// Writes the forms that every direction has, over the cycles of all.
void write_all_directions(Table& table, const std::vector<std::vector<FormRow>>& directions) {
  for (const FormRow& first : directions.front()) {
    HeldOutErrors together;
    std::size_t found = 0;
    for (const std::vector<FormRow>& rows : directions)
      for (const FormRow& row : rows) {
        if (row.name != first.name || row.errors.area.empty()) continue;
        ++found;
        together.area.insert(together.area.end(), row.errors.area.begin(), row.errors.area.end());
        together.range.insert(together.range.end(), row.errors.range.begin(), row.errors.range.end());
      }
    if (found == directions.size())
      table.row({"all", first.name, "", "", "", "", "", "", "", "", static_cast<int>(together.area.size()),
                 mean(together.area), mean(together.range)});
  }
}

}  // namespace

void write_forms(Run& run, const FabAnswer& answer) {
  Table table(
      "direction,form,numbers,rms over noise,rms over repeats,misfit,preference,excluded (95 %),b2 [N m],HB "
      "[N],held-out cycles,area error [%],force range error [%]");
  std::vector<std::vector<FormRow>> directions;
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i)
    directions.push_back(write_direction(table, answer, i));
  if (directions.size() > 1) write_all_directions(table, directions);
  table.write(run.path("forms.csv"));
}

}  // namespace hysteron::experiments
