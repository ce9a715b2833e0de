#include "sim/scene/fabric_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "sim/base/error.h"
#include "sim/base/units.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_limits.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"
#include "sim/scene/toml_file.h"

namespace hysteron {
namespace {

const std::vector<std::string> kConfidences = {"published", "fitted", "derived", "given", "assumed"};
const std::vector<std::string> kRequired = {"b1", "b2", "k0", "density", "thickness"};
const std::vector<std::string> kRequiredOfShaped = {"kes-b", "kes-2hb", "stops-spread", "density",
                                                    "thickness"};
const std::vector<std::string> kRequiredOfPair = {"kes-b", "kes-2hb", "k0", "density", "thickness"};
const std::vector<std::string> kSaidByStops = {"b1", "k0"};
const std::vector<std::string> kTables = {"name",    "description", "sources",   "parameters",
                                          "bending", "membrane",    "published", "look"};
constexpr const char* kPartTables[] = {"bending", "membrane"};
constexpr const char* kOptional[] = {"fabric.bending.", "fabric.membrane.",     "fabric.kes-",
                                     "fabric.stops-",   "fabric.weft-friction", "fabric.back-"};

bool is_parameter(const std::string& name) {
  const std::vector<KeyDescription> keys = scene_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const KeyDescription& key) { return key.path == "fabric." + name; });
}

struct Reader {
  std::string file;

  Error refusal(const std::string& what, const ValueTree& node) const {
    return Error::invalid_input(what + " (" + place(file, node) + ")");
  }

  void only_known(const ValueTree& table, const std::vector<std::string>& names) const {
    for (const ValueTree& child : table.children) {
      if (std::count(names.begin(), names.end(), child.key)) continue;
      if (&names == &kTables && is_parameter(child.key))
        throw refusal(child.key + " is one of the fabric's parameters and must stand below [parameters]",
                      child);
      const std::string nearest = nearest_name(child.key, names);
      throw refusal("unknown key " + child.key + (nearest.empty() ? "" : ", did you mean " + nearest + "?"),
                    child);
    }
  }

  const ValueTree& required(const ValueTree& table, const std::string& name) const {
    const ValueTree* node = table.find(name);
    if (!node) throw refusal((table.key.empty() ? "the fabric" : table.key) + " needs " + name, table);
    return *node;
  }

  std::string text(const ValueTree& table, const std::string& name) const {
    const ValueTree& node = required(table, name);
    const auto* words = std::get_if<std::string>(&node.value);
    if (node.kind != ValueTree::Kind::value || !words || words->empty())
      throw refusal(name + " must be a text", node);
    return *words;
  }

  double number(const ValueTree& table, const std::string& name) const {
    return finite(required(table, name), table.key + "." + name, "a number");
  }

  double plain_number(const ValueTree& node) const {
    return finite(node, node.key, "a number or a table {value, unit, source, confidence}");
  }

  double finite(const ValueTree& node, const std::string& key, const std::string& must) const {
    const std::optional<double> x = node.number();
    if (!x) throw refusal(key + " must be " + must, node);
    if (!std::isfinite(*x)) throw refusal(key + " must be finite", node);
    return *x;
  }

  // Returns the text that a name stands for in [sources]; other names stand for themselves.
  std::string source(const ValueTree* sources, const std::string& name) const {
    const ValueTree* node = sources ? sources->find(name) : nullptr;
    if (!node) return name;
    return node->kind == ValueTree::Kind::table ? text(*node, "text") : text(*sources, name);
  }

  std::map<std::string, std::string> short_names(const ValueTree& sources) const {
    std::map<std::string, std::string> names;
    for (const ValueTree& node : sources.children) {
      if (node.kind != ValueTree::Kind::table) continue;
      only_known(node, {"short", "text"});
      names[text(node, "text")] = text(node, "short");
    }
    return names;
  }

  // Reads {value = 1.157e-5, unit = "N m", source = "kes", confidence = "published"}, or the value alone, in
  // the program's own unit, `own_unit`.  Without a stated source the file is the source.
  PublishedNumber quantity(const ValueTree& node, const ValueTree* sources,
                           const std::string& own_unit) const {
    if (node.kind != ValueTree::Kind::table)
      return {plain_number(node), own_unit, {place(file, node), "given"}};
    only_known(node, {"value", "unit", "source", "confidence", "stderr", "range", "tester"});
    PublishedNumber number{this->number(node, "value"), "", provenance(node, sources)};
    number.unit = node.find("unit") ? text(node, "unit") : own_unit;
    if (node.find("stderr")) {
      number.provenance.standard_error = this->number(node, "stderr");
      if (*number.provenance.standard_error < 0) throw refusal(node.key + ": stderr must be >= 0", node);
    }
    if (node.find("tester")) {
      const std::string tester = text(node, "tester");
      number.tester = value_if_named<DrapeStandard>(tester);
      if (!number.tester)
        throw refusal(node.key + ": tester = \"" + tester + "\" must be jis | iso9073", node);
    }
    return number;
  }

  // [published] may hold any number, of which most are only shown; those that drapes are compared with must
  // have these names.
  static constexpr const char* kReadNames[] = {"drape-coefficient", "node-count"};
  void check_published_name(const ValueTree& node) const {
    const std::vector<std::string> names(std::begin(kReadNames), std::end(kReadNames));
    const std::string nearest = nearest_name(node.key, names);
    if (!nearest.empty() && nearest != node.key)
      throw refusal("unknown number " + node.key + " in [published], did you mean " + nearest + "?", node);
    if (std::count(names.begin(), names.end(), node.key) == 0 && node.find("tester"))
      throw refusal(node.key + " in [published] has a tester, as only " + join(names, " and ") + " have",
                    node);
  }

  void check_drape(const ValueTree& node, PublishedNumber& number) const {
    if (number.unit == "1") number.value *= 100, number.unit = "%";
    if (!number.unit.empty() && number.unit != "%")
      throw refusal(node.key + " has unit \"" + number.unit + "\" and must have \"%\" or \"1\"", node);
    if (!(number.value > 1.5 && number.value <= 101))
      throw refusal(node.key + " = " + number_text(number.value) +
                        " % is no drape's, which has up to 100 %: a share has the unit \"1\"",
                    node);
  }

  // Reads range = [low, high], which must contain the value; returns none where the number does not state it.
  std::optional<Range> range(const ValueTree& number, double value) const {
    const ValueTree* node = number.find("range");
    if (!node) return {};
    const auto* ends = std::get_if<std::vector<double>>(&node->value);
    if (node->kind != ValueTree::Kind::value || !ends || ends->size() != 2)
      throw refusal(number.key + ": range must be [low, high]", *node);
    const Range range = between((*ends)[0], (*ends)[1]);
    if (!range.contains(value))
      throw refusal(number.key + " = " + number_text(value) + " must lie in its range [" +
                        number_text(range.low) + ", " + number_text(range.high) + "]",
                    *node);
    return range;
  }

  // Reads the provenance of a table of lists, which may leave it out: then the file itself is the source.
  Provenance provenance(const ValueTree& table, const ValueTree* sources) const {
    Provenance from{place(file, table), "given"};
    if (table.find("source")) from.source = text(table, "source");
    from.source = source(sources, from.source);
    if (table.find("confidence")) from.confidence = confidence(table, table);
    return from;
  }

  std::string confidence(const ValueTree& table, const ValueTree& of) const {
    const std::string word = text(table, "confidence");
    if (std::count(kConfidences.begin(), kConfidences.end(), word)) return word;
    throw refusal(of.key + ": confidence = " + word + " must be " + join(kConfidences, " | "), of);
  }
};

// Reads the parameter `name` into the key fabric.NAME.
void read_parameter(const Reader& reader, const ValueTree& node, const std::string& name,
                    const ValueTree* sources, Scene& scene, std::map<std::string, Range>& ranges) {
  const std::string origin = place(reader.file, node);
  const Keys keys = bind_scene(scene);
  const BoundKey& key = find_key(keys, "fabric." + name, origin);
  PublishedNumber number = reader.quantity(node, sources, key.description.unit);
  const auto factor = factor_to(key.description.unit, number.unit);
  if (!factor) {
    const std::string others = known_units(key.description.unit);
    throw Error::invalid_input("fabric." + name + " has unit \"" + number.unit + "\" and must have \"" +
                               key.description.unit + "\"" + (others.empty() ? "" : " or one of " + others) +
                               " (" + origin + ")");
  }
  if (const auto range = reader.range(node, number.value)) {
    ranges[name] = between(*factor * range->low, *factor * range->high);
    for (const double end : {ranges[name].low, ranges[name].high}) assign(key, end, origin + ", range");
  }
  if (number.provenance.standard_error) *number.provenance.standard_error *= *factor;
  number.value *= *factor;
  assign(key, number.value, origin);
  check_fabric_number(name, number.value, "fabric." + name, origin);
  scene.fabric.provenance[name] = number.provenance;
  scene.origin["fabric." + name] = origin;
}

// Reads [bending] or [membrane] and the tables in it: the keys fabric.bending.* or fabric.membrane.* as bare
// values, each table with a source of its own; a number may have its own, {value, unit, ...}.
void read_lists(const Reader& reader, const ValueTree& table, const std::string& path,
                const ValueTree* sources, Scene& scene, std::map<std::string, Range>& ranges) {
  const Keys keys = bind_scene(scene);
  for (const ValueTree& node : table.children) {
    if (node.key == "source" || node.key == "confidence") continue;
    const std::string name = path + "." + node.key, origin = place(reader.file, node);
    if (node.kind == ValueTree::Kind::table && node.find("value")) {
      read_parameter(reader, node, name, sources, scene, ranges);
      continue;
    }
    if (node.kind == ValueTree::Kind::table) {
      read_lists(reader, node, name, sources, scene, ranges);
      continue;
    }
    assign(find_key(keys, "fabric." + name, origin), node.value, origin);
    scene.fabric.provenance[name] = reader.provenance(table, sources);
    scene.origin["fabric." + name] = origin;
  }
}

// Derives b1 and k0 from the stops where the file leaves them out.
void note_three_numbers(Fabric& fabric) {
  Fabric follows = fabric;
  follow_stops(follows);
  for (auto [name, number] : {std::pair("b1", &Fabric::b1), std::pair("k0", &Fabric::k0)}) {
    if (fabric.bending.stops.empty() || fabric.provenance.contains(name)) continue;
    fabric.*number = follows.*number;
    fabric.provenance[name] = follows.provenance[name];
  }
}

void read_parts(const Reader& reader, const ValueTree& table, const ValueTree* sources, Scene& scene,
                std::map<std::string, Range>& ranges) {
  read_lists(reader, table, table.key, sources, scene, ranges);
  if (scene.fabric.bending.stops.thresholds.size() == scene.fabric.bending.stops.stiffnesses.size())
    note_three_numbers(scene.fabric);
  check_fabric_lists(scene);
}

// Records that a number that the file leaves out keeps the program's default.
void note_defaults(Fabric& fabric) {
  if (!fabric.provenance.contains("bias-bending") && fabric.weft_bending != 1) follow_weft(fabric);
  for (const KeyDescription& key : scene_keys()) {
    if (!key.path.starts_with("fabric.") || key.path == "fabric.name") continue;
    if (std::any_of(std::begin(kOptional), std::end(kOptional),
                    [&](const char* prefix) { return key.path.starts_with(prefix); }))
      continue;  // the fabric lacks this optional part
    fabric.provenance.try_emplace(key.path.substr(7), Provenance{"the program's default", "assumed"});
  }
}

}  // namespace

const std::string& FabricFile::shown(const Provenance& from) const {
  const auto found = short_names.find(from.source);
  return found == short_names.end() ? from.source : found->second;
}

FabricFile read_fabric(const std::string& name_or_file, const std::string& origin) {
  const Reader reader{find_asset("fabrics", name_or_file, origin).string()};
  const ValueTree root = read_toml(reader.file);
  reader.only_known(root, kTables);
  const ValueTree* sources = root.find("sources");
  const ValueTree& parameters = reader.required(root, "parameters");

  FabricFile result;
  Scene scene;
  if (sources) result.short_names = reader.short_names(*sources);
  scene.fabric.name =
      root.find("name") ? reader.text(root, "name") : std::filesystem::path(reader.file).stem().string();
  if (root.find("description")) result.description = reader.text(root, "description");
  for (const ValueTree& node : parameters.children)
    read_parameter(reader, node, node.key, sources, scene, result.range);
  for (const char* table : kPartTables)
    if (const ValueTree* parts = root.find(table)) read_parts(reader, *parts, sources, scene, result.range);
  const bool shaped = scene.fabric.kes.on(), pair = !shaped && parameters.find("kes-b");
  for (const std::string& name : shaped ? kRequiredOfShaped : pair ? kRequiredOfPair : kRequired) {
    const bool said =
        !scene.fabric.bending.stops.empty() && std::count(kSaidByStops.begin(), kSaidByStops.end(), name);
    if (!said) reader.required(parameters, name);
  }
  if (shaped || pair) {
    const std::string last = shaped ? "stops-median" : "k0";
    for (const char* name : {"b1", "b2", "k0"}) {
      if (name == last) continue;
      if (const ValueTree* node = parameters.find(name))
        throw reader.refusal(std::string(name) + " follows from kes-b, kes-2hb and " + last, *node);
      scene.origin["fabric." + std::string(name)] = scene.origin.at("fabric.kes-b");
    }
    if (!scene.fabric.bending.stops.empty())
      throw reader.refusal("bending.stops follow from kes-b, kes-2hb and " + last, *root.find("bending"));
    scene.fabric.follow_kes();
  }
  if (const ValueTree* published = root.find("published")) {
    for (const ValueTree& node : published->children) {
      reader.check_published_name(node);
      scene.fabric.published[node.key] = reader.quantity(node, sources, "");
      if (node.key == "drape-coefficient") reader.check_drape(node, scene.fabric.published[node.key]);
      if (const auto range = reader.range(node, scene.fabric.published[node.key].value)) {
        if (node.key != "B" && node.key != "2HB")
          throw reader.refusal(node.key + ": a range belongs to [parameters], or to B and 2HB", node);
        result.published_range[node.key] = *range;
      }
    }
  }
  note_defaults(scene.fabric);
  result.fabric = std::move(scene.fabric);
  for (const auto& [key, place] : scene.origin)
    result.place[key.substr(std::string("fabric.").size())] = place;
  return result;
}

std::vector<FabricFile> list_fabrics() {
  std::vector<FabricFile> fabrics;
  for (const std::string& name : list_assets("fabrics"))
    fabrics.push_back(read_fabric(name, "assets/fabrics"));
  return fabrics;
}

}  // namespace hysteron
