// This is the only file that includes CLI11, which costs seconds to compile.
#include "experiments/workbench/app/command_line.h"

#include <CLI/CLI.hpp>
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

// One subcommand with its options, by the key that each sets.
struct Command {
  const Experiment* experiment;
  CLI::App* app;
  std::vector<std::pair<KeyDescription, CLI::Option*>> flags;
  std::vector<std::string> positionals;
};

CLI::Option* add_flag(CLI::App& app, const KeyDescription& key) {
  const std::string name = option_name(key);
  if (key.type == "flag") return app.add_flag(name);
  CLI::Option* option = app.add_option(*key.traits.flag ? name + ",--" + key.path : name);
  option->expected(1)->type_name(key.type);
  if (key.type == "name=value") return option->take_all()->allow_extra_args(false);
  return option->take_last();
}

// Returns the experiment's own options, then those of every simulated run.
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

// Quotes a word so that the shell reads it back unchanged.
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

// Warns of other values of a repeated flag than the last, which counts.
void warn_of_repeated(const std::string& path, const CLI::Option& option) {
  const std::vector<std::string>& given = option.results();
  if (option.reduced_results().size() > 1 || given.empty()) return;
  for (const std::string& text : given) {
    if (text == given.back()) continue;
    std::cerr << "warning: --" << path << " is given more than once: as " << quoted(text) << ", and last as "
              << quoted(given.back()) << ", which is taken" << std::endl;
    return;
  }
}

// Adds a subcommand.  Options that the experiment fixes are added, too, because the refusal of such a flag
// says more than that it is unknown.
void add_command(CLI::App& program, const Experiment& experiment, Command& command) {
  command.experiment = &experiment;
  command.app = program.add_subcommand(experiment.name, experiment.question);
  command.app->allow_extras();
  command.app->set_version_flag("--version", program_version());
  for (const KeyDescription& key : every_option(experiment, Defaults::left_out))
    command.flags.emplace_back(key, add_flag(*command.app, key));
  if (*experiment.positionals)
    command.app->add_option("names", command.positionals)->type_name(experiment.positionals);
}

std::string shell_command(std::vector<std::string> words) {
  words[0] = std::filesystem::path(words[0]).filename().string();
  return shell_text(words);
}

// Checks values before CLI11 does: for an option that needs a value it would take any next word, even another
// option, and likewise after an empty one, "--key=".
std::vector<std::string> with_their_values(const std::vector<std::string>& words, const Command& command) {
  const auto wants = [&](const std::string& name) {
    return std::any_of(command.flags.begin(), command.flags.end(), [&](const auto& flag) {
      return flag.second->get_items_expected_max() > 0 && flag.second->check_name(name);
    });
  };
  std::vector<std::string> all;
  std::size_t i = 0;
  for (; i < words.size() && words[i] != "--"; ++i) {
    const std::size_t equals = words[i].find('=');
    const std::string name = words[i].substr(0, equals);
    all.push_back(words[i]);
    if (!name.starts_with("--") || !wants(name)) continue;
    if (equals + 1 == words[i].size()) {
      all.back() = name;
      all.emplace_back();
    } else if (equals == std::string::npos && i + 1 < words.size()) {
      const std::string& value = words[++i];
      if (value == "--template") {  // `--kes-sheet --template` asks for an empty sheet without a file
        --i;
        all.emplace_back();
        continue;
      }
      if (value.starts_with("--"))
        throw Error::invalid_input(name + " needs a value, and " + value + " is an option: " + name + "=" +
                                   value + " if it is not")
            .with_key(name.substr(2), value)
            .with_experiment(command.experiment->name);
      all.push_back(value);
    }
  }
  all.insert(all.end(), words.begin() + static_cast<std::ptrdiff_t>(i), words.end());
  return all;
}

// Returns the words with the checked value of each option of their subcommand.
std::vector<std::string> checked(const std::vector<std::string>& words,
                                 const std::vector<Command>& commands) {
  for (const Command& command : commands)
    if (!words.empty() && words.front() == command.experiment->name) return with_their_values(words, command);
  return words;
}

// Throws for an unknown flag, naming it and the nearest known one; CLI11 leaves it over, as it does the "--"
// after which nothing is a flag.
void throw_if_unknown(const Command& command) {
  std::vector<std::string> unknown = command.app->remaining();
  std::erase(unknown, "--");
  if (unknown.empty()) return;
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  const std::string experiment = command.experiment->name;
  if (!word.starts_with('-'))
    throw Error::invalid_input("unexpected argument \"" + word + "\"").with_experiment(experiment);
  std::vector<std::string> known;
  for (const auto& flag : command.flags) known.push_back(option_name(flag.first));
  const std::string owner = owners_of_key(word.substr(std::min(word.find_first_not_of('-'), word.size())));
  const std::string nearest = nearest_name(word, known);
  std::string more = owner;
  if (!nearest.empty()) more = "did you mean " + nearest + "?" + (owner.empty() ? "" : " (" + owner + ")");
  if (more.empty()) more = "see hysteron " + experiment + " --help";
  throw Error::invalid_input("unknown option " + word + "; " + more)
      .with_key(word, "")
      .with_experiment(experiment);
}

// Throws for a word before the subcommand, or instead of one.
void throw_if_stray_word(const std::string& word, const std::vector<Experiment>& experiments) {
  if (word.starts_with('-')) throw Error::invalid_input("unknown option " + word + " before the subcommand");
  std::vector<std::string> known;
  for (const Experiment& experiment : experiments)
    if (!experiment.hidden) known.push_back(experiment.name);
  const std::string nearest = nearest_name(word, known);
  throw Error::invalid_input("unknown subcommand " + word +
                             (nearest.empty() ? "; see hysteron --help" : "; did you mean " + nearest + "?"));
}

CommandLine taken_apart(const Command& command, std::string shell_command) {
  CommandLine line{command.experiment->name, std::move(shell_command), {}, command.positionals};
  throw_if_unknown(command);
  for (const auto& [key, option] : command.flags) {
    const std::string path = key.flag();
    warn_of_repeated(path, *option);
    for (const std::string& text : option->reduced_results()) {
      if (path == "out" && text.empty())
        throw Error::invalid_input("--out is empty: name where to write")
            .with_key("out", "")
            .with_experiment(line.experiment);
      line.flags.push_back({path, parse_text(key, text)});
    }
  }
  return line;
}

}  // namespace

std::vector<KeyDescription> experiment_options(const Experiment& experiment, Defaults defaults) {
  std::vector<KeyDescription> keys = every_option(experiment, defaults);
  const std::vector<FixedKey> fixed_keys = experiment.fixed_keys();
  std::erase_if(keys, [&](const KeyDescription& key) { return has_key(fixed_keys, key.path); });
  return keys;
}

std::string option_name(const KeyDescription& key) { return "--" + key.flag(); }

std::string shell_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

std::optional<CommandLine> parse_command_line(const std::vector<std::string>& words,
                                              const std::vector<Experiment>& known) {
  const std::vector<std::string> given(words.begin() + 1, words.end());
  if (const auto help = help_asked(given, known, terminal_width())) {
    std::cout << *help;
    return std::nullopt;
  }
  CLI::App program("", "hysteron");
  program.set_help_flag();
  program.set_version_flag("--version", program_version());
  program.allow_extras();
  program.require_subcommand(0, 1);
  std::vector<Command> commands(known.size());
  for (std::size_t i = 0; i < commands.size(); ++i) add_command(program, known[i], commands[i]);
  const auto chosen = [&]() -> const Command* {
    for (const Command& command : commands) {
      if (command.app->parsed()) return &command;
    }
    return nullptr;
  };
  try {
    std::vector<std::string> all = checked(given, commands);
    std::reverse(all.begin(), all.end());  // CLI11 takes words in reverse
    program.parse(std::move(all));
  } catch (const CLI::Success& requested) {
    program.exit(requested);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const Error refused = Error::invalid_input(error.what());
    throw chosen() ? refused.with_experiment(chosen()->experiment->name) : refused;
  }
  if (!program.remaining().empty()) throw_if_stray_word(program.remaining().front(), known);
  if (!chosen()) throw Error::invalid_input("needs a subcommand; see hysteron --help");
  return taken_apart(*chosen(), shell_command(words));
}

}  // namespace hysteron::experiments
