// This is the only file that includes the template engine.
#include "experiments/workbench/pages/page.h"

#include <algorithm>
#include <cctype>
#include <kainjow/mustache.hpp>
#include <map>
#include <stdexcept>
#include <string_view>

namespace hysteron::experiments {
namespace {

using kainjow::mustache::data;

data template_data(const Fields& fields) {
  data object;
  for (const auto& [name, value] : fields.items()) {
    if (value.is_string()) {
      if (value != "") object.set(name, value.get<std::string>());
    } else if (value.is_boolean()) {
      object.set(name, value.get<bool>());
    } else {
      kainjow::mustache::list list;
      for (const Fields& entry : value) list.push_back(template_data(entry));
      object.set(name, std::move(list));
    }
  }
  return object;
}

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string filled(const std::string& name, const Fields& fields) {
  kainjow::mustache::mustache engine(embedded_text(name));
  if (!engine.is_valid()) throw std::logic_error("template " + name + ": " + engine.error_message());
  engine.set_custom_escape(escaped);
  return engine.render(template_data(fields));
}

std::string embedded_text(const std::string& name) {
  const auto bytes = embedded_file(name);
  return {bytes.begin(), bytes.end()};
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> kEscaped = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string html;
  for (const char c : text) {
    const auto known = kEscaped.find(c);
    html += known == kEscaped.end() ? std::string(1, c) : known->second;
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

std::string html_figure(const std::string& image, const std::string& caption) {
  return filled("figure.html", {{"image", image}, {"caption", caption}});
}

std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric) {
  const auto row_cells = [&](const std::vector<std::string>& texts) {
    std::vector<Fields> cells;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const bool right = std::count(numeric.begin(), numeric.end(), i) > 0;
      cells.push_back({{"kind", right == (i > 0) ? "" : right ? "n" : "t"}, {"html", escaped(texts[i])}});
    }
    return cells;
  };
  std::vector<Fields> lines;
  for (const auto& row : rows) lines.push_back({{"cells", row_cells(row)}});
  return filled("table.html", {{"head", row_cells(head)}, {"rows", lines}});
}

std::string relative_url(const std::string& path) {
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
  return "<a href=\"" + relative_url(target) + "\">" + escaped(text) + "</a>";
}

std::string file_link(const std::string& target, const std::string& text, PageForm form) {
  return form == PageForm::linked ? html_link(target, text) : escaped(text);
}

std::string html_details(const std::string& summary, const std::string& body, bool open) {
  return filled("details.html", {{"summary", summary}, {"body", body}, {"open", open}});
}

std::string html_group(const std::string& kind, const std::string& content) {
  return content.empty() ? "" : filled("group.html", {{"kind", kind}, {"content", content}});
}

std::string html_about(const std::string& text) {
  return text.empty() ? "" : filled("about.html", {{"text", text}});
}

std::string html_section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : filled("section.html", {{"title", title}, {"body", body}});
}

std::string html_page(const std::string& title, const std::string& body, const std::string& kind) {
  const bool moves = body.find("class=\"player\"") != body.npos || body.find("class=\"zoom\"") != body.npos;
  const bool turns = body.find("class=\"turn\"") != body.npos;
  return filled("page.html", {{"title", title},
                              {"style", embedded_text("page.css")},
                              {"kind", kind},
                              {"body", body},
                              {"script", (moves ? embedded_text("page.js") : "") +
                                             (turns ? embedded_text("turn.js") : "")}});
}

}  // namespace hysteron::experiments
