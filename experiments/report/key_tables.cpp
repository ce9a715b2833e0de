#include "experiments/report/key_tables.h"

#include "experiments/run/metrics.h"
#include "experiments/workbench/app/ending.h"
#include "experiments/workbench/app/experiment.h"
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

// What stands between the two comments of a name.
struct Marked {
  std::string name;
  std::string (*text)();
};
const Marked kMarked[] = {{"keys", key_tables}, {"exit-codes", exit_code_table}};

// What is there becomes what should be.
void write_between(Page& page, const Marked& marked) {
  const std::string begin = "<!-- " + marked.name + ":begin -->", end = "<!-- " + marked.name + ":end -->";
  const std::size_t at = page.text.find(begin), first = at + begin.size();
  if (at == page.text.npos) return;
  const int line = line_at(page.text, at);
  const std::size_t last = page.text.find(end, first);
  if (last == page.text.npos) {
    page.faults.push_back({line, begin + " needs " + end + " below it"});
    return;
  }
  const std::string tables = "\n" + marked.text();
  if (page.text.compare(first, last - first, tables) == 0) return;
  page.faults.push_back({line, "these tables are not what --help says now", true});
  page.text.replace(first, last - first, tables);
}

}  // namespace

std::string exit_code_table() {
  std::string table = "\n| code | meaning |\n|---|---|\n", differs;
  for (const ExitCode& exit : kExitCodes)
    table += "| " + std::to_string(exit.code) + " | " + cell(exit.meaning) + " |\n";
  for (const Experiment& experiment : experiments())
    if (*experiment.differs)
      differs +=
          std::string(differs.empty() ? "" : "; ") + "`" + experiment.name + "`: " + experiment.differs;
  return table + "| " + std::to_string(kDiffers) + " | " + cell(differs) + " |\n\n";
}

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

void write_keys(Page& page) {
  for (const Marked& marked : kMarked) write_between(page, marked);
}

}  // namespace hysteron::experiments
