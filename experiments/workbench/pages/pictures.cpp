#include "experiments/workbench/pages/pictures.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <thread>

#include "render/contact_sheet.h"
#include "sim/base/csv.h"
#include "sim/base/number_in.h"
#include "sim/base/parallel.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

constexpr int kFrameWidth = 480;  // [pixels]

// Returns the value of an attribute `name="1200"` of a tag; 0 if it is missing or in another unit.
int whole_number(const std::string& tag, const std::string& name) {
  for (std::size_t at = 0; (at = tag.find(name + "=\"", at + 1)) != tag.npos;) {
    const std::size_t begin = at + name.size() + 2, end = tag.find('"', begin);
    const std::string value = tag.substr(begin, end - begin);
    const bool whole = std::isspace(static_cast<unsigned char>(tag[at - 1])) && !value.empty() &&
                       value.size() < 7 && value.find_first_not_of("0123456789") == value.npos;
    if (whole) return std::stoi(value);
  }
  return 0;
}

// Returns a chart of a line through (x, y), scaled to its own extent, with the ends of both axes labelled.
std::string line_chart(const std::string& title, const std::vector<double>& x, const std::string& x_name,
                       const std::vector<double>& y) {
  constexpr double kLeft = 12, kTop = 40, kWidth = 396, kHeight = 120;  // place of the line in chart.svg
  constexpr std::size_t kMaxPoints = 600;
  const auto [x_low, x_high] = std::minmax_element(x.begin(), x.end());
  const auto [y_low, y_high] = std::minmax_element(y.begin(), y.end());
  const double x_span = *x_high > *x_low ? *x_high - *x_low : 1,
               y_span = *y_high > *y_low ? *y_high - *y_low : 1;
  std::string points;
  const std::size_t count = std::min(kMaxPoints, x.size());
  for (std::size_t i = 0; i < count; ++i) {
    // Includes the first and the last.
    const std::size_t row = count < 2 ? 0 : i * (x.size() - 1) / (count - 1);
    points += fmt::format("{:.1f},{:.1f} ", kLeft + kWidth * (x[row] - *x_low) / x_span,
                          kTop + kHeight * (1 - (y[row] - *y_low) / y_span));
  }
  return filled("chart.svg", {{"title", title},
                              {"points", points},
                              {"high", number_text(*y_high, 4)},
                              {"low", number_text(*y_low, 4)},
                              {"axis", fmt::format("{} {:.4g} … {:.4g}", x_name, *x_low, *x_high)}});
}

}  // namespace

bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

std::vector<fs::path> files_ending(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored) && entry.path().extension() == ending) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> content_bytes(const fs::path& file) {
  const std::string bytes = whole_file(file);
  return {bytes.begin(), bytes.end()};
}

bool is_plot(const fs::path& file) { return file.filename().string().starts_with("plot_"); }

std::vector<std::uint8_t> thumbnail(const fs::path& file, int width) {
  const render::Image picture = render::read_png(file);
  const int w = std::min(width, picture.width()), h = std::max(1, picture.height() * w / picture.width());
  return encode_png(shrink(picture, w, h), render::PngEffort::best);
}

render::ImageSize drawing_size(const fs::path& file) {
  const std::string text = whole_file(file);
  const std::size_t begin = std::min(text.find("<svg"), text.size());
  const std::string tag = text.substr(begin, text.find('>', begin) - begin);
  const render::ImageSize size{whole_number(tag, "width"), whole_number(tag, "height")};
  return size.width > 0 && size.height > 0 ? size : render::ImageSize{};
}

std::string image_element(const PagePicture& picture, PageForm form) {
  const bool drawing = picture.file.extension() == ".svg";
  const std::string source = " alt=\"" + escaped(picture.words) + "\" src=\"";
  if (form == PageForm::linked) {
    const render::ImageSize size = drawing ? drawing_size(picture.file) : render::png_size(picture.file);
    const std::string place = size == render::ImageSize{}
                                  ? ""
                                  : fmt::format(" width=\"{}\" height=\"{}\"", size.width, size.height);
    return "<img loading=\"lazy\"" + place + source + relative_url(picture.path) + "\">";
  }
  const bool shrunk = !drawing && picture.width > 0;
  return "<img" + source + "data:" + (drawing ? "image/svg+xml" : "image/png") + ";base64," +
         base64(shrunk ? thumbnail(picture.file, picture.width) : content_bytes(picture.file)) + "\">";
}

std::string player(const fs::path& folder, const std::string& path, int count, PageForm form) {
  const std::vector<fs::path> frames = files_ending(folder / "frames", ".png");
  if (frames.empty()) return "";
  const std::vector<int> chosen = render::spread(static_cast<int>(frames.size()), count);
  std::vector<std::string> figures(chosen.size());
  in_parallel(chosen.size(), static_cast<int>(std::thread::hardware_concurrency()), [&](std::size_t i) {
    const fs::path& file = frames[static_cast<std::size_t>(chosen[i])];
    const std::string name = "frames/" + file.filename().string();
    figures[i] = html_figure(image_element({file, path + name, name, kFrameWidth}, form), name);
  });
  std::string html;
  for (const std::string& figure : figures) html += figure;
  return filled("player.html", {{"figures", html}});
}

std::string series_charts(const fs::path& folder) {
  const fs::path file = folder / "metrics.csv";
  if (!is_there(file)) return "";
  Table table = read_table(file);
  table.reader = "report";
  std::string charts;
  for (std::size_t i = 1; i < table.head.size() && !table.rows.empty(); ++i) {
    std::string title = table.head[i];
    std::replace(title.begin(), title.end(), '_', ' ');
    charts += line_chart(title, table.numbers(0), table.head[0], table.numbers(i));
  }
  return html_group("charts", charts);
}

}  // namespace hysteron::experiments
