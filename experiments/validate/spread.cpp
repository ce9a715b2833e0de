#include "experiments/validate/spread.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "experiments/validate/drapes.h"
#include "render/plot.h"
#include "sim/base/comma_list.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/mesh/random_points.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kDrapeFittedOn = "B, 2HB, density, thickness; the rest assumed";

// 0 to count - 1 in an order by chance (Fisher & Yates).
std::vector<int> shuffled(int count, Uniform& uniform) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[static_cast<int>(uniform(0, i + 1))]);
  return order;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Standard deviation of one, of at least two.
double spread_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double x : values) squares += (x - mean) * (x - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

// Drapes of one fabric and what they say together.
Prediction summary(const std::vector<Drape>& drapes, const std::string& question) {
  Prediction p{question, kDrapeFittedOn, "%"};
  std::vector<double> coefficients;
  for (const Drape& drape : drapes) coefficients.push_back(drape.coefficient());
  p.predicted = mean_of(coefficients);
  p.measured = drapes.front().published();
  const auto [low, high] = std::minmax_element(coefficients.begin(), coefficients.end());
  p.low = *low, p.high = *high;
  return p;
}

Prediction folds(const std::vector<Drape>& drapes, const std::string& question) {
  std::vector<double> counts;
  for (const Drape& drape : drapes) counts.push_back(drape.number("node_count"));
  Prediction p{question, kDrapeFittedOn, "folds", mean_of(counts),
               drapes.front().number("published_node_count")};
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
  p.low = *low, p.high = *high;
  return p;
}

using DrapesOf = std::vector<std::pair<std::string, std::vector<Drape>>>;

void write_spread(Run& run, const DrapesOf& all, const std::set<std::string>& keys) {
  std::vector<CsvField> head = {"fabric", "sample"};
  for (const std::string& key : keys) head.emplace_back(key);
  for (const char* name : {"drape coefficient [%]", "nodes", "settled", "computing [s]"})
    head.emplace_back(name);
  CsvFile file(run.path("spread.csv"), head);
  for (const auto& [fabric, drapes] : all)
    for (const Drape& d : drapes) {
      std::vector<CsvField> row = {fabric, d.varied};
      for (const std::string& key : keys) row.emplace_back(last_text(d.further, "fabric." + key, ""));
      row.insert(row.end(), {d.coefficient(), d.number("node_count"),
                             d.metrics["settled"].is(true) ? "yes" : "no", d.seconds});
      file.row(row);
    }
  file.commit();
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
      predicted.x.push_back(static_cast<double>(f));
      predicted.y.push_back(drape.coefficient());
    }
    measured.x.push_back(static_cast<double>(f));
    measured.y.push_back(drapes.front().published());
  }
  plot.series = {predicted, measured};
  run.plot("plot_spread", plot);
}

}  // namespace

std::vector<Flag> flags_of(const Sample& sample) {
  std::vector<Flag> flags;
  for (const auto& [key, value] : sample) flags.push_back({"fabric." + key, number_text(value)});
  return flags;
}

std::vector<Sample> samples_of(const FabricFile& file, int count, unsigned seed) {
  std::vector<Sample> samples(count);
  Uniform uniform(seed);
  for (const auto& [key, range] : file.range) {
    if (!(range.low > 0))
      throw Error::request("validate: the range of " + key + " in " + file.fabric.name + " must be > 0")
          .of("fabrics", file.fabric.name);
    const double decades = std::log(range.high / range.low);
    const std::vector<int> part = shuffled(count, uniform);
    for (int i = 0; i < count; ++i)
      samples[i][key] = range.low * std::exp(decades * (part[i] + uniform(0, 1)) / count);
  }
  const double friction_moment = file.fabric.virgin_curve().friction_moment();
  for (Sample& sample : samples)
    if (sample.count("k0")) sample["b1"] = file.fabric.b2 + 2 * friction_moment / sample["k0"];
  return samples;
}

std::vector<Prediction> predict_spread(const ValidateFlags& flags, Run& run) {
  DrapesOf all;
  std::set<std::string> keys;
  std::vector<Prediction> predictions;
  for (const std::string& fabric : split(flags.fabrics)) {
    const FabricFile file = read_fabric(fabric, "--fabrics");
    auto& drapes = all.emplace_back(fabric, std::vector<Drape>{}).second;
    int number = 0;
    for (const Sample& sample : samples_of(file, flags.samples, flags.seed)) {
      for (const auto& [key, value] : sample) keys.insert(key);
      Drape drape = nominal_drape(fabric, flags);
      drape.varied = "sample-" + std::to_string(++number);
      drape.further = flags_of(sample);
      drape.further.push_back({"seed", std::to_string(number)});
      drape.further.push_back({"no-images", "true"});
      run_drape(drape, flags, run);
      drapes.push_back(std::move(drape));
      write_spread(run, all, keys);
    }
    const Prediction p = summary(drapes, "drape of " + fabric + " with uncertain numbers in their ranges");
    run.metric(fabric + ".spread_low_percent", p.low);
    run.metric(fabric + ".spread_high_percent", p.high);
    run.metric(fabric + ".spread_has_measured", p.contains_measured());
    predictions.push_back(p);
  }
  if (!flags.options.no_images) draw_spread(run, all);
  return predictions;
}

std::vector<Prediction> predict_draws(const ValidateFlags& flags, Run& run) {
  CsvFile file(run.path("draws.csv"),
               "fabric,release,meshes,mean drape coefficient [%],standard deviation [%],mean nodes,published "
               "drape coefficient [%],published nodes");
  std::vector<Prediction> predictions;
  for (const std::string& fabric : split(flags.fabrics))
    for (const char* release : {"lowered", "dropped"}) {
      std::vector<Drape> drapes;
      std::vector<double> coefficients;
      for (int draw = 1; draw <= flags.draws; ++draw) {
        Drape drape = nominal_drape(fabric, flags);
        drape.release = release;
        drape.varied = "draw-" + std::to_string(draw);
        drape.further = {{"seed", std::to_string(draw)}, {"no-images", "true"}};
        run_drape(drape, flags, run);
        coefficients.push_back(drape.coefficient());
        drapes.push_back(std::move(drape));
      }
      const std::string what = fabric + ", " + release + ", on several meshes";
      const Prediction p = summary(drapes, "drape of " + what), n = folds(drapes, "folds of " + what);
      file.row({fabric, release, flags.draws, p.predicted, spread_of(coefficients), n.predicted, p.measured,
                n.measured});
      const std::string key = fabric + "-" + release;
      run.metric(key + ".drape_coefficient_percent_mean", p.predicted);
      run.metric(key + ".drape_coefficient_percent_spread", spread_of(coefficients));
      run.metric(key + ".node_count_mean", n.predicted);
      predictions.insert(predictions.end(), {p, n});
    }
  file.commit();
  return predictions;
}

}  // namespace hysteron::experiments
