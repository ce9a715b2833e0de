#include "experiments/workbench/app/command_line.h"

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

int nothing(const CommandLine&) { return 0; }

const std::vector<Experiment> kKnown = {
    {.name = "drape", .question = "simulates", .run = nothing, .simulates = true},
    {.name = "report", .question = "takes names", .run = nothing, .positionals = "DIR"}};

std::optional<CommandLine> parsed(std::vector<const char*> words) {
  words.insert(words.begin(), "/somewhere/hysteron");
  return parse_command_line({words.begin(), words.end()}, kKnown);
}

std::string text_of_flag(const CommandLine& line, const std::string& path) {
  for (const Flag& flag : line.flags) {
    if (flag.path == path) return flag.text();
  }
  return "(none)";
}

std::string refusal(std::vector<const char*> words) {
  return test::refusal([&] { parsed(std::move(words)); });
}

TEST(CommandLine, TakesEveryKeyOfASceneAsAFlag) {
  for (const KeyDescription& key : scene_keys()) {
    if (key.path == "fabric.name") continue;
    const std::string flag = "--" + key.path;
    const bool bare = key.type == "flag";
    const auto line = bare ? parsed({"drape", flag.c_str()}) : parsed({"drape", flag.c_str(), "x=1"});
    EXPECT_EQ(text_of_flag(*line, key.path), bare ? "true" : "x=1");
  }
}

TEST(CommandLine, TakesABareFlagBack) {
  EXPECT_EQ(text_of_flag(*parsed({"drape", "--self-contact=false"}), "self-contact"), "false");
}

TEST(CommandLine, TakesNegativeNumbersAndVectorsAsOneWord) {
  const auto line = parsed({"drape", "--fabric.coupling", "-3e1", "--gravity", "-1 0 -9.81"});
  EXPECT_EQ(text_of_flag(*line, "fabric.coupling"), "-30");
  EXPECT_EQ(text_of_flag(*line, "gravity"), "-1 0 -9.81");
}

TEST(CommandLine, KeepsEveryParameterAndTheLastOfAnyOtherFlag) {
  const auto line =
      parsed({"drape", "--param", "memory=stops", "--step", "1", "--param", "stops=16", "--step", "2"});
  std::vector<std::string> parameters, steps;
  for (const Flag& flag : line->flags) {
    if (flag.path == "param") parameters.push_back(flag.text());
    if (flag.path == "step") steps.push_back(flag.text());
  }
  EXPECT_EQ(parameters, (std::vector<std::string>{"memory=stops", "stops=16"}));
  EXPECT_EQ(steps, std::vector<std::string>{"2"});
}

TEST(CommandLine, HoldsValuesOfTheirKeysTypes) {
  const auto line = parsed({"drape", "--fabric.b2", "1e-5", "--gravity", "0,0,-1", "--seed", "7", "--quick",
                            "--fabric.bending.stops.thresholds", "5", "--step", "long"});
  const auto value = [&](const std::string& path) {
    return std::ranges::find(line->flags, path, &Flag::path)->value;
  };
  EXPECT_EQ(value("fabric.b2"), Value(1e-5));
  EXPECT_EQ(value("gravity"), Value(Numbers{0, 0, -1}));
  EXPECT_EQ(value("seed"), Value(7));
  EXPECT_EQ(value("quick"), Value(true));
  EXPECT_EQ(value("fabric.bending.stops.thresholds"), Value(Numbers{5}));
  EXPECT_EQ(value("step"), Value("long")) << "which is refused where it is set";
}

TEST(ParsedFlag, HasTheTypeThatTheExperimentsKeyHas) {
  EXPECT_EQ(parsed_flag("drape", "drape.disc", "8e-2"), (Flag{"drape.disc", 0.08}));
  EXPECT_EQ(parsed_flag("drape", "fabric.b2", "1e-5"), (Flag{"fabric.b2", 1e-5}));
  EXPECT_EQ(parsed_flag("drape", "fabric", "12"), (Flag{"fabric", "12"})) << "a file's name";
  EXPECT_EQ(parsed_flag("law", "b2", "1e-5"), (Flag{"b2", 1e-5}));
  EXPECT_EQ(parsed_flag("law", "starch", "5"), (Flag{"starch", "5"})) << "which no key is";
}

TEST(CommandLine, TakesBareFlagsAsTrue) {
  const auto line = parsed({"drape", "--quick"});
  EXPECT_EQ(text_of_flag(*line, "quick"), "true");
  EXPECT_EQ(text_of_flag(*line, "quiet"), "(none)");
}

TEST(CommandLine, NamesAFabricEitherWay) {
  EXPECT_EQ(text_of_flag(*parsed({"drape", "--fabric", "wool-tropical"}), "fabric"), "wool-tropical");
  EXPECT_EQ(text_of_flag(*parsed({"drape", "--fabric.name", "wool-tropical"}), "fabric"), "wool-tropical");
}

TEST(CommandLine, IsKeptForTheManifestAsTheShellReadsIt) {
  EXPECT_EQ(parsed({"drape", "--gravity", "0 0 -1", "--out", "it's"})->command,
            "hysteron drape --gravity '0 0 -1' --out 'it'\\''s'");
}

TEST(CommandLine, TakesNamesWhereTheExperimentDoes) {
  EXPECT_EQ(parsed({"report", "a", "drape"})->positionals, (std::vector<std::string>{"a", "drape"}));
  EXPECT_EQ(parsed({"report", "--", "--a", ""})->positionals, (std::vector<std::string>{"--a", ""}));
  EXPECT_EQ(refusal({"drape", "a"}), "drape: unexpected argument \"a\"");
}

TEST(CommandLine, RefusesUnknownWordsAndNamesTheNearest) {
  EXPECT_EQ(refusal({}), "needs a subcommand; see hysteron --help");
  EXPECT_EQ(refusal({"drap"}), "unknown subcommand drap; did you mean drape?");
  EXPECT_EQ(refusal({"--quick", "drape"}), "unknown option --quick before the subcommand");
  EXPECT_EQ(refusal({"drape", "--fabric.b3", "1"}),
            "drape: unknown option --fabric.b3; did you mean --fabric.b1?");
  EXPECT_EQ(refusal({"drape", "--fabric.b3=1"}),
            "drape: unknown option --fabric.b3; did you mean --fabric.b1?");
  EXPECT_EQ(refusal({"drape", "--zzzzzzzz"}), "drape: unknown option --zzzzzzzz; see hysteron drape --help");
}

TEST(CommandLine, RefusesToWriteToNowhere) {
  EXPECT_EQ(refusal({"drape", "--out", ""}), "drape: --out is empty: name where to write");
  EXPECT_EQ(refusal({"drape", "--out=", "--quick"}), "drape: --out is empty: name where to write");
}

TEST(CommandLine, RefusesAnOptionAsTheValueOfAnother) {
  EXPECT_EQ(refusal({"drape", "--out", "--quick"}),
            "drape: --out needs a value, and --quick is an option: --out=--quick if it is not");
  EXPECT_EQ(refusal({"drape", "--param", "--"}),
            "drape: --param needs a value, and -- is an option: --param=-- if it is not");
  EXPECT_EQ(text_of_flag(*parsed({"drape", "--out=--quick"}), "out"), "--quick");
  EXPECT_EQ(text_of_flag(*parsed({"drape", "--out=--quick"}), "quick"), "(none)");
}

TEST(CommandLine, TakesNothingBehindAnEqualsSignForNothing) {
  const auto line = parsed({"drape", "--reference=", "--quick", "--probe=", "--out", "here"});
  EXPECT_EQ(text_of_flag(*line, "reference"), "");
  EXPECT_EQ(text_of_flag(*line, "quick"), "true");
  EXPECT_EQ(text_of_flag(*line, "probe"), "");
  EXPECT_EQ(text_of_flag(*line, "out"), "here");
}

TEST(CommandLine, SaysWhoseAnOptionIs) {
  EXPECT_EQ(refusal({"drape", "--gamma", "1"}),
            "drape: unknown option --gamma; it is an option of cantilever");
  EXPECT_EQ(refusal({"report", "--crease.hold=3"}),
            "report: unknown option --crease.hold; it is an option of crease");
}

TEST(CommandLine, RefusesAFlagWithoutItsValueInOneLine) {
  const std::string message = refusal({"drape", "--step"});
  EXPECT_TRUE(says(message, "drape: --step"));
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace hysteron::experiments
