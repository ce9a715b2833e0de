#include "experiments/workbench/compare/comparison_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "experiments/workbench/compare/archived_page.h"
#include "experiments/workbench/compare/column_view.h"
#include "experiments/workbench/compare/film.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/color_map.h"
#include "render/compare.h"
#include "render/comparison_sheet.h"
#include "render/contact_sheet.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kDifference = "difference";  // name of the look
constexpr int kDifferenceScale = 64;               // 8-bit steps at the end of the difference's colours
constexpr std::size_t kMaxOutlined = 4;            // most columns that leave room for outlines of all

double second(const ChildRun& column, std::size_t frame) { return instants(column).at(frame).time; }

// Returns the column that went on longest; null if none has a picture.
const ChildRun* longest_column(const std::vector<ChildRun>& columns) {
  const ChildRun* longest = nullptr;
  for (const ChildRun& c : columns)
    if (has_frames(c) &&
        (!longest || second(c, instants(c).size() - 1) > second(*longest, instants(*longest).size() - 1)))
      longest = &c;
  return longest;
}

// Returns how far the cloth moves from each picture of the longest column to the next [m], in the column
// where it moves most.
std::vector<double> frame_displacements(const ChildRun& longest, const std::vector<ChildRun>& columns) {
  std::vector<double> moved(instants(longest).size(), 0);
  for (const ChildRun& c : columns)
    for (std::size_t f = 1; has_frames(c) && f < std::min(moved.size(), instants(c).size()); ++f)
      moved[f] = std::max(moved[f], instants(c)[f].moved);
  return moved;
}

// Returns times of pictures of the longest column [s]: those nearest to the page's own times, or spread by
// displacement, without the first picture, which is the same in all columns.
std::vector<double> shown_times(const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  const ChildRun* longest = longest_column(columns);
  std::vector<double> times;
  if (!longest) return times;
  for (double time : page.times) times.push_back(second(*longest, frame_at(*longest, time)));
  if (!times.empty()) return times;
  for (int f : render::spread_by_displacement(frame_displacements(*longest, columns), page.rows + 1))
    if (f > 0 || instants(*longest).size() == 1)
      times.push_back(second(*longest, static_cast<std::size_t>(f)));
  return times;
}

// Returns the time, and the phase at it.  Times given by the user may be milliseconds apart.
std::pair<std::string, std::string> instant_text(const ComparisonPage& page,
                                                 const std::vector<ChildRun>& columns, double time) {
  const bool in_hundredths = std::abs(100 * time - std::round(100 * time)) < 1e-6;
  const std::string text = fmt::format("{:.{}f} s", time, page.times.empty() || in_hundredths ? 2 : 3);
  for (const ChildRun& c : columns) {
    if (!has_frames(c)) continue;
    const Frames::Instant& instant = instants(c).at(frame_at(c, time));
    if (std::abs(instant.time - time) < 1e-9) return {text, instant.phase};
  }
  return {text, ""};
}

// One sheet of columns; its rows are added one by one.
class PageTable {
 public:
  PageTable(const ComparisonPage& page, const std::vector<ChildRun>& columns)
      : page_(page), columns_(columns), loops_(columns) {
    sheet_.columns = column_heads(columns, page.metrics, page.names);
    sheet_.scale_note = "at the cloth's middle";
    sheet_.loop_note = loops_.note(column_names(columns, page.names));
    if (page.outlines && columns.size() > 1 && columns.size() <= kMaxOutlined)
      sheet_.columns.push_back({"all, outlined", {}, {}, "", {}});
  }

  Crop crop_at(std::initializer_list<double> times) const {
    Crop crop;
    for (const ChildRun& c : columns_)
      for (const double time : times)
        if (has_frames(c)) crop.include(instants(c)[frame_at(c, time)]);
    return crop;
  }
  // True if every column looks the same at both times.
  bool look_alike(double a, double b) const {
    const Crop both = crop_at({a, b});
    return std::all_of(columns_.begin(), columns_.end(), [&](const ChildRun& c) {
      return !has_frames(c) || frame_at(c, a) == frame_at(c, b) ||
             render::look_alike(both.of(picture_at(c, a)), both.of(picture_at(c, b)));
    });
  }
  Crop crop_until(double end) const {
    Crop crop;
    for (const ChildRun& c : columns_)
      for (std::size_t f = 0; has_frames(c) && f <= frame_at(c, end); ++f) crop.include(instants(c)[f]);
    return crop;
  }

  void add_row(double time, const Crop& crop) {
    const auto [text, phase] = instant_text(page_, columns_, time);
    sheet_.rows.push_back({text, phase, scale()});
    for (std::size_t c = 0; c < columns_.size(); ++c) sheet_.columns[c].cells.push_back(cell(c, time, crop));
    if (sheet_.columns.size() > columns_.size())
      sheet_.columns.back().cells.push_back({outlines(time, crop)});
  }

  // Adds a row with everything that moves up to `end` [s] in one picture.
  void add_onion(double end, const Crop& crop) {
    sheet_.rows.push_back({fmt::format("0–{:.2f} s", end), "", scale()});
    for (std::size_t c = 0; c < columns_.size(); ++c) sheet_.columns[c].cells.push_back(onion(c, end, crop));
    if (sheet_.columns.size() > columns_.size()) sheet_.columns.back().cells.emplace_back();
  }

  void add_differences(double time, const Crop& crop) {
    const std::size_t to = static_cast<std::size_t>(page_.to);
    sheet_.rows.push_back({"", "less " + sheet_.columns[to].name, scale()});
    for (std::size_t c = 0; c < columns_.size(); ++c)
      sheet_.columns[c].cells.push_back(c == to ? render::ComparisonCell{} : difference(c, to, time, crop));
    if (sheet_.columns.size() > columns_.size()) sheet_.columns.back().cells.emplace_back();
  }

  render::ComparisonSheet& sheet() { return sheet_; }

  // The layout of all frames of a film, which has one row.
  struct FilmPlace {
    Crop crop;                        // covers everything shown
    std::vector<render::Image> busy;  // for each column with loops: its pictures over each other, cropped
    std::vector<render::ComparisonRow> rows;
  };
  FilmPlace film_place(const std::vector<double>& times) const {
    FilmPlace place;
    for (const double time : times) {
      const auto [text, phase] = instant_text(page_, columns_, time);
      place.rows.push_back({text, phase});
      for (const ChildRun& c : columns_)
        if (has_frames(c)) place.crop.include_shown(picture_at(c, time));
    }
    for (std::size_t c = 0; c < columns_.size(); ++c)
      place.busy.push_back(all_over_each_other(c, times, place.crop));
    return place;
  }
  // Returns the number of columns in a row that makes a picture about as high as wide: four are two above
  // two.
  static int film_columns(std::size_t count) {
    constexpr std::size_t kInARow = 3;
    const int square = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    return count <= kInARow ? static_cast<int>(count) : std::min(square, render::kMaxBeside);
  }
  // Returns a film's picture: the row at that time, laid out as all others, without numbers, which belong to
  // the end.
  render::Image film_picture(double time, const FilmPlace& place) {
    add_row(time, place.crop);
    for (render::ComparisonColumn& column : sheet_.columns) column.numbers.clear();
    sheet_.further_rows = place.rows;
    sheet_.beside = film_columns(sheet_.columns.size());
    for (std::size_t c = 0; c < columns_.size(); ++c) sheet_.columns[c].cells.back().busy = place.busy[c];
    return render::draw_comparison(sheet_);
  }

 private:
  render::Image all_over_each_other(std::size_t c, const std::vector<double>& times, const Crop& crop) const {
    render::Image all;
    if (!has_frames(columns_[c]) || loops_.at(c, times.back()).empty()) return all;
    for (const double time : times) {
      const render::Image one = crop.of(picture_at(columns_[c], time));
      if (all.empty()) all = one;
      std::ranges::transform(all.pixels(), one.pixels(), all.pixels().begin(),
                             [](std::uint8_t a, std::uint8_t b) { return std::min(a, b); });
    }
    return all;
  }

  double scale() const {
    for (const ChildRun& c : columns_)
      if (has_frames(c)) return c.manifest->frames->metres_per_pixel;
    return 0;
  }

  render::Image picture_at(const ChildRun& column, double time) const {
    return render::read_png(page_.picture.empty() ? picture_file(column, page_.look, frame_at(column, time))
                                                  : column.folder / page_.picture);
  }

  render::ComparisonCell cell(std::size_t c, double time, const Crop& crop) const {
    const ChildRun& column = columns_[c];
    if (!has_frames(column)) return {};
    const std::size_t frame = frame_at(column, time);
    const bool over = time - second(column, frame) > 1e-9;
    return {crop.of(picture_at(column, time)),
            over ? fmt::format("{} {:.2f} s", column.stopped.empty() ? "at rest since" : "stopped at",
                               second(column, frame))
                 : "",
            loops_.at(c, time)};
  }

  render::ComparisonCell onion(std::size_t c, double end, const Crop& crop) const {
    constexpr int kSkins = 14;
    if (!has_frames(columns_[c])) return {};
    std::vector<double> moved;
    for (std::size_t f = 0; f <= frame_at(columns_[c], end); ++f)
      moved.push_back(f == 0 ? 0 : instants(columns_[c])[f].moved);
    std::vector<render::Image> skins;
    for (int f : render::spread_by_displacement(moved, kSkins))
      skins.push_back(
          crop.of(render::read_png(picture_file(columns_[c], page_.look, static_cast<std::size_t>(f)))));
    return {render::onion_skin(skins), "", loops_.at(c, end)};
  }

  render::ComparisonCell difference(std::size_t c, std::size_t to, double time, const Crop& crop) const {
    if (!has_frames(columns_[c]) || !has_frames(columns_[to])) return {};
    const std::size_t frame = frame_at(columns_[c], time);
    if (page_.curvature) {
      const std::optional<double> rms = instants(columns_[c]).at(frame).difference_rms;
      return {crop.of(render::read_png(picture_file(columns_[c], kDifference, frame))),
              rms ? fmt::format("rms {:.3g} /m", *rms) : "no such instant",
              {}};
    }
    const render::Image image = crop.of(picture_at(columns_[c], time)),
                        other = crop.of(picture_at(columns_[to], time));
    return {render::heat_map(image, other, kDifferenceScale),
            number_text(render::compare(image, other).pixels_over_8_percent, 2, "%") + " differ",
            {}};
  }

  render::Image outlines(double time, const Crop& crop) const {
    render::Image over;
    const std::vector<render::Rgb8> colors = column_colors(columns_);
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!has_frames(columns_[c])) continue;
      const render::Image shape =
          crop.of(render::read_png(picture_file(columns_[c], "silhouette", frame_at(columns_[c], time))));
      if (over.empty()) over = render::Image(shape.width(), shape.height(), render::Rgb8{255, 255, 255});
      const bool again =
          std::count(colors.begin(), colors.begin() + static_cast<std::ptrdiff_t>(c), colors[c]) > 0;
      render::draw_outline(over, shape, colors[c], std::max(2, shape.width() / 160), again);
    }
    return over;
  }

  const ComparisonPage& page_;
  const std::vector<ChildRun>& columns_;
  ProbedLoops loops_;
  render::ComparisonSheet sheet_;
};

std::optional<render::ColorBar> look_color_bar(const std::vector<ChildRun>& columns,
                                               const std::string& look) {
  for (const ChildRun& c : columns) {
    if (!has_frames(c)) continue;
    for (const auto& [name, bar] : c.manifest->frames->looks)
      if (name == look && bar)
        return render::ColorBar{look_color_map(look), bar->low, bar->high, bar->label, bar->unit};
  }
  return {};
}

std::vector<render::ColorBar> look_color_bars(const ComparisonPage& page,
                                              const std::vector<ChildRun>& columns) {
  std::vector<render::ColorBar> bars;
  std::vector<std::string> looks = {page.look};
  if (page.to >= 0 && page.curvature) looks.emplace_back(kDifference);
  for (const std::string& look : looks)
    if (const auto bar = look_color_bar(columns, look)) bars.push_back(*bar);
  if (page.to >= 0 && !page.curvature)
    bars.push_back(
        {render::ColorMap::sequential, 0, kDifferenceScale, "difference of pictures", "8-bit steps", 5});
  return bars;
}

PageTable columns_table(const ComparisonPage& page, const std::vector<ChildRun>& columns,
                        const std::vector<double>& times) {
  PageTable table(page, columns);
  std::vector<Crop> crops;
  for (double time : times) crops.push_back(table.crop_at({time}));
  const double onion = std::min(page.onion, times.back());
  if (onion > 0) crops.push_back(table.crop_until(onion));
  double widest = 0;
  for (const Crop& crop : crops) widest = std::max(widest, crop.width());
  for (Crop& crop : crops) crop.widen(widest);
  if (onion > 0) table.add_onion(onion, crops.back());
  for (std::size_t r = 0; r < times.size(); ++r) {
    const double time = times[r];
    const Crop& crop = crops[r];
    table.add_row(time, crop);
    if (page.to >= 0) table.add_differences(time, crop);
  }
  table.sheet().title = page.title;
  table.sheet().notes = page.notes;
  table.sheet().bars = look_color_bars(page, columns);
  return table;
}

// Returns the times of rows that show something new, or all requested ones.
std::vector<double> representative_times(const ComparisonPage& page, const std::vector<ChildRun>& columns,
                                         const std::vector<double>& times) {
  if (!page.times.empty()) return times;
  const PageTable table(page, columns);
  std::vector<double> telling;
  for (const std::size_t i : render::distinct(
           times.size(), [&](std::size_t a, std::size_t b) { return table.look_alike(times[a], times[b]); }))
    telling.push_back(times[i]);
  return telling;
}

// Draws the sheet, at most twice as high as wide: of many columns the first instants are dropped, unless they
// were requested.
render::Image page_sheet(const ComparisonPage& page, const std::vector<ChildRun>& columns,
                         const std::vector<double>& shown) {
  render::Image sheet;
  for (std::vector<double> times = representative_times(page, columns, shown);; times.erase(times.begin())) {
    sheet = render::draw_comparison(columns_table(page, columns, times).sheet());
    if (times.size() == 1 || !page.times.empty() || sheet.height() <= 2 * sheet.width()) return sheet;
  }
}

// Draws films of all columns side by side at each instant, at the columns' own speed, with a fixed crop.
void draw_films(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  std::vector<double> times;
  if (const ChildRun* longest = longest_column(columns))
    for (const Frames::Instant& instant : instants(*longest)) times.push_back(instant.time);
  const PageTable table(page, columns);
  const PageTable::FilmPlace place = table.film_place(times);
  for (std::size_t f = 0; f < times.size(); ++f)
    render::write_png(run.path(fmt::format("film/{:04}.png", f)),
                      PageTable(table).film_picture(times[f], place));
  const double rate =
      times.size() > 1 ? static_cast<double>(times.size() - 1) / (times.back() - times.front()) : 1;
  for (const std::string& format : page.films)
    write_film(run, "compare.video", format, rate, page.film_bytes);
}

// Returns for each column the frames in its rows, or up to the end of the motion in one picture, and the
// first, which is needed for the motion before them.
std::vector<std::vector<int>> shown_frames(const ComparisonPage& page, const std::vector<ChildRun>& columns,
                                           const std::vector<double>& times) {
  std::vector<std::vector<int>> frames(columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (!has_frames(columns[c])) continue;
    std::set<int> chosen;
    if (times.size() > 1 || page.onion > 0) chosen.insert(0);
    for (const double time : times) chosen.insert(static_cast<int>(frame_at(columns[c], time)));
    if (page.onion > 0)
      for (std::size_t f = 0; f <= frame_at(columns[c], std::min(page.onion, times.back())); ++f)
        chosen.insert(static_cast<int>(f));
    frames[c].assign(chosen.begin(), chosen.end());
  }
  return frames;
}

}  // namespace

void draw_comparison_page(Run& run, const ComparisonPage& page, const std::vector<ChildRun>& columns) {
  const std::vector<double> times = shown_times(page, columns);
  if (times.empty()) throw Error::simulation("no column has a picture");
  render::write_png(run.path("sheet.png"), page_sheet(page, columns, times), render::PngEffort::best);
  keep_page(run, page, columns, shown_frames(page, columns, times));
  if (!page.films.empty()) draw_films(run, page, columns);
}

}  // namespace hysteron::experiments
