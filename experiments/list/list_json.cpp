#include "experiments/list/list_json.h"

#include "render/offscreen.h"
#include "sim/bending/laws/law_run.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"
#include "sim/time/back_end.h"

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
  Json list = Json::array({{{"device", "cpu"}, {"name", cpu_description()}}});
  std::string reason;
  const int gpus = gpu_count(reason);
  for (int i = 0; i < gpus; ++i)
    list.push_back({{"device", "cuda:" + std::to_string(i)}, {"name", gpu_description(i)}});
  if (gpus == 0) list.push_back({{"device", "cuda"}, {"name", nullptr}, {"reason", reason}});
  for (const render::Candidate& candidate : render::Offscreen::candidates(render::Renderer::automatic))
    list.push_back({{"renderer", candidate.name()}});
  return list;
}

}  // namespace

Json json_of(const FabricFile& file) {
  Scene scene;
  scene.fabric = file.fabric;
  Json numbers = Json::object(), published = Json::object();
  for (const BoundKey& key : bind_scene(scene)) {
    const std::string& path = key.description.path;
    const auto from = file.fabric.provenance.find(path.substr(path.find('.') + 1));
    if (!path.starts_with("fabric.") || from == file.fabric.provenance.end()) continue;
    Json& number = numbers[from->first];
    if (const auto* list = std::get_if<Numbers*>(&key.field))
      number["value"] = std::vector<double>(**list);
    else
      number["value"] = *std::get<double*>(key.field);
    number["unit"] = key.description.unit;
    number["known"] = from->second.confidence;
    const auto range = file.range.find(from->first);
    if (range != file.range.end()) number["range"] = {range->second.low, range->second.high};
    number["source"] = from->second.source;
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
  for (const FabricFile& file : list_fabrics()) list.push_back(json_of(file));
  return list;
}

}  // namespace hysteron::experiments
