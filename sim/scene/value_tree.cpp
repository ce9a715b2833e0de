#include "sim/scene/value_tree.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/base/error.h"
#include "sim/scene/assets.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

bool all(const Json& array, bool (Json::*is)() const noexcept) {
  return std::all_of(array.begin(), array.end(), [&](const Json& x) { return (x.*is)(); });
}

// `path` is the key's full name for messages: "pin[0].low".
ValueTree converted(const Json& json, const std::string& key, const std::string& path,
                    const std::string& file, Lists lists) {
  using Kind = ValueTree::Kind;
  ValueTree node{Kind::value, key, 0, {}, {}};
  const auto add = [&](const Json& child, const std::string& name, const std::string& child_path) {
    node.children.push_back(converted(child, name, child_path, file, lists));
  };
  if (json.is_object()) {
    node.kind = Kind::table;
    for (const auto& [name, child] : json.items()) add(child, name, path.empty() ? name : path + "." + name);
  } else if (json.is_array() && !json.empty() && all(json, &Json::is_number)) {
    node.value = json.get<std::vector<double>>();
  } else if (json.is_array() &&
             (all(json, &Json::is_object) || (lists == Lists::allowed && all(json, &Json::is_string)))) {
    node.kind = Kind::array;
    for (std::size_t i = 0; i < json.size(); ++i) add(json[i], "", path + "[" + std::to_string(i) + "]");
  } else if (json.is_boolean()) {
    node.value = json.get<bool>();
  } else if (json.is_number_integer()) {
    node.value = json.get<std::int64_t>();
  } else if (json.is_number()) {
    node.value = json.get<double>();
  } else if (json.is_string()) {
    node.value = json.get<std::string>();
  } else {
    throw Error::invalid_input(path + " is no value (" + file + ")").with_key(path, "");
  }
  return node;
}

}  // namespace

const ValueTree* ValueTree::find(const std::string& name) const {
  for (const ValueTree& child : children) {
    if (child.key == name) return &child;
  }
  return nullptr;
}

std::optional<double> ValueTree::number() const {
  if (kind != Kind::value) return {};
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return {};
}

ValueTree json_tree(const Json& json, const std::string& file, Lists lists, const std::string& key) {
  return converted(json, key, key, file, lists);
}

const std::vector<ValueTree>& tables(const ValueTree& node, const std::string& file) {
  if (node.kind != ValueTree::Kind::array)
    throw Error::invalid_input(node.key + " must be an array of tables, [[" + node.key + "]] (" +
                               place(file, node) + ")");
  return node.children;
}

void assign(const Keys& keys, const ValueTree& node, const std::string& file, const std::string& prefix) {
  const std::string path = prefix + node.key, origin = place(file, node);
  const BoundKey& key = find_key(keys, path, origin);
  if (node.kind != ValueTree::Kind::value)
    throw Error::invalid_input(path + " must be one value (" + origin + ")");
  assign(key, node.value, origin);
}

std::string place(const std::string& file, const ValueTree& node) {
  return node.line > 0 ? asset_name(file) + ":" + std::to_string(node.line) : file;
}

}  // namespace hysteron
