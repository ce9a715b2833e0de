#include "experiments/workbench/pages/page.h"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <sstream>
#include <string_view>

#include "experiments/workbench/pages/style.h"

namespace hysteron::experiments {
namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

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

std::string embedded_image(std::span<const std::uint8_t> bytes, const std::string& type,
                           const std::string& words) {
  return "<img alt=\"" + escaped(words) + "\" src=\"data:" + type + ";base64," + base64(bytes) + "\">";
}

std::string linked_image(const std::string& path, const render::ImageSize& size, const std::string& words) {
  const std::string place =
      size == render::ImageSize{}
          ? ""
          : " width=\"" + std::to_string(size.width) + "\" height=\"" + std::to_string(size.height) + "\"";
  return "<img loading=\"lazy\"" + place + " alt=\"" + escaped(words) + "\" src=\"" + url_of(path) + "\">";
}

std::string html_figure(const std::string& image, const std::string& caption) {
  return "<figure>" + image + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string embedded_picture(std::span<const std::uint8_t> bytes, const std::string& type,
                             const std::string& caption) {
  return html_figure(embedded_image(bytes, type, caption), caption);
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric) {
  std::vector<std::vector<std::string>> cells = rows;
  for (auto& row : cells) std::transform(row.begin(), row.end(), row.begin(), escaped);
  return html_table_of_html(head, cells, numeric);
}

std::string html_table_of_html(const std::vector<std::string>& head,
                               const std::vector<std::vector<std::string>>& rows,
                               const std::vector<std::size_t>& numeric) {
  const auto line = [&](const std::vector<std::string>& cells, const std::string& tag) {
    std::string row = "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool right = std::count(numeric.begin(), numeric.end(), i) > 0;
      const char* kind = right == (i > 0) ? ">" : right ? " class=\"n\">" : " class=\"t\">";
      row += "<" + tag + kind + cells[i] + "</" + tag + ">";
    }
    return row + "</tr>\n";
  };
  std::vector<std::string> names = head;
  std::transform(names.begin(), names.end(), names.begin(), escaped);
  std::string table = "<div class=\"scroll\"><table>\n<thead>" + line(names, "th") + "</thead>\n<tbody>";
  for (const auto& row : rows) table += line(row, "td");
  return table + "</tbody></table></div>\n";
}

std::string url_of(const std::string& path) {
  static const char* const kDigits = "0123456789ABCDEF";
  std::string url;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 128 && (std::isalnum(byte) || std::string("/-_.~").find(c) != std::string::npos);
    url += plain ? std::string(1, c) : std::string("%") + kDigits[byte >> 4] + kDigits[byte & 15];
  }
  return url;
}

std::string html_link(const std::string& target, const std::string& text) {
  return "<a href=\"" + url_of(target) + "\">" + escaped(text) + "</a>";
}

std::string file_link(const std::string& target, const std::string& text, PageForm form) {
  return form == PageForm::linked ? html_link(target, text) : escaped(text);
}

std::string html_details(const std::string& summary, const std::string& body, bool open) {
  return "<details" + std::string(open ? " open" : "") + "><summary>" + escaped(summary) + "</summary>\n" +
         body + "</details>\n";
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

std::string html_page(const std::string& title, const std::string& body, const std::string& kind) {
  const bool moves = body.find("class=\"player\"") != body.npos || body.find("class=\"zoom\"") != body.npos;
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(title) + "</title>\n<style>" + page_style() + "</style></head>\n<body" +
         (kind.empty() ? "" : " class=\"" + kind + "\"") + ">\n" + body +
         (moves ? std::string("<script>") + page_script() + "</script>\n" : "") + "</body></html>\n";
}

}  // namespace hysteron::experiments
