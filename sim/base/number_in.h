// Numbers and their texts.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hysteron {

// Reads a number in C notation, whatever the locale; returns none unless all of the text is one.
std::optional<double> number_in(std::string_view text);

// How number_text() writes a number.
struct NumberForm {
  static constexpr int kShortest = -1;

  int digits = kShortest;      // significant digits, as printf's %g; kShortest: see number_text()
  int decimals = kShortest;    // digits behind the point, as printf's %f, in place of significant ones
  std::string_view unit = {};  // stands behind the number and a space
  bool thousands = false;      // true: commas group the digits before the point, "1,000"
};

// Writes a number; without a number of digits it is the shortest text that number_in() reads back as the same
// number: "0.1", "1e-300".
std::string number_text(double x, const NumberForm& form = {});
// Writes so many significant digits: number_text(0.00094, 2, "N") is "0.00094 N".
inline std::string number_text(double x, int digits, std::string_view unit = {}) {
  return number_text(x, {.digits = digits, .unit = unit});
}

// The form of a count: "1,000".
inline constexpr NumberForm kCount{.decimals = 0, .thousands = true};

// Puts a unit, if there is one, behind a number's or a range's text.
std::string with_unit(std::string text, std::string_view unit);

}  // namespace hysteron
