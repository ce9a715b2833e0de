#include "experiments/workbench/app/help.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <utility>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_status.h"
#include "experiments/workbench/app/key_conditions.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr int kUsualWidth = 100, kMinWidth = 40, kWidestName = 28;

// Describes the groups of KeyGroup but its own, in their order.
constexpr const char* kAbout[] = {"cloth, its mesh and start, gravity, contact, the scene's file",
                                  "the fabric's numbers, the law of bending and its parameters",
                                  "integrator, steps, tolerances, precision",
                                  "pictures, camera, meshes and probes that are written",
                                  "folder, device, threads, errors, checkpoints, what is printed"};

// Returns the other experiment that owns an option, "drape" for "drape.disc", as a comparison has options of
// the one it compares.
std::string other_owner(const KeyDescription& key, const std::string& experiment) {
  const std::string name = key.path.substr(0, key.path.find('.'));
  if (name == experiment || name == key.path) return "";
  for (const Experiment& other : experiments())
    if (other.name == name && has_key(other.own_keys(), key.path)) return name;
  return "";
}

// Splits a text into words; lists without spaces that are longer than `most` are split after commas.
std::vector<std::string> breakable_text(const std::string& text, std::size_t most) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) {
    for (std::size_t comma; word.size() > most && (comma = word.rfind(',', most - 1)) != word.npos;) {
      words.push_back(word.substr(0, comma + 1));
      word.erase(0, comma + 1);
    }
    words.push_back(word);
  }
  return words;
}

// Wraps a text; lines after the first are indented by `indent`, and the first already has `begun` columns.
std::string wrapped(const std::string& text, int width, int indent, int begun) {
  std::string all;
  int column = begun;
  for (const std::string& word : breakable_text(text, static_cast<std::size_t>(width - indent))) {
    const int length = static_cast<int>(word.size());
    if (column > indent && column + 1 + length > width) {
      all += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!all.empty()) {
      all += ' ';
      ++column;
    }
    all += word;
    column += length;
  }
  return all;
}

// Formats one or more lines for each name and its meaning.
std::string entries(const std::vector<std::pair<std::string, std::string>>& all, int width) {
  int widest = 0;
  for (const auto& [name, meaning] : all)
    widest = std::max(widest, std::min(static_cast<int>(name.size()), kWidestName));
  const int indent = std::min(widest + 4, width / 2);
  std::string text;
  for (const auto& [name, meaning] : all) {
    text += "  " + name;
    const int after = 2 + static_cast<int>(name.size());
    text += after + 2 > indent ? "\n" + std::string(indent, ' ') : std::string(indent - after, ' ');
    text += wrapped(meaning, width, indent, indent) + "\n";
  }
  return text;
}

// Formats "radius of the pedestal [m], > 0, default 0.09".
std::string option_help(const KeyDescription& key, const std::string& condition) {
  std::string text = key.doc;
  if (!key.choices.empty()) text += ": " + join(key.choices, " | ");
  if (!key.unit.empty()) text += " [" + key.unit + "]";
  if (key.range.text() != "finite") text += ", " + key.range.text();
  if (!key.default_text.empty()) text += ", default " + key.default_text;
  if (!condition.empty()) text += "; " + condition;
  return text;
}

std::string options_text(const Experiment& experiment, const std::vector<KeyDescription>& keys, int width) {
  const std::vector<KeyCondition> conditions = key_conditions(experiment);
  std::vector<std::pair<std::string, std::string>> all;
  for (const KeyDescription& key : keys)
    all.emplace_back(option_name(key) + (key.type == "flag" ? "" : " " + key.type),
                     option_help(key, condition_text(conditions, key.path)));
  return entries(all, width);
}

std::string counted_options(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " option" : " options");
}

std::string group_text(const Experiment& experiment, const OptionGroup& group, int width) {
  const bool own = group.name == experiment.name;
  const std::string title = own ? "Options of " + group.name : "Options: " + group.about;
  return wrapped(title, width, 0, 0) + "\n" + options_text(experiment, group.keys, width);
}

// Formats the common exit codes and, unless it is "", the meaning of 4.
std::string exit_codes_text(const std::string& differs, int width) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const ExitCode& exit : kExitCodes) all.emplace_back(std::to_string(exit.code), exit.meaning);
  if (!differs.empty()) all.emplace_back(std::to_string(kDiffers), differs);
  return "Exit codes:\n" + entries(all, width);
}

// Lists the other groups, a line each.
std::string group_list(const Experiment& experiment, const std::vector<OptionGroup>& others, int width) {
  const std::string command = std::string("hysteron ") + experiment.name + " --help";
  std::vector<std::pair<std::string, std::string>> all;
  for (const OptionGroup& group : others)
    all.emplace_back(group.name, group.about + " (" + counted_options(group.keys.size()) + ")");
  return wrapped("Further options by group; " + command + " GROUP lists one, " + command + "-all all of them",
                 width, 0, 0) +
         "\n" + entries(all, width);
}

std::string opening(const Experiment& experiment, int width) {
  const std::string name = std::string("hysteron ") + experiment.name;
  const std::string names = *experiment.positionals ? std::string(" ") + experiment.positionals : "";
  return wrapped(name + ": " + experiment.question, width, 0, 0) + "\n\n" +
         wrapped("Usage: " + name + names + " [options]", width, 2, 0) + "\n\n";
}

// Lists the options without defaults if the fabric of the defaults cannot be read.
std::vector<KeyDescription> shown_options(const Experiment& experiment) {
  try {
    return experiment_options(experiment, Defaults::shown);
  } catch (const Error&) {
    return experiment_options(experiment, Defaults::left_out);
  }
}

std::string help_text(const Experiment& experiment, bool all, int width) {
  std::string text = opening(experiment, width);
  const std::vector<OptionGroup> groups = option_groups(experiment, shown_options(experiment));
  for (std::size_t i = 0; i < groups.size() && (i == 0 || all); ++i)
    if (!groups[i].keys.empty()) text += group_text(experiment, groups[i], width) + "\n";
  if (groups.size() > 1 && !all)
    text += group_list(experiment, {groups.begin() + 1, groups.end()}, width) + "\n";
  return text + exit_codes_text(experiment.differs, width);
}

std::string help_of_group(const Experiment& experiment, const std::string& name, int width) {
  std::vector<std::string> known;
  for (const OptionGroup& group : option_groups(experiment, shown_options(experiment))) {
    if (group.name == name) return group_text(experiment, group, width);
    known.push_back(group.name);
  }
  throw Error::invalid_input("--help " + name + ": no group of options is called so; there are " +
                             join(known, ", "))
      .with_key("help", name)
      .with_experiment(experiment.name);
}

std::string program_help(const std::vector<Experiment>& known, int width) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const Experiment& experiment : known)
    if (!experiment.hidden) all.emplace_back(experiment.name, experiment.question);
  return "Bending hysteresis of cloth: simulate, measure, picture\n\n"
         "Usage: hysteron SUBCOMMAND [arguments] [options]\n\nSubcommands\n" +
         entries(all, width) + "\nOptions\n" +
         entries({{"--help", "this; behind a subcommand, its options"},
                  {"--help GROUP", "behind a subcommand: one group of its options in full"},
                  {"--help-all", "behind a subcommand: all of its options"},
                  {"--version", "version and commit"}},
                 width) +
         "\n" + exit_codes_text("what was compared differs", width);
}

}  // namespace

std::vector<OptionGroup> option_groups(const Experiment& experiment, std::vector<KeyDescription> keys) {
  const std::vector<KeyDescription> own = experiment.own_keys(), fabric = fabric_keys();
  // True for a test of fabrics, which simulates no cloth.
  const bool takes_fabrics = std::all_of(fabric.begin(), fabric.end(),
                                         [&](const KeyDescription& key) { return has_key(own, key.path); });
  std::vector<OptionGroup> all = {{experiment.name, "", {}}};
  for (std::size_t i = 0; i < std::size(kAbout); ++i)
    all.push_back({enum_name(static_cast<KeyGroup>(i + 1)), kAbout[i], {}});
  for (KeyDescription& key : keys) {
    const bool of_fabric = takes_fabrics && has_key(fabric, key.path);
    const bool is_own = !of_fabric && (!experiment.simulates || has_key(own, key.path));
    std::string name = is_own ? experiment.name : enum_name(key.traits.group);
    if (const std::string other = is_own && experiment.simulates ? other_owner(key, name) : "";
        !other.empty())
      name = other;
    auto group = std::find_if(all.begin(), all.end(), [&](const OptionGroup& g) { return g.name == name; });
    if (group == all.end()) group = all.insert(all.end(), {name, "what " + name + " is asked", {}});
    group->keys.push_back(std::move(key));
  }
  std::erase_if(all, [&](const OptionGroup& g) { return g.keys.empty() && g.name != experiment.name; });
  return all;
}

int terminal_width() {
  const char* columns = std::getenv("COLUMNS");
  const double said = number_in(columns ? columns : "").value_or(0);
  winsize size{};
  if (said < 1 && (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)) return kUsualWidth;
  constexpr double kWidest = 1000;
  return std::max(kMinWidth, static_cast<int>(said < 1 ? size.ws_col : std::min(said, kWidest)));
}

std::optional<std::string> help_asked(const std::vector<std::string>& words,
                                      const std::vector<Experiment>& known, int width) {
  const auto end = std::find(words.begin(), words.end(), "--");
  const auto asks = std::find_if(words.begin(), end, [](const std::string& word) {
    return word == "--help" || word == "-h" || word == "--help-all" || word.starts_with("--help=");
  });
  if (asks == end) return std::nullopt;
  std::string group = asks->starts_with("--help=") ? asks->substr(7) : "";
  if (*asks == "--help" && asks + 1 != end && !(asks + 1)->starts_with('-')) group = *(asks + 1);
  const auto named = [&](const std::string& name) {
    return std::find_if(known.begin(), known.end(), [&](const Experiment& e) { return e.name == name; });
  };
  auto experiment = named(words.front());
  if (experiment == known.end() && asks == words.begin()) experiment = named(std::exchange(group, ""));
  if (experiment == known.end() && (asks == words.begin() || words.front().starts_with('-')))
    return program_help(known, width);
  if (experiment == known.end()) return std::nullopt;  // the subcommand is unknown
  return group.empty() ? help_text(*experiment, *asks == "--help-all", width)
                       : help_of_group(*experiment, group, width);
}

}  // namespace hysteron::experiments
