// Pieces of an HTML page that needs no network, from the files in templates/
// (https://mustache.github.io/mustache.5.html), which the build puts into the binary.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

namespace hysteron::experiments {

// What a template is filled with, by name: {{text}} escaped or {{{html}}} as it is, {{#truth}} and {{#list}}
// for sections.  An empty text is one that is not there.
using Fields = nlohmann::ordered_json;

// The template of that file name, "table.html", filled.  std::logic_error if the file is no template.
std::string filled(const std::string& name, const Fields& fields);

// A file of templates/ as it is; Error::system if a list forgotten in CMakeLists.txt has left it out.
std::span<const unsigned char> embedded_file(std::string_view name);
std::string embedded_text(const std::string& name);

// Text as HTML: & < > " escaped.
std::string escaped(const std::string& text);

enum class PageForm {
  linked,          // pictures are files beside the page
  self_contained,  // pictures are inside and nothing leads to another file: the page can be sent alone
};

// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

// An image, which is HTML, with a caption, which is text.
std::string html_figure(const std::string& image, const std::string& caption);

// Cells are text; columns in `numeric` are set right-aligned with tabular figures.  Most are, but the first
// is not: only cells that differ from that carry a class, which makes a page of tables an eighth smaller.
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric);

// A relative path as the target of a link: what is no letter, digit, /, -, _, . or ~ as %XX.
std::string relative_url(const std::string& path);
std::string html_link(const std::string& target, const std::string& text);
// The same to a file beside the page; the text alone where the page is self-contained.
std::string file_link(const std::string& target, const std::string& text, PageForm form);

// Folded away under a line that unfolds it.
std::string html_details(const std::string& summary, const std::string& body, bool open);

// Figures or charts beside each other, "grid", "charts"; "" without content, which is HTML.
std::string html_group(const std::string& kind, const std::string& content);
// A paragraph of text on where things come from; "" without text.
std::string html_about(const std::string& text);

std::string html_section(const std::string& title, const std::string& body);

// What every page has in its style, by which the program knows it as its own.
inline constexpr const char* kOwnPage = "color-scheme: light dark; --ink";

// The whole document, with style, and with the script where something plays or opens.
// `kind`: class of the body, "gallery" for many runs.
std::string html_page(const std::string& title, const std::string& body, const std::string& kind = "");

}  // namespace hysteron::experiments
