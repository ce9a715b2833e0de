#include "sim/scene/toml_file.h"

#include <algorithm>
#include <vector>

#define TOML_HEADER_ONLY 1
#define TOML_MAX_NESTED_VALUES 32  // its trees are destroyed by recursion
#include <toml++/toml.h>

#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"
#include "sim/scene/assets.h"

namespace hysteron {
namespace {

constexpr std::size_t kMaxTomlBytes = std::size_t{16} << 20;

// A file that is read, and the lists that may stand in it.
struct Source {
  const std::string& file;
  Lists lists;
};

ValueTree convert(const Source& from, const std::string& key, const toml::node& source);

int line_number(const toml::node& source) { return static_cast<int>(source.source().begin.line); }

bool all_numbers(const toml::array& array) {
  return std::all_of(array.begin(), array.end(), [](const toml::node& x) { return x.is_number(); });
}

// Refuses control characters: keys and texts stand in messages of one line, in captions and in file names.
void throw_if_control_characters(const std::string& text, const std::string& file, int line) {
  const auto is_control = [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7F; };
  if (std::none_of(text.begin(), text.end(), is_control)) return;
  throw Error::invalid_input("a key or a text holds a line break or another control character (" + file +
                             ":" + std::to_string(line) + ")");
}

Value convert_value(const std::string& file, const std::string& key, const toml::node& source) {
  if (const auto* x = source.as_boolean()) return x->get();
  if (const auto* x = source.as_integer()) return x->get();
  if (const auto* x = source.as_floating_point()) return x->get();
  if (const auto* x = source.as_string()) {
    throw_if_control_characters(x->get(), file, line_number(source));
    return x->get();
  }
  throw Error::invalid_input(key + " is a date or a mixed array (" + file + ":" +
                             std::to_string(line_number(source)) +
                             "); allowed are true, false, numbers, texts, arrays of numbers, tables");
}

ValueTree convert_array(const Source& from, const std::string& key, const toml::array& source) {
  ValueTree node{ValueTree::Kind::array, key, line_number(source), {}, {}};
  if (all_numbers(source) && !source.empty()) {
    node.kind = ValueTree::Kind::value;
    std::vector<double> numbers;
    for (const toml::node& element : source) numbers.push_back(*element.value<double>());
    node.value = numbers;
    return node;
  }
  const bool list =
      from.lists == Lists::allowed && (source.is_homogeneous<std::string>() || source.is_homogeneous<bool>());
  for (const toml::node& element : source) {
    if (!list && !element.is_table()) convert_value(from.file, key, source);
    node.children.push_back(convert(from, "", element));
  }
  return node;
}

ValueTree convert(const Source& from, const std::string& key, const toml::node& source) {
  if (const auto* array = source.as_array()) return convert_array(from, key, *array);
  ValueTree node{ValueTree::Kind::table, key, line_number(source), {}, {}};
  if (const auto* table = source.as_table()) {
    for (const auto& [name, child] : *table) {
      throw_if_control_characters(std::string(name.str()), from.file, line_number(child));
      node.children.push_back(convert(from, std::string(name.str()), child));
    }
    // The library sorts by name; messages should come in the file's order.
    std::stable_sort(node.children.begin(), node.children.end(),
                     [](const ValueTree& a, const ValueTree& b) { return a.line < b.line; });
    return node;
  }
  node.kind = ValueTree::Kind::value;
  node.value = convert_value(from.file, key, source);
  return node;
}

Error malformed(const std::string& why, const std::string& file, int line) {
  return Error::invalid_input("cannot read as TOML: " + why + " (" + file + ":" + std::to_string(line) + ")");
}

}  // namespace

ValueTree read_toml(const std::string& file, Lists lists) {
  const std::string text = utf8_text(whole_file(file, "cannot read " + file, kMaxTomlBytes));
  if (const std::optional<TomlFault> fault = fault_before_parsing(text))
    throw malformed(fault->what, file, fault->line);
  try {
    return convert({file, lists}, "", toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    std::string why(error.description());
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw malformed(why, file, static_cast<int>(error.source().begin.line));
  }
}

}  // namespace hysteron
