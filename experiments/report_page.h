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

// An <img> with the picture inside.  `type`: "image/png", "image/svg+xml".
std::string embedded_picture(std::span<const std::uint8_t> bytes, const std::string& type,
                             const std::string& caption);

// Cells are text; columns in `numeric` are set right-aligned with tabular figures.
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows,
                       const std::vector<std::size_t>& numeric);

// A line through (x, y), scaled to its own extent, with the ends of both axes written.
std::string line_chart(const std::string& title, const std::vector<double>& x, const std::string& x_name,
                       const std::vector<double>& y);

std::string html_section(const std::string& title, const std::string& body);

// The whole document.
std::string html_page(const std::string& title, const std::string& body);

}  // namespace hysteron::experiments
