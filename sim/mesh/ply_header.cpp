#include "sim/mesh/ply_header.h"

#include <charconv>
#include <sstream>
#include <utility>

#include "sim/base/error.h"

namespace hysteron {

std::size_t type_bytes(std::string_view type) {
  static const std::pair<std::string_view, std::size_t> kTypes[] = {
      {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
      {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
      {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  for (const auto& [name, bytes] : kTypes)
    if (name == type) return bytes;
  return 0;
}

namespace {

// Returns the fewest bytes of one item: an ASCII number takes a digit and a separator, a list may be empty.
std::size_t least_bytes(const PlyElement& element, bool ascii) {
  std::size_t sum = 0;
  for (const PlyProperty& p : element.property)
    sum += ascii ? 2 : type_bytes(p.is_list() ? p.count_type : p.type);
  return sum;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& what) : text_(text), what_(what) {}

  PlyHeader read() {
    if (next_line() != std::vector<std::string>{"ply"}) throw bad("a PLY file begins with \"ply\"");
    read_format(next_line());
    for (std::vector<std::string> word = next_line(); word != std::vector<std::string>{"end_header"};
         word = next_line()) {
      if (word.empty()) throw bad("an empty line in the header");
      if (word[0] == "element")
        read_element(word);
      else if (word[0] == "property")
        read_property(word);
      else if (word[0] != "comment" && word[0] != "obj_info")
        throw bad("\"" + word[0] +
                  "\" is unknown; allowed: element, property, comment, obj_info, end_header");
    }
    header_.bytes = at_;
    for (const PlyElement& element : header_.element) check_room(element);
    return header_;
  }

 private:
  Error bad(const std::string& problem) const {
    return Error::invalid_input(what_ + ": line " + std::to_string(line_) + ": " + problem);
  }

  std::vector<std::string> next_line() {
    ++line_;
    const std::size_t end = text_.find('\n', at_);
    if (end == text_.npos) throw bad("the header has no end_header");
    std::istringstream words{std::string(text_.substr(at_, end - at_))};
    at_ = end + 1;
    std::vector<std::string> found;
    for (std::string word; words >> word;) found.push_back(word);
    return found;
  }

  void read_format(const std::vector<std::string>& word) {
    const bool known =
        word.size() == 3 && word[0] == "format" &&
        (word[1] == "ascii" || word[1] == "binary_little_endian" || word[1] == "binary_big_endian");
    if (!known)
      throw bad("needs \"format\" with ascii, binary_little_endian or binary_big_endian, and a version");
    header_.ascii = word[1] == "ascii";
    header_.big_endian = word[1] == "binary_big_endian";
  }

  void read_element(const std::vector<std::string>& word) {
    if (word.size() != 3) throw bad("an element needs a name and a number");
    std::size_t count = 0;
    const char* const end = word[2].data() + word[2].size();
    const auto [parse_end, code] = std::from_chars(word[2].data(), end, count);
    if (code != std::errc() || parse_end != end) throw bad("\"" + word[2] + "\" is no number of elements");
    header_.element.push_back({word[1], count, line_, {}});
  }

  void read_property(const std::vector<std::string>& word) {
    const bool list = word.size() == 5 && word[1] == "list";
    if (!list && word.size() != 3) throw bad("a property needs a type and a name, a list two types");
    if (header_.element.empty()) throw bad("a property before the first element");
    PlyProperty property{word.back(), word[word.size() - 2], list ? word[2] : ""};
    for (const std::string& type : {property.type, property.count_type})
      if (!type.empty() && type_bytes(type) == 0) throw bad("the type \"" + type + "\" is unknown");
    const bool counts = type_bytes(property.count_type) <= 4 && !property.count_type.starts_with("float");
    if (list && !counts) throw bad("a list counts its items in integers");
    header_.element.back().property.push_back(std::move(property));
  }

  // Checks that the file can hold the elements, before anything is allocated for them.
  void check_room(const PlyElement& element) const {
    const std::size_t least = least_bytes(element, header_.ascii), left = text_.size() - at_ + 1;
    if (element.count == 0 || (least > 0 && element.count <= left / least)) return;
    throw Error::invalid_input(what_ + ": line " + std::to_string(element.line) +
                               ": the file is too short for " + std::to_string(element.count) +
                               " items of \"" + element.name + "\"");
  }

  std::string_view text_;
  const std::string& what_;
  PlyHeader header_;
  std::size_t at_ = 0;
  int line_ = 0;
};

}  // namespace

PlyHeader read_ply_header(std::string_view text, const std::string& what) {
  return HeaderReader(text, what).read();
}

}  // namespace hysteron
