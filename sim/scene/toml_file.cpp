#include "sim/scene/toml_file.h"

#include <algorithm>
#include <vector>

namespace hysteron {
namespace {

// An assertion of the library that failed.
struct BrokenAssertion {};
[[noreturn]] void break_off() { throw BrokenAssertion(); }

}  // namespace
}  // namespace hysteron

// The library's parser asserts what a malformed file can violate ("[#]"), where it must not abort, and not go
// on either.  It takes this definition only without NDEBUG.
#undef NDEBUG
#define TOML_ASSERT(expression) ((expression) ? void() : hysteron::break_off())
#define TOML_HEADER_ONLY 1
#define TOML_MAX_NESTED_VALUES 32  // its trees are taken down by recursion
#include <toml++/toml.h>

#include "sim/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/toml_text.h"
#include "sim/whole_file.h"

namespace hysteron {
namespace {

constexpr std::size_t kMostTomlBytes = std::size_t{16} << 20;

TomlNode convert(const std::string& file, const std::string& key, const toml::node& source);

int line_of(const toml::node& source) { return static_cast<int>(source.source().begin.line); }

bool all_numbers(const toml::array& array) {
  return std::all_of(array.begin(), array.end(), [](const toml::node& x) { return x.is_number(); });
}

// Keys and texts stand in messages of one line, in captions and in names of files.
void refuse_control_characters(const std::string& text, const std::string& file, int line) {
  const auto is_control = [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7F; };
  if (std::none_of(text.begin(), text.end(), is_control)) return;
  throw Error::request("a key or a text holds a line break or another control character (" + file + ":" +
                       std::to_string(line) + ")");
}

Value convert_value(const std::string& file, const std::string& key, const toml::node& source) {
  if (const auto* x = source.as_boolean()) return x->get();
  if (const auto* x = source.as_integer()) return x->get();
  if (const auto* x = source.as_floating_point()) return x->get();
  if (const auto* x = source.as_string()) {
    refuse_control_characters(x->get(), file, line_of(source));
    return x->get();
  }
  throw Error::request(key + " is a date or a mixed array (" + file + ":" + std::to_string(line_of(source)) +
                       "); allowed are true, false, numbers, texts, arrays of numbers, tables");
}

TomlNode convert_array(const std::string& file, const std::string& key, const toml::array& source) {
  TomlNode node{TomlNode::Kind::array, key, line_of(source), {}, {}};
  if (all_numbers(source) && !source.empty()) {
    node.kind = TomlNode::Kind::value;
    std::vector<double> numbers;
    for (const toml::node& element : source) numbers.push_back(*element.value<double>());
    node.value = numbers;
    return node;
  }
  for (const toml::node& element : source) {
    if (!element.is_table()) convert_value(file, key, source);
    node.children.push_back(convert(file, "", element));
  }
  return node;
}

TomlNode convert(const std::string& file, const std::string& key, const toml::node& source) {
  if (const auto* array = source.as_array()) return convert_array(file, key, *array);
  TomlNode node{TomlNode::Kind::table, key, line_of(source), {}, {}};
  if (const auto* table = source.as_table()) {
    for (const auto& [name, child] : *table) {
      refuse_control_characters(std::string(name.str()), file, line_of(child));
      node.children.push_back(convert(file, std::string(name.str()), child));
    }
    // The library sorts by name; messages should come in reading order.
    std::stable_sort(node.children.begin(), node.children.end(),
                     [](const TomlNode& a, const TomlNode& b) { return a.line < b.line; });
    return node;
  }
  node.kind = TomlNode::Kind::value;
  node.value = convert_value(file, key, source);
  return node;
}

toml::table parse(std::string_view text, const std::string& file) { return toml::parse(text, file); }

// Whether the beginning of a file breaks an assertion; whatever else is wrong with it is the parser's to say.
bool breaks(std::string_view text, const std::string& file) {
  try {
    parse(text, file);
  } catch (const toml::parse_error&) {
  } catch (const BrokenAssertion&) {
    return true;
  }
  return false;
}

// An assertion does not say where: the first line with which the file breaks one.
int broken_line(std::string_view text, const std::string& file) {
  std::vector<std::size_t> ends;
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) ends.push_back(at);
  const auto whole = [&](std::size_t end) { return !breaks(text.substr(0, end + 1), file); };
  return 1 + static_cast<int>(std::partition_point(ends.begin(), ends.end(), whole) - ends.begin());
}

Error malformed(const std::string& why, const std::string& file, int line) {
  return Error::request("cannot read as TOML: " + why + " (" + file + ":" + std::to_string(line) + ")");
}

}  // namespace

const TomlNode* TomlNode::find(const std::string& name) const {
  for (const TomlNode& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

TomlNode read_toml(const std::string& file) {
  const std::string text = whole_file(file, "cannot read " + file, kMostTomlBytes);
  if (const int line = line_of_a_long_key(text))
    throw malformed("a key has more than " + std::to_string(kMostKeyParts) + " parts", file, line);
  try {
    return convert(file, "", parse(text, file));
  } catch (const toml::parse_error& error) {
    std::string why(error.description());
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw malformed(why, file, static_cast<int>(error.source().begin.line));
  } catch (const BrokenAssertion&) {
    throw malformed("a bracket, a key or a value is malformed", file, broken_line(text, file));
  }
}

std::string place(const std::string& file, const TomlNode& node) {
  return asset_name(file) + ":" + std::to_string(node.line);
}

}  // namespace hysteron
