#include "experiments/validate/figure.h"

#include <algorithm>
#include <cmath>

#include "experiments/validate/effects.h"
#include "experiments/validate/folds.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/identification/decay_shape.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

using Style = render::Series::Style;

// The paths of recorded results, below one folder.
constexpr const char* kLoops = "fab-shirley/loops_L_D1.csv";
constexpr const char* kSwing = "swing-cotton-broad";
constexpr const char* kTurns = "swing-cotton-broad/turns.csv";
constexpr const char* kSwingManifest = "swing-cotton-broad/manifest.json";
constexpr const char* kDrapes = "drapes-jis-h200/means.csv";
constexpr const char* kSpread = "spread-h200";
constexpr const char* kFolds = "drapes-iso-h200/table.csv";

constexpr const char* kModelColor = "#D55E00";
constexpr const char* kMeasuredColor = "#6F7F8F";
constexpr const char* kLineColor = "#888888";

// Plots force per width against the distance of the clamps, cycle by cycle.
render::PagePlot loops_plot(const fs::path& csv) {
  const Table table = read_table(csv);
  render::Plot plot{"Loops of a knit, fitted on the middle one",
                    {"distance of the clamps [mm]"},
                    {"force per width [N/m]"}};
  render::Series measured{"measured", {}, {}, Style::points, kMeasuredColor};
  render::Series model{"the chapter's friction", {}, {}, Style::line, kModelColor};
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double distance = 1e3 * table.number(r, "clamp_distance_m"), width = table.number(r, "width_m");
    measured.add(distance, table.number(r, "measured_force_N") / width);
    model.add(distance, table.number(r, "force_N") / width);
  }
  plot.series = {measured, model};
  return {plot, "top left"};
}

// Reads the amplitudes that a decay was fitted to; those before are too large.
std::vector<Amplitude> read_amplitudes(const fs::path& swing) {
  const Table turns = read_csv(swing / "turns.csv", {"turn", "time [s]", "amplitude [mm]"}, {}, "validate");
  std::vector<Amplitude> amplitudes;
  for (std::size_t r = 0; r < turns.rows.size(); ++r)
    amplitudes.push_back({static_cast<int>(turns.number(r, "turn")), turns.number(r, "time [s]"),
                          turns.number(r, "amplitude [mm]") / 1e3});
  const double used = read_manifest(swing / "manifest.json").metrics.number("decay_amplitudes_count");
  if (!(used >= kMinAmplitudes))
    throw Error::invalid_input("validate: " + swing.string() + " has too few amplitudes for two lines");
  const auto count = std::min(amplitudes.size(), static_cast<std::size_t>(used));
  return {amplitudes.end() - static_cast<std::ptrdiff_t>(count), amplitudes.end()};
}

// Returns the saturating shape of a decay, from its first amplitude at `start` to its last at `end` [s].
render::Series decay_curve(const DecayFit& fit, double start, double end) {
  constexpr int kPoints = 200;
  render::Series curve{"the chapter's closed form", {}, {}, Style::line, kModelColor};
  for (int i = 0; i <= kPoints; ++i) {
    const double t = (end - start) * i / kPoints;
    curve.add(start + t, 1e3 * fit.at(t));
  }
  return curve;
}

render::PagePlot decay_plot(const fs::path& swing) {
  constexpr double kFifth = 0.2;
  const std::vector<Amplitude> amplitudes = read_amplitudes(swing);
  const Decay decay = decay_between_amplitudes(amplitudes, INFINITY);
  if (decay.fits.empty())
    throw Error::invalid_input("validate: the swing in " + swing.string() + " does not fall");
  const DecayFit fit = decay.of(DecayShape::saturating);
  render::Plot plot{"Decay of a swing, cotton broad", {"time [s]"}, {"amplitude of the free end [mm]"}};
  render::Series points{"simulated", {}, {}, Style::points, kMeasuredColor};
  for (const Amplitude& a : amplitudes) points.add(a.time, 1e3 * a.value);
  const double start = amplitudes.front().time, end = amplitudes.back().time, knee = 1e3 * fit.knee,
               fifth = 1e3 * kFifth * fit.first;
  plot.series = {points,
                 decay_curve(fit, start, end),
                 {"its knee", {start, end}, {knee, knee}, Style::dashed, kModelColor, 1.5},
                 {"a fifth (real cloth)", {start, end}, {fifth, fifth}, Style::dashed, kLineColor, 1.5}};
  plot.y.low = 0, plot.y.high = 1.1 * points.y.front();
  plot.x.low = 0, plot.x.high = end;
  return {plot, "top right"};
}

// Returns a bar from the low to the high end of an interval.
render::Series interval(const PredictedDrape& drape, const std::string& color, const std::string& label) {
  return {label, {drape.measured, drape.measured}, {drape.low, drape.high}, Style::line, color, 5};
}

// Places a fabric's name away from the diagonal: for limp fabrics below the interval and to the right, for
// stiff ones above it and to the left.
render::Mark drape_mark(const PredictedDrape& drape, bool stiff, const std::string& color) {
  constexpr double kAway = 3.5;  // [%]
  if (stiff) return {drape.fabric, drape.measured + 1, drape.high + kAway, -0.1, 0, color, false};
  return {drape.fabric, drape.measured - 1, drape.low - kAway, 0.1, 0, color, false};
}

render::PagePlot drapes_plot(const std::vector<PredictedDrape>& drapes) {
  constexpr double kLow = 15, kHigh = 100, kKey = 12;  // room above for the key
  render::Plot plot{"Drape coefficients on the JIS tester",
                    {"measured [%]", false, kLow, kHigh},
                    {"predicted [%]", false, kLow, kHigh + kKey}};
  plot.series.push_back({"as measured", {kLow, kHigh}, {kLow, kHigh}, Style::dashed, kLineColor, 1.5});
  render::Series mean{"with friction", {}, {}, Style::points, "#222222"};
  render::Series elastic{"elasticity alone", {}, {}, Style::rings, "#222222"};
  for (std::size_t f = 0; f < drapes.size(); ++f) {
    const PredictedDrape& drape = drapes[f];
    plot.series.push_back(interval(drape, fabric_color(f), f == 0 ? "95 % interval" : ""));
    mean.add(drape.measured, drape.mean);
    elastic.add(drape.measured, drape.elastic);
    plot.marks.push_back(drape_mark(drape, 2 * f >= drapes.size(), fabric_color(f)));
  }
  plot.series.insert(plot.series.end(), {mean, elastic});
  return {plot, "top left"};
}

// Plots the folds of the fabrics in this order, which determines their colours.
render::PagePlot fold_counts_plot(const std::vector<CountedDrape>& counted,
                                  const std::vector<PredictedDrape>& order) {
  render::Plot plot{"Folds of drapes, 300 mm on 180 mm",
                    {"drape coefficient [%]", false, 10, 100},
                    {"folds", false, 0, 18}};
  plot.series = real_drape_boxes("584 real drapes");
  for (std::size_t f = 0; f < order.size(); ++f) {
    render::Series series{order[f].fabric, {}, {}, Style::points, fabric_color(f)};
    for (const CountedDrape& drape : counted)
      if (drape.fabric == order[f].fabric) series.add(drape.coefficient, drape.folds);
    if (!series.x.empty()) plot.series.push_back(series);
  }
  return {plot, "top right"};
}

}  // namespace

std::string fabric_color(std::size_t fabric) {
  static const std::vector<std::string> kColors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7"};
  return kColors[fabric % kColors.size()];
}

std::vector<PredictedDrape> read_drapes(const fs::path& means, const fs::path& spread) {
  const Table table = read_table(means);
  std::vector<PredictedDrape> drapes;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& fabric = table.word(r, "fabric");
    auto at = std::find_if(drapes.begin(), drapes.end(),
                           [&](const PredictedDrape& drape) { return drape.fabric == fabric; });
    if (at == drapes.end()) {
      const Table known =
          read_table(spread / fabric / "predictions.csv");  // has the coefficient first, then folds
      if (known.rows.empty())
        throw Error::invalid_input("validate: " + (spread / fabric).string() + " has no drape");
      at = drapes.insert(drapes.end(), {.fabric = fabric,
                                        .measured = known.number(0, "measured"),
                                        .low = known.number(0, "low"),
                                        .high = known.number(0, "high")});
    }
    const std::string& law = table.word(r, "law");
    const double coefficient = table.number(r, "drape_coefficient_percent_mean");
    if (law == "prandtl") at->mean = coefficient;
    if (law == "linear") at->elastic = coefficient;
  }
  return drapes;
}

std::vector<PredictedDrape> recorded_drapes(const fs::path& recorded) {
  return read_drapes(recorded / kDrapes, recorded / kSpread);
}

render::PlotPage validation_page(const fs::path& recorded, const std::vector<PredictedDrape>& drapes) {
  return {"From the raw loop to decay, drape and folds",
          "friction of the chapter's form, fitted on one loop of a knit; B and 2HB of each fabric",
          {loops_plot(recorded / kLoops), decay_plot(recorded / kSwing), drapes_plot(drapes),
           fold_counts_plot(read_counted(recorded / kFolds), drapes)}};
}

void check_recorded(const fs::path& recorded) {
  std::error_code ignored;
  for (const char* file : {kLoops, kTurns, kSwingManifest, kDrapes, kFolds})
    if (!fs::is_regular_file(recorded / file, ignored))
      throw Error::invalid_input("recorded = " + recorded.string() + " has no " + file +
                                 ": the figure is drawn from a folder of all recorded results (--recorded)")
          .with_key("recorded", recorded.string());
}

void draw_recorded(const fs::path& recorded, Run& run) {
  const std::vector<PredictedDrape> drapes = recorded_drapes(recorded);
  const render::PlotPage page = validation_page(recorded, drapes);
  run.plot("plot_validation", page, render::write_plot_page);
  compare_folds(run, read_counted(recorded / kFolds), true);
  EffectsByFabric effects;
  for (const PredictedDrape& drape : drapes)
    effects.emplace_back(drape.fabric,
                         effects_of_spread(read_table(recorded / kSpread / drape.fabric / "spread.csv"),
                                           read_fabric(drape.fabric, "recorded")));
  note_effects(run, effects);
  run.plot("plot_effects", effects_plot(effects));
}

}  // namespace hysteron::experiments
