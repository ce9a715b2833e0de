#include "sim/scene/fabric_reader.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"
#include "sim/scene/toml_file.h"

namespace hysteron {
namespace {

const std::vector<std::string> kConfidences = {"published", "fitted", "derived", "given", "assumed"};
const std::vector<std::string> kRequired = {"b1", "b2", "k0", "density", "thickness"};

struct Reader {
  std::string file;

  Error refusal(const std::string& what, const TomlNode& node) const {
    return Error::request(what + " (" + place(file, node) + ")");
  }

  void only_known(const TomlNode& table, const std::vector<std::string>& names) const {
    for (const TomlNode& child : table.children) {
      if (std::count(names.begin(), names.end(), child.key)) continue;
      const std::string nearest = nearest_name(child.key, names);
      throw refusal("unknown key " + child.key + (nearest.empty() ? "" : ", did you mean " + nearest + "?"),
                    child);
    }
  }

  const TomlNode& required(const TomlNode& table, const std::string& name) const {
    const TomlNode* node = table.find(name);
    if (!node) throw refusal((table.key.empty() ? "the fabric" : table.key) + " needs " + name, table);
    return *node;
  }

  std::string text(const TomlNode& table, const std::string& name) const {
    const TomlNode& node = required(table, name);
    const auto* words = std::get_if<std::string>(&node.value);
    if (node.kind != TomlNode::Kind::value || !words || words->empty())
      throw refusal(name + " must be a text", node);
    return *words;
  }

  double number(const TomlNode& table, const std::string& name) const {
    const TomlNode& node = required(table, name);
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    const auto* real = std::get_if<double>(&node.value);
    if (!integer && !real) throw refusal(table.key + "." + name + " must be a number", node);
    const double x = integer ? static_cast<double>(*integer) : *real;
    if (!std::isfinite(x)) throw refusal(table.key + "." + name + " must be finite", node);
    return x;
  }

  // {value = 1.157e-5, unit = "N m", source = "kes", confidence = "published"}
  PublishedNumber quantity(const TomlNode& node, const TomlNode* sources) const {
    if (node.kind != TomlNode::Kind::table) {
      throw refusal(node.key + " must be a table {value, unit, source, confidence}, stderr if known", node);
    }
    only_known(node, {"value", "unit", "source", "confidence", "stderr"});
    PublishedNumber number{this->number(node, "value"), "", {text(node, "source"), text(node, "confidence")}};
    if (node.find("unit")) number.unit = text(node, "unit");
    if (node.find("stderr")) {
      number.provenance.standard_error = this->number(node, "stderr");
      if (*number.provenance.standard_error < 0) throw refusal(node.key + ": stderr must be >= 0", node);
    }
    if (!std::count(kConfidences.begin(), kConfidences.end(), number.provenance.confidence)) {
      throw refusal(node.key + ": confidence = " + number.provenance.confidence + " must be " +
                        join(kConfidences, " | "),
                    node);
    }
    if (sources && sources->find(number.provenance.source)) {
      number.provenance.source = text(*sources, number.provenance.source);
    }
    return number;
  }
};

void read_parameter(const Reader& reader, const TomlNode& node, const TomlNode* sources, FabricFile& result) {
  Scene scene;
  scene.fabric = std::move(result.fabric);
  const std::string origin = place(reader.file, node);
  const Keys keys = bind_scene(scene);
  const BoundKey& key = find_key(keys, "fabric." + node.key, origin);
  const PublishedNumber number = reader.quantity(node, sources);
  if (number.unit != key.description.unit) {
    throw Error::request("fabric." + node.key + " has unit \"" + number.unit + "\" and must have \"" +
                         key.description.unit + "\" (" + origin + ")");
  }
  assign(key, number.value, origin);
  result.fabric = std::move(scene.fabric);
  result.fabric.provenance[node.key] = number.provenance;
  result.place[node.key] = origin;
}

// What the file leaves out keeps the program's default and says so.
void note_defaults(Fabric& fabric) {
  for (const KeyDescription& key : scene_keys()) {
    if (!key.path.starts_with("fabric.") || key.path == "fabric.name") continue;
    fabric.provenance.try_emplace(key.path.substr(7), Provenance{"the program's default", "assumed"});
  }
}

}  // namespace

FabricFile read_fabric(const std::string& name_or_file, const std::string& origin) {
  const Reader reader{find_asset("fabrics", name_or_file, origin).string()};
  const TomlNode root = read_toml(reader.file);
  reader.only_known(root, {"name", "description", "sources", "parameters", "published"});
  const TomlNode* sources = root.find("sources");
  const TomlNode& parameters = reader.required(root, "parameters");

  FabricFile result;
  result.fabric.name = reader.text(root, "name");
  result.description = reader.text(root, "description");
  for (const TomlNode& node : parameters.children) read_parameter(reader, node, sources, result);
  for (const std::string& name : kRequired) reader.required(parameters, name);
  if (const TomlNode* published = root.find("published")) {
    for (const TomlNode& node : published->children) {
      result.fabric.published[node.key] = reader.quantity(node, sources);
    }
  }
  note_defaults(result.fabric);
  return result;
}

std::vector<FabricFile> list_fabrics() {
  std::vector<FabricFile> fabrics;
  for (const std::string& name : list_assets("fabrics"))
    fabrics.push_back(read_fabric(name, "assets/fabrics"));
  return fabrics;
}

}  // namespace hysteron
