#include "sim/scene/recorded_scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/keys.h"

namespace hysteron {
namespace {

using Json = nlohmann::ordered_json;

Error malformed(const std::string& path, const std::string& what, const std::string& file) {
  return Error::invalid_input("scene." + path + " " + what + " (" + file + ")").with_key(path, "");
}

std::string string_at(const Json& json, const std::string& path, const std::string& file) {
  if (!json.is_string()) throw malformed(path, "must be a text", file);
  return json.get<std::string>();
}

class RecordedTree {
 public:
  RecordedTree(Scene& scene, const std::string& file)
      : scene_(scene), file_(file), known_(bind_scene(scene)) {}

  void read(const Json& tree) {
    scene_.fabric.kes = {};  // manifests of before do not know of it
    for (const auto& [name, value] : tree.items()) {
      if (name == "pin")
        read_tables(value, name, scene_.pin, bind_pin);
      else if (name == "obstacle")
        read_tables(value, name, scene_.obstacle, bind_obstacle);
      else if (name == "command")
        read_tables(value, name, scene_.command, bind_command);
      else if (name == "phase")
        read_tables(value, name, scene_.phase, bind_phase);
      else if (name == "param")
        scene_.param = texts(value, name);
      else if (name == "origin")
        scene_.origin = texts(value, name);
      else
        read_keys(value, name);
    }
  }

 private:
  void read_keys(const Json& value, const std::string& path) {
    if (path == "fabric.provenance") return read_provenance(value);
    if (path == "fabric.published") return read_published(value);
    if (!value.is_object())
      return assign(find_key(known_, path, file_), recorded_value(value, path, file_), file_);
    for (const auto& [name, entry] : value.items()) read_keys(entry, path + "." + name);
  }

  std::map<std::string, std::string> texts(const Json& entries, const std::string& path) const {
    if (!entries.is_object()) throw malformed(path, "must be an object", file_);
    std::map<std::string, std::string> all;
    for (const auto& [name, text] : entries.items()) all[name] = string_at(text, path + "." + name, file_);
    return all;
  }

  Provenance provenance(const Json& entry, const std::string& path) const {
    if (!entry.is_object() || !entry.contains("source") || !entry.contains("confidence"))
      throw malformed(path, "must have source and confidence", file_);
    return {string_at(entry["source"], path + ".source", file_),
            string_at(entry["confidence"], path + ".confidence", file_)};
  }

  void read_provenance(const Json& entries) {
    scene_.fabric.provenance.clear();
    for (const auto& [name, entry] : entries.items())
      scene_.fabric.provenance[name] = provenance(entry, "fabric.provenance." + name);
  }

  void read_published(const Json& entries) {
    scene_.fabric.published.clear();
    for (const auto& [name, entry] : entries.items()) {
      const std::string path = "fabric.published." + name;
      const Provenance from = provenance(entry, path);
      if (!entry.contains("value") || !entry["value"].is_number() || !entry.contains("unit"))
        throw malformed(path, "must have a value and its unit", file_);
      scene_.fabric.published[name] = {
          entry["value"].get<double>(), string_at(entry["unit"], path + ".unit", file_), from,
          entry.contains("tester") ? string_at(entry["tester"], path + ".tester", file_) : ""};
    }
  }

  template <class Item>
  void read_tables(const Json& tables, const std::string& name, std::vector<Item>& items,
                   Keys (*bind_one)(Item&)) const {
    if (!tables.is_array()) throw malformed(name, "must be a list", file_);
    items.assign(tables.size(), Item{});
    for (std::size_t i = 0; i < items.size(); ++i) {
      const std::string path = name + "[" + std::to_string(i) + "]";
      Json table = tables[i];
      if constexpr (requires { items[i].motion; }) {
        if (table.is_object() && table.contains("keys"))
          read_tables(table["keys"], path + ".keys", items[i].motion.keys, bind_keyframe);
        if (table.is_object()) table.erase("keys");
      }
      read_table(table, path, bind_one(items[i]));
    }
  }

  void read_table(const Json& table, const std::string& path, Keys keys) const {
    if (!table.is_object()) throw malformed(path, "must be an object", file_);
    for (BoundKey& key : keys) key.description.path = path + "." + key.description.path;
    for (const auto& [name, value] : table.items()) {
      const std::string full = path + "." + name;
      assign(find_key(keys, full, file_), recorded_value(value, full, file_), file_);
    }
  }

  Scene& scene_;
  const std::string& file_;
  Keys known_;
};

}  // namespace

Value recorded_value(const nlohmann::ordered_json& json, const std::string& path, const std::string& file) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_array() && std::all_of(json.begin(), json.end(), [](const Json& x) { return x.is_number(); }))
    return json.get<std::vector<double>>();
  throw malformed(path, "is no value", file);
}

void apply_recorded_scene(Scene& scene, const nlohmann::ordered_json& tree, const std::string& file) {
  RecordedTree(scene, file).read(tree);
}

}  // namespace hysteron
