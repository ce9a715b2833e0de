#include "experiments/sweep/recorded_study.h"

#include <nlohmann/json.hpp>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

TomlNode value_node(const std::string& key, const std::string& text) {
  return {TomlNode::Kind::value, key, 0, text, {}};
}

TomlNode list_node(const std::string& key, const Json& texts) {
  TomlNode list{TomlNode::Kind::array, key, 0, {}, {}};
  for (const Json& text : texts) list.children.push_back(value_node("", text.get<std::string>()));
  return list;
}

// "fabric.k0=12", "param=stack=8".
TomlNode shared_node(const std::string& flag) {
  const std::size_t end = flag.find('=');
  const std::string key = flag.substr(0, end), value = flag.substr(end + 1);
  if (key != "param") return value_node(key, value);
  const std::size_t inner = value.find('=');
  return value_node("param." + value.substr(0, inner), value.substr(inner + 1));
}

TomlNode axis_node(const Json& axis) {
  TomlNode node;
  node.children = {value_node("key", axis.at("key")), list_node("values", axis.at("values"))};
  for (const char* more : {"scale", "sampled"})
    if (axis.contains(more)) node.children.push_back(value_node(more, axis.at(more)));
  return node;
}

TomlNode study_node(const Json& keys) {
  TomlNode root, scene{TomlNode::Kind::table, "scene", 0, {}, {}},
      axes{TomlNode::Kind::array, "axis", 0, {}, {}};
  for (const Json& flag : keys.at("shared")) scene.children.push_back(shared_node(flag));
  for (const Json& axis : keys.at("axes")) axes.children.push_back(axis_node(axis));
  root.children = {value_node("experiment", keys.at("experiment")), scene, axes};
  if (keys.contains("metrics")) root.children.push_back(list_node("metrics", keys.at("metrics")));
  return root;
}

}  // namespace

Json study_record(const Study& study) {
  Json shared = Json::array(), axes = Json::array();
  for (const Flag& flag : study.shared) shared.push_back(flag.path + "=" + flag.text);
  for (const StudyAxis& axis : study.axes) {
    axes.push_back({{"key", axis.key}, {"values", axis.values}});
    if (axis.logarithmic) axes.back()["scale"] = "log";
    if (axis.sampled) axes.back()["sampled"] = "latin";
  }
  Json keys = {{"study", study.name}, {"experiment", study.experiment}, {"shared", shared}, {"axes", axes}};
  if (!study.metrics.empty()) keys["metrics"] = study.metrics;
  return keys;
}

TomlNode recorded_study(const Manifest& manifest, const std::string& file) {
  try {
    if (manifest.experiment == "sweep" && manifest.keys) return study_node(*manifest.keys);
  } catch (const Json::exception&) {  // other keys, or others than texts
  }
  throw Error::invalid_input(file + " is not the manifest of a sweep").with_key("study", file);
}

}  // namespace hysteron::experiments
