// `hysteron list` prints what is available: fabrics, laws, scenes and so on.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/doctor/findings.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"
#include "experiments/workbench/session/metric_request.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_run.h"
#include "sim/reference/kes.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

std::string short_number(double x, int digits = 4) { return fmt::format("{:.{}g}", x, digits); }

void print_row(const std::vector<std::string>& cells, const std::vector<int>& widths) {
  std::cout << aligned(cells, widths) << "\n";
}

// Returns who measured the bending: the source of the first published number, else that of B or b2.
std::string bending_source(const FabricFile& file) {
  for (const char* key : {"B", "ke-0-small", "b1-warp"}) {
    const auto found = file.fabric.published.find(key);
    if (found != file.fabric.published.end()) return file.shown(found->second.provenance);
  }
  return file.shown(file.fabric.provenance.at(file.fabric.kes.on() ? "kes-b" : "b2"));
}

// Formats a list of numbers, or a single one, which Json iterates like a list.
std::string listed(const Json& numbers) {
  std::vector<std::string> words;
  for (const Json& x : numbers) words.push_back(short_number(x.get<double>()));
  return join(words, ", ");
}

// Prints a line for each bending part beyond three numbers, with its source.
void print_parts(const FabricFile& file) {
  const Fabric& fabric = file.fabric;
  const BendingParts& parts = fabric.bending;
  const auto print = [&](const char* key, const std::string& text) {
    const Provenance& from = fabric.provenance.at(key);
    std::cout << "  " << text << " (" << from.confidence << ": " << file.shown(from) << ")\n";
  };
  const auto stops = [&](const char* key, const char* along, const Spectrum& of) {
    if (of.empty()) return;
    print(key, std::string("stops") + along + ": " + listed(of.thresholds) + " 1/m, " +
                   listed(of.stiffnesses) + " N m; HB " + short_number(of.friction_moment()) + " N");
  };
  stops("bending.stops.thresholds", "", parts.stops);
  stops("bending.stops.weft.thresholds", " along weft", parts.weft_stops);
  if (!parts.branches.empty())
    print("bending.branches.times", "relaxing branches: " + listed(parts.branches.times) + " s, " +
                                        listed(parts.branches.stiffnesses) + " N m");
  if (parts.set.on())
    print("bending.set.yield", "permanent set: yield " + short_number(parts.set.yield) + " 1/m, hardening " +
                                   short_number(parts.set.hardening) + " N m");
  const auto in_plane = [&](const char* component, const Spectrum& of, double growth = 0) {
    if (of.empty()) return;
    print(("membrane.stops." + std::string(component) + ".thresholds").c_str(),
          std::string("stops in the plane, ") + component + ": strains " + listed(of.thresholds) + ", " +
              listed(of.stiffnesses) + " N/m; half width of the loop " + short_number(of.friction_moment()) +
              " N/m" +
              (growth > 0 ? ", growing by " + short_number(growth) + " times that per unit of shear" : ""));
  };
  in_plane("warp", fabric.in_plane.warp);
  in_plane("weft", fabric.in_plane.weft);
  in_plane("shear", fabric.in_plane.shear, fabric.in_plane.shear_growth);
}

void print_fabrics() {
  const std::vector<int> widths = {-20, -11, -10, -11, -9, -17};
  print_row({"fabric", "B [N m]", "2HB [N]", "HB/B [1/m]", "K0 [1/m]", "density [kg/m^2]", "bending from"},
            widths);
  for (const FabricFile& file : list_fabrics()) {
    const Fabric& f = file.fabric;
    const auto [b, width] = kes_pair(f.virgin_curve());
    const bool friction = width > 0;
    print_row({f.name, short_number(b), friction ? short_number(width) : "-",
               friction ? short_number(width / 2 / b, 3) : "-", friction ? short_number(f.k0) : "-",
               short_number(f.density), bending_source(file)},
              widths);
    print_parts(file);
  }
  std::cout << "-: no bending friction published; none assumed (b1 = b2)\n";
}

// Returns every number that the file states, in the order of the keys: a value or a list of them, its unit,
// its confidence, its range if stated, and its source.
Json stated_numbers(const FabricFile& file) {
  Scene scene;
  scene.fabric = file.fabric;
  Json numbers = Json::object();
  for (const BoundKey& key : bind_scene(scene)) {
    const std::string& path = key.description.path;
    const auto from = file.fabric.provenance.find(path.substr(path.find('.') + 1));
    if (!path.starts_with("fabric.") || from == file.fabric.provenance.end()) continue;
    Json& number = numbers[from->first];
    const auto* list = std::get_if<Numbers*>(&key.field);
    number["value"] = list ? Json(**list) : Json(*std::get<double*>(key.field));
    number["unit"] = key.description.unit;
    number["known"] = from->second.confidence;
    if (const auto range = file.range.find(from->first); range != file.range.end())
      number["range"] = {range->second.low, range->second.high};
    number["source"] = from->second.source;
  }
  return numbers;
}

// Returns the fabric with the numbers as published.
Json fabric_json(const FabricFile& file) {
  Json published = Json::object();
  for (const auto& [name, number] : file.fabric.published) {
    published[name] = {{"value", number.value},
                       {"unit", number.unit},
                       {"known", number.provenance.confidence},
                       {"source", number.provenance.source}};
    if (number.tester) published[name]["tester"] = enum_name(*number.tester);
  }
  return {{"name", file.fabric.name},
          {"description", file.description},
          {"numbers", stated_numbers(file)},
          {"published", published}};
}

Json fabrics() {
  Json list = Json::array();
  for (const FabricFile& file : list_fabrics()) list.push_back(fabric_json(file));
  return list;
}

const std::vector<int> kNumberWidths = {-25, -24, -11, -10, -16};

void print_numbers(const Json& numbers) {
  for (const auto& [name, number] : numbers.items()) {
    std::string range;
    if (number.contains("range"))
      range = number_text(number["range"][0]) + " to " + number_text(number["range"][1]);
    print_row({name, listed(number["value"]), number["unit"], number["known"], range, number["source"]},
              kNumberWidths);
  }
}

void print_fabric(const Json& fabric) {
  std::cout << fabric["name"].get<std::string>() << ": " << fabric["description"].get<std::string>() << "\n";
  print_row({"number", "value", "unit", "known", "range", "from"}, kNumberWidths);
  print_numbers(fabric["numbers"]);
  if (!fabric["published"].empty()) std::cout << "as printed:\n";
  print_numbers(fabric["published"]);
}

Json laws() {
  Json list = Json::array();
  for (const LawEntry& law : law_catalogue())
    list.push_back({{"name", law.name},
                    {"description", law.description},
                    {"parameters", law_parameter_names(law.name)}});
  return list;
}

void print_laws() {
  for (const LawEntry& law : law_catalogue()) {
    const std::string parameters = join(law_parameter_names(law.name), " ");
    print_row({law.name, law.description + (parameters.empty() ? "" : " [" + parameters + "]")}, {-15});
  }
}

Json scenes() { return list_assets("scenes"); }

void print_scenes() {
  for (const std::string& name : list_assets("scenes")) print_row({name}, {-1});
}

Json devices() { return devices_json(tried_devices()); }

void print_devices() { print_findings("out"); }

// Escapes bars, which would end a Markdown cell.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

std::string allowed(const KeyDescription& key) {
  if (key.choices.empty()) return key.range.text() == "finite" ? "" : key.range.text();
  return "`" + join(key.choices, "`, `") + "`";
}

std::string default_cell(const BoundKey& key) {
  if (const auto* flag = std::get_if<bool*>(&key.field)) return **flag ? "true" : "false";
  return key.description.default_text;
}

std::string keys_table(const Keys& keys) {
  std::string table = "\n| key | type | unit | allowed | default | |\n|---|---|---|---|---|---|\n";
  for (const BoundKey& key : keys) {
    const KeyDescription& what = key.description;
    const std::string type = what.choices.empty() ? what.type : "choice";
    for (const std::string& text :
         {"`" + what.path + "`", type, what.unit, allowed(what), default_cell(key), what.doc})
      table += text.empty() ? "| " : "| " + cell(text) + " ";
    table += "|\n";
  }
  return table;
}

// Leaves out the fabric's keys, which belong to its file and to `--help fabric`.
Keys without_fabric(Keys keys) {
  std::erase_if(keys, [](const BoundKey& key) {
    return key.description.path.starts_with("fabric.") && key.description.path != "fabric.name";
  });
  return keys;
}

std::string section(const std::string& title, const Keys& keys) {
  return "\n### " + title + "\n" + keys_table(keys);
}

// Returns the keys of scene files as Markdown tables, one for each kind of key, from the same tables as
// reading, flags, --help and checks; fabrics and runs have theirs in --help.
std::string key_tables() {
  Scene scene = default_scene();
  Pin pin;
  Obstacle obstacle;
  Keyframe keyframe;
  SceneEvent command;
  Phase phase;
  MetricRequest metric;
  return section("Scene", without_fabric(bind_scene(scene))) + section("`[[pin]]`", bind_pin(pin)) +
         section("`[[obstacle]]`", bind_obstacle(obstacle)) +
         section("`keys` of a pin or an obstacle", bind_keyframe(keyframe)) +
         section("`[[command]]`", bind_command(command)) + section("`[[phase]]`", bind_phase(phase)) +
         section("`[[metric]]`", bind_metric(metric)) + "\n";
}

struct List {
  const char* name;
  void (*print)();
  Json (*json)();
};
constexpr List kLists[] = {{"fabrics", print_fabrics, fabrics},
                           {"laws", print_laws, laws},
                           {"scenes", print_scenes, scenes},
                           {"devices", print_devices, devices}};

bool is_list(const std::string& name) {
  return std::any_of(std::begin(kLists), std::end(kLists),
                     [&](const List& list) { return list.name == name; });
}

struct ListFlags {
  bool json = false;
};
// clang-format off
const KeyRow<ListFlags> kRows[] = {
    {"json", at<&ListFlags::json>, "", any(), "one JSON object on stdout: an array for each of the lists; of fabrics that are named, an array of those"},
};
// clang-format on

void list_named_fabrics(const std::vector<std::string>& names, bool as_json) {
  Json fabrics = Json::array();
  for (const std::string& name : names) {
    const Json fabric = fabric_json(read_fabric(name, "list fabrics"));
    as_json ? fabrics.push_back(fabric) : print_fabric(fabric);
  }
  if (as_json) std::cout << Json{{"fabrics", fabrics}}.dump(2) << "\n";
}

void print_lists(const std::vector<std::string>& names, bool as_json) {
  Json lists;
  for (const List& list : kLists) {
    if (!names.empty() && !std::count(names.begin(), names.end(), list.name)) continue;
    if (as_json) {
      lists[list.name] = list.json();
      continue;
    }
    if (names.empty()) std::cout << (&list == kLists ? "" : "\n") << list.name << ":\n";
    list.print();
  }
  if (as_json) std::cout << lists.dump(2) << "\n";
}

int run_list(const CommandLine& line) {
  ListFlags flags;
  set_keys(line, bind(kRows, flags));
  const std::vector<std::string>& names = line.positionals;
  if (names == std::vector<std::string>{"keys"} && !flags.json) {
    std::cout << key_tables();
    return 0;
  }
  if (names.size() > 1 && names.front() == "fabrics" &&
      std::none_of(names.begin() + 1, names.end(), is_list)) {
    list_named_fabrics({names.begin() + 1, names.end()}, flags.json);
    return 0;
  }
  for (const std::string& name : names)
    if (!is_list(name))
      throw Error::invalid_input(
          "\"" + name + "\" must be fabrics | laws | scenes | devices, or keys alone, without --json");
  print_lists(names, flags.json);
  return 0;
}

}  // namespace

Experiment list() {
  return {.name = "list",
          .question = "what there is: fabrics, laws, scenes, devices; keys of scene files, in Markdown",
          .run = run_list,
          .own_keys = own_key_descriptions<kRows>,
          .positionals = "fabrics [NAME|FILE]...|laws|scenes|devices|keys"};
}

}  // namespace hysteron::experiments
