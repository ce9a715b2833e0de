#include "experiments/fit/from_fab.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/fab/loops.h"
#include "experiments/fit/predictions.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/parallel.h"
#include "sim/identification/series.h"

namespace hysteron::experiments {
namespace {

constexpr int kThreads = 2;

// Farther from the data, what was fitted is not what was measured: rms over the noise of bending, and over
// the largest force of stretch, which no law of stops follows to less than some percent.
constexpr double kMaxOverNoise = 3, kMaxOfStretch = 0.1;

std::vector<double> parsed_numbers(const std::string& text, const std::string& key) {
  std::vector<double> numbers;
  for (const std::string& word : split(text)) {
    const auto number = number_in(word);
    if (!number || !(*number > 0) || !std::isfinite(*number))
      throw Error::invalid_input(key + " = " + text + " must be numbers > 0 separated by commas")
          .with_key(key, text);
    numbers.push_back(*number);
  }
  if (numbers.empty() || !std::is_sorted(numbers.begin(), numbers.end(), std::less_equal<>()))
    throw Error::invalid_input(key + " = " + text + " must be numbers that rise").with_key(key, text);
  return numbers;
}

std::vector<int> parsed_cycles(const std::string& text) {
  std::vector<int> cycles;
  for (const double cycle : parsed_numbers(text, "fab.cycles")) {
    if (cycle != std::floor(cycle))
      throw Error::invalid_input("fab.cycles = " + text + " must be whole numbers, the first cycle being 1")
          .with_key("fab.cycles", text);
    cycles.push_back(static_cast<int>(cycle));
  }
  return cycles;
}

bool is_bias(const std::string& direction) { return strip_direction(direction) == StripDirection::bias; }

// Those asked for, of which the first is warp and the second weft: a bias is neither, unless it is alone.
// None asked for: warp before weft, whatever their order in the file, or the bias where it is alone.
std::vector<std::string> requested_directions(const std::string& text, const std::vector<FabLoops>& loops) {
  std::vector<std::string> directions = split(text);
  if (directions.size() > 1 && (is_bias(directions[0]) || is_bias(directions[1])))
    throw Error::invalid_input(
        "fab.directions = " + text +
        " must begin with warp and weft, L,W, or name the bias alone, B: it stands for neither")
        .with_key("fab.directions", text);
  if (!directions.empty()) return directions;
  for (const FabLoops& one : loops)
    if (std::find(directions.begin(), directions.end(), one.direction) == directions.end())
      directions.push_back(one.direction);
  std::stable_sort(directions.begin(), directions.end(), [](const std::string& a, const std::string& b) {
    return strip_direction(a) < strip_direction(b);
  });
  if (directions.size() > 1) std::erase_if(directions, is_bias);
  return directions;
}

Error misfit(const std::string& direction, const std::string& by, double noise) {
  return Error::invalid_input(
             fmt::format("along {} the fit misses the forces by {}: check gauge, width, density, tests and "
                         "cycles; data that scatter so are fitted with --fab.noise {:.2g} [N]",
                         direction, by, noise))
      .with_key("fab.noise", "");
}

void check_fit(const FabBending& b, double noise) {
  for (const auto& [name, rigidity] : {std::pair{"b1", b.law.initial_stiffness()}, {"b2", b.law.spring}})
    if (!(rigidity >= kMinRigidity && rigidity <= kGreatestRigidity))
      throw Error::invalid_input(
          fmt::format("along {} the fit finds {} = {:.3g} N m, must be in [{:g}, {:g}] N m, as "
                      "fabrics are: check the units of forces and lengths, and the width",
                      b.direction, name, rigidity, kMinRigidity, kGreatestRigidity));
  if (!(b.residual_rms <= kMaxOverNoise))
    throw misfit(
        b.direction,
        fmt::format("{:.2g} times their noise of {:g} N (rms), at most {:g} times is taken for noise",
                    b.residual_rms, noise, kMaxOverNoise),
        noise * b.residual_rms);
}

void check_fit(const FabTension& t, double width, double noise) {
  const double most = std::max(kMaxOfStretch * t.largest_force, kMaxOverNoise * noise / width);
  if (!(t.residual_rms <= most))
    throw misfit(t.direction,
                 fmt::format("{:.2g} % of the largest in stretch (rms), at most {:g} % is taken for noise",
                             100 * t.residual_rms / t.largest_force, 100 * kMaxOfStretch),
                 t.residual_rms * width);
}

// Loops of one direction that bend, or that stretch, among the tests asked for.
std::vector<FabLoops> requested(const FabAnswer& answer, const std::string& direction, bool bending) {
  std::vector<FabLoops> loops;
  for (const std::string& test : answer.tests) {
    const FabLoops& one = find_loops(answer.loops, direction, test);
    if (one.bends() == bending) loops.push_back(one);
  }
  return loops;
}

std::string where_from(const FabFlags& flags, const std::vector<std::string>& directions) {
  return "cycle " + flags.cycles + " of " + flags.tests + " along " + join(directions, ", ") + " in " +
         std::filesystem::path(flags.file).filename().string();
}

void write_spectrum(Run& run, const FabIdentification& found) {
  Table table("direction,kind,threshold,stiffness,standard error,unit,determined");
  const auto rows = [&](const std::string& direction, const char* kind, const StopsLaw& law,
                        double spring_error, const std::vector<double>& errors,
                        const std::vector<bool>& determined, const char* unit) {
    table.row({direction, kind, "", law.spring, spring_error, unit, determined[0] ? 1 : 0});
    for (int j = 0; j < law.stops(); ++j)
      table.row({direction, kind, law.thresholds[j], law.stiffnesses[j], errors[j], unit,
                 determined[j + 1] ? 1 : 0});
  };
  for (const FabBending& b : found.bending)
    rows(b.direction, "bending", b.law, b.spring_error, b.stiffness_errors, b.determined, "N m");
  for (const FabTension& t : found.tension)
    rows(t.direction, "tension", t.law, t.spring_error, t.stiffness_errors, t.determined, "N/m");
  table.write(run.path("spectrum.csv"));
}

void add_fab_metrics(Run& run, const FabAnswer& answer) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i) {
    const FabBending& b = answer.found.bending[i];
    const std::string p = b.direction + ".";
    run.metric(p + "b2_N_m", b.law.spring);
    run.metric(p + "b2_N_m_stderr", b.spring_error);
    run.metric(p + "b1_N_m", b.law.initial_stiffness());
    run.metric(p + "HB_N", b.law.friction());
    run.metric(p + "HB_N_stderr", b.friction_error);
    add_shape(run, b, p);
    run.metric(p + "residual_over_noise", b.residual_rms);
    for (const FabForm& form : answer.forms[i])
      if (form.name == "k0 = 50/m") run.metric(p + "k0_50.misfit", form.misfit(b));
    run.metric(p + "iterations", b.iterations);
    run.metric(p + "converged", b.converged);
    run.metric(p + "one_stop.threshold_per_m", answer.one_stop[i].law.thresholds[0]);
    run.metric(p + "one_stop.residual_over_noise", answer.one_stop[i].residual_rms);
    for (const std::string& name : b.undetermined()) open.push_back(b.direction + " " + name);
  }
  for (const FabTension& t : answer.found.tension) {
    const std::string p = t.direction + ".tension.";
    run.metric(p + "spring_N_per_m", t.law.spring);
    run.metric(p + "spring_N_per_m_stderr", t.spring_error);
    run.metric(p + "initial_N_per_m", t.law.initial_stiffness());
    run.metric(p + "friction_N_per_m", t.law.friction());
    run.metric(p + "residual_rms_percent", 100 * t.residual_rms / t.largest_force);
    for (const std::string& name : t.undetermined()) open.push_back(t.direction + " " + name);
  }
  run.metric("undetermined", open);
}

}  // namespace

void write_forms(Run& run, const FabAnswer& answer) {
  Table table("direction,form,numbers,rms over noise,misfit,excluded (95 %),b2 [N m],HB [N]");
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i) {
    const FabBending& best = answer.found.bending[i];
    std::vector<FabForm> all = {{best.is_shaped() ? "shaped" : "stops", best}};
    all.insert(all.end(), answer.forms[i].begin(), answer.forms[i].end());
    for (const FabForm& form : all) {
      const double misfit = form.misfit(best);
      table.row({best.direction, form.name, static_cast<int>(form.found.form.size()), form.found.residual_rms,
                 misfit, misfit > kLikelihoodFall ? "yes" : "no", form.found.law.spring,
                 form.found.law.friction()});
    }
  }
  table.write(run.path("forms.csv"));
}

void add_shape(Run& run, const FabBending& b, const std::string& prefix) {
  if (!b.is_shaped()) return;
  const FrictionShape shape = friction_shape(b.form);
  run.metric(prefix + "median_per_m", shape.median);
  run.metric(prefix + "median_per_m_stderr", b.form_errors[1] * shape.median);
  run.metric(prefix + "spread", shape.spread);
  run.metric(prefix + "spread_stderr", b.form_errors[2] * shape.spread);
}

FabAnswer fit_fab(const FabFlags& flags, const std::string& units, double density) {
  FabAnswer answer;
  answer.loops = read_fab(flags.file, tester_units(units), "fit");
  answer.tests = split(flags.tests);
  answer.cycles = parsed_cycles(flags.cycles);
  const std::vector<std::string> directions = requested_directions(flags.directions, answer.loops);
  answer.found.from = where_from(flags, directions);
  FabBendingQuestion bending;
  bending.cycles = answer.cycles;
  bending.thresholds = parsed_numbers(flags.thresholds, "fab.thresholds");
  bending.density = density;
  bending.noise = flags.noise;
  FabBendingQuestion main = bending;
  if (flags.friction == "shaped") main.form = shaped_friction();
  FabTensionQuestion tension;
  tension.cycles = answer.cycles;
  tension.noise = std::max(tension.noise, flags.noise);
  std::vector<FabBending> stops(directions.size()), one(directions.size());
  std::vector<FabTension> stretched(directions.size());
  std::vector<std::vector<FabForm>> forms(directions.size());
  in_parallel(directions.size(), kThreads, [&](std::size_t i) {
    if (const auto loops = requested(answer, directions[i], true); !loops.empty()) {
      stops[i] = identify_fab_bending(loops, main);
      check_fit(stops[i], flags.noise);
      one[i] = identify_one_stop(loops, bending);
      forms[i] = even_forms(loops, bending);
      forms[i].insert(forms[i].begin(),
                      {"one stop at " + number_text(one[i].law.thresholds[0]) + "/m", one[i]});
      if (main.form)
        forms[i].insert(forms[i].begin(),
                        {free_stops(bending.thresholds).name, identify_fab_bending(loops, bending)});
    }
    if (const auto loops = requested(answer, directions[i], false); !loops.empty()) {
      stretched[i] = identify_fab_tension(loops, tension);
      check_fit(stretched[i], loops[0].width, tension.noise);
    }
  });
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (stops[i].rows > 0) {
      answer.found.bending.push_back(stops[i]);
      answer.one_stop.push_back(one[i]);
      answer.forms.push_back(forms[i]);
    }
    if (stretched[i].rows > 0) answer.found.tension.push_back(stretched[i]);
  }
  if (answer.found.bending.empty())
    throw Error::invalid_input("needs a test that bends (U.., D..) among --fab.tests for b1, b2 and k0")
        .with_key("fab.tests", flags.tests);
  return answer;
}

void report_fab(Run& run, const FabAnswer& answer, const FabricNotes& notes) {
  for (const FabBending& b : answer.found.bending)
    if (!b.converged) run.warn("along " + b.direction + " the fit of bending did not converge");
  for (const FabTension& t : answer.found.tension)
    if (!t.converged) run.warn("along " + t.direction + " the fit of stretch did not converge");
  FabIdentification one{answer.one_stop, {}, answer.found.from + ", by one stop"};
  write_fab_fabric(run.path("fabric.toml"), answer.found, notes);
  write_fab_fabric(run.path("one_stop.toml"), one, notes);
  write_spectrum(run, answer.found);
  write_forms(run, answer);
  add_fab_metrics(run, answer);
  const std::vector<FabPrediction> predictions = predict(answer, notes.density.value_or(0));
  write_predictions(run, predictions);
  write_compared_loops(run, predictions);
  draw_predictions(run, notes.name, predictions);
}

std::string summary(const FabAnswer& answer) {
  std::string text;
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i) {
    const FabBending& b = answer.found.bending[i];
    const std::vector<std::string> open = b.undetermined();
    text += fmt::format(
        "along {}: b2 = {:.3g} +- {:.2g} N m, HB = {:.3g} +- {:.2g} N, b1 = {:.3g} N m; rms {:.2g} "
        "of the noise, {} iterations\n",
        b.direction, b.law.spring, b.spring_error, b.law.friction(), b.friction_error,
        b.law.initial_stiffness(), b.residual_rms, b.iterations);
    if (b.is_shaped()) {
      const FrictionShape shape = friction_shape(b.form);
      text += fmt::format(
          "  friction slips about {:.3g}/m (a factor of {:.2g}), spread {:.3g} (a factor of {:.2g})\n",
          shape.median, std::exp(b.form_errors[1]), shape.spread, std::exp(b.form_errors[2]));
    }
    text += "  undetermined: " + (open.empty() ? std::string("nothing") : join(open, ", ")) + "\n";
    for (const FabForm& form : answer.forms[i])
      text +=
          fmt::format("  {}: rms {:.2g} of the noise, misfit {:.3g}{}\n", form.name, form.found.residual_rms,
                      form.misfit(b), form.misfit(b) > kLikelihoodFall ? ", excluded" : "");
  }
  for (const FabTension& t : answer.found.tension)
    text += fmt::format(
        "along {}: stretch {:.3g} +- {:.2g} N/m beside stops, {:.3g} N/m at first; rms {:.2g} % "
        "of the largest force\n",
        t.direction, t.law.spring, t.spring_error, t.law.initial_stiffness(),
        100 * t.residual_rms / t.largest_force);
  return text;
}

}  // namespace hysteron::experiments
