// `hysteron manual`: the manual page, from what --help says.
#include <iostream>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/exit_codes.h"
#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {
namespace {

// As roff reads it: no escapes, no request at the beginning, hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string safe = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) safe += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return safe;
}

// A term and, indented below it, what it means.
std::string entry(const std::string& term, const std::string& argument, const std::string& meaning) {
  return ".TP\n\\fB" + roff(term) + "\\fR" + (argument.empty() ? "" : " \\fI" + roff(argument) + "\\fR") +
         "\n" + roff(meaning) + "\n";
}

std::string entries(const std::vector<KeyDescription>& keys) {
  std::string text;
  for (const KeyDescription& key : keys)
    text += entry(option_name(key), key.type == "flag" ? "" : key.type, option_help(key));
  return text;
}

std::string section(const std::string& title, const std::string& body) {
  return ".SH " + title + "\n" + body;
}

std::string subcommands() {
  std::string text;
  for (const Experiment& experiment : experiments()) {
    if (experiment.hidden || !experiment.run) continue;
    text += std::string(".SS \"") + experiment.name + (*experiment.names ? " " : "") +
            roff(experiment.names) + "\"\n" + roff(experiment.question) + ".\n";
    if (experiment.simulates) text += "Takes the options of runs and the keys of scenes as well.\n";
    if (experiment.own_keys) text += entries(experiment.own_keys());
  }
  return text;
}

std::string exit_status() {
  std::string text, differs;
  for (const ExitCode& exit : kExitCodes) text += entry(std::to_string(exit.code), "", exit.meaning);
  for (const Experiment& experiment : experiments())
    if (*experiment.differs)
      differs += std::string(differs.empty() ? "" : "; ") + experiment.name + ": " + experiment.differs;
  return text + entry(std::to_string(kDiffers), "", differs);
}

std::string manual_text() {
  Scene scene = default_scene();
  Options options;
  return ".TH HYSTERON 1 \"\" \"hysteron " + roff(program_version()) + "\"\n.ad l\n" +
         section("NAME", "hysteron \\- bending hysteresis of cloth: simulate, measure, picture\n") +
         section("SYNOPSIS",
                 ".B hysteron\n\\fISUBCOMMAND\\fR [\\fIargument\\fR | \\fIoption\\fR]...\n.br\n.B hysteron\n"
                 "[\\fISUBCOMMAND\\fR] \\fB\\-\\-help\\fR [\\fIGROUP\\fR] | \\fB\\-\\-help\\-all\\fR | "
                 "\\fB\\-\\-version\\fR\n") +
         section("SUBCOMMANDS", subcommands()) +
         section("OPTIONS OF RUNS", entries(descriptions(bind_options(options)))) +
         section("KEYS OF SCENES",
                 "In files of scenes and as options; defaults are those of a scene of one's own.\n" +
                     entries(descriptions(bind_scene(scene)))) +
         section("EXIT STATUS", exit_status()) +
         section("ENVIRONMENT",
                 entry("HYSTERON_ASSETS", "", "folder of fabrics, scenes, studies and limits"));
}

int run_manual(const CommandLine&) {
  std::cout << manual_text();
  return 0;
}

}  // namespace

Experiment manual() {
  return {.name = "manual",
          .question = "the manual page, as man reads it, on stdout",
          .run = run_manual,
          .hidden = true};
}

}  // namespace hysteron::experiments
