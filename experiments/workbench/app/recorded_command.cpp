#include "experiments/workbench/app/recorded_command.h"

#include <wordexp.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

// Splits a command quoted for a shell, for programs that recorded nothing else; returns nothing if it cannot
// be parsed.
std::vector<std::string> command_text(const std::string& command) {
  wordexp_t found{};
  if (wordexp(command.c_str(), &found, WRDE_NOCMD | WRDE_UNDEF) != 0) return {};
  const std::vector<std::string> words(found.we_wordv, found.we_wordv + found.we_wordc);
  wordfree(&found);
  return words;
}

CommandLine recorded_line(const RecordedRun& run) {
  if (run.manifest.spec) {
    CommandLine line{run.manifest.experiment, "", {}, run.manifest.spec->positionals};
    for (const auto& [path, text] : run.manifest.spec->flags)
      line.flags.push_back(parsed_flag(line.experiment, path, text));
    if (!*experiment_named(line.experiment).name)
      throw Error::invalid_input(run.file.string() + ": there is no experiment " + line.experiment);
    return line;
  }
  const std::vector<std::string> words = command_text(run.manifest.command);
  if (words.size() < 2)
    throw Error::invalid_input(run.file.string() + " holds no command that could be repeated")
        .with_key("command", "");
  const auto line = parse_command_line(words);
  if (!line)
    throw Error::invalid_input(run.file.string() + ": its command, \"" + run.manifest.command +
                               "\", is no run");
  return *line;
}

// Replaces an experiment's scene file that no longer exists by the manifest, which holds the scene.
void find_scene(CommandLine& line, const RecordedRun& run) {
  for (Flag& flag : line.flags) {
    if (flag.path != "scene" || !flag.text().ends_with(".toml") || fs::exists(flag.text())) continue;
    flag.value = run.file.string();
  }
}

// True if the experiment takes the key: without a simulation there are no threads, and some experiments have
// no pictures.
bool takes(const Experiment& experiment, const std::string& key) {
  return experiment.simulates || has_key(experiment.own_keys(), key);
}

// Returns the line as typed: "hysteron drape --scene=a.toml".
std::string typed_command(const CommandLine& line) { return "hysteron " + shell_text(line.words()); }

}  // namespace

RecordedRun recorded_run(const std::string& folder_or_manifest) {
  std::error_code ignored;
  fs::path file = folder_or_manifest;
  if (fs::is_directory(file, ignored)) file /= "manifest.json";
  return {file, read_manifest(file)};
}

std::string missing_input(const CommandLine& line) {
  std::error_code ignored;
  for (const Flag& flag : line.flags)
    if (flag.text().ends_with(".csv") && !fs::exists(flag.text(), ignored)) return flag.text();
  return "";
}

CommandLine line_that_repeats(const RecordedRun& run, const std::vector<Flag>& later, bool with_errors) {
  const Manifest& m = run.manifest;
  CommandLine line = recorded_line(run);
  static const std::set<std::string> kNotRepeatedFlags = {"out", "resume",
                                                          "collect"};  // collected runs are run again
  std::erase_if(line.flags, [](const Flag& flag) { return kNotRepeatedFlags.contains(flag.path); });
  if (m.options && m.keys->contains("cloth")) {
    std::erase_if(line.flags, [](const Flag& flag) { return !flag.path.starts_with("errors"); });
    line.experiment = m.experiment;
    line.positionals.clear();
    line.flags.push_back({"scene", run.file.string()});
  } else {
    find_scene(line, run);
  }
  if (m.experiment == "sweep")
    line.positionals = {run.file.string()};  // the study's file may have changed since
  if (!with_errors)
    std::erase_if(line.flags, [](const Flag& flag) { return flag.path.starts_with("errors"); });
  for (const Flag& flag : later) {
    if (!takes(experiment_named(line.experiment), flag.path)) continue;
    const bool draws_no_more = flag == Flag{"no-images", true};
    if (draws_no_more) line.flags = without_unread_flags(line, flag);
    line.flags.push_back(flag);
  }
  line.command = typed_command(line);
  return line;
}

}  // namespace hysteron::experiments
