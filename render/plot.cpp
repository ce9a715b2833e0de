#include "render/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "render/process.h"
#include "sim/atomic_file.h"
#include "sim/error.h"

namespace hysteron::render {
namespace {

// Okabe & Ito 2008, "Color universal design": apart under all common kinds of colour blindness.
constexpr std::array kPalette{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000"};

std::string number(double value) {
  if (!std::isfinite(value)) return "NaN";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// A gnuplot string: single quotes are doubled, line ends become spaces.
std::string gnuplot_string(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return result + "'";
}

void require_drawable(const std::filesystem::path& base, const Plot& plot) {
  if (plot.series.empty()) throw Error::request("plot " + base.string() + ": there is nothing to draw");
  for (const Series& series : plot.series)
    if (series.x.size() != series.y.size() || series.x.empty())
      throw Error::request("plot " + base.string() + ": series \"" + series.label + "\" has " +
                           std::to_string(series.x.size()) + " x and " + std::to_string(series.y.size()) +
                           " y values; as many of both are needed, at least one");
}

std::string data_blocks(const Plot& plot) {
  std::string script;
  for (size_t i = 0; i < plot.series.size(); ++i) {
    script += "$series" + std::to_string(i) + " << END\n";
    for (size_t k = 0; k < plot.series[i].x.size(); ++k)
      script += number(plot.series[i].x[k]) + " " + number(plot.series[i].y[k]) + "\n";
    script += "END\n";
  }
  return script;
}

// A label: characters that gnuplot's enhanced text would take for markup are escaped.
std::string label_text(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    if (std::string_view("_^@&~{}\\").find(c) != std::string_view::npos) plain += '\\';
    plain += c;
  }
  return gnuplot_string(plain);
}

std::string axis_commands(const char* name, const Axis& axis) {
  std::string script = std::string("set ") + name + "label " + label_text(axis.label) + "\n";
  if (axis.logarithmic)
    script += std::string("set logscale ") + name + "\nset format " + name + " '10^{%L}'\n";
  if (axis.low != axis.high)
    script += std::string("set ") + name + "range [" + number(axis.low) + ":" + number(axis.high) + "]\n";
  return script;
}

std::string frame_commands(const Plot& plot) {
  std::string script =
      "set border 3 lw 1.2 lc rgb '#444444'\nset tics nomirror out scale 0.6\n"
      "set grid lc rgb '#DDDDDD' lw 0.8 lt 1, lc rgb '#EEEEEE' lw 0.5 lt 1\n"
      "set key outside right top vertical reverse Left samplen 2.5 spacing 1.25\nset datafile missing 'NaN'\n"
      "set lmargin 11\nset bmargin 4\n";
  script += "set title " + label_text(plot.title) + " font ',19' offset 0,0.3\n";
  if (plot.equal_scales) script += "set size ratio -1\n";
  return script + axis_commands("x", plot.x) + axis_commands("y", plot.y);
}

std::string style_words(Series::Style style, const std::string& color) {
  const std::string lines = " lw 2.2 lc rgb '" + color + "'", dots = " pt 7 ps 0.9";
  switch (style) {
    case Series::Style::points:
      return "points" + dots + " lc rgb '" + color + "'";
    case Series::Style::line_and_points:
      return "linespoints" + lines + dots;
    case Series::Style::dashed:
      return "lines dt 2" + lines;
    default:
      return "lines" + lines;
  }
}

std::string plot_command(const Plot& plot) {
  std::string script = "plot ";
  for (size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    const std::string name = series.label.empty() ? " notitle" : " title " + label_text(series.label);
    script += std::string(i ? ", " : "") + "$series" + std::to_string(i) + " using 1:2" + name + " with " +
              style_words(series.style, kPalette[i % kPalette.size()]);
  }
  return script + "\n";
}

std::string output_commands(const char* terminal, int width, int height, double letters,
                            const std::filesystem::path& file) {
  return std::string("set terminal ") + terminal + " enhanced size " + std::to_string(width) + "," +
         std::to_string(height) + " font 'DejaVu Sans," + number(letters) +
         "' background rgb 'white'\nset output " + gnuplot_string(file.string()) + "\n";
}

// The SVG gets the same page in its own units, so that both look alike.
std::string whole_script(const Plot& plot, const std::filesystem::path& png,
                         const std::filesystem::path& svg) {
  const std::string drawing = plot_command(plot);
  return "set encoding utf8\n" + data_blocks(plot) +
         output_commands("pngcairo", plot.width, plot.height, 15, png) + frame_commands(plot) + drawing +
         output_commands("svg", plot.width, plot.height, 15, svg) + drawing + "set output\n";
}

bool has_content(const std::string& file) {
  std::error_code error;
  return std::filesystem::file_size(file, error) > 0 && !error;
}

}  // namespace

void write_plot(const std::filesystem::path& base, const Plot& plot) {
  require_drawable(base, plot);
  AtomicFile png(base.string() + ".png"), svg(base.string() + ".svg");
  const ProcessResult result =
      run_process({"gnuplot", "-"}, whole_script(plot, png.temporary(), svg.temporary()));
  if (!result.started)
    throw Error::machine("plot " + base.string() + ": gnuplot cannot be started; install gnuplot-nox");
  if (result.exit_code != 0 || !has_content(png.temporary()) || !has_content(svg.temporary()))
    throw Error::machine("plot " + base.string() + ": gnuplot fails: " + result.first_error_line);
  png.commit();
  svg.commit();
}

}  // namespace hysteron::render
