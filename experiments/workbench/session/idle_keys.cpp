#include "experiments/workbench/session/idle_keys.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

bool turns(const Motion& motion) {
  return std::ranges::any_of(motion.keys, [](const Keyframe& key) { return key.angle != 0; });
}

bool is_one_of(const Obstacle& obstacle, std::initializer_list<ObstacleKind> kinds) {
  return std::ranges::find(kinds, obstacle.kind) != kinds.end();
}

bool is_mesh(const Obstacle& obstacle) { return obstacle.kind == ObstacleKind::mesh; }

using K = ObstacleKind;
constexpr ReadKey<Pin> kPins[] = {
    {"low", "select = box", [](const Pin& pin) { return pin.select == PinSelection::box; }},
    {"high", "select = box", [](const Pin& pin) { return pin.select == PinSelection::box; }},
    {"point", "select = nearest", [](const Pin& pin) { return pin.select == PinSelection::nearest; }},
    {"home", "from > 0", [](const Pin& pin) { return pin.from > 0; }},
    {"axis", "a keyframe's angle", [](const Pin& pin) { return turns(pin.motion); }},
    {"center", "a keyframe's angle", [](const Pin& pin) { return turns(pin.motion); }},
};
constexpr ReadKey<Obstacle> kObstacles[] = {
    {"size", "a box", [](const Obstacle& o) { return is_one_of(o, {K::box}); }},
    {"radius", "another kind",
     [](const Obstacle& o) {
       return !is_one_of(o, {K::box, K::ground, K::mesh});
     }},
    {"height", "a cylinder, capsule or torus",
     [](const Obstacle& o) {
       return is_one_of(o, {K::cylinder, K::capsule, K::torus});
     }},
    {"rim", "a cylinder or box", [](const Obstacle& o) { return obstacle_form(o).has_rim; }},
    {"file", "a mesh", is_mesh},
    {"unit", "a mesh", is_mesh},
    {"sequence", "a mesh", is_mesh},
    {"fps", "the sequence of a mesh", [](const Obstacle& o) { return is_mesh(o) && !o.sequence.empty(); }},
    {"axis", "another kind", [](const Obstacle& o) { return obstacle_form(o).has_axis; }},
    {"motion-axis", "a keyframe's angle", [](const Obstacle& o) { return turns(o.motion); }},
};

// Checks keys of the scene itself that a flag sets; a scene's file may state what only some of its runs read.
std::vector<std::string> idle_flags(const Scene& scene) {
  const bool is_still = scene.integrator == Integrator::quasi_static,
             touches = !scene.obstacle.empty() || scene.self_contact;
  const struct {
    const char *key, *why;
    bool is_idle;
  } kKeys[] = {{"contact-stiffness", "nothing touches the cloth", !touches},
               {"air-drag", "quasi-static equilibria know no speed", is_still},
               {"fabric.damping", "quasi-static equilibria know no speed", is_still}};
  std::vector<std::string> warnings;
  for (const auto& [key, why, is_idle] : kKeys) {
    const auto origin = scene.origin.find(key);
    if (is_idle && origin != scene.origin.end() && origin->second.starts_with("--"))
      warnings.push_back(std::string(key) + " (" + origin->second + ") changes nothing: " + why);
  }
  return warnings;
}

}  // namespace

std::vector<std::string> idle_key_warnings(const Scene& scene) {
  std::vector<std::string> all = idle_flags(scene);
  for (const std::vector<std::string>& more :
       {idle_keys_of(scene.pin, "pin", bind_pin, kPins),
        idle_keys_of(scene.obstacle, "obstacle", bind_obstacle, kObstacles)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace hysteron::experiments
