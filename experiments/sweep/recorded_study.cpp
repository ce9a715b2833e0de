#include "experiments/sweep/recorded_study.h"

#include <nlohmann/json.hpp>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

// "fabric.k0=12", "param=stack=8".
ValueTree shared_node(std::string flag) {
  if (flag.starts_with("param=")) flag[5] = '.';
  const std::size_t end = flag.find('=');
  return {ValueTree::Kind::value, flag.substr(0, end), 0, flag.substr(end + 1), {}};
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

ValueTree recorded_study(const Manifest& manifest, const std::string& file) {
  for (const char* key : {"experiment", "shared", "axes"})
    if (manifest.experiment != "sweep" || !manifest.keys || !manifest.keys->contains(key))
      throw Error::invalid_input(file + " is not the manifest of a sweep").with_key("study", file);
  ValueTree root = json_tree(*manifest.keys, file, Lists::allowed);
  std::erase_if(root.children, [](const ValueTree& node) { return node.key == "study"; });
  for (ValueTree& node : root.children) {
    if (node.key == "axes") node.key = "axis";
    if (node.key != "shared") continue;
    node.key = "scene";
    node.kind = ValueTree::Kind::table;
    for (ValueTree& flag : node.children)
      if (const auto* text = std::get_if<std::string>(&flag.value)) flag = shared_node(*text);
  }
  return root;
}

}  // namespace hysteron::experiments
