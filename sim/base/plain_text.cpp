#include "sim/base/plain_text.h"

#include <cctype>
#include <cstdint>
#include <utility>

namespace hysteron {
namespace {

void append_utf8(std::uint32_t code, std::string& text) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  const auto add_rest = [&](int bytes) {
    while (bytes-- > 0) add(0x80 | (code >> 6 * bytes & 0x3F));
  };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | code >> 6);
    add_rest(1);
  } else if (code < 0x10000) {
    add(0xE0 | code >> 12);
    add_rest(2);
  } else {
    add(0xF0 | code >> 18);
    add_rest(3);
  }
}

bool is_high_surrogate(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_surrogate(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

// Converts the text behind the byte order mark.  An unpaired surrogate becomes the replacement character.
std::string from_utf16(std::string_view bytes, bool big_endian) {
  constexpr std::uint32_t kReplacement = 0xFFFD;
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<unsigned char>(bytes[at]),
               second = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<std::uint32_t>(big_endian ? first << 8 | second : second << 8 | first);
  };
  std::string text;
  for (std::size_t at = 2; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (is_high_surrogate(code) && at + 3 < bytes.size() && is_low_surrogate(unit(at + 2))) {
      code = 0x10000 + ((code - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
      at += 2;
    } else if (is_high_surrogate(code) || is_low_surrogate(code)) {
      code = kReplacement;
    }
    append_utf8(code, text);
  }
  return text;
}

// Returns how many bytes follow the first one of a character; -1 if no character begins with this byte.
int bytes_that_follow(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  return first >= 0xF0 && first < 0xF5 ? 3 : -1;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    int rest = bytes_that_follow(static_cast<unsigned char>(text[at]));
    if (rest < 0) return false;
    for (; rest > 0; --rest)
      if (++at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0) != 0x80) return false;
  }
  return true;
}

std::string from_latin1(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) append_utf8(static_cast<unsigned char>(c), text);
  return text;
}

using Replacement = std::pair<std::string_view, std::string_view>;

// Returns the replacement whose first text begins here, or null.
template <std::size_t N>
const Replacement* replacement_at(const Replacement (&all)[N], std::string_view text, std::size_t at) {
  for (const Replacement& one : all)
    if (text.compare(at, one.first.size(), one.first) == 0) return &one;
  return nullptr;
}

template <std::size_t N>
std::string with_replacements(const Replacement (&all)[N], std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const Replacement* const found = replacement_at(all, text, at);
    result += found ? found->second : text.substr(at, 1);
    at += found ? found->first.size() : 1;
  }
  return result;
}

constexpr Replacement kPlain[] = {
    {"\r\n", "\n"},        {"\r", "\n"}, {"\xC2\xA0", " "},  // no-break space
    {"\xE2\x80\x87", " "},                                   // figure space
    {"\xE2\x80\x89", " "},                                   // thin space
    {"\xE2\x80\xAF", " "},                                   // narrow no-break space
};

constexpr Replacement kSigns[] = {
    {"\xC2\xB7", " "},      // middle dot
    {"\xE2\x8B\x85", " "},  // dot operator
    {"\xC3\x97", " "},      // multiplication sign
    {"*", " "},
    {"\xC2\xB5", "u"},               // micro sign
    {"\xCE\xBC", "u"},               // mu
    {"\xE2\x81\xBB\xC2\xB9", "-1"},  // superscript -1
    {"\xC2\xB2", "2"},               // superscripts
    {"\xC2\xB3", "3"},
    {"\xE2\x88\x92", "-"},  // minus sign
    {"^", ""},
};

constexpr Replacement kSameUnits[] = {
    {"1", ""}, {"-", ""}, {"m-1", "1/m"}, {"cm-1", "1/cm"}, {"Nm", "N m"}, {"N m/m", "N"}, {"Nm/m", "N"},
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// Is true for the dot between letters of "gf.cm/cm", not for that of "0.1 N".
bool is_dot_of_product(std::string_view text, std::size_t at) {
  return text[at] == '.' && at > 0 && at + 1 < text.size() && is_letter(text[at - 1]) &&
         is_letter(text[at + 1]);
}

// Leaves one space between words, none at the ends and beside a slash.
std::string with_single_spaces(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = is_dot_of_product(text, at) ? ' ' : text[at];
    const bool needless = result.empty() || result.back() == ' ' || result.back() == '/';
    if (c == ' ' && needless) continue;
    if (c == '/' && !result.empty() && result.back() == ' ') result.pop_back();
    result += c;
  }
  return std::string(trimmed(result));
}

}  // namespace

std::string utf8_text(std::string bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return bytes.substr(3);
  const bool little = bytes.starts_with("\xFF\xFE"), big = bytes.starts_with("\xFE\xFF");
  return little || big ? from_utf16(bytes, big) : std::move(bytes);
}

std::string plain_text(std::string bytes) {
  std::string text = utf8_text(std::move(bytes));
  if (!is_utf8(text)) text = from_latin1(text);
  const auto is_plain = [](char c) { return c != '\r' && static_cast<unsigned char>(c) < 0x80; };
  for (const char c : text)
    if (!is_plain(c)) return with_replacements(kPlain, text);
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::string plain_unit(std::string_view unit) {
  std::string plain = with_single_spaces(with_replacements(kSigns, unit));
  for (const auto& [written, same] : kSameUnits)
    if (plain == written) return std::string(same);
  return plain;
}

}  // namespace hysteron
