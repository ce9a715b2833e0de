#include "experiments/workbench/app/command_line.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <string_view>

#include "experiments/workbench/app/help.h"
#include "experiments/workbench/app/run.h"
#include "sim/base/error.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

// The experiment's own, then those of every simulated run.
std::vector<KeyDescription> every_option(const Experiment& experiment, Defaults defaults) {
  std::vector<KeyDescription> keys = experiment.own_keys();
  if (!experiment.simulates) return keys;
  const bool shown = defaults == Defaults::shown && experiment.defaults;
  Setup setup = shown ? experiment.defaults() : Setup();
  std::vector<KeyDescription> general = descriptions(bind_options(setup.options));
  for (const KeyDescription& key : descriptions(bind_scene(setup.scene))) general.push_back(key);
  for (KeyDescription& key : general) {
    if (!shown) key.default_text.clear();
    keys.push_back(std::move(key));
  }
  return keys;
}

// A word that the shell reads back as it is.
std::string quoted(const std::string& word) {
  const std::string_view safe = "-_./=,:+@%";
  const auto plain = [&](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || safe.find(c) != safe.npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string text = "'";
  for (char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string shell_command(std::vector<std::string> words) {
  words[0] = std::filesystem::path(words[0]).filename().string();
  return shell_text(words);
}

// A word that begins an option, unlike a negative number.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && !std::isdigit(static_cast<unsigned char>(word[1]));
}

// What stands behind "=" in the word of this option, or else the next word, to which `i` goes on.
std::string value_in(const std::vector<std::string>& words, std::size_t& i, const KeyDescription& key) {
  const std::string& word = words[i];
  const std::size_t equals = word.find('=');
  const std::string text = equals == word.npos ? "" : word.substr(equals + 1);
  if (key.type == "flag") return text.empty() ? "true" : text;
  if (equals != word.npos) return text;
  if (i + 1 == words.size())
    throw Error::invalid_input(option_name(key) + ": 1 required " + key.type + " missing");
  const std::string& value = words[++i];
  if (value.starts_with("--"))
    throw Error::invalid_input(word + " needs a value, and " + value + " is an option: " + word + "=" +
                               value + " if it is not")
        .with_key(word.substr(2), value);
  return value;
}

// Says which word no option takes, and what was meant.
[[noreturn]] void throw_unknown(const std::string& given, const std::string& experiment,
                                const std::vector<KeyDescription>& keys) {
  const std::string word = given.substr(0, given.find('='));
  if (!word.starts_with('-')) throw Error::invalid_input("unexpected argument \"" + word + "\"");
  std::vector<std::string> known;
  for (const KeyDescription& key : keys) known.push_back(option_name(key));
  const std::string owner = whose(word.substr(std::min(word.find_first_not_of('-'), word.size())));
  const std::string nearest = nearest_name(word, known);
  std::string more = owner;
  if (!nearest.empty()) more = "did you mean " + nearest + "?" + (owner.empty() ? "" : " (" + owner + ")");
  if (more.empty()) more = "see hysteron " + experiment + " --help";
  throw Error::invalid_input("unknown option " + word + "; " + more).with_key(word, "");
}

// A word before the subcommand, or instead of one.
[[noreturn]] void throw_stray_word(const std::string& word, const std::vector<Experiment>& experiments) {
  if (word.starts_with('-')) throw Error::invalid_input("unknown option " + word + " before the subcommand");
  std::vector<std::string> known;
  for (const Experiment& experiment : experiments)
    if (!experiment.hidden) known.push_back(experiment.name);
  const std::string nearest = nearest_name(word, known);
  throw Error::invalid_input("unknown subcommand " + word +
                             (nearest.empty() ? "; see hysteron --help" : "; did you mean " + nearest + "?"));
}

// The words behind the experiment's name.  Behind "--" nothing is an option.
void take_apart(const std::vector<std::string>& words, const Experiment& experiment, CommandLine& line) {
  // What the experiment decides itself, too: what it says to such a flag is more than that it is unknown.
  const std::vector<KeyDescription> keys = every_option(experiment, Defaults::left_out);
  std::vector<std::vector<std::string>> texts(keys.size());
  std::optional<std::string> unknown;  // the first
  bool names_only = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool is_name = names_only || !is_option(word);
    const std::string option = is_name ? "" : word.substr(0, word.find('='));
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const KeyDescription& k) {
      return option == option_name(k) || option == "--" + k.path;
    });
    if (key != keys.end())
      texts[static_cast<std::size_t>(key - keys.begin())].push_back(value_in(words, i, *key));
    else if (option == "--")
      names_only = true;
    else if (is_name && *experiment.positionals)
      line.positionals.push_back(word);
    else if (!unknown)
      unknown = word;
  }
  if (unknown) throw_unknown(*unknown, line.experiment, keys);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (keys[k].type != "name=value" && texts[k].size() > 1) texts[k] = {texts[k].back()};
    for (const std::string& text : texts[k]) line.flags.push_back({option_name(keys[k]).substr(2), text});
  }
  if (last_text(line.flags, "out", "out").empty())
    throw Error::invalid_input("--out is empty: name where to write").with_key("out", "");
}

}  // namespace

std::vector<KeyDescription> experiment_options(const Experiment& experiment, Defaults defaults) {
  std::vector<KeyDescription> keys = every_option(experiment, defaults);
  const std::vector<DecidedKey> decided = experiment.decided();
  std::erase_if(keys, [&](const KeyDescription& key) { return has_key(decided, key.path); });
  return keys;
}

std::string option_name(const KeyDescription& key) {
  return key.path == "fabric.name" ? "--fabric" : "--" + key.path;
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

std::optional<CommandLine> parse_command_line(const std::vector<std::string>& words,
                                              const std::vector<Experiment>& known) {
  const std::vector<std::string> given(words.begin() + 1, words.end());
  const auto end = std::find(given.begin(), given.end(), "--");
  if (const auto help = help_asked(given, known, terminal_width())) return std::cout << *help, std::nullopt;
  if (std::find(given.begin(), end, "--version") != end)
    return std::cout << program_version() << std::endl, std::nullopt;
  if (given.empty()) throw Error::invalid_input("needs a subcommand; see hysteron --help");
  const auto experiment =
      std::find_if(known.begin(), known.end(), [&](const Experiment& e) { return e.name == given.front(); });
  if (experiment == known.end()) throw_stray_word(given.front(), known);
  CommandLine line{experiment->name, shell_command(words), {}, {}};
  try {
    take_apart({given.begin() + 1, given.end()}, *experiment, line);
  } catch (const Error& error) {
    throw error.with_experiment(line.experiment);
  }
  return line;
}

}  // namespace hysteron::experiments
