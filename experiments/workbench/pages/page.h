// Builds pieces of an HTML page that needs no network, from the files in templates/
// (https://mustache.github.io/mustache.5.html), which the build embeds into the binary.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/image.h"

namespace hysteron::experiments {

// The values that fill a template, by name: {{text}} escaped or {{{html}}} as it is, {{#truth}} and {{#list}}
// for sections.  An empty text counts as absent.
using Fields = nlohmann::ordered_json;

// Returns the filled template of that file name, "table.html".  Throws std::logic_error if the file is no
// template.
std::string filled(const std::string& name, const Fields& fields);

// Returns a file of templates/ as it is; throws Error::system if the list in CMakeLists.txt lacks it.
std::span<const unsigned char> embedded_file(std::string_view name);
std::string embedded_text(const std::string& name);

// Escapes & < > " for HTML.
std::string escaped(const std::string& text);

enum class PageForm {
  linked,          // pictures are files beside the page
  self_contained,  // pictures are embedded and nothing leads to another file, so the page can be sent alone
};

// Encodes by RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

// Returns a figure of `image`, which is HTML, with a caption, which is text.
std::string html_figure(const std::string& image, const std::string& caption);

// Returns a table of text cells; columns in `numeric` are right-aligned with tabular figures.  By default all
// but the first are: only cells that differ from that carry a class, which makes a page of tables an eighth
// smaller.
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric);

// Encodes a relative path as the target of a link: characters other than letters, digits, /, -, _, . and ~
// become %XX.
std::string relative_url(const std::string& path);
std::string html_link(const std::string& target, const std::string& text);
// Returns a link to a file beside the page; only the text if the page is self-contained.
std::string file_link(const std::string& target, const std::string& text, PageForm form);

// Returns a section folded under a line that unfolds it.
std::string html_details(const std::string& summary, const std::string& body, bool open);

// Returns figures or charts beside each other, "grid", "charts"; `content` is HTML; "" without content.
std::string html_group(const std::string& kind, const std::string& content);
// Returns a paragraph on the origin of data; "" without text.
std::string html_about(const std::string& text);

std::string html_section(const std::string& title, const std::string& body);

// A part of every page's style, by which the program recognises it as its own.
inline constexpr const char* kOwnPage = "color-scheme: light dark; --ink";

// Returns the whole document, with style, and with the script if something plays or opens.  `kind` is the
// class of the body, "gallery" for many runs.
std::string html_page(const std::string& title, const std::string& body, const std::string& kind = "");

}  // namespace hysteron::experiments
