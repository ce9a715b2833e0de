#include "experiments/workbench/app/same_request.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/this_program.h"
#include "sim/base/comma_list.h"
#include "sim/base/error.h"
#include "sim/base/fnv1a.h"
#include "sim/base/job.h"
#include "sim/base/whole_file.h"
#include "sim/scene/assets.h"
#include "sim/scene/scene_text.h"

namespace hysteron::experiments {
namespace {
namespace fs = std::filesystem;

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

// Returns the path without links, or unchanged if that fails.
fs::path canonical_or_same(const fs::path& path) {
  std::error_code failure;
  fs::path canonical = fs::weakly_canonical(path, failure);
  return failure ? path : canonical;
}

// Both paths must be without links.
bool is_inside(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// Returns assets/..., or the path relative to the working folder if it is below that, however it was made
// absolute; otherwise the given name.
std::string input_name(const fs::path& file, const fs::path& canonical, const fs::path& here) {
  const std::string name = asset_name(file.lexically_normal());
  const bool is_below = fs::path(name).is_absolute() && is_inside(canonical, here);
  return is_below ? canonical.lexically_relative(here).string() : name;
}

// Returns the place of a recorded file on this machine.
fs::path place_of(const InputRecord& input) {
  std::error_code ignored;
  const fs::path shipped = asset_place(input.file);
  return fs::exists(shipped, ignored) ? shipped : fs::path(input.file);
}

// Returns nothing if the file cannot be read.
std::optional<std::string> hash_of(const fs::path& file) {
  const WorkingFor nobody(nullptr);  // a comparison does not count as reading the file for the request
  try {
    const std::string bytes = whole_file(file);
    return hash_text(fnv1a(bytes.data(), bytes.size()));
  } catch (const Error&) {
    return {};
  }
}

const InputRecord* find_file(const std::vector<InputRecord>& inputs, const std::string& file) {
  const auto found = std::ranges::find(inputs, file, &InputRecord::file);
  return found == inputs.end() ? nullptr : &*found;
}

bool has_bytes(const std::vector<InputRecord>& inputs, const std::string& hash) {
  return std::ranges::find(inputs, hash, &InputRecord::hash) != inputs.end();
}

Json comparable(Json scene) {
  if (!scene.is_object()) return Json::object();
  for (const KeyDescription& key : scene_keys())
    if (key.traits.is_of_page()) scene.erase(key.path);
  scene.erase("origin");
  if (scene.contains("fabric") && scene["fabric"].is_object()) scene["fabric"].erase("provenance");
  return scene;
}

std::string flag_name(const std::string& word) { return word.substr(0, word.find('=')); }

std::string joined_parts(std::vector<std::string> parts, const std::string& separator) {
  std::erase(parts, "");
  return join(parts, separator);
}

}  // namespace

std::vector<InputRecord> inputs_of_job(const fs::path& own) {
  std::vector<InputRecord> inputs;
  const Job* const job = Job::current();
  if (!job) return inputs;
  std::error_code ignored;
  const fs::path here = canonical_or_same(fs::current_path(ignored)), outputs = canonical_or_same(own);
  for (const FileRead& read : job->files_read()) {
    const fs::path canonical = canonical_or_same(read.file);
    if (is_inside(canonical, outputs)) continue;
    const std::string name = input_name(read.file, canonical, here);
    if (!find_file(inputs, name)) inputs.push_back({name, hash_text(read.hash)});
  }
  return inputs;
}

std::vector<std::string> input_changes(const std::vector<InputRecord>& then,
                                       const std::vector<InputRecord>& now) {
  std::vector<std::string> changes;
  for (const InputRecord& input : then) {
    const InputRecord* const same_file = find_file(now, input.file);
    // The file has another name when seen from another working folder.
    if (!same_file && has_bytes(now, input.hash)) continue;
    const std::optional<std::string> hash = same_file ? same_file->hash : hash_of(place_of(input));
    if (!hash)
      changes.push_back(input.file + " is not there any more");
    else if (*hash != input.hash)
      changes.push_back(input.file + " has changed");
  }
  for (const InputRecord& input : now)
    if (!find_file(then, input.file) && !has_bytes(then, input.hash))
      changes.push_back(input.file + " was not read");
  return changes;
}

std::string changed_keys(const Manifest& before, const Setup& setup) {
  const Json none = Json::object();
  const std::string scene = differing_keys(comparable(*before.keys), comparable(to_json(setup.scene)));
  const std::string options =
      differing_keys(before.options ? *before.options : none, setup.resolved ? *setup.resolved : none);
  return joined_parts({scene, options}, ", ");
}

std::string changed_error_flags(const Manifest& before, const CommandLine& line) {
  const auto words = [](const auto& flags, const auto& path, const auto& text) {
    std::vector<std::string> found;
    for (const auto& flag : flags)
      if (path(flag).starts_with("errors") && text(flag) != "false")
        found.push_back("--" + path(flag) + "=" + text(flag));
    return found;
  };
  const std::vector<std::pair<std::string, std::string>> none;
  const auto then = words(
      before.spec ? before.spec->flags : none, [](const auto& flag) { return flag.first; },
      [](const auto& flag) { return flag.second; });
  const auto now = words(
      line.flags, [](const Flag& flag) { return flag.path; }, [](const Flag& flag) { return flag.text(); });
  return join(changed_text(then, now), ", ");
}

std::vector<std::string> changed_text(const std::vector<std::string>& then,
                                      const std::vector<std::string>& now) {
  std::vector<std::string> names;
  const auto add_missing = [&](const std::vector<std::string>& words,
                               const std::vector<std::string>& others) {
    for (const std::string& word : words)
      if (!std::count(others.begin(), others.end(), word) &&
          !std::count(names.begin(), names.end(), flag_name(word)))
        names.push_back(flag_name(word));
  };
  add_missing(now, then);
  add_missing(then, now);
  return names;
}

std::vector<InputRecord> written_tables(const std::vector<std::string>& files, const fs::path& folder) {
  std::vector<InputRecord> tables;
  for (const std::string& file : files)
    if (file.ends_with(".csv") || file.ends_with(".toml"))
      if (const std::optional<std::string> hash = hash_of(folder / file)) tables.push_back({file, *hash});
  return tables;
}

bool is_as_written(const Manifest& run, const fs::path& folder, const std::string& table) {
  const auto written = std::ranges::find(run.tables, table, &InputRecord::file);
  const std::optional<std::string> hash = hash_of(folder / table);
  return written == run.tables.end() || !hash || *hash == written->hash;
}

std::vector<std::string> lost_files(const Manifest& run, const fs::path& folder) {
  std::vector<std::string> lost;
  for (const InputRecord& table : run.tables)
    if (!is_as_written(run, folder, table.file))
      lost.push_back("its " + table.file + " is not as it was written");
  for (const std::string& file : run.files)
    if (std::error_code ignored; !fs::exists(folder / file, ignored))
      lost.push_back("its " + file + " is not there any more");
  return lost;
}

std::string why_another_request(const Manifest& before, const CommandLine& line, const Setup& setup) {
  if (before.experiment != line.experiment) return "it is of " + before.experiment;
  const std::string keys =
      joined_parts({changed_keys(before, setup), changed_error_flags(before, line)}, ", ");
  std::vector<std::string> reasons = {keys.empty() ? "" : "it has other values of " + keys};
  for (const std::string& change : input_changes(before.inputs, inputs_of_job(setup.options.out)))
    reasons.push_back(change);
  for (const std::string& lost : lost_files(before, setup.options.out)) reasons.push_back(lost);
  reasons.push_back(program_change(before));
  return joined_parts(reasons, ", ");
}

}  // namespace hysteron::experiments
