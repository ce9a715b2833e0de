#include "experiments/workbench/compare/comparison_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "experiments/workbench/compare/kept_page.h"
#include "experiments/workbench/compare/table_plot.h"
#include "experiments/workbench/pages/error_words.h"
#include "experiments/workbench/pages/manifest.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/color_map.h"
#include "render/compare.h"
#include "render/comparison_sheet.h"
#include "sim/base/error.h"
#include "sim/base/process.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;

constexpr int kCellWidth = 420;  // [pixels]
constexpr std::size_t kMostNumbers = 5;
constexpr const char* kDifference = "difference";  // the look of it
constexpr int kDifferenceScale = 64;               // 8-bit steps at the end of the difference's colours

const std::vector<Frames::Instant>& instants(const SweepColumn& column) {
  return column.manifest->frames->instants;
}
double second(const SweepColumn& column, std::size_t frame) { return instants(column).at(frame).time; }
bool has_frames(const SweepColumn& column) {
  return column.manifest && column.manifest->frames && !instants(column).empty();
}

// The picture nearest to a time, the last one where the run had ended before.
std::size_t frame_at(const SweepColumn& column, double time) {
  std::size_t nearest = 0;
  for (std::size_t f = 0; f < instants(column).size(); ++f)
    if (std::abs(second(column, f) - time) < std::abs(second(column, nearest) - time)) nearest = f;
  return nearest;
}

// The first look's pictures stand in frames/.
fs::path picture_of(const SweepColumn& column, const std::string& look, std::size_t frame) {
  const std::string folder = column.manifest->frames->looks.at(0).name == look ? "frames" : "frames-" + look;
  return column.folder / folder / fmt::format("{:04}.png", frame);
}

// Of pictures of the column that went on longest: those nearest to the page's own times, or spread evenly,
// without the first picture, which is the same in all columns.
std::vector<double> times_of(const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  const SweepColumn* longest = nullptr;
  for (const SweepColumn& c : columns)
    if (has_frames(c) &&
        (!longest || second(c, instants(c).size() - 1) > second(*longest, instants(*longest).size() - 1)))
      longest = &c;
  std::vector<double> times;
  if (!longest) return times;
  for (double time : page.times) times.push_back(second(*longest, frame_at(*longest, time)));
  if (!times.empty()) return times;
  const int last = static_cast<int>(instants(*longest).size()) - 1,
            count = std::min(page.rows, std::max(1, last));
  for (int r = 1; r <= count; ++r)
    times.push_back(second(*longest, static_cast<std::size_t>(std::lround(1.0 * r * last / count))));
  return times;
}

// "t = 0.50 s, hang".
std::string instant_text(const std::vector<SweepColumn>& columns, double time, int decimals = 2) {
  for (const SweepColumn& c : columns) {
    if (!has_frames(c)) continue;
    const Frames::Instant& instant = instants(c).at(frame_at(c, time));
    if (std::abs(instant.time - time) > 1e-9) continue;
    return fmt::format("t = {:.{}f} s{}{}", time, decimals, instant.phase.empty() ? "" : ", ", instant.phase);
  }
  return fmt::format("t = {:.{}f} s", time, decimals);
}

// Of a row: times of one's own may be milliseconds apart.
std::string row_text(const ComparisonPage& page, const std::vector<SweepColumn>& columns, double time) {
  return instant_text(columns, time, page.times.empty() ? 2 : 3);
}

struct Drawn {
  const ComparisonPage& page;
  const std::vector<SweepColumn>& columns;
  std::vector<double> times;

  render::ComparisonRow pictures(double time) const {
    render::ComparisonRow row{row_text(page, columns, time), {}};
    for (const SweepColumn& c : columns) {
      row.cells.emplace_back();
      if (!has_frames(c)) continue;
      const std::size_t frame = frame_at(c, time);
      row.cells.back().image = render::read_png(picture_of(c, page.look, frame));
      if (time - second(c, frame) > 1e-9)
        row.cells.back().caption =
            fmt::format("{} {:.2f} s", c.stopped.empty() ? "at rest since" : "stopped at", second(c, frame));
    }
    return row;
  }

  render::ComparisonRow differences(const render::ComparisonRow& row, double time) const {
    const std::size_t to = static_cast<std::size_t>(page.to);
    render::ComparisonRow result{
        row.label + (page.curvature ? ": curvature less that of " : ": difference to ") + columns[to].name,
        {}};
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      result.cells.emplace_back();
      if (c == to || !has_frames(columns[c]) || !has_frames(columns[to])) continue;
      result.cells.back() = page.curvature ? of_curvature(columns[c], time)
                                           : of_pictures(row.cells[c].image, row.cells[to].image);
    }
    return result;
  }

  static render::ComparisonCell of_pictures(const render::Image& image, const render::Image& to) {
    return {render::heat_map(image, to, kDifferenceScale),
            fmt::format("{:.2f} % of the pixels differ by more than 8",
                        render::compare(image, to).pixels_over_8_percent)};
  }

  static render::ComparisonCell of_curvature(const SweepColumn& column, double time) {
    const std::size_t frame = frame_at(column, time);
    return {render::read_png(picture_of(column, kDifference, frame)),
            fmt::format("rms {:.3g} 1/m", instants(column).at(frame).difference_rms.value())};
  }

  render::ComparisonRow outlines() const {
    render::ComparisonRow row{"outlines of all", {}};
    for (double time : times) {
      render::Image over;
      for (std::size_t c = 0; c < columns.size(); ++c) {
        if (!has_frames(columns[c])) continue;
        const render::Image shape =
            render::read_png(picture_of(columns[c], "silhouette", frame_at(columns[c], time)));
        if (over.empty()) over = render::Image(shape.width(), shape.height(), render::Rgb8{255, 255, 255});
        render::draw_outline(over, shape, render::method_color(c), std::max(1, shape.width() / 320));
      }
      row.cells.push_back({std::move(over), row_text(page, columns, time)});
    }
    return row;
  }
};

std::optional<render::ColorBar> bar_of(const std::vector<SweepColumn>& columns, const std::string& look) {
  for (const SweepColumn& c : columns) {
    if (!has_frames(c)) continue;
    for (const auto& [name, bar] : c.manifest->frames->looks)
      if (name == look && bar)
        return render::ColorBar{map_of(look), bar->low, bar->high, bar->label, bar->unit};
  }
  return {};
}

render::ComparisonSheet head_of(const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  render::ComparisonSheet sheet;
  sheet.title = page.title;
  sheet.notes = page.notes;
  sheet.cell_width = kCellWidth;
  for (std::size_t c = 0; c < columns.size(); ++c)
    sheet.columns.push_back({columns[c].name, numbers_of(page, columns[c]), render::method_color(c)});
  for (const SweepColumn& c : columns)
    if (has_frames(c)) sheet.metres_per_pixel = c.manifest->frames->metres_per_pixel;
  sheet.scale_note = "at the cloth's middle";
  return sheet;
}

// All columns side by side at their frame `f`, or their last.
render::Image strip_of(const ComparisonPage& page, const std::vector<SweepColumn>& columns, std::size_t f) {
  render::ComparisonSheet strip;
  strip.cell_width = kCellWidth;
  strip.rows.emplace_back();
  for (std::size_t c = 0; c < columns.size(); ++c) {
    strip.columns.push_back({columns[c].name, {}, render::method_color(c)});
    strip.rows[0].cells.emplace_back();
    if (!has_frames(columns[c])) continue;
    const std::size_t last = instants(columns[c]).size() - 1;
    strip.rows[0].cells[c].image = render::read_png(picture_of(columns[c], page.look, std::min(f, last)));
    if (f <= last) strip.rows[0].label = instant_text({columns[c]}, second(columns[c], f));
  }
  return render::draw_comparison(strip);
}

// A film at the columns' own speed, where ffmpeg is there.
void film(Run& run, const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  std::size_t frames = 0;
  double rate = 1;  // [1/s]
  for (const SweepColumn& c : columns) {
    if (!has_frames(c) || instants(c).size() <= frames) continue;
    frames = instants(c).size();
    if (frames > 1) rate = static_cast<double>(frames - 1) / (second(c, frames - 1) - second(c, 0));
  }
  for (std::size_t f = 0; f < frames; ++f) {
    render::write_png(run.path(fmt::format("film/{:04}.png", f)), strip_of(page, columns, f));
  }
  const std::string name = "film." + page.video, strips = (run.folder() / "film" / "%04d.png").string();
  std::vector<std::string> words = {
      "ffmpeg", "-y", "-loglevel", "error", "-framerate", fmt::format("{:g}", rate), "-i", strips};
  if (page.video == "mp4")
    words.insert(words.end(), {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
  words.push_back(run.path(name).string());
  const ProcessResult result = run_process(words, "");
  if (result.started && result.exit_code == 0) return;
  run.forget(name);
  run.manifest().film_missing = result.started ? result.first_error_line : "ffmpeg is not installed";
  run.warn("compare.video: there is no " + name + ": " + run.manifest().film_missing);
}

// What the first column notes that notes anything: lists of series, of curves.
template <class List>
List first_list(const std::vector<SweepColumn>& columns, List (*noted)(const Manifest&)) {
  for (const SweepColumn& c : columns)
    if (c.manifest && !noted(*c.manifest).empty()) return noted(*c.manifest);
  return {};
}

// The experiment's own columns of metrics.csv against time.
void plot_series(Run& run, const std::string& title, const std::vector<SweepColumn>& columns) {
  using Names = std::vector<std::string>;
  for (const std::string& name :
       first_list<Names>(columns, [](const Manifest& m) { return m.series.value_or(Names{}); })) {
    const std::string word = name.substr(0, name.find(" ["));
    TablePlot plot{"plot_" + word, {title, {"time [s]"}, {name}}, "metrics.csv", "time", word};
    std::replace(plot.plot.y.label.begin(), plot.plot.y.label.end(), '_', ' ');
    draw(run, plot, columns);
  }
}

// Tables of its own that the experiment names in its manifest.
void plot_curves(Run& run, const std::string& title, const std::vector<SweepColumn>& columns) {
  for (const Curve& curve :
       first_list<std::vector<Curve>>(columns, [](const Manifest& m) { return m.curves; }))
    draw(run,
         TablePlot{curve.plot,
                   {title, {curve.x}, {curve.y, curve.logarithmic}},
                   curve.file,
                   curve.x,
                   curve.y,
                   render::Series::Style::line_and_points},
         columns);
}

// Of each column the frames in its rows, and the first, which tells of no motion before them.
std::vector<std::vector<int>> frames_of(const std::vector<SweepColumn>& columns,
                                        const std::vector<double>& times) {
  std::vector<std::vector<int>> frames(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!has_frames(columns[c])) continue;
    std::set<int> chosen = {0};
    for (const double time : times) chosen.insert(static_cast<int>(frame_at(columns[c], time)));
    frames[c].assign(chosen.begin(), chosen.end());
  }
  return frames;
}

// Those that the page asks for, or all of shown_numbers().
std::vector<std::string> candidates(const ComparisonPage& page) {
  std::vector<std::string> keys = page.metrics;
  if (keys.empty())
    for (const ShownNumber& number : shown_numbers()) keys.push_back(number.metric);
  return keys;
}

// Those of them that stand below a column: as many of the usual ones as there is room for.
std::vector<std::string> own_metrics(const ComparisonPage& page, const SweepColumn& column) {
  if (!column.manifest) return {};
  std::vector<std::string> keys = candidates(page);
  const Metrics& metrics = column.manifest->metrics;
  std::erase_if(keys,
                [&](const std::string& key) { return !metrics[key].is_number() && !metrics[key].is_text(); });
  const std::size_t most = kMostNumbers - (column.stopped.empty() ? 0 : 1);
  if (page.metrics.empty() && keys.size() > most) keys.resize(most);
  return keys;
}

// The page's metrics, or what these experiments are asked for, a bar a column.
void plot_answers(Run& run, const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  const std::vector<std::string> usual = {"drape_coefficient_percent", "recovery_angle_deg"};
  for (const std::string& key : page.metrics.empty() ? usual : page.metrics) {
    render::Plot plot{page.title, {""}, {split_unit(key).text()}};
    std::vector<double> values;
    for (const SweepColumn& c : columns) {
      if (!c.manifest || !c.manifest->metrics[key].is_number()) continue;
      plot.x.categories.push_back(c.name);
      values.push_back(c.manifest->metrics[key].number());
    }
    if (values.size() < 2) continue;
    plot.series = render::grouped_bars({""}, {values}, plot.bar_width);
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    plot.y.low = 1.05 * std::min(0.0, *least);
    plot.y.high = 1.05 * std::max(0.0, *most);
    if (plot.y.low == plot.y.high) plot.y.high = 1;
    run.plot("plot_" + key, plot);
  }
}

}  // namespace

std::vector<std::string> shown_instants(const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  std::vector<std::string> texts;
  for (double time : times_of(page, columns)) texts.push_back(row_text(page, columns, time));
  return texts;
}

std::vector<std::string> shown_metrics(const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  std::vector<std::string> keys = candidates(page);
  std::erase_if(keys, [&](const std::string& key) {
    return std::none_of(columns.begin(), columns.end(), [&](const SweepColumn& c) {
      const std::vector<std::string> own = own_metrics(page, c);
      return std::find(own.begin(), own.end(), key) != own.end();
    });
  });
  return keys;
}

std::vector<std::string> numbers_of(const ComparisonPage& page, const SweepColumn& column) {
  std::vector<std::string> lines;
  if (!column.stopped.empty()) lines.push_back("stopped: " + column.stopped);
  if (!column.manifest) return lines;
  const Metrics& metrics = column.manifest->metrics;
  for (const std::string& key : own_metrics(page, column)) {
    lines.push_back(metrics[key].is_text() ? split_unit(key).name + " " + metrics[key].text()
                                           : metric_text(key, metrics[key].number()));
    if (is_headline(metrics, key)) lines.push_back(headline_words(metrics, key).errors);
  }
  constexpr const char* kStepping[] = {"membrane", "bending", "solve", "contact", "history"};
  double stepping = 0;
  for (const auto& [stage, seconds] : column.manifest->wall_seconds)
    if (std::count(std::begin(kStepping), std::end(kStepping), stage)) stepping += seconds;
  const double steps = static_cast<double>(column.manifest->steps.value_or(0));
  if (steps > 0) lines.push_back(fmt::format("{:.3g} ms per step", 1e3 * stepping / steps));
  return lines;
}

void draw_comparison_page(Run& run, const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  const Drawn drawn{page, columns, times_of(page, columns)};
  if (drawn.times.empty()) throw Error::run("no column has a picture");
  render::ComparisonSheet sheet = head_of(page, columns);
  for (double time : drawn.times) {
    sheet.rows.push_back(drawn.pictures(time));
    if (page.to >= 0) sheet.rows.push_back(drawn.differences(sheet.rows.back(), time));
  }
  if (page.outlines) sheet.more = {drawn.outlines()};
  std::vector<std::string> looks = {page.look};
  if (page.to >= 0 && page.curvature) looks.push_back(kDifference);
  for (const std::string& look : looks)
    if (const auto bar = bar_of(columns, look)) sheet.bars.push_back(*bar);
  if (page.to >= 0 && !page.curvature)
    sheet.bars.push_back(
        {render::ColorMap::sequential, 0, kDifferenceScale, "difference of pictures", "8-bit steps", 5});
  render::write_png(run.path("sheet.png"), render::draw_comparison(sheet), render::PngEffort::best);
  keep_page(run, page, columns, frames_of(columns, drawn.times));
  if (page.video != "none") film(run, page, columns);
}

void plot_comparison(Run& run, const ComparisonPage& page, const std::vector<SweepColumn>& columns) {
  plot_series(run, page.title, columns);
  plot_curves(run, page.title, columns);
  plot_answers(run, page, columns);
}

}  // namespace hysteron::experiments
