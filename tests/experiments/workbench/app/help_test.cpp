// --help prints by group, no wider than the terminal.
#include "experiments/workbench/app/help.h"

#include <map>
#include <sstream>

#include "experiments/workbench/app/command_line.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr int kWidth = 100;

std::string help(const std::vector<std::string>& words, int width = kWidth) {
  return help_asked(words, experiments(), width).value_or("(not asked)");
}

std::vector<std::string> text_lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Help, OfAGroupHasItsOptionsAlone) {
  for (const auto& words :
       {std::vector<std::string>{"drape", "--help", "fabric"}, {"drape", "--help=fabric"}}) {
    const std::string text = help(words);
    for (const char* option :
         {"  --fabric text", "  --fabric.b1 number", "  --law text", "  --param name=value"})
      EXPECT_TRUE(says(text, option)) << option;
    for (const char* other : {"--drape.disc", "--step ", "--size", "Usage"})
      EXPECT_FALSE(says(text, other)) << other;
  }
  EXPECT_TRUE(says(help({"kes", "--help", "fabric"}), "  --fabric.b1 number"));
  EXPECT_FALSE(says(help({"kes", "--help"}), "--fabric.b1"));
  EXPECT_TRUE(says(help({"compare", "--help", "crease"}), "  --crease.hold number"));
  EXPECT_EQ(test::refusal([] {
              help({"drape", "--help", "fabrics"});
            }),
            "drape: --help fabrics: no group of options is called so; there are drape, scene, fabric, "
            "solver, pictures, running");
}

TEST(Help, OfAllHasEveryOptionOnce) {
  for (const Experiment& experiment : experiments()) {
    std::map<std::string, int> times;
    for (const std::string& line : text_lines(help({experiment.name, "--help-all"})))
      if (line.starts_with("  --")) ++times[line.substr(2, line.find(' ', 2) - 2)];
    const std::vector<KeyDescription> keys = experiment_options(experiment, Defaults::left_out);
    for (const KeyDescription& key : keys)
      EXPECT_EQ(times[option_name(key)], 1) << experiment.name << key.path;
    EXPECT_EQ(times.size(), keys.size()) << experiment.name;
  }
}

TEST(Help, IsNoWiderThanTheTerminal) {
  for (const Experiment& experiment : experiments())
    for (const int width : {80, 100, 160})
      for (const char* requested : {"--help", "--help-all"})
        for (const std::string& line : text_lines(help({experiment.name, requested}, width)))
          EXPECT_LE(line.size(), static_cast<std::size_t>(width)) << experiment.name << ": " << line;
  for (const std::string& line : text_lines(help({"--help"}, 80))) EXPECT_LE(line.size(), 80u) << line;
}

}  // namespace
}  // namespace hysteron::experiments
