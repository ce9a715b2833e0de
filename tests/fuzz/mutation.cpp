#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <cctype>

namespace hysteron::fuzz {
namespace {

constexpr std::size_t kLongest = 64;  // [bytes] of a piece that is cut, moved or made up

// Where the number begins and ends that stands at or behind `at`; empty if there is none.
std::pair<std::size_t, std::size_t> number_at(const std::string& text, std::size_t at) {
  const auto of_number = [&](std::size_t i) {
    return i < text.size() && (std::isdigit(static_cast<unsigned char>(text[i])) || text[i] == '.');
  };
  while (at < text.size() && !of_number(at)) ++at;
  std::size_t end = at;
  while (of_number(end)) ++end;
  return {at, end};
}

}  // namespace

std::string Mutation::word() { return words_[below(words_.size())]; }

std::string Mutation::noise() {
  std::string bytes(1 + below(8), ' ');
  for (char& byte : bytes) byte = static_cast<char>(random_());
  return bytes;
}

void Mutation::change(std::string& text, const std::vector<std::string>& seeds) {
  const std::size_t at = below(text.size() + 1), length = std::min(below(kLongest), text.size() - at);
  switch (below(9)) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
      return;
    case 1:
      text.insert(at, noise());
      return;
    case 2:
      text.erase(at, length);
      return;
    case 3:
      text.insert(at, text.substr(at, length));
      return;
    case 4:
      text.insert(at, word());
      return;
    case 5:
      text.replace(at, length, word());
      return;
    case 6: {
      const std::string& other = seeds[below(seeds.size())];
      text.insert(at, other.substr(below(other.size() + 1), below(kLongest)));
      return;
    }
    case 7:
      if (below(4) == 0) text.resize(at);
      return;
    default:
      const auto [begin, end] = number_at(text, at);
      text.replace(begin, end - begin, word());
  }
}

std::string Mutation::of(const std::vector<std::string>& seeds) {
  std::string text = seeds[below(seeds.size())];
  for (std::size_t changes = 1 + below(1 + below(8)); changes > 0; --changes) change(text, seeds);
  return text;
}

}  // namespace hysteron::fuzz
