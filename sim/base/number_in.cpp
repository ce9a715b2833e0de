#include "sim/base/number_in.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace hysteron {
namespace {

// As many characters as the largest number has before its point, and what stands around them.
constexpr int kMostCharacters = std::numeric_limits<double>::max_exponent10 + 32;

void group_thousands(std::string& text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  const std::size_t end = std::min(text.find_first_not_of("0123456789", first), text.size());
  for (std::size_t at = end; at > first + 3;) text.insert(at -= 3, 1, ',');
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [remainder, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc() || remainder != end) return std::nullopt;
  return value;
}

std::string number_text(double x, const NumberForm& form) {
  char characters[kMostCharacters];
  char* const last = characters + sizeof characters;
  char* end = nullptr;
  if (form.decimals != NumberForm::kShortest)
    end = std::to_chars(characters, last, x, std::chars_format::fixed, form.decimals).ptr;
  else if (form.digits != NumberForm::kShortest)
    end = std::to_chars(characters, last, x, std::chars_format::general, form.digits).ptr;
  else
    end = std::to_chars(characters, last, x).ptr;
  std::string text(characters, end);
  if (form.thousands) group_thousands(text);
  return with_unit(std::move(text), form.unit);
}

std::string with_unit(std::string text, std::string_view unit) {
  return unit.empty() ? text : std::move(text.append(1, ' ').append(unit));
}

}  // namespace hysteron
