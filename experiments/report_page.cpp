#include "experiments/report_page.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace hysteron::experiments {
namespace {

constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1f24; --soft: #5d6670; --line: #d9dde2; --paper: #fff; --panel: #f5f6f8;
  --accent: #2f5d8c; --good: #1e7a46; --bad: #b3401f; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e8eb; --soft: #9aa3ad; --line: #333a42; --paper: #14171b;
  --panel: #1d2126; --accent: #8ab6e6; --good: #6fcf97; --bad: #f2936b; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 1080px; padding: 1.5rem 1rem 4rem; background: var(--paper); color: var(--ink);
  font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", sans-serif; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.1rem; margin: 2.2rem 0 .7rem; padding-bottom: .3rem; border-bottom: 1px solid var(--line); }
p.about { color: var(--soft); margin: 0 0 1rem; }
pre { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: .7rem .9rem; margin: 0;
  overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .85rem; }
.state { display: inline-block; border-radius: 99px; padding: .05rem .7rem; font-size: .8rem; color: var(--paper);
  vertical-align: middle; background: var(--good); } .state.bad { background: var(--bad); }
.cards { display: grid; gap: .7rem; grid-template-columns: repeat(auto-fill, minmax(170px, 1fr)); }
.card { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: .7rem .9rem; }
.card b { display: block; font-size: 1.35rem; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.card b small { font-size: .8rem; font-weight: 500; color: var(--soft); }
.card span { color: var(--soft); font-size: .82rem; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th { text-align: left; color: var(--soft); font-weight: 600; }
th, td { padding: .32rem .7rem .32rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th.n, td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 0 0 1rem; } figcaption { color: var(--soft); font-size: .82rem; margin-top: .25rem; }
img { max-width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); display: block; }
.plot img { background: #fff; }
.thumbs { display: grid; gap: .6rem; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); }
.charts { display: grid; gap: .8rem; grid-template-columns: repeat(auto-fill, minmax(300px, 1fr)); }
svg { width: 100%; height: auto; display: block; background: var(--panel); border-radius: 8px; }
svg polyline { fill: none; stroke: var(--accent); stroke-width: 1.6; stroke-linejoin: round; }
svg text { fill: var(--soft); font-size: 11px; } svg text.title { fill: var(--ink); font-size: 12.5px; }
@media print { body { max-width: none; padding: 0; font-size: 11pt; } h2 { break-after: avoid; }
  figure, .card, tr, svg { break-inside: avoid; } }
)css";

std::string short_number(double x) {
  std::ostringstream text;
  text << std::setprecision(4) << x;
  return text.str();
}

// `count` values out of a long series, the first and the last among them.
std::size_t sampled(std::size_t i, std::size_t count, std::size_t size) {
  return count < 2 ? 0 : i * (size - 1) / (count - 1);
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string html;
  for (char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  static const char* const kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? kLetters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string embedded_picture(std::span<const std::uint8_t> bytes, const std::string& type,
                             const std::string& caption) {
  return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:" + type + ";base64," + base64(bytes) +
         "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric) {
  const auto cells = [&](const std::vector<std::string>& texts, const std::string& tag) {
    std::string row = "<tr>";
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const bool right = std::count(numeric.begin(), numeric.end(), i) > 0;
      row += "<" + tag + (right ? " class=\"n\">" : ">") + escaped(texts[i]) + "</" + tag + ">";
    }
    return row + "</tr>\n";
  };
  std::string table = "<div class=\"scroll\"><table>\n<thead>" + cells(head, "th") + "</thead>\n<tbody>";
  for (const auto& row : rows) table += cells(row, "td");
  return table + "</tbody></table></div>\n";
}

std::string line_chart(const std::string& title, const std::vector<double>& x, const std::string& x_name,
                       const std::vector<double>& y) {
  constexpr double kLeft = 12, kTop = 40, kWidth = 396,
                   kHeight = 120;  // of the drawing, in a 420 x 190 picture
  constexpr std::size_t kMostPoints = 600;
  const auto [x_low, x_high] = std::minmax_element(x.begin(), x.end());
  const auto [y_low, y_high] = std::minmax_element(y.begin(), y.end());
  const double x_span = *x_high > *x_low ? *x_high - *x_low : 1,
               y_span = *y_high > *y_low ? *y_high - *y_low : 1;
  std::ostringstream svg;
  svg << std::fixed << std::setprecision(1)
      << "<svg viewBox=\"0 0 420 190\" role=\"img\"><text class=\"title\" x=\"" << kLeft << "\" y=\"18\">"
      << escaped(title) << "</text><polyline points=\"";
  const std::size_t count = std::min(kMostPoints, x.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = sampled(i, count, x.size());
    svg << kLeft + kWidth * (x[row] - *x_low) / x_span << ","
        << kTop + kHeight * (1 - (y[row] - *y_low) / y_span) << " ";
  }
  svg << "\"/><text x=\"" << kLeft << "\" y=\"34\">" << short_number(*y_high) << "</text><text x=\"" << kLeft
      << "\" y=\"172\">" << short_number(*y_low) << "</text><text x=\"408\" y=\"172\" text-anchor=\"end\">"
      << escaped(x_name) << " " << short_number(*x_low) << " … " << short_number(*x_high)
      << "</text></svg>\n";
  return svg.str();
}

std::string html_section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section><h2>" + escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string html_page(const std::string& title, const std::string& body) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + kStyle + "</style></head>\n<body>\n" + body +
         "</body></html>\n";
}

}  // namespace hysteron::experiments
