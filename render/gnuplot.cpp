#include "render/gnuplot.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "render/color_map.h"
#include "render/color_vision.h"
#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/process.h"

namespace hysteron::render::gnuplot {

namespace {

// Writes a gnuplot string: single quotes are doubled, line ends become spaces.
std::string single_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return result + "'";
}

// Escapes all markup; gnuplot reads `escape` as one backslash.
std::string unmarked(const std::string& text, const char* escape) {
  std::string plain;
  for (const char c : text) {
    if (std::string_view("_^@&~{}\\").find(c) != std::string_view::npos) plain += escape;
    plain += c;
  }
  return plain;
}

// Returns the dashes of a pattern; the last one stands for all that follow.
std::string dashes(int pattern) {
  constexpr const char* kDashes[] = {
      "", " dt (14,5)", " dt (3,4)", " dt (14,4,3,4)", " dt (14,4,3,4,3,4)", " dt (7,7)"};
  return kDashes[std::min<std::size_t>(static_cast<std::size_t>(pattern), std::size(kDashes) - 1)];
}

// Returns the dots of a pattern: circles, squares, triangles, diamonds, inverted triangles.
std::string dots_of(int pattern) {
  constexpr int kFilled[] = {7, 5, 9, 13, 11};
  return " pt " + std::to_string(kFilled[static_cast<std::size_t>(pattern) % std::size(kFilled)]) + " ps 0.9";
}

std::string style_commands(const Series& series, const std::string& color, int pattern) {
  const std::string lines = dashes(pattern) + " lw " + number(series.line_width) + " lc rgb '" + color + "'",
                    dots = dots_of(pattern);
  switch (series.style) {
    case Series::Style::points:
      return "points" + dots + " lc rgb '" + color + "'";
    case Series::Style::rings:
      return "points pt 6 ps 1.3 lw 2 lc rgb '" + color + "'";
    case Series::Style::line_and_points:
      return "linespoints" + lines + dots;
    case Series::Style::dashed:
      return "lines dt 2 lw " + number(series.line_width) + " lc rgb '" + color + "'";
    case Series::Style::bars:
      return "boxes lc rgb '" + color + "'";
    default:
      return "lines" + lines;
  }
}

bool has_line(const Series& series) {
  return series.style == Series::Style::line || series.style == Series::Style::line_and_points;
}

// Returns patterns that tell named series apart, lines from lines and dots from dots.  Dashed lines get none:
// others are held against them.
std::vector<int> patterns_of(const std::vector<Series>& series, const std::vector<std::string>& colors) {
  std::vector<int> patterns(series.size());
  for (const bool lines : {true, false}) {
    std::vector<std::size_t> alike;
    std::vector<std::string> beside;
    for (std::size_t i = 0; i < series.size(); ++i)
      if (!series[i].label.empty() &&
          (lines ? has_line(series[i]) : series[i].style == Series::Style::points))
        alike.push_back(i), beside.push_back(colors[i]);
    const std::vector<int> found = patterns_beside(beside);
    for (std::size_t k = 0; k < alike.size(); ++k) patterns[alike[k]] = found[k];
  }
  return patterns;
}

std::string output_commands(const char* terminal, int width, int height, const std::filesystem::path& file) {
  return std::string("set terminal ") + terminal + " enhanced size " + std::to_string(width) + "," +
         std::to_string(height) + " font 'DejaVu Sans,15' background rgb 'white'\nset output " +
         single_quoted(file.string()) + "\n";
}

// Numbers an axis at 1, 2, 5, 10, ..., and at more places where few of these lie within it.
std::string numbers_of_short(const char* name, const Axis& axis) {
  const bool few = axis.high < 5 * axis.low;
  const std::vector<double> digits =
      few ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 8} : std::vector<double>{1, 2, 5};
  std::string ticks;
  for (int power = static_cast<int>(std::floor(std::log10(axis.low))); power <= std::log10(axis.high);
       ++power)
    for (const double digit : digits)
      if (const double at = digit * std::pow(10, power); at >= axis.low && at <= axis.high)
        ticks += (ticks.empty() ? "" : ",") + number(at);
  return std::string("set format ") + name + " '%g'\nset " + name + "tics (" + ticks + ")\n";
}

// Names at ticks are formats of their numbers: a percent sign is doubled.
std::string category_commands(const char* name, const std::vector<std::string>& categories) {
  std::string ticks;
  for (std::size_t i = 0; i < categories.size(); ++i) {
    std::string text;
    for (const char c : categories[i]) text += c == '%' ? "%%" : std::string(1, c);
    ticks += (i ? "," : "") + label_text(text) + " " + std::to_string(i);
  }
  return std::string("set ") + name + "tics (" + ticks + ") rotate by -35\nset " + name +
         "range [-0.6:" + number(static_cast<double>(categories.size()) - 0.4) + "]\n";
}

// The exit status of gnuplot that without_letters() sets.
constexpr int kNoLetters = 9;

// Ends gnuplot where a character of the picture before is less than a pixel high or wide: without any font,
// gnuplot draws on and leaves every letter out.  Fontconfig's messages do not tell: it goes on without its
// configuration, and may find fonts all the same.  The height is then any number in gnuplot 6.
std::string without_letters(int width) {
  const std::string pixel = " * " + std::to_string(width) + " < GPVAL_TERM_XSIZE";
  return "if (exists('GPVAL_TERM_VCHAR') && (GPVAL_TERM_VCHAR" + pixel + " || GPVAL_TERM_HCHAR" + pixel +
         ")) exit status " + std::to_string(kNoLetters) + "\n";
}

bool has_content(const std::string& file) {
  std::error_code error;
  return std::filesystem::file_size(file, error) > 0 && !error;
}

// Returns true if the last bytes of the file hold `end`: gnuplot ends well where it could not write all of
// one.
bool has_end(const std::string& file, std::string_view end) {
  constexpr std::streamoff kTail = 64;
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  in.seekg(-std::min<std::streamoff>(kTail, in.tellg()), std::ios::end);
  const std::string tail{std::istreambuf_iterator<char>(in), {}};
  return tail.find(end) != tail.npos;
}

// Returns true if the disk has no room for a page: the PDF is empty then, too, not only where gnuplot cannot
// write any.
bool is_full(const std::filesystem::path& folder) {
  constexpr std::uintmax_t kLeast = 1 << 16;  // least size of a page [byte]
  std::error_code failure;
  const auto room = std::filesystem::space(folder.empty() ? "." : folder, failure);
  return !failure && room.available < kLeast;
}

void require_complete(const std::filesystem::path& base, const AtomicFile& file, const char* ending,
                      std::string_view end) {
  if (has_end(file.temporary(), end)) return;
  throw Error::system("plot " + base.string() + ": gnuplot did not write all of " + base.filename().string() +
                      ending + (is_full(base.parent_path()) ? ": the disk is full" : ", is the disk full?"));
}

}  // namespace

std::string number(double value) { return std::isfinite(value) ? number_text(value, 17) : "NaN"; }

std::string label_text(const std::string& text) { return single_quoted(unmarked(text, "\\")); }

std::string data_text(const std::string& text) { return "\"" + unmarked(text, "\\\\") + "\""; }

void require_something(const std::filesystem::path& base, std::size_t count) {
  if (count == 0) throw Error::invalid_input("plot " + base.string() + ": there is nothing to draw");
}

void require_drawable(const std::filesystem::path& base, const std::vector<Series>& all) {
  require_something(base, all.size());
  for (const Series& series : all)
    if (series.x.size() != series.y.size() || series.x.empty() ||
        (!series.spread.empty() && series.spread.size() != series.y.size()))
      throw Error::invalid_input("plot " + base.string() + ": series \"" + series.label + "\" has " +
                                 std::to_string(series.x.size()) + " x and " +
                                 std::to_string(series.y.size()) +
                                 " y values; as many of both are needed, at least one");
}

std::string data_blocks(const std::vector<Series>& series, std::size_t first) {
  std::string script;
  for (size_t i = 0; i < series.size(); ++i) {
    script += "$series" + std::to_string(first + i) + " << END\n";
    for (size_t k = 0; k < series[i].x.size(); ++k) {
      const double x = series[i].x[k], y = series[i].y[k];
      if (std::isfinite(x) && std::isfinite(y)) script += number(x) + " " + number(y);
      if (std::isfinite(x) && std::isfinite(y) && !series[i].spread.empty())
        script += " " + number(series[i].spread[k]);
      script += "\n";  // an empty line ends the curve: gnuplot draws on through what is called missing
    }
    script += "END\n";
  }
  return script;
}

std::string plot_command(const std::vector<Series>& series, std::size_t first) {
  std::string script = "plot ";
  std::vector<std::string> colors;
  for (std::size_t i = 0; i < series.size(); ++i)
    colors.push_back(series[i].color.empty() ? hex(method_color(i)) : series[i].color);
  const std::vector<int> patterns = patterns_of(series, colors);
  for (size_t i = 0; i < series.size(); ++i)  // bands are drawn behind all lines
    if (!series[i].spread.empty())
      script +=
          "$series" + std::to_string(first + i) +
          " using 1:($2-$3):($2+$3) notitle with filledcurves fs transparent solid 0.25 noborder lc rgb '" +
          colors[i] + "', ";
  for (size_t i = 0; i < series.size(); ++i) {
    const std::string name = series[i].label.empty() ? " notitle" : " title " + label_text(series[i].label);
    script += std::string(i ? ", " : "") + "$series" + std::to_string(first + i) + " using 1:2" + name +
              " with " + style_commands(series[i], colors[i], patterns[i]);
  }
  return script + "\n";
}

bool is_short(double low, double high) { return low > 0 && high < 100 * low; }

std::string axis_commands(const char* name, const Axis& axis) {
  std::string script = std::string("set ") + name + "label " + label_text(axis.label) + "\n";
  if (axis.logarithmic)
    script += std::string("set logscale ") + name + "\n" +
              (axis.low != axis.high && is_short(axis.low, axis.high)
                   ? numbers_of_short(name, axis)
                   : std::string("set format ") + name + " '10^{%L}'\n");
  if (axis.low != axis.high)
    script += std::string("set ") + name + "range [" + number(axis.low) + ":" + number(axis.high) + "]\n";
  if (!axis.categories.empty()) script += category_commands(name, axis.categories);
  return script;
}

std::string mark_commands(const std::vector<Mark>& marks) {
  std::string script;
  for (size_t i = 0; i < marks.size(); ++i) {
    const Mark& mark = marks[i];
    const char* side = mark.dx > 0 ? "left" : mark.dx < 0 ? "right" : "center";
    script += "set label " + std::to_string(i + 1) + " " + label_text(mark.text) + " at " + number(mark.x) +
              "," + number(mark.y) + " " + side + " offset character " + number(mark.dx) + "," +
              number(mark.dy) + " font ',16' textcolor rgb '" + mark.color + "' front" +
              (mark.dot ? " point pt 7 ps 1 lc rgb '" + mark.color + "'" : "") + "\n";
  }
  return script;
}

// Starts a PDF page of as many points as the PNG has pixels; a gnuplot that cannot write PDF ends here.
std::string pdf_commands(int width, int height, const std::filesystem::path& file) {
  constexpr double kPoint = 1. / 72;  // size of a point [inch]
  return "if (strstrt(GPVAL_TERMINALS, 'pdfcairo') == 0) exit\nset terminal pdfcairo enhanced size " +
         number(kPoint * width) + "in," + number(kPoint * height) + "in font 'DejaVu Sans,15'\nset output " +
         single_quoted(file.string()) + "\n";
}

// Overwrites a PDF's time of creation, which would make two files of the same plot differ, with zeros, except
// where cairo packs it with other objects (1.18).
void forget_when(const std::filesystem::path& pdf) {
  constexpr std::string_view kKey = "/CreationDate (D:";
  std::ifstream in(pdf, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t at = text.find(kKey);
  if (at == std::string::npos) return;
  for (std::size_t i = at + kKey.size(); i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
       ++i)
    text[i] = '0';
  std::ofstream out(pdf, std::ios::binary | std::ios::in);  // in place, which needs no room
  if (!(out << text).flush()) throw Error::system("cannot write " + pdf.string() + ": is the disk full?");
}

// The SVG gets the same page in its own units, so that both look alike.
void write_both(const std::filesystem::path& base, int width, int height, const std::string& prologue,
                const std::string& drawing) {
  AtomicFile png(base.string() + ".png"), svg(base.string() + ".svg"), pdf(base.string() + ".pdf");
  const std::string script =
      "set encoding utf8\n" + prologue + output_commands("pngcairo", width, height, png.temporary()) +
      drawing + without_letters(width) + output_commands("svg", width, height, svg.temporary()) + drawing +
      "set output\n" + pdf_commands(width, height, pdf.temporary()) + drawing + "set output\n";
  const ProcessResult result = run_process({"gnuplot", "-"}, script);
  if (!result.started)
    throw Error::system("plot " + base.string() + ": gnuplot cannot be started; install gnuplot-nox");
  if (result.exit_code == kNoLetters)
    throw Error::system("plot " + base.string() +
                        ": gnuplot finds no fonts and would leave all letters out; install fontconfig and "
                        "fonts-dejavu-core");
  if (result.exit_code != 0 && !is_full(base.parent_path()))
    throw Error::system("plot " + base.string() + ": gnuplot fails: " + result.first_error_line);
  require_complete(base, png, ".png", "IEND");
  require_complete(base, svg, ".svg", "</svg>");
  const bool has_pdf = has_content(pdf.temporary()) || is_full(base.parent_path());
  if (has_pdf) {
    require_complete(base, pdf, ".pdf", "%%EOF");
    forget_when(pdf.temporary());
  }
  png.commit();
  svg.commit();
  if (has_pdf) pdf.commit();
}

Trial try_gnuplot() {
  constexpr int kWidth = 640, kHeight = 480;  // [pixels]
  Trial trial;
  const auto read = [&](const std::string& line) {
    if (line.starts_with("version ")) trial.version = line.substr(line.find(' ') + 1);
    if (line == "pdf") trial.writes_pdf = true;
  };
  const ProcessResult result = run_process(
      {"gnuplot", "-"},
      "set print '-'\nprint sprintf('version %.1f patchlevel ', GPVAL_VERSION) . "
      "GPVAL_PATCHLEVEL\nif (strstrt(GPVAL_TERMINALS, 'pdfcairo')) print 'pdf'\n" +
          output_commands("pngcairo", kWidth, kHeight, "/dev/null") + "plot 0\n" + without_letters(kWidth),
      read);
  if (!result.started) trial.failure = "gnuplot cannot be started";
  if (result.exit_code == kNoLetters)
    trial.has_letters = false;
  else if (result.started && result.exit_code != 0)
    trial.failure = "gnuplot fails: " + result.first_error_line;
  return trial;
}

std::string PanelPage::point(double x, double y) const {
  return "screen " + number(across(x)) + "," + number(up(y));
}

std::string PanelPage::margins(int index) const {
  const int x = left + index % columns * (panel_width + gap_x),
            y = top + index / columns * (panel_height + gap_y);
  const auto margin = [](const char* side, double at) {
    return std::string("set ") + side + "margin at screen " + number(at) + "\n";
  };
  return margin("l", across(x)) + margin("r", across(x + panel_width)) + margin("t", up(y)) +
         margin("b", up(y + panel_height));
}

std::string text_at(const std::string& text, const std::string& place, const std::string& style) {
  return "set label " + label_text(text) + " at " + place + " " + style + "\n";
}

std::string page_texts(const PanelPage& page, const std::string& title, const std::string& subtitle,
                       const std::string& x_label, const std::string& y_label) {
  const double middle = page.left + (page.width() - page.left - page.right) / 2.0;
  const double beside = page.top + (page.height() - page.top - page.bottom) / 2.0;
  return text_at(title, page.point(page.left, 28), "left font ',19'") +
         text_at(subtitle, page.point(page.left, 56), "left font ',13' textcolor rgb '#555555'") +
         text_at(x_label, page.point(middle, page.height() - 16), "center font ',15'") +
         text_at(y_label, page.point(22, beside), "center rotate by 90 font ',15'");
}

}  // namespace hysteron::render::gnuplot
