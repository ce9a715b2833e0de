// The only file that includes CLI11: it costs seconds to compile.
#include "experiments/workbench/app/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/run.h"
#include "sim/base/error.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

// One subcommand with its options, by the key that each sets.
struct Command {
  const Experiment* experiment;
  CLI::App* app;
  std::vector<std::pair<std::string, CLI::Option*>> flags;
  std::vector<std::string> names;
};

CLI::Option* add_flag(CLI::App& app, const KeyDescription& key) {
  const std::string name = option_name(key);
  if (key.type == "flag") return app.add_flag(name)->description(option_help(key));
  CLI::Option* option = app.add_option(key.path == "fabric.name" ? name + ",--" + key.path : name)
                            ->description(option_help(key));
  option->expected(1)->type_name(key.type);
  if (key.type == "name=value") return option->take_all()->allow_extra_args(false);
  return option->take_last();
}

void add_command(CLI::App& program, const Experiment& experiment, Defaults defaults, Command& command) {
  command.experiment = &experiment;
  command.app = program.add_subcommand(experiment.name, experiment.question);
  command.app->allow_extras();
  command.app->set_version_flag("--version", program_version());
  command.app->footer(exit_codes_text(experiment.differs));
  if (experiment.hidden) command.app->group("");
  if (!experiment.run) return;
  for (const KeyDescription& key : options_of(experiment, defaults))
    command.flags.emplace_back(option_name(key).substr(2), add_flag(*command.app, key));
  if (*experiment.names) command.app->add_option("names", command.names)->type_name(experiment.names);
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

std::string shell_command(int count, const char* const* words) {
  std::vector<std::string> all(words, words + count);
  all[0] = std::filesystem::path(words[0]).filename().string();
  return shell_text(all);
}

// CLI11 leaves what it does not know, and the "--" behind which nothing is a flag; say which flag that is,
// and what was meant.
void refuse_unknown(const Command& command) {
  std::vector<std::string> unknown = command.app->remaining();
  std::erase(unknown, "--");
  if (unknown.empty()) return;
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  const std::string experiment = command.experiment->name;
  if (!word.starts_with('-')) throw Error::request("unexpected argument \"" + word + "\"").in(experiment);
  std::vector<std::string> known;
  for (const auto& flag : command.flags) known.push_back("--" + flag.first);
  const std::string nearest = nearest_name(word, known);
  throw Error::request(
      "unknown option " + word +
      (nearest.empty() ? "; see hysteron " + experiment + " --help" : "; did you mean " + nearest + "?"))
      .of(word, "")
      .in(experiment);
}

// A word before the subcommand, or instead of one.
void refuse_stray_word(const std::string& word, const std::vector<Experiment>& experiments) {
  if (word.starts_with('-')) throw Error::request("unknown option " + word + " before the subcommand");
  std::vector<std::string> known;
  for (const Experiment& experiment : experiments)
    if (!experiment.hidden) known.push_back(experiment.name);
  const std::string nearest = nearest_name(word, known);
  throw Error::request("unknown subcommand " + word +
                       (nearest.empty() ? "; see hysteron --help" : "; did you mean " + nearest + "?"));
}

CommandLine taken_apart(const Command& command, std::string shell_command) {
  CommandLine line{command.experiment->name, std::move(shell_command), {}, command.names};
  if (!command.experiment->run) return line;
  refuse_unknown(command);
  for (const auto& [path, option] : command.flags) {
    for (const std::string& text : option->reduced_results()) {
      if (path == "out" && text.empty())
        throw Error::request("--out is empty: name where to write").of("out", "").in(line.experiment);
      line.flags.push_back({path, text});
    }
  }
  return line;
}

}  // namespace

std::vector<KeyDescription> options_of(const Experiment& experiment, Defaults defaults) {
  std::vector<KeyDescription> keys;
  if (experiment.own_keys) keys = experiment.own_keys();
  if (!experiment.simulates) return keys;
  const bool shown = defaults == Defaults::shown && experiment.defaults;
  Setup setup = shown ? experiment.defaults() : Setup();
  std::vector<KeyDescription> general = descriptions(bind_options(setup.options));
  for (const KeyDescription& key : descriptions(bind_scene(setup.scene))) general.push_back(key);
  for (KeyDescription& key : general) {
    if (!shown) key.usual.clear();
    keys.push_back(std::move(key));
  }
  return keys;
}

std::string option_name(const KeyDescription& key) {
  return key.path == "fabric.name" ? "--fabric" : "--" + key.path;
}

std::string option_help(const KeyDescription& key) {
  std::string text = key.doc;
  if (!key.choices.empty()) text += ": " + join(key.choices, " | ");
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  if (key.range.text() != "finite") text += ", " + key.range.text();
  if (!key.usual.empty()) text += ", default " + key.usual;
  return text;
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + quoted(word);
  return text;
}

std::optional<CommandLine> parse_command_line(int count, const char* const* words,
                                              const std::vector<Experiment>& known) {
  CLI::App program("Bending hysteresis of cloth: simulate, measure, picture", "hysteron");
  program.set_version_flag("--version", program_version());
  program.footer(exit_codes_text("what was compared differs"));
  program.allow_extras();
  program.require_subcommand(0, 1);
  std::vector<Command> commands(known.size());
  const bool for_help = std::any_of(
      words, words + count, [](const std::string_view word) { return word == "--help" || word == "-h"; });
  for (std::size_t i = 0; i < commands.size(); ++i)
    add_command(program, known[i], for_help ? Defaults::shown : Defaults::left_out, commands[i]);
  const auto chosen = [&]() -> const Command* {
    for (const Command& command : commands) {
      if (command.app->parsed()) return &command;
    }
    return nullptr;
  };
  try {
    program.parse(count, words);
  } catch (const CLI::Success& asked) {
    program.exit(asked);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    const Error refused = Error::request(error.what());
    throw chosen() ? refused.in(chosen()->experiment->name) : refused;
  }
  if (!program.remaining().empty()) refuse_stray_word(program.remaining().front(), known);
  if (!chosen()) throw Error::request("needs a subcommand; see hysteron --help");
  return taken_apart(*chosen(), shell_command(count, words));
}

}  // namespace hysteron::experiments
