#include "experiments/list/key_tables.h"

#include "experiments/run/metrics.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {

// A cell must not end at a bar.
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

// Those of a fabric are its file's, and in `--help fabric`.
Keys without_fabric(Keys keys) {
  std::erase_if(keys, [](const BoundKey& key) {
    return key.description.path.starts_with("fabric.") && key.description.path != "fabric.name";
  });
  return keys;
}

std::string section(const std::string& title, const Keys& keys) {
  return "\n### " + title + "\n" + keys_table(keys);
}

}  // namespace

std::string key_tables() {
  Scene scene = default_scene();
  Pin pin;
  Obstacle obstacle;
  Keyframe keyframe;
  Command command;
  Phase phase;
  MetricRequest metric;
  return section("Scene", without_fabric(bind_scene(scene))) + section("`[[pin]]`", bind_pin(pin)) +
         section("`[[obstacle]]`", bind_obstacle(obstacle)) +
         section("`keys` of a pin or an obstacle", bind_keyframe(keyframe)) +
         section("`[[command]]`", bind_command(command)) + section("`[[phase]]`", bind_phase(phase)) +
         section("`[[metric]]`", bind_metric(metric)) + "\n";
}

}  // namespace hysteron::experiments
