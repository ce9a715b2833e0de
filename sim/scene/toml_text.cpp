// Checks a TOML text before it is parsed.
#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "sim/scene/toml_file.h"

namespace hysteron {
namespace {

// Returns the position behind the text in quotation marks that begins here, "...", '...', or three of them;
// then up to two more marks at its end belong to it.
std::size_t behind_text(std::string_view text, std::size_t at) {
  const char mark = text[at];
  const std::string three(3, mark), end = text.substr(at, 3) == three ? three : three.substr(0, 1);
  for (at += end.size(); at < text.size(); ++at) {
    if (mark == '"' && text[at] == '\\') {
      ++at;
    } else if (text.substr(at, end.size()) == end) {
      at += end.size();
      for (int more = 0; end == three && more < 2 && at < text.size() && text[at] == mark; ++more) ++at;
      return at;
    } else if (end != three && text[at] == '\n') {
      return at;  // malformed, and the parser stops here
    }
  }
  return text.size();
}

bool is_beyond_ascii(char c) { return static_cast<unsigned char>(c) >= 0x80; }

bool is_among(char c, std::string_view characters) { return characters.find(c) != characters.npos; }

// Is a backslash of this text in quotation marks followed, but for white space, by a letter beyond ASCII?
bool has_letter_behind_backslash(std::string_view text) {
  if (text[0] != '"') return false;
  for (std::size_t at = text.find('\\'); at != text.npos; at = text.find('\\', at + 2)) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", at + 1);
    if (next != text.npos && is_beyond_ascii(text[next])) return true;
  }
  return false;
}

// Reads the characters outside of texts and comments in order; of each text it sees the first quotation mark
// alone.
class Structure {
 public:
  // Returns what is wrong at this character; empty: nothing so far.
  std::string see(char c, int line) {
    const char before = std::exchange(before_, c);
    if (before == '\r' && c != '\n') return "a carriage return stands without a line feed";
    if (is_among(c, " \t\r#")) return {};
    if (c == '\n') return end_line();
    if (is_beyond_ascii(c)) return "a letter beyond ASCII stands outside of a text: a key is malformed";
    if (header_ == Header::over) return "something stands behind a header in brackets: it is malformed";
    if (is_among(c, "\"'") && !may_stand_before_a_text(before)) return "a key or a value is malformed";
    if (c == '[' && open_.empty() && is_first_in_line_) header_ = Header::opens;
    is_first_in_line_ = false;
    if (header_ != Header::none && !continues_header(c)) return "a header in brackets is malformed";
    return take(c, line);
  }

  // Returns a bracket that is still open where the text ends.
  std::optional<TomlFault> fault_at_end() const {
    if (open_.empty()) return {};
    return TomlFault{open_.back().line, "a bracket is not closed: a list, a table or a header is malformed"};
  }

 private:
  struct Bracket {
    char character;
    int line;
  };
  enum class Header { none, opens, has_key, closes, over };  // "[[", "[[a.b", "[[a.b]", "[[a.b]]"

  bool may_stand_before_a_text(char c) const {
    return is_among(c, " \t\r\n=[{,") || (c == '.' && !in_value_);
  }

  bool continues_header(char c) {
    if (c == '[') return header_ == Header::opens && open_.size() < 2;
    if (c == ']') return header_ == Header::has_key || header_ == Header::closes;
    if (header_ == Header::closes || (c == '.' && header_ == Header::opens)) return false;
    header_ = Header::has_key;
    return std::isalnum(static_cast<unsigned char>(c)) || is_among(c, "_-.\"'");
  }

  std::string take(char c, int line) {
    if (is_among(c, "=,[]{}")) dots_ = 0;
    if (c == '.' && ++dots_ >= kMaxKeyParts)
      return "a key has more than " + std::to_string(kMaxKeyParts) + " parts";
    if (c == '=' && std::exchange(in_value_, true)) return "a value holds an equals sign";
    if (is_among(c, "[{")) open_.push_back({c, line});
    if (is_among(c, "]}")) return close(c);
    if (c == '{' || (c == ',' && !open_.empty() && open_.back().character == '{')) in_value_ = false;
    return {};
  }

  std::string close(char c) {
    if (open_.empty() || open_.back().character != (c == ']' ? '[' : '{'))
      return "a bracket closes what is not open: a list, a table or a header is malformed";
    open_.pop_back();
    in_value_ = true;
    if (header_ != Header::none) header_ = open_.empty() ? Header::over : Header::closes;
    return {};
  }

  std::string end_line() {
    if (header_ != Header::none && header_ != Header::over)
      return "a header in brackets is malformed: it ends in its line";
    header_ = Header::none;
    dots_ = 0;
    is_first_in_line_ = true;
    if (open_.empty()) in_value_ = false;
    return {};
  }

  std::vector<Bracket> open_;
  Header header_ = Header::none;
  char before_ = '\n';
  int dots_ = 0;
  bool is_first_in_line_ = true, in_value_ = false;
};

}  // namespace

std::optional<TomlFault> fault_before_parsing(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  Structure structure;
  int line = 1;
  for (std::size_t at = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0; at < text.size();) {
    const char c = text[at];
    std::size_t next = at + 1;
    if (c == '"' || c == '\'') next = behind_text(text, at);
    if (c == '#') next = std::min(text.find('\n', at), text.size());
    if (std::string what = structure.see(c, line); !what.empty()) return TomlFault{line, std::move(what)};
    if (is_among(c, "\"'") && has_letter_behind_backslash(text.substr(at, next - at)))
      return TomlFault{line, "a text is malformed: behind a backslash stands a letter beyond ASCII"};
    line += static_cast<int>(std::count(text.begin() + at, text.begin() + next, '\n'));
    at = next;
  }
  return structure.fault_at_end();
}

}  // namespace hysteron
