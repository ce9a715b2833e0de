// Numbers and their texts.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace hysteron {

// Reads a number in C notation, whatever the locale; returns none unless all of the text is one.
inline std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [remainder, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || remainder != end) return std::nullopt;
  return value;
}

// Writing numbers.

// Returns the shortest text that number_in() reads back as the same number: "0.1", "1e-300".
inline std::string number_text(double x) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}
// Returns the number with so many significant digits, as printf's %g writes it.
inline std::string number_text(double x, int digits) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, digits).ptr};
}

}  // namespace hysteron
