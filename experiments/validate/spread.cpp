// Drapes with the fabric's uncertain numbers drawn from their ranges.
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "experiments/validate/drapes.h"
#include "experiments/validate/effects.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/identification/fast_sheet.h"
#include "sim/mesh/random_points.h"

namespace hysteron::experiments {
namespace {

// The 95 % interval of one more drape, and the measured value.
struct Prediction {
  std::string question;  // name of the predicted quantity: "drape of wool-tropical"
  std::string unit, fitted_on;
  double predicted, measured, low, high;  // `measured` is NaN if unknown

  std::optional<bool> contains_measured() const {
    if (std::isnan(measured)) return std::nullopt;
    return low <= measured && measured <= high;
  }
};

// Returns "yes" or "no"; "" if nothing was measured.
std::string answer_text(const std::optional<bool>& answer) {
  if (!answer) return "";
  return *answer ? "yes" : "no";
}

// Lists what was measured of a fabric, apart from its drape.
std::string fitted_on(const Fabric& fabric) {
  std::vector<std::string> measured;
  for (const auto& [name, number] : fabric.published)
    if (name != "drape-coefficient" && name != "node-count") measured.push_back(name);
  for (const auto& [name, provenance] : fabric.provenance)
    if (provenance.confidence == "published" && !fabric.published.contains(name)) measured.push_back(name);
  return measured.empty() ? "nothing measured; all assumed" : join(measured, ", ") + "; the rest assumed";
}

void write_predictions(Run& run, const std::vector<Prediction>& predictions) {
  Table table(
      "predicted quantity,fitted on,predicted,low,high,measured,unit,error,error [%],measured is between");
  for (const Prediction& p : predictions) {
    const double error = p.predicted - p.measured;
    table.row({p.question, p.fitted_on, p.predicted, p.low, p.high, p.measured, p.unit, error,
               100 * error / p.measured, answer_text(p.contains_measured())});
  }
  table.write(run.path("predictions.csv"));
}

// Returns 0 to count - 1 in random order (Fisher & Yates).
std::vector<int> shuffled(int count, Uniform& uniform) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[static_cast<int>(uniform(0, i + 1))]);
  return order;
}

// Returns the mean over drapes of one fabric, and the interval of one more.
Prediction together(const std::vector<Drape>& drapes, const std::string& metric, const std::string& question,
                    const std::string& unit, const std::string& fitted_on) {
  std::vector<double> values;
  for (const Drape& drape : drapes) values.push_back(drape.number(metric));
  const double mean = mean_value(values), half = reach_of_next(values.size()) * sample_deviation(values);
  return {question, unit, fitted_on, mean, drapes.front().published(metric), mean - half, mean + half};
}

using DrapesOf = std::vector<std::pair<std::string, std::vector<Drape>>>;

// Returns the drawn numbers that drapes received with other values, because what was measured was kept.
std::set<std::string> retold_numbers(const DrapesOf& all) {
  std::set<std::string> retold;
  for (const auto& [fabric, drapes] : all)
    for (const Drape& d : drapes)
      for (const auto& [key, value] : d.drawn)
        if (last_text(d.further, "fabric." + key, "") != number_text(value)) retold.insert(key);
  return retold;
}

Table write_spread(Run& run, const DrapesOf& all, const std::set<std::string>& keys) {
  std::vector<std::string> head = {"fabric", "sample"};
  for (const std::string& key : keys) head.emplace_back(key);
  const std::set<std::string> retold = retold_numbers(all);
  for (const std::string& key : retold) head.emplace_back(kDrawn + key);
  for (const char* name : {"drape coefficient [%]", "nodes", "settled", "computing [s]"})
    head.emplace_back(name);
  Table table(head);
  for (const auto& [fabric, drapes] : all)
    for (const Drape& d : drapes) {
      std::vector<Cell> row = {fabric, d.varied};
      for (const std::string& key : keys) row.emplace_back(last_text(d.further, "fabric." + key, ""));
      for (const std::string& key : retold)
        row.emplace_back(d.drawn.contains(key) ? Cell(d.drawn.at(key)) : Cell(""));
      row.insert(row.end(), {d.coefficient(), d.number("node_count"),
                             d.metrics["settled"].is(true) ? "yes" : "no", d.seconds});
      table.row(row);
    }
  table.write(run.path("spread.csv"));
  return table;
}

void draw_spread(Run& run, const DrapesOf& all) {
  render::Plot plot{
      "Drape coefficient with uncertain numbers anywhere in their ranges", {""}, {"drape coefficient [%]"}};
  render::Series predicted{"predicted", {}, {}, render::Series::Style::points},
      measured{"measured", {}, {}, render::Series::Style::points, "#000000"};
  for (std::size_t f = 0; f < all.size(); ++f) {
    const auto& [fabric, drapes] = all[f];
    plot.x.categories.push_back(fabric);
    for (const Drape& drape : drapes) {
      predicted.add(static_cast<double>(f), drape.coefficient());
    }
    if (const double published = drapes.front().published(); std::isfinite(published))
      measured.add(static_cast<double>(f), published);
  }
  plot.series = {predicted};
  if (!measured.x.empty()) plot.series.push_back(measured);
  run.plot("plot_spread", plot);
}

}  // namespace

double mean_value(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

namespace {

// Returns the probability that Student's t with `freedom` degrees of freedom is within +-sqrt(freedom)
// tan(angle), by finite sums (Abramowitz & Stegun 1964, 26.7.3 and 26.7.4).
double student_within(int freedom, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const bool is_odd = freedom % 2 != 0;
  double term = is_odd ? cosine : 1, sum = 0;
  for (int k = is_odd ? 3 : 2; k <= freedom; k += 2) {
    sum += term;
    term *= cosine * cosine * (k - 1) / k;
  }
  return is_odd ? 2 / std::numbers::pi * (angle + sine * sum) : sine * sum;
}

}  // namespace

double reach_of_next(std::size_t count) {
  constexpr double kInside = 0.95;
  constexpr int kBisections = 60;
  const int freedom = static_cast<int>(count) - 1;
  double low = 0, high = std::numbers::pi / 2;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (student_within(freedom, middle) < kInside ? low : high) = middle;
  }
  return std::sqrt(freedom) * std::tan(low) * std::sqrt(1 + 1 / static_cast<double>(count));
}

double sample_deviation(const std::vector<double>& values) {
  const double mean = mean_value(values);
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

namespace {

double number_or(const Sample& sample, const std::string& key, double otherwise) {
  const auto found = sample.find(key);
  return found == sample.end() ? otherwise : found->second;
}

// True if no number of the sample changes bending along warp.
bool unstated(const Sample& sample) {
  return std::ranges::none_of(std::array{"k0", "B", "2HB", "weft-bending", "weft-friction"},
                              [&](const char* key) { return sample.count(key) > 0; });
}

bool has_bending_length(const Fabric& fabric) { return fabric.published.contains("bending-length"); }

// Returns B [N m]; if the fabric's cantilever was measured, it keeps the bending length along warp with
// another friction or weight.
double rigidity_beside(const Fabric& fabric, double density, double two_hb, double k0) {
  if (!has_bending_length(fabric)) return fabric.b2;
  const PublishedNumber& measured = fabric.published.at("bending-length");
  const double length = measured.value * factor_to("m", measured.unit).value_or(1);
  return rigidity_of_bending_length(length, kLaboratoryGravity * density, [&](double) {
    return StripFriction{two_hb / 2, k0};
  });
}

// Throws Error::invalid_input if the bending length of [published] gives another B than the file has.
void check_bending_length(const Fabric& fabric) {
  constexpr double kOtherwise = 0.05;
  if (!has_bending_length(fabric)) return;
  const double told =
      rigidity_beside(fabric, fabric.density, 2 * fabric.virgin_curve().friction_moment(), fabric.k0);
  if (!(std::abs(told / fabric.b2 - 1) < kOtherwise))
    throw Error::invalid_input("validate: " + fabric.name + " has b2 = " + number_text(fabric.b2, 4) +
                               " N m, and its published bending length tells " + number_text(told, 4) +
                               " N m: one of them is another fabric's")
        .with_key("fabrics", fabric.name);
}

// Throws for ranges that would change nothing, and for a friction that stops already determine.
void check_ranges(const FabricFile& file, const std::map<std::string, Range>& ranges) {
  const auto has = [&](const char* key) { return ranges.contains(key); };
  const auto refuse = [&](const std::string& what) {
    throw Error::invalid_input("validate: " + file.fabric.name + " " + what)
        .with_key("fabrics", file.fabric.name);
  };
  const bool of_pair = has("k0") || has("B") || has("2HB");
  if (!file.fabric.bending.stops.empty() && (of_pair || has("b1") || has("b2")))
    refuse("has stops of its own: a range of b1, b2, k0, B or 2HB cannot stand beside them");
  if ((of_pair || has("weft-bending")) && (has("b1") || has("b2")))
    refuse(
        "states a range of b1 or b2 beside one of k0, weft-bending, B or 2HB, from which they follow: state "
        "it "
        "of B and 2HB in [published]");
}

}  // namespace

std::map<std::string, Range> uncertain_numbers(const FabricFile& file) {
  std::map<std::string, Range> all = file.range;
  if (!file.fabric.kes.on())
    for (const auto& [key, printed] : file.published_range) {
      const PublishedNumber& number = file.fabric.published.at(key);
      const double si = key == "B" ? file.fabric.b2 : 2 * file.fabric.virgin_curve().friction_moment();
      const double unit = factor_to(key == "B" ? "N m" : "N", number.unit).value_or(si / number.value);
      all[key] = between(unit * printed.low, unit * printed.high);
    }
  check_ranges(file, all);
  check_bending_length(file.fabric);
  return all;
}

namespace {

// Returns the friction moment along weft over that along warp.
double friction_ratio(const Fabric& fabric, const Sample& sample) {
  const double own = number_or(sample, "weft-friction", fabric.weft_friction);
  return own > 0 ? own : std::sqrt(number_or(sample, "weft-bending", fabric.weft_bending));
}

}  // namespace

void keep_what_was_measured(const Fabric& fabric, Sample& sample) {
  const double weft = number_or(sample, "weft-bending", fabric.weft_bending);
  // B and 2HB are the means of warp and weft, whatever the ratios of these are.
  const double warp = (1 + fabric.weft_bending) / (1 + weft),
               rubs = (1 + friction_ratio(fabric, {})) / (1 + friction_ratio(fabric, sample));
  if (sample.count("bias-bending")) sample["bias-bending"] *= (1 + weft) / (1 + fabric.weft_bending);
  if (!fabric.bending.stops.empty()) return;  // stops keep their friction along warp
  if (fabric.kes.on() && (sample.count("weft-bending") || sample.count("weft-friction"))) {
    sample["kes-b"] = warp * number_or(sample, "kes-b", fabric.kes.read.rigidity);
    sample["kes-2hb"] = rubs * number_or(sample, "kes-2hb", fabric.kes.read.loop_width);
  } else if (!fabric.kes.on() &&
             (!unstated(sample) || (has_bending_length(fabric) && sample.count("density")))) {
    const double k0 = number_or(sample, "k0", fabric.k0),
                 two_hb = number_or(sample, "2HB", 2 * fabric.virgin_curve().friction_moment()),
                 density = number_or(sample, "density", fabric.density),
                 b = number_or(sample, "B", rigidity_beside(fabric, density, two_hb, k0));
    const bool is_of_warp = has_bending_length(fabric);  // then B is no mean
    sample["b2"] = (is_of_warp ? 1 : warp) * b;
    sample["b1"] = sample["b2"] + (is_of_warp ? 1 : rubs) * two_hb / k0;
    sample.erase("B");
    sample.erase("2HB");
  }
}

std::vector<Flag> drape_flags(const Sample& sample) {
  std::vector<Flag> flags;
  for (const auto& [key, value] : sample) flags.push_back({"fabric." + key, value});
  return flags;
}

std::vector<Sample> drawn_samples(const FabricFile& file, int count, unsigned seed) {
  std::vector<Sample> samples(count);
  Uniform uniform(seed);
  for (const auto& [key, range] : uncertain_numbers(file)) {
    if (!(range.low > 0))
      throw Error::invalid_input("validate: the range of " + key + " in " + file.fabric.name + " must be > 0")
          .with_key("fabrics", file.fabric.name);
    const double decades = std::log(range.high / range.low);
    const std::vector<int> part = shuffled(count, uniform);
    for (int i = 0; i < count; ++i)
      samples[i][key] = range.low * std::exp(decades * (part[i] + uniform(0, 1)) / count);
  }
  return samples;
}

void predict_spread(const ValidateFlags& flags, Run& run) {
  DrapesOf all;
  std::set<std::string> keys;
  std::vector<Prediction> predictions;
  EffectsByFabric effects;
  for (const std::string& given : split(flags.fabrics)) {
    const FabricFile file = read_fabric(given, "--fabrics");
    const std::string fabric = file.fabric.name;
    const std::vector<Sample> samples = drawn_samples(file, flags.samples, flags.seed);
    if (samples.front().empty())
      run.warn(fabric + " states no range of any number: its interval is that of " +
               std::to_string(flags.samples) + " meshes alone, and says nothing of what is not known of it");
    auto& drapes = all.emplace_back(fabric, std::vector<Drape>{}).second;
    int number = 0;
    const Drape nominal = nominal_drape(given, flags);
    for (const Sample& drawn : samples) {
      Sample sample = drawn;
      keep_what_was_measured(file.fabric, sample);
      for (const auto& [key, value] : sample) keys.insert(key);
      Drape drape = nominal;
      drape.drawn = drawn;
      drape.varied = "sample-" + std::to_string(++number);
      drape.further = drape_flags(sample);
      drape.further.push_back({"seed", std::to_string(number)});
      drape.further.push_back({"no-images", "true"});
      drapes.push_back(std::move(drape));
    }
    run_drapes(drapes, flags, run);
    const Table spread = write_spread(run, all, keys);  // so that an interrupted run keeps its results
    const std::string with = fabric + " with uncertain numbers in their ranges";
    const Prediction p = together(drapes, "drape_coefficient_percent", "drape of " + with, "%",
                                  fitted_on(file.fabric)),
                     n = together(drapes, "node_count", "folds of " + with, "folds", fitted_on(file.fabric));
    run.metric(fabric + ".spread_low_percent", p.low);
    run.metric(fabric + ".spread_high_percent", p.high);
    run.metric(fabric + ".spread_has_measured", p.contains_measured());
    run.metric(fabric + ".spread_folds_low", n.low);
    run.metric(fabric + ".spread_folds_high", n.high);
    predictions.insert(predictions.end(), {p, n});
    write_predictions(run, predictions);
    effects.emplace_back(fabric, effects_of_spread(spread, file));
    note_effects(run, effects);
  }
  if (flags.options.no_images) return;
  draw_spread(run, all);
  if (const render::Plot plot = effects_plot(effects); !plot.series.empty()) run.plot("plot_effects", plot);
}

}  // namespace hysteron::experiments
