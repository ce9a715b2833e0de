#include "experiments/report/key_tables.h"

#include <algorithm>

#include "experiments/run/metrics.h"
#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/experiment.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

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

std::string usual_of(const BoundKey& key) {
  if (const auto* flag = std::get_if<bool*>(&key.field)) return **flag ? "true" : "false";
  return key.description.usual;
}

std::string table_of(const Keys& keys) {
  std::string table = "\n| key | type | unit | allowed | default | |\n|---|---|---|---|---|---|\n";
  for (const BoundKey& key : keys) {
    const KeyDescription& what = key.description;
    const std::string type = what.choices.empty() ? what.type : "choice";
    for (const std::string& text :
         {"`" + what.path + "`", type, what.unit, allowed(what), usual_of(key), what.doc})
      table += text.empty() ? "| " : "| " + cell(text) + " ";
    table += "|\n";
  }
  return table;
}

std::string section(const std::string& title, const Keys& keys) {
  return "\n### " + title + "\n" + table_of(keys);
}

// What stands between the two comments of a name.
struct Marked {
  std::string name;
  std::string (*text)();
};
const Marked kMarked[] = {{"keys", key_tables}, {"exit-codes", exit_code_table}};

// Whether the page has such a place; what is there becomes what should be.
bool rewrite(KeyPage& page, const Marked& marked) {
  const std::string begin = "<!-- " + marked.name + ":begin -->", end = "<!-- " + marked.name + ":end -->";
  const std::size_t at = page.text.find(begin), first = at + begin.size();
  if (at == page.text.npos) return false;
  const std::size_t last = page.text.find(end, first);
  if (last == page.text.npos)
    throw Error::request(page.file.string() + " has " + begin + " without " + end + " below it");
  const std::string tables = "\n" + marked.text();
  page.stale = page.stale || page.text.compare(first, last - first, tables) != 0;
  page.text.replace(first, last - first, tables);
  return true;
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
  Options options;
  return section("Scene", bind_scene(scene)) + section("`[[pin]]`", bind_pin(pin)) +
         section("`[[obstacle]]`", bind_obstacle(obstacle)) +
         section("`keys` of a pin or an obstacle", bind_keyframe(keyframe)) +
         section("`[[command]]`", bind_command(command)) + section("`[[phase]]`", bind_phase(phase)) +
         section("`[[metric]]`", bind_metric(metric)) + section("Run and pictures", bind_options(options)) +
         "\n";
}

std::vector<KeyPage> key_pages(const fs::path& folder) {
  std::vector<KeyPage> pages;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (entry.path().extension() != ".md") continue;
    KeyPage page{entry.path(), whole_file(entry.path(), "cannot read " + entry.path().string())};
    bool any = false;
    for (const Marked& marked : kMarked) any = rewrite(page, marked) || any;
    if (!any) continue;
    pages.push_back(std::move(page));
  }
  if (failure) throw Error::machine("cannot read the folder " + folder.string() + ": " + failure.message());
  std::sort(pages.begin(), pages.end(), [](const KeyPage& a, const KeyPage& b) { return a.file < b.file; });
  return pages;
}

}  // namespace hysteron::experiments
