#include "experiments/fit/from_fab.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>

#include "experiments/fab/loops.h"
#include "experiments/fit/fab_predictions.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/parallel.h"
#include "sim/identification/loop_warnings.h"
#include "sim/identification/series.h"

namespace hysteron::experiments {
namespace {

// Limits of a credible fit: rms over the noise for bending, and over the largest force for stretch, which no
// law of stops follows to better than some percent.
constexpr double kMaxOverNoise = 3, kMaxOfStretch = 0.1;

// Largest share of HB beyond the data's reach: the data must cover most of a shape to determine it.
constexpr double kMostBeyondReach = 0.5;

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

// Returns the requested directions, of which the first is warp and the second weft; a bias is neither, unless
// it is alone.  By default warp comes before weft, whatever their order in the file, or the bias if it is
// alone.
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

// Returns the loops of one direction that bend, or that stretch, among the requested tests.
std::vector<FabLoops> requested(const FabAnswer& answer, const std::string& direction, bool bending) {
  std::vector<FabLoops> loops;
  for (const std::string& test : answer.tests) {
    const FabLoops& one = find_loops(answer.loops, direction, test);
    if (one.bends() == bending) loops.push_back(one);
  }
  return loops;
}

// The fits of one direction; fits that were not requested have no rows.
struct DirectionFits {
  FabBending bending, free, shaped, one;  // requested form; free stops, a shape, and one stop for comparison
  std::vector<FabForm> even;
  FabTension stretch;

  // Returns the forms of friction other than the requested one.
  std::vector<FabForm> forms(const std::string& name_of_free) const {
    std::vector<FabForm> all;
    if (free.rows > 0) all.push_back({name_of_free, free});
    if (shaped.rows > 0) all.push_back({"shaped", shaped});
    all.push_back({"one stop at " + number_text(one.law.thresholds[0]) + "/m", one});
    all.insert(all.end(), even.begin(), even.end());
    return all;
  }
  // Drops the forms of the requested family: a parabola's own error already states how far k0 may lie.
  std::vector<FabForm> other_families(std::vector<FabForm> all) const {
    if (bending.is_parabola()) std::erase_if(all, [](const FabForm& form) { return form.fixes_k0; });
    return all;
  }
};

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

// Adds the common k0 of all directions: the mean of its logarithms, weighted by their errors.
void add_common_saturation(Run& run, const std::vector<FabBending>& bending) {
  double weights = 0, sum = 0;
  for (const FabBending& b : bending) {
    if (!b.is_parabola()) return;
    const double weight = 1 / (b.form_errors[1] * b.form_errors[1]);
    weights += weight;
    sum += weight * std::log(saturation_curvature(b.form));
  }
  const double k0 = std::exp(sum / weights);
  run.metric("k0_per_m", k0);
  run.metric("k0_per_m_stderr", k0 / std::sqrt(weights));
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
      if (form.name == "k0 = 50/m")
        run.metric(p + "k0_50.misfit", compare_forms(form, b, answer.repeats[i]).misfit);
    if (const Repeats& repeats = answer.repeats[i]; repeats.known()) {
      run.metric(p + "repeats_noise_N", repeats.noise);
      run.metric(p + "repeats_correlation", repeats.correlation);
    }
    run.metric(p + "iterations", b.iterations);
    run.metric(p + "converged", b.converged);
    run.metric(p + "one_stop.threshold_per_m", answer.one_stop[i].law.thresholds[0]);
    run.metric(p + "one_stop.residual_over_noise", answer.one_stop[i].residual_rms);
    for (const std::string& name : b.undetermined()) open.push_back(b.direction + " " + name);
  }
  add_common_saturation(run, answer.found.bending);
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

void add_shape(Run& run, const FabBending& b, const std::string& prefix) {
  if (b.is_parabola()) {
    const double k0 = saturation_curvature(b.form);
    run.metric(prefix + "k0_per_m", k0);
    run.metric(prefix + "k0_per_m_stderr", b.form_errors[1] * k0);
  }
  if (!b.is_shaped()) return;
  const FrictionShape shape = friction_shape(b.form);
  run.metric(prefix + "median_per_m", shape.median);
  run.metric(prefix + "median_per_m_stderr", b.form_errors[1] * shape.median);
  run.metric(prefix + "spread", shape.spread);
  run.metric(prefix + "spread_stderr", b.form_errors[2] * shape.spread);
}

FabAnswer fit_fab(const FabFlags& flags, TesterUnits units, double density) {
  FabAnswer answer;
  answer.tests = split(flags.tests);
  answer.cycles = parsed_cycles(flags.cycles);
  answer.density = density;
  const auto among = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const std::vector<std::string> asked = split(flags.directions);
  const auto asks_for = [&](const FabLoops& one) {
    return (asked.empty() || among(asked, one.direction)) && among(answer.tests, one.test);
  };
  answer.loops = read_fab(flags.file, units, "fit", {asks_for, answer.cycles, flags.noise});
  const std::vector<std::string> directions = requested_directions(flags.directions, answer.loops);
  answer.found.from = where_from(flags, directions);
  FabBendingQuestion bending;
  bending.cycles = answer.cycles;
  bending.thresholds = parsed_numbers(flags.thresholds, "fab.thresholds");
  bending.density = density;
  bending.noise = flags.noise;
  FabBendingQuestion main = bending;
  if (flags.friction == FabFriction::shaped) main.form = shaped_friction();
  if (flags.friction == FabFriction::chapter) main.form = parabola_friction();
  FabTensionQuestion tension;
  tension.cycles = answer.cycles;
  tension.noise = std::max(tension.noise, flags.noise);
  std::vector<DirectionFits> fits(directions.size());
  // Fits of the requested form; fits that are compared with it.
  std::vector<std::function<void()>> requests, others;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    DirectionFits& fit = fits[i];
    if (const auto loops = requested(answer, directions[i], true); !loops.empty()) {
      requests.emplace_back([=, &fit] {
        fit.bending = identify_fab_bending(loops, main);
        check_fit(fit.bending, bending.noise);
      });
      if (main.form) others.emplace_back([=, &fit] { fit.free = identify_fab_bending(loops, bending); });
      if (flags.friction == FabFriction::chapter) {
        FabBendingQuestion shaped = bending;
        shaped.form = shaped_friction();
        others.emplace_back([=, &fit] { fit.shaped = identify_fab_bending(loops, shaped); });
      }
      others.emplace_back([=, &fit] { fit.even = even_forms(loops, bending); });
      others.emplace_back([=, &fit] { fit.one = identify_one_stop(loops, bending); });
    }
    if (const auto loops = requested(answer, directions[i], false); !loops.empty())
      requests.emplace_back([=, &fit] {
        fit.stretch = identify_fab_tension(loops, tension);
        check_fit(fit.stretch, loops[0].width, tension.noise);
      });
  }
  for (const auto& jobs : {requests, others})
    in_parallel(jobs.size(), static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
                [&](std::size_t j) { jobs[j](); });
  for (DirectionFits& fit : fits) {
    if (fit.bending.rows > 0) {
      answer.forms.push_back(fit.forms(free_stops(bending.thresholds).name));
      answer.found.bending.push_back(fit.bending);
      answer.repeats.push_back(
          find_repeats(answer.loops, requested(answer, fit.bending.direction, true), bending));
      widen_errors(answer.found.bending.back(), fit.other_families(answer.forms.back()),
                   answer.repeats.back());
      answer.one_stop.push_back(fit.one);
    }
    if (fit.stretch.rows > 0) answer.found.tension.push_back(fit.stretch);
  }
  if (answer.found.bending.empty())
    throw Error::invalid_input("needs a test that bends (U.., D..) among --fab.tests for b1, b2 and k0")
        .with_key("fab.tests", flags.tests);
  return answer;
}

namespace {

// The words for a kind of data, and for what may improve a fit to it.
struct RecordTexts {
  const char *data, *larger, *range, *remedy, *better_form;
};
constexpr RecordTexts kLoopTexts = {
    "loops", "which the fitted cycles do not reach: the form asked for supposes it; fit a larger compression",
    "the range of their forces",
    "see plots and predictions.csv; other cycles, gauge, width and density may be nearer",
    "give --fab.friction stops"};
constexpr RecordTexts kDecayTexts = {
    "amplitudes", "which the strip does not reach: the form supposes it; let it go from a larger amplitude",
    "the first one", "see plot_decay and decay.csv; another length, density, rigidity may be nearer",
    "forms.csv has its numbers"};

// Warns if another form describes the data significantly better than the requested one.
std::string better_form_warning(const FabBending& b, const std::vector<FabForm>& forms,
                                const Repeats& repeats, const RecordTexts& texts) {
  const FabForm* best = nullptr;
  for (const FabForm& form : forms)
    if (!best || form.found.residual_rms < best->found.residual_rms) best = &form;
  if (!best) return "";
  const FormComparison beside = compare_forms(*best, b, repeats);
  if (!beside.is_nearer) return "";
  return fmt::format(
      "along {} another form of friction describes the {} better: {} leave {:.2g} of the noise (rms), and "
      "the form asked for {:.2g} (preference {:.3g}; below -1.96 is not by chance): {}",
      b.direction, texts.data, best->name, best->found.residual_rms, b.residual_rms, beside.preference,
      (b.is_shaped() || b.is_parabola()) && best->found.law.stops() > 1 && best->name.ends_with("stops")
          ? texts.better_form
          : "forms.csv has its numbers");
}

// Warns if friction that slips beyond the data's reach comes from the assumed form, not from the data.
std::string beyond_reach_warning(const FabBending& b, const RecordTexts& texts) {
  const double beyond = 1 - b.friction_within_reach() / b.law.friction();
  if (!(beyond > kMostBeyondReach)) return "";
  return fmt::format(
      "along {} {:.0f} % of HB slips at curvatures that differ by more than {:.3g}/m from those at the "
      "start, {}",
      b.direction, 100 * beyond, b.reach, texts.larger);
}

// Warns that the numbers may mean little because the law stays this far from the data.
std::string misses_warning(const FabBending& b, const RecordTexts& texts) {
  if (!(b.residual_share > kImplausibleMiss)) return "";
  return fmt::format("along {} the fit misses the fitted {} by {:.2g} % of {} (rms): {}", b.direction,
                     texts.data, 100 * b.residual_share, texts.range, texts.remedy);
}

// Warns that the file has loops along the bias and the fabric does not; "" otherwise.
std::string unused_bias_warning(const FabAnswer& answer) {
  const auto& fitted = answer.found.bending;
  const auto is_of_bias = [](const auto& one) { return is_bias(one.direction); };
  if (fitted.size() < 2 || std::ranges::any_of(fitted, is_of_bias) ||
      std::ranges::none_of(answer.loops, is_of_bias))
    return "";
  return "the loops along the bias are not fitted, and bias-bending is the mean of both directions: "
         "--fab.directions " +
         fitted[0].direction + "," + fitted[1].direction + ",B fits them";
}

std::vector<std::string> texts_on_fit(const FabBending& b, const std::vector<FabForm>& forms,
                                      const Repeats& repeats, const RecordTexts& texts) {
  std::vector<std::string> warnings = {misses_warning(b, texts),
                                       better_form_warning(b, forms, repeats, texts),
                                       beyond_reach_warning(b, texts)};
  std::erase(warnings, "");
  if (!b.converged) warnings.push_back("along " + b.direction + " the fit of bending did not converge");
  return warnings;
}

}  // namespace

std::vector<std::string> bending_warnings(const FabBending& b, const std::vector<FabForm>& forms,
                                          const Repeats& repeats) {
  return texts_on_fit(b, forms, repeats, kLoopTexts);
}

std::vector<std::string> decay_fit_warnings(const FabBending& b, const std::vector<FabForm>& forms,
                                            const Repeats& repeats) {
  return texts_on_fit(b, forms, repeats, kDecayTexts);
}

void report_fab(Run& run, const FabAnswer& answer, const FabricNotes& notes) {
  for (const FabLoops& loops : answer.loops)
    for (const std::string& warning : loops.warnings) run.warn(warning);
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i)
    for (const std::string& warning :
         bending_warnings(answer.found.bending[i], answer.forms[i], answer.repeats[i]))
      run.warn(warning);
  for (const FabTension& t : answer.found.tension)
    if (!t.converged) run.warn("along " + t.direction + " the fit of stretch did not converge");
  if (const std::string unused = unused_bias_warning(answer); !unused.empty()) run.warn(unused);
  FabIdentification one{answer.one_stop, {}, answer.found.from + ", by one stop"};
  write_fab_fabric(run.path("fabric.toml"), answer.found, notes);
  write_fab_fabric(run.path("one_stop.toml"), one, notes);
  write_spectrum(run, answer.found);
  write_forms(run, answer);
  add_fab_metrics(run, answer);
  const std::vector<FabPrediction> predictions = predict(answer);
  write_predictions(run, predictions);
  write_compared_loops(run, predictions);
  draw_predictions(run, notes.name, predictions);
}

// Formats the rigidity; with a free vibration it is given, so it has no error.
std::string rigidity_text(const FabBending& b) {
  if (b.spring_error == 0) return number_text(b.law.spring, 3, "N m") + " (of kes.b, taken as exact)";
  return fmt::format("{:.3g} +- {:.2g} N m", b.law.spring, b.spring_error);
}

std::string repeats_text(const Repeats& repeats, const FabBending& b) {
  if (!repeats.known()) return "";
  return fmt::format("  {} differ as records with {:.2g} N of noise do; the fit leaves {:.2g} times that\n",
                     join(repeats.of, ", "), repeats.noise, b.residual_rms * b.noise / repeats.noise);
}

std::string summary(const FabAnswer& answer) {
  std::string text;
  for (std::size_t i = 0; i < answer.found.bending.size(); ++i) {
    const FabBending& b = answer.found.bending[i];
    const std::vector<std::string> open = b.undetermined();
    text += fmt::format(
        "along {}: b2 = {}, HB = {:.3g} +- {:.2g} N, b1 = {:.3g} N m; rms {:.2g} "
        "of the noise, {} iterations\n",
        b.direction, rigidity_text(b), b.law.friction(), b.friction_error, b.law.initial_stiffness(),
        b.residual_rms, b.iterations);
    if (b.is_parabola())
      text += fmt::format("  k0 = {:.3g} +- {:.2g} 1/m\n", saturation_curvature(b.form),
                          b.form_errors[1] * saturation_curvature(b.form));
    if (b.is_shaped()) {
      const FrictionShape shape = friction_shape(b.form);
      text += fmt::format(
          "  friction slips about {:.3g}/m (a factor of {:.2g}), spread {:.3g} (a factor of {:.2g})\n",
          shape.median, std::exp(b.form_errors[1]), shape.spread, std::exp(b.form_errors[2]));
    }
    text += "  undetermined: " + (open.empty() ? std::string("nothing") : join(open, ", ")) + "\n";
    text += repeats_text(answer.repeats[i], b);
    for (const FabForm& form : answer.forms[i]) {
      const FormComparison beside = compare_forms(form, b, answer.repeats[i]);
      text += fmt::format("  {}: rms {:.2g} of the noise, misfit {:.3g}, preference {:.2g}{}\n", form.name,
                          form.found.residual_rms, beside.misfit, beside.preference,
                          beside.is_excluded ? ", excluded"
                          : beside.is_nearer ? ", nearer"
                                             : "");
    }
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
