// Pieces of a self-contained HTML page.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hysteron::experiments {

// Text as HTML: & < > " escaped.
std::string escaped(const std::string& text);

// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);
// Its inverse, up to the padding or the first other character.
std::vector<std::uint8_t> from_base64(const std::string& text);

// An <img> with the picture inside.  `type`: "image/png", "image/svg+xml"; `words` stand for it where it
// cannot be seen.
std::string embedded_image(std::span<const std::uint8_t> bytes, const std::string& type,
                           const std::string& words);
// The same as a <figure> with a caption.
std::string embedded_picture(std::span<const std::uint8_t> bytes, const std::string& type,
                             const std::string& caption);

// Cells are text; columns in `numeric` are set right-aligned with tabular figures.
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric);

// The same of cells that are HTML; the head is text.
std::string html_table_of_html(const std::vector<std::string>& head,
                               const std::vector<std::vector<std::string>>& rows,
                               const std::vector<std::size_t>& numeric);

// A relative path as the target of a link: what is no letter, digit, /, -, _, . or ~ as %XX.
std::string url_of(const std::string& path);
std::string html_link(const std::string& target, const std::string& text);

// Folded away under a line that unfolds it.
std::string html_details(const std::string& summary, const std::string& body, bool open);

// A line through (x, y), scaled to its own extent, with the ends of both axes written.
std::string line_chart(const std::string& title, const std::vector<double>& x, const std::string& x_name,
                       const std::vector<double>& y);

std::string html_section(const std::string& title, const std::string& body);

// The whole document, with the style of report_style.h, and with its script where something plays or opens.
// `kind`: class of the body, "gallery" for many runs.
std::string html_page(const std::string& title, const std::string& body, const std::string& kind = "");

}  // namespace hysteron::experiments
