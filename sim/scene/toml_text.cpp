#include "sim/scene/toml_text.h"

#include <algorithm>

namespace hysteron {
namespace {

// Behind the text that begins here with a quotation mark, "...", '...', or three of them.
std::size_t behind_text(std::string_view text, std::size_t at) {
  const char mark = text[at];
  const std::string_view three = mark == '"' ? R"(""")" : "'''";
  const std::string_view end = text.substr(at, 3) == three ? three : three.substr(0, 1);
  for (at += end.size(); at < text.size(); ++at) {
    if (mark == '"' && text[at] == '\\')
      ++at;
    else if (text.substr(at, end.size()) == end)
      return at + end.size();
    else if (end.size() == 1 && text[at] == '\n')
      return at;  // malformed, and the parser stops here
  }
  return text.size();
}

}  // namespace

int line_of_a_long_key(std::string_view text) {
  int line = 1, dots = 0;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t next = at + 1;
    if (c == '"' || c == '\'') next = behind_text(text, at);
    if (c == '#') next = std::min(text.find('\n', at), text.size());
    if (c == '.') ++dots;
    if (std::string_view("\n=,[]{}#").find(c) != std::string_view::npos) dots = 0;
    if (dots >= kMostKeyParts) return line;
    line += static_cast<int>(std::count(text.begin() + at, text.begin() + next, '\n'));
    at = next;
  }
  return 0;
}

}  // namespace hysteron
