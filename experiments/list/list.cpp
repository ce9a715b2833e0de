// `hysteron list`: what there is, on stdout.
#include <fmt/core.h>

#include <algorithm>
#include <iostream>

#include "experiments/list/key_tables.h"
#include "experiments/list/list_json.h"
#include "experiments/list/tried_devices.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/csv.h"
#include "sim/base/error.h"
#include "sim/bending/laws/law_run.h"
#include "sim/reference/kes.h"
#include "sim/scene/assets.h"
#include "sim/scene/fabric_reader.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

std::string short_number(double x, int digits = 4) { return fmt::format("{:.{}g}", x, digits); }

void print_row(const std::vector<std::string>& cells, const std::vector<int>& widths) {
  std::cout << aligned(cells, widths) << "\n";
}

// Who measured the bending: the source of the first published number, else that of B or b2.
std::string bending_source(const FabricFile& file) {
  for (const char* key : {"B", "ke-0-small", "b1-warp"}) {
    const auto found = file.fabric.published.find(key);
    if (found != file.fabric.published.end()) return file.shown(found->second.provenance);
  }
  return file.shown(file.fabric.provenance.at(file.fabric.kes.on() ? "kes-b" : "b2"));
}

std::string listed(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  for (double x : numbers) words.push_back(short_number(x));
  return join(words, ", ");
}

// A line for each part that the fabric has beyond three numbers, with where it comes from.
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
  const auto in_plane = [&](const char* component, const Spectrum& of) {
    if (of.empty()) return;
    print(("membrane.stops." + std::string(component) + ".thresholds").c_str(),
          std::string("stops in the plane, ") + component + ": strains " + listed(of.thresholds) + ", " +
              listed(of.stiffnesses) + " N/m; half width of the loop " + short_number(of.friction_moment()) +
              " N/m");
  };
  in_plane("warp", fabric.in_plane.warp);
  in_plane("weft", fabric.in_plane.weft);
  in_plane("shear", fabric.in_plane.shear);
}

void list_fabrics_table() {
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

// Every number of one fabric with its unit, how it is known, between which numbers it may lie, and its
// source.
void list_numbers(const FabricFile& file) {
  const std::vector<int> widths = {-25, -24, -11, -10, -16};
  std::cout << file.fabric.name << ": " << file.description << "\n";
  print_row({"number", "value", "unit", "known", "range", "from"}, widths);
  for (const StatedNumber& number : stated_numbers(file))
    print_row({number.name, listed(number.value), number.unit, number.from->confidence,
               number.range ? number_text(number.range->low) + " to " + number_text(number.range->high) : "",
               number.from->source},
              widths);
  if (!file.fabric.published.empty()) std::cout << "as printed:\n";
  for (const auto& [name, number] : file.fabric.published)
    print_row({name, short_number(number.value), number.unit, number.provenance.confidence, "",
               number.provenance.source},
              widths);
}

void list_laws() {
  for (const LawEntry& law : law_catalogue()) {
    std::string parameters;
    for (const std::string& name : law_parameter_names(law.name))
      parameters += (parameters.empty() ? "" : " ") + name;
    print_row({law.name, law.description + (parameters.empty() ? "" : " [" + parameters + "]")}, {-15});
  }
}

void list_scenes() {
  for (const std::string& name : list_assets("scenes")) print_row({name}, {-1});
}

void list_devices() {
  for (const TriedDevice& device : tried_devices())
    print_row({device.kind, device.name + (device.failure.empty() ? "" : ": " + device.failure)}, {-10});
}

struct ListFlags {
  bool json = false;
};
// clang-format off
const KeyRow<ListFlags> kRows[] = {
    {"json", at<&ListFlags::json>, "", any(), "", "one JSON object on stdout: an array for each of the lists; of fabrics that are named, an array of those"},
};
// clang-format on

void list_named_fabrics(const std::vector<std::string>& names, bool as_json) {
  nlohmann::ordered_json fabrics = nlohmann::ordered_json::array();
  for (const std::string& name : names) {
    const FabricFile file = read_fabric(name, "list fabrics");
    as_json ? fabrics.push_back(fabric_json(file)) : list_numbers(file);
  }
  if (as_json) std::cout << nlohmann::ordered_json{{"fabrics", fabrics}}.dump(2) << "\n";
}

int run_list(const CommandLine& line) {
  ListFlags flags;
  set_keys(line, bind(kRows, flags));
  const std::vector<std::pair<std::string, void (*)()>> parts = {{"fabrics", list_fabrics_table},
                                                                 {"laws", list_laws},
                                                                 {"scenes", list_scenes},
                                                                 {"devices", list_devices}};
  const auto is_part = [&](const std::string& name) {
    return std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return part.first == name; });
  };
  const std::vector<std::string>& names = line.positionals;
  if (names == std::vector<std::string>{"keys"} && !flags.json) {
    std::cout << key_tables();
    return 0;
  }
  if (names.size() > 1 && names.front() == "fabrics" &&
      std::none_of(names.begin() + 1, names.end(), is_part)) {
    list_named_fabrics({names.begin() + 1, names.end()}, flags.json);
    return 0;
  }
  for (const std::string& name : names)
    if (!is_part(name))
      throw Error::invalid_input(
          "\"" + name + "\" must be fabrics | laws | scenes | devices, or keys alone, without --json");
  if (flags.json) {
    nlohmann::ordered_json lists;
    for (const auto& [name, print] : parts)
      if (names.empty() || std::count(names.begin(), names.end(), name)) lists[name] = json_list(name);
    std::cout << lists.dump(2) << "\n";
    return 0;
  }
  for (const auto& [name, print] : parts) {
    if (names.empty()) std::cout << (print == list_fabrics_table ? "" : "\n") << name << ":\n";
    if (names.empty() || std::count(names.begin(), names.end(), name)) print();
  }
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
