#include "sim/scene/toml_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include "sim/error.h"
#include "sim/scene/assets.h"

namespace hysteron {
namespace {

TomlNode convert(const std::string& file, const std::string& key, const toml::node& source);

int line_of(const toml::node& source) { return static_cast<int>(source.source().begin.line); }

bool all_numbers(const toml::array& array) {
  return std::all_of(array.begin(), array.end(), [](const toml::node& x) { return x.is_number(); });
}

Value convert_value(const std::string& file, const std::string& key, const toml::node& source) {
  if (const auto* x = source.as_boolean()) return x->get();
  if (const auto* x = source.as_integer()) return x->get();
  if (const auto* x = source.as_floating_point()) return x->get();
  if (const auto* x = source.as_string()) return x->get();
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
    for (const auto& [name, child] : *table)
      node.children.push_back(convert(file, std::string(name.str()), child));
    // The library sorts by name; messages should come in reading order.
    std::stable_sort(node.children.begin(), node.children.end(),
                     [](const TomlNode& a, const TomlNode& b) { return a.line < b.line; });
    return node;
  }
  node.kind = TomlNode::Kind::value;
  node.value = convert_value(file, key, source);
  return node;
}

std::string read_text(const std::string& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    throw Error::machine("cannot read " + file + ": " + std::strerror(errno ? errno : EIO));
  }
  return text;
}

}  // namespace

const TomlNode* TomlNode::find(const std::string& name) const {
  for (const TomlNode& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

TomlNode read_toml(const std::string& file) {
  const std::string text = read_text(file);
  try {
    return convert(file, "", toml::parse(text, file));
  } catch (const toml::parse_error& error) {
    std::string why(error.description());
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw Error::request("cannot read as TOML: " + why + " (" + file + ":" +
                         std::to_string(error.source().begin.line) + ")");
  }
}

std::string place(const std::string& file, const TomlNode& node) {
  return asset_name(file) + ":" + std::to_string(node.line);
}

}  // namespace hysteron
