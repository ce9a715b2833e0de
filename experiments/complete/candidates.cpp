#include "experiments/complete/candidates.h"

#include <algorithm>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/help.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/assets.h"

namespace hysteron::experiments {
namespace {

std::vector<Candidate> those_with(const std::string& begun, std::vector<Candidate> all) {
  std::erase_if(all, [&](const Candidate& candidate) { return !candidate.word.starts_with(begun); });
  return all;
}

std::vector<Candidate> without_meaning(const std::vector<std::string>& words) {
  std::vector<Candidate> all;
  for (const std::string& word : words) all.push_back({word, ""});
  return all;
}

std::vector<Candidate> subcommands() {
  std::vector<Candidate> all;
  for (const Experiment& experiment : experiments())
    if (!experiment.hidden) all.push_back({experiment.name, experiment.question});
  return all;
}

const std::vector<Candidate> kEverywhere = {{"--help", "options, and what exit codes say"},
                                            {"--help-all", "the options of every group"},
                                            {"--version", "version and commit"}};

std::vector<Candidate> options(const std::vector<KeyDescription>& keys) {
  std::vector<Candidate> all;
  for (const KeyDescription& key : keys) all.push_back({option_name(key), option_help(key)});
  all.insert(all.end(), kEverywhere.begin(), kEverywhere.end());
  return all;
}

std::vector<Candidate> values_of(const KeyDescription& key) {
  if (!key.choices.empty()) return without_meaning(key.choices);
  if (key.path == "fabric.name") return without_meaning(list_assets("fabrics"));
  if (key.path == "scene") return without_meaning(list_assets("scenes"));
  if (key.path == "limits") return without_meaning(list_assets("limits"));
  std::vector<Candidate> laws;
  if (key.path == "law")
    for (const LawEntry& law : law_catalogue()) laws.push_back({law.name, law.description});
  return laws;
}

// Behind --help.
std::vector<Candidate> groups_of(const Experiment& experiment, const std::vector<KeyDescription>& keys) {
  std::vector<Candidate> all;
  for (const OptionGroup& group : option_groups(experiment, keys)) all.push_back({group.name, group.about});
  return all;
}

// Of an argument that is no option: the words among what it may be, "drape|swing|SCENE".
std::vector<Candidate> arguments(const std::string& names) {
  std::vector<Candidate> all;
  std::string word;
  for (const char c : names + "|") {
    if (c != '|') {
      word += c;
      continue;
    }
    word = word.substr(0, word.find(' '));
    const bool plain = std::all_of(word.begin(), word.end(), [](char of) { return of >= 'a' && of <= 'z'; });
    if (plain && !word.empty()) all.push_back({word, ""});
    if (word == "SCENE")
      for (const Candidate& scene : without_meaning(list_assets("scenes"))) all.push_back(scene);
    word.clear();
  }
  return all;
}

// The option whose value is begun by the last word, which becomes that value: "--law" "p", "--law" "=" "p",
// "--law" "=", "--law=p".  "" if none is.
std::string option_before(std::vector<std::string>& words) {
  std::string& last = words.back();
  const std::size_t equals = last.find('=');
  if (last.starts_with("--") && equals != last.npos) {
    const std::string option = last.substr(0, equals);
    last = last.substr(equals + 1);
    return option;
  }
  std::size_t at = words.size() - 1;
  if (last == "=")
    last.clear();
  else if (at > 0 && words[at - 1] == "=")
    --at;
  return at > 0 && words[at - 1].starts_with("--") ? words[at - 1] : "";
}

}  // namespace

std::vector<Candidate> candidates(const std::vector<std::string>& words) {
  const std::vector<Candidate> known = subcommands();
  if (words.empty()) return known;
  if (words.size() == 1 && words[0].starts_with('-')) return those_with(words[0], kEverywhere);
  if (words.size() == 1) return those_with(words[0], known);
  if (std::none_of(known.begin(), known.end(), [&](const Candidate& c) { return c.word == words[0]; }))
    return {};
  const Experiment& experiment = experiment_named(words[0]);
  const std::vector<KeyDescription> keys = options_of(experiment, Defaults::left_out);
  std::vector<std::string> rest(words.begin() + 1, words.end());
  const bool whole = rest.back().starts_with("--") && rest.back().find('=') != std::string::npos;
  const std::string option = option_before(rest), begun = rest.back();
  if (option == "--help") return those_with(begun, groups_of(experiment, keys));
  for (const KeyDescription& key : keys)
    if (!option.empty() && option_name(key) == option && key.type != "flag") {
      std::vector<Candidate> found = those_with(begun, values_of(key));
      for (Candidate& candidate : found)
        if (whole) candidate.word = option + "=" + candidate.word;
      return found;
    }
  if (begun.starts_with('-')) return those_with(begun, options(keys));
  return those_with(begun, arguments(experiment.names));
}

}  // namespace hysteron::experiments
