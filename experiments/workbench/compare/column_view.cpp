#include "experiments/workbench/compare/column_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/workbench/app/law_family.h"
#include "experiments/workbench/pages/manifest.h"
#include "render/color_map.h"
#include "render/plot.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShown = 2;  // numbers behind a name, unless a page asks for more

// The headlines of each experiment, then metrics of any run, in the order in which pages show them; with the
// symbol before the number in a picture's line, "" if the unit says enough.
constexpr std::pair<const char*, const char*> kShownNumbers[] = {{"drape_coefficient_percent", "DC"},
                                                                 {"node_count", "folds"},
                                                                 {"recovery_angle_deg", ""},
                                                                 {"2HB_N", "2HB"},
                                                                 {"set_curvature_per_m", "κ"},
                                                                 {"decay_shape", ""},
                                                                 {"turns", "turns"},
                                                                 {"decay_knee_fraction", "knee at"},
                                                                 {"decay_step_fraction", "step at"},
                                                                 {"bending_friction_J", ""},
                                                                 {"residual_curvature_rms_per_m", "κ"},
                                                                 {"ridge_length_m", "ridges"},
                                                                 {"max_stretch_percent", "stretch"}};

std::string symbol_of(const std::string& metric) {
  for (const auto& [known, symbol] : kShownNumbers)
    if (metric == known) return symbol;
  return split_unit(metric).name;
}

bool is_shown(const MetricValue& value) {
  return value.is_number() || (value.is_text() && value.text() != "unknown");
}

// Formats three digits without an exponent, for 0.001 to 999999.
std::string three_digits(double value) {
  const double size = std::abs(value);
  return number_text(value, {.decimals = size >= 99.95 || size == 0 ? 0 : size >= 9.995 ? 1 : 2});
}

// Formats "0.94 mN", with prefixes for units that take them, from half of one on.
std::string readable(double value, const std::string& unit) {
  constexpr double kNothing = 1e-9;
  if (std::abs(value) < kNothing) value = 0;
  if (unit == "°") return fmt::format("{:.0f}°", value);
  const std::string plain = std::abs(value) < 999.5 ? number_text(value, 3) : three_digits(value);
  if (unit == "%") return plain + " %";
  if (unit == "1/m") return plain + " /m";
  const auto [prefix, factor] = unit.empty() ? render::SiPrefix{} : render::si_prefix(2 * value);
  return three_digits(value / factor) + (unit.empty() ? "" : " " + std::string(prefix) + unit);
}

// Returns the law of a column; of one that was refused, and so has no manifest, the law that it was asked
// for.
std::string column_law(const ChildRun& column) {
  return column.manifest ? column.manifest->text("law") : last_text(column.line.flags, "law", "");
}

bool differ_in_laws(const std::vector<ChildRun>& columns) {
  std::set<std::string> laws;
  for (const ChildRun& column : columns) laws.insert(column_law(column));
  return laws.size() > 1 && !laws.contains("");
}

std::vector<std::string> head_numbers(const ChildRun& column, const std::vector<std::string>& metrics,
                                      std::size_t most) {
  std::vector<std::string> numbers;
  if (!column.stopped.empty()) numbers.emplace_back("stopped");
  if (!column.manifest) return numbers;
  for (const std::string& metric : metrics)
    if (numbers.size() < most && is_shown(column.manifest->metrics[metric]))
      numbers.push_back(short_number(metric, column.manifest->metrics[metric]));
  return numbers;
}

// Returns those of the requested metrics, or of kShownNumbers if none is requested, that any column has.
std::vector<std::string> shown_metrics(const std::vector<ChildRun>& columns,
                                       const std::vector<std::string>& requested) {
  std::vector<std::string> metrics = requested;
  if (requested.empty())
    for (const auto& [metric, symbol] : kShownNumbers) metrics.emplace_back(metric);
  std::erase_if(metrics, [&](const std::string& metric) {
    return std::none_of(columns.begin(), columns.end(),
                        [&](const ChildRun& c) { return is_shown(c.metrics()[metric]); });
  });
  if (requested.empty() && metrics.size() > kShown) metrics.resize(kShown);
  return metrics;
}

// Describes a shape of decay.
std::string decay_text(const std::string& shape) {
  static const std::map<std::string, std::string> kWords = {
      {"linear", "decays straight"},           {"two-step", "decays at two rates"},
      {"exponential", "decays exponentially"}, {"hyperbolic", "decays as 1/t"},
      {"saturating", "decays with a knee"},    {"plateau", "does not decay"}};
  const auto found = kWords.find(shape);
  return found == kWords.end() ? shape : found->second;
}

}  // namespace

std::string short_number(const std::string& metric, const MetricValue& value) {
  if (metric == "decay_shape" && value.is_text()) return decay_text(value.text());
  const std::string symbol = symbol_of(metric);
  const std::string number = value.is_text()      ? value.text()
                             : value.is_integer() ? shown(value)
                                                  : readable(value.number(), split_unit(metric).unit);
  if (symbol == "folds" || symbol == "turns")
    return number + " " + (number == "1" ? symbol.substr(0, symbol.size() - 1) : symbol);
  return symbol.empty() ? number : symbol + " " + number;
}

std::vector<std::string> column_families(const std::vector<ChildRun>& columns) {
  std::vector<std::string> families(columns.size());
  if (differ_in_laws(columns))
    for (std::size_t c = 0; c < columns.size(); ++c) families[c] = family_of_law(column_law(columns[c]));
  return families;
}

std::vector<render::Rgb8> column_colors(const std::vector<ChildRun>& columns) {
  if (differ_in_laws(columns)) {
    std::vector<render::Rgb8> colors;
    for (const ChildRun& column : columns) colors.push_back(color_of_law(column_law(column)));
    return colors;
  }
  constexpr int kHues = 4;
  const int count = static_cast<int>(columns.size()), shades = (count + kHues - 1) / kHues;
  std::vector<render::Rgb8> colors;
  for (int c = 0; c < count; ++c)
    colors.push_back(count <= render::kMethodColors ? render::method_color(static_cast<std::size_t>(c))
                                                    : render::family_color(c / shades, c % shades, shades));
  return colors;
}

namespace {

// Formats "fabric.damping=0.006378" for readers: "damping 0.00638".
std::string setting_text(const std::string& setting) {
  const std::size_t equal = setting.find('=');
  std::string key = setting.substr(0, equal), value = setting.substr(std::min(setting.size(), equal + 1));
  if (key == "fabric") return value;
  if (const std::size_t dot = key.rfind('.'); dot != key.npos) key.erase(0, dot + 1);
  std::ranges::replace(key, '-', ' ');
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  return key + " " + (!value.empty() && *end == '\0' ? number_text(number, 3) : value);
}

// Returns the integrator's share of what the column lost in time, if a curve shows it [%]; else 0. Statics
// lose nothing in time.
double integrators_share(const ChildRun& column) {
  constexpr double kShown = 5;
  if (column.manifest && column.manifest->text("integrator") == "quasi-static") return 0;
  const MetricValue share = column.metrics()["integrator_share_percent"];
  return share.is_number() && share.number() > kShown ? share.number() : 0;
}

}  // namespace

std::string column_text(const std::string& name) {
  std::string words;
  for (std::size_t start = 0; start <= name.size();) {
    const std::size_t end = std::min(name.find('+', start), name.size());
    const std::string part = name.substr(start, end - start);
    words += words.empty() ? part : ", " + setting_text(part);
    start = end + 1;
  }
  return words;
}

std::vector<std::string> column_names(const std::vector<ChildRun>& columns,
                                      const std::vector<std::string>& names) {
  std::vector<std::string> shown;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (c < names.size())
      shown.push_back(names[c]);
    else
      shown.push_back(column_text(columns[c].name));
  }
  return shown;
}

std::vector<std::string> column_labels(const std::vector<ChildRun>& columns,
                                       const std::vector<std::string>& names) {
  std::vector<std::string> labels = column_names(columns, names);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (const double share = integrators_share(columns[c]); share > 0)
      labels[c] += fmt::format(" (integrator {:.0f} %)", share);
  }
  return labels;
}

std::string integrators_note(const std::vector<ChildRun>& columns, const std::vector<std::string>& names) {
  const std::vector<std::string> shown = column_names(columns, names);
  std::string note;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (const double share = integrators_share(columns[c]); share > 0)
      note += fmt::format("{}{:.0f} % ({})", note.empty() ? "" : ", ", share, shown[c]);
  return note.empty() ? "" : "Of the energy lost the integrator took " + note + ": that share is no law's.";
}

std::vector<render::ComparisonColumn> column_heads(const std::vector<ChildRun>& columns,
                                                   const std::vector<std::string>& requested,
                                                   const std::vector<std::string>& names) {
  const std::vector<std::string> metrics = shown_metrics(columns, requested),
                                 families = column_families(columns);
  const std::vector<render::Rgb8> colors = column_colors(columns);
  const std::vector<std::string> shown = column_names(columns, names);
  std::vector<render::ComparisonColumn> heads;
  for (std::size_t c = 0; c < columns.size(); ++c)
    heads.push_back({shown[c],
                     head_numbers(columns[c], metrics, std::max(kShown, requested.size())),
                     colors[c],
                     families[c],
                     {}});
  return heads;
}

bool has_frames(const ChildRun& column) {
  return column.manifest && column.manifest->frames && !instants(column).empty();
}

const std::vector<Frames::Instant>& instants(const ChildRun& column) {
  return column.manifest->frames->instants;
}

std::size_t frame_at(const ChildRun& column, double time) {
  const std::vector<Frames::Instant>& all = instants(column);
  std::size_t nearest = 0;
  for (std::size_t f = 0; f < all.size(); ++f)
    if (std::abs(all[f].time - time) < std::abs(all[nearest].time - time)) nearest = f;
  return nearest;
}

fs::path picture_file(const ChildRun& column, const std::string& look, std::size_t frame) {
  const std::string folder = column.manifest->frames->looks.at(0).name == look ? "frames" : "frames-" + look;
  return column.folder / folder / fmt::format("{:04}.png", frame);
}

void Crop::include(const Frames::Instant& instant) {
  const std::array<double, 4>& b = instant.cloth;
  const bool noted = b[2] > b[0] && b[3] > b[1];
  reach(noted ? b : std::array<double, 4>{0, 0, 1, 1});
}

void Crop::include_shown(const render::Image& picture) {
  constexpr int kWhite = 250;  // 8-bit steps
  const int w = picture.width(), h = picture.height();
  int left = w, top = h, right = 0, bottom = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::uint8_t* const p = picture.at(x, y);
      if (std::min({p[0], p[1], p[2]}) >= kWhite) continue;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = y + 1;
    }
  if (right > left) reach({1.0 * left / w, 1.0 * top / h, 1.0 * right / w, 1.0 * bottom / h});
}

void Crop::reach(const std::array<double, 4>& box) {
  box_ = {std::min(box_[0], box[0]), std::min(box_[1], box[1]), std::max(box_[2], box[2]),
          std::max(box_[3], box[3])};
}

void Crop::widen(double to) {
  constexpr double kWasted = 1.8;
  const double more = (to - width()) / 2;
  if (width() == 0 || more <= 0 || to > kWasted * width()) return;
  // The crop stays within the picture: what is beyond one border is added at the other.
  const double left = std::max(0.0, box_[0] - more), right = std::min(1.0, box_[2] + more);
  box_[0] = std::max(0.0, std::min(left, right - to));
  box_[2] = std::min(1.0, std::max(right, left + to));
}

render::Image Crop::of(const render::Image& picture) const {
  constexpr double kRoom = 0.08;                 // of either side
  constexpr double kWidest = 3, kTallest = 0.9;  // width over height
  const double w = picture.width(), h = picture.height();
  double left = box_[0] * w, top = box_[1] * h, right = box_[2] * w, bottom = box_[3] * h;
  if (right <= left || bottom <= top) return picture;
  const auto grow = [](double& low, double& high, double wanted) {
    const double more = std::max(0.0, wanted - (high - low)) / 2;
    low -= more;
    high += more;
  };
  grow(left, right, (right - left) * (1 + 2 * kRoom));
  grow(top, bottom, (bottom - top) * (1 + 2 * kRoom));
  grow(top, bottom, (right - left) / kWidest);
  grow(left, right, (bottom - top) * kTallest);
  const int x = std::max(0, static_cast<int>(std::floor(left))),
            y = std::max(0, static_cast<int>(std::floor(top))),
            x_end = std::min(picture.width(), static_cast<int>(std::ceil(right))),
            y_end = std::min(picture.height(), static_cast<int>(std::ceil(bottom)));
  if (x_end <= x || y_end <= y) return picture;
  render::Image part(x_end - x, y_end - y, picture.channels());
  for (int row = 0; row < part.height(); ++row)
    std::copy_n(picture.at(x, y + row), part.row_bytes(), part.at(0, row));
  const double width_kept = x_end - x, height_kept = y_end - y;
  render::fade_to_page(part, {(box_[0] * w - x) / width_kept, (box_[1] * h - y) / height_kept,
                              (box_[2] * w - x) / width_kept, (box_[3] * h - y) / height_kept});
  return part;
}

namespace {

// Returns the curves of the first probe's moments that a manifest names, one per direction.
std::vector<Curve> probed_curves(const ChildRun& column) {
  std::vector<Curve> curves;
  if (!column.manifest) return curves;
  for (const Curve& curve : column.manifest->curves)
    if (curve.plot.starts_with("plot_probe1_moment") && fs::exists(column.folder / curve.file))
      curves.push_back(curve);
  return curves;
}

double most_bent(const ChildRun& column, const Curve& curve) {
  double most = 0;
  for (double k : render::series_from_csv(column.folder / curve.file, curve.x, curve.x, "").y)
    if (std::isfinite(k)) most = std::max(most, std::abs(k));
  return most;
}

}  // namespace

ProbedLoops::ProbedLoops(const std::vector<ChildRun>& columns)
    : loops_(columns.size()), colors_(column_colors(columns)) {
  std::string direction;  // name of the plot
  double most = 0;
  for (const ChildRun& column : columns)
    for (const Curve& curve : probed_curves(column))
      if (const double bent = most_bent(column, curve); bent > most) most = bent, direction = curve.plot;
  std::vector<render::LoopFrame> frames;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (const Curve& curve : probed_curves(columns[c])) {
      if (curve.plot != direction) continue;
      const fs::path file = columns[c].folder / curve.file;
      const render::Series curvature = render::series_from_csv(file, "time", curve.x, "");
      loops_[c] = {curvature.x, {curvature.y, render::series_from_csv(file, "time", curve.y, "").y}};
    }
    if (column_law(columns[c]) == "prandtl" && !reference_ && !loops_[c].time.empty()) reference_ = c;
    if (!loops_[c].time.empty()) frames.emplace_back().include(loops_[c].path);
  }
  frame_ = render::LoopFrame::of_most(frames);
}

render::Path ProbedLoops::Loop::until(double end) const {
  render::Path until;
  for (std::size_t i = 0; i < time.size() && time[i] <= end + 1e-9; ++i) {
    until.curvature.push_back(path.curvature[i]);
    until.moment.push_back(path.moment[i]);
  }
  return until;
}

render::LoopInset ProbedLoops::at(std::size_t c, double time) const {
  render::LoopInset inset{loops_[c].until(time), {}, colors_[c], frame_};
  if (reference_ && *reference_ != c) inset.reference = loops_[*reference_].until(time);
  return inset;
}

}  // namespace hysteron::experiments
