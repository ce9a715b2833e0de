#include "experiments/list/list_json.h"

#include "experiments/list/tried_devices.h"
#include "sim/bending/laws/law_run.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {
using Json = nlohmann::ordered_json;

Json laws() {
  Json list = Json::array();
  for (const LawEntry& law : law_catalogue())
    list.push_back({{"name", law.name},
                    {"description", law.description},
                    {"parameters", law_parameter_names(law.name)}});
  return list;
}

Json devices() {
  Json list = Json::array();
  for (const TriedDevice& device : tried_devices()) {
    Json entry = {{device.kind == "renderer" ? "renderer" : "device", device.id},
                  {"name", device.failure.empty() ? Json(device.name) : Json(nullptr)}};
    if (!device.failure.empty()) entry["reason"] = device.failure;
    list.push_back(entry);
  }
  return list;
}

}  // namespace

std::vector<StatedNumber> stated_numbers(const FabricFile& file) {
  Scene scene;
  scene.fabric = file.fabric;
  std::vector<StatedNumber> result;
  for (const BoundKey& key : bind_scene(scene)) {
    const std::string& path = key.description.path;
    const auto from = file.fabric.provenance.find(path.substr(path.find('.') + 1));
    if (!path.starts_with("fabric.") || from == file.fabric.provenance.end()) continue;
    StatedNumber number{from->first, key.description.unit, {}, false, &from->second, nullptr};
    const auto* list = std::get_if<Numbers*>(&key.field);
    number.is_list = list;
    if (list)
      number.value.assign((**list).begin(), (**list).end());
    else
      number.value = {*std::get<double*>(key.field)};
    const auto range = file.range.find(from->first);
    if (range != file.range.end()) number.range = &range->second;
    result.push_back(std::move(number));
  }
  return result;
}

Json fabric_json(const FabricFile& file) {
  Json numbers = Json::object(), published = Json::object();
  for (const StatedNumber& stated : stated_numbers(file)) {
    Json& number = numbers[stated.name];
    number["value"] = stated.is_list ? Json(stated.value) : Json(stated.value.front());
    number["unit"] = stated.unit;
    number["known"] = stated.from->confidence;
    if (stated.range) number["range"] = {stated.range->low, stated.range->high};
    number["source"] = stated.from->source;
  }
  for (const auto& [name, number] : file.fabric.published)
    published[name] = {{"value", number.value},
                       {"unit", number.unit},
                       {"known", number.provenance.confidence},
                       {"source", number.provenance.source}};
  return {{"name", file.fabric.name},
          {"description", file.description},
          {"numbers", numbers},
          {"published", published}};
}

Json json_list(const std::string& name) {
  if (name == "laws") return laws();
  if (name == "scenes") return list_assets("scenes");
  if (name == "devices") return devices();
  Json list = Json::array();
  for (const FabricFile& file : list_fabrics()) list.push_back(fabric_json(file));
  return list;
}

}  // namespace hysteron::experiments
