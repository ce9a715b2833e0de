// A key is one row: help, scene files, manifest, studies and repeats follow from what the row states.
#include <set>

#include "experiments/sweep/study.h"
#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/help.h"
#include "experiments/workbench/app/key_conditions.h"
#include "experiments/workbench/app/scene_source.h"
#include "sim/scene/keys.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

enum class Stitch { plain, blind };
constexpr std::array<const char*, 2> names(Stitch) { return {"plain", "blind"}; }

// A table of an experiment's own with one row of each scope.
struct HemKeys {
  double width = 0.02;
  Stitch stitch = Stitch::plain;
  bool is_told = false;
};
const KeyRow<HemKeys> kHemRows[] = {
    {"hem.width", at<&HemKeys::width>, "m", positive(), "of the hem"},
    {"hem.stitch", at<&HemKeys::stitch>, "", any(), "by which it is held"},
    {"hem.told", at<&HemKeys::is_told>, "", any(), "say so", {.scope = Scope::run}}};

struct HemRun {
  HemKeys keys;
  experiments::Setup setup;
};
HemRun with_hem(std::vector<Flag> flags) {
  HemRun run;
  run.setup =
      set_up({"hem", "hysteron hem", std::move(flags), {}}, {default_scene(), {}}, bind(kHemRows, run.keys));
  return run;
}

TEST(ANewKey, IsShownByHelpWithUnitRangeChoicesAndDefault) {
  const Experiment hem{.name = "hem",
                       .question = "how a hem falls",
                       .run = [](const CommandLine&) { return 0; },
                       .simulates = true,
                       .own_keys = own_key_descriptions<kHemRows>};
  const std::string text = help_asked({"hem", "--help"}, {hem}, 100).value_or("");
  EXPECT_TRUE(says(text, "--hem.width number", "of the hem [m], > 0, default 0.02"));
  EXPECT_TRUE(says(text, "--hem.stitch text", "by which it is held: plain | blind, default plain"));
  const auto line = parse_command_line({"hysteron", "hem", "--hem.width", "0.03"}, {hem});
  EXPECT_EQ(last_text(line->flags, "hem.width", ""), "0.03");
}

TEST(ANewKey, IsReadFromFlagsAndFilesWithinItsRangeAndChoices) {
  const Folder folder;
  const std::string file = folder.write("scene.toml", "hem.width = 0.01\nhem.stitch = \"blind\"\n");
  const HemRun run = with_hem({{"scene", file}, {"hem.width", 0.03}});
  EXPECT_EQ(run.keys.width, 0.03);
  EXPECT_EQ(run.keys.stitch, Stitch::blind);
  EXPECT_EQ(test::refusal([] { with_hem({{"hem.width", 0}}); }), "hem.width = 0 m must be > 0 (--hem.width)");
  EXPECT_EQ(test::refusal([] {
              with_hem({{"hem.stitch", "blnd"}});
            }),
            "hem.stitch = blnd must be plain | blind (--hem.stitch; did you mean blind?)");
}

TEST(ANewKey, IsInManifestAndDumpedSceneUnlessItOnlySaysHowARunIsExecuted) {
  const Folder folder;
  const std::string file = (folder.path() / "dump.toml").string();
  HemRun run = with_hem({{"hem.width", 0.03}, {"hem.told", true}, {"dump-scene", file}});
  EXPECT_EQ((*run.setup.resolved)["hem"], (Json{{"width", 0.03}, {"stitch", "plain"}}));
  dump_scene(run.setup);
  const std::string text = file_content(file);
  EXPECT_TRUE(says(text, "hem.width = 0.03\n", "hem.stitch = \"plain\"\n"));
  EXPECT_FALSE(says(text, "hem.told"));
  EXPECT_EQ(with_hem({{"scene", file}}).keys.width, 0.03) << "as the dumped file has it";
}

// Every row of scenes and runs states its traits, which agree with each other.
TEST(EveryKey, StatesTraitsThatAgree) {
  std::set<std::string> flags;
  for (const KeyDescription& key : simulation_keys()) {
    const KeyTraits& of = key.traits;
    EXPECT_NE(of.group, KeyGroup::own) << key.path << " has no group of --help";
    EXPECT_FALSE(key.doc.empty()) << key.path;
    EXPECT_TRUE(flags.insert(key.flag()).second) << key.flag() << " is the flag of two keys";
    EXPECT_EQ(key_of_flag(key.flag()), key.path);
    EXPECT_EQ(flag_of_key(key.path), key.flag());
    if (of.is_of_page()) {
      EXPECT_EQ(of.scope, Scope::run) << key.path << ": what a run finds is its own request";
    }
    if (of.scope == Scope::output) {
      EXPECT_NE(of.group, KeyGroup::solver) << key.path;
    }
    if (of.takers == Takers::laws) {
      EXPECT_EQ(of.group, KeyGroup::fabric) << key.path;
    }
    if (of.file != NamesFile::no) {
      EXPECT_EQ(key.type, "text") << key.path;
    }
    if (!*of.needs) {
      EXPECT_STREQ(of.needs_text, "") << key.path;
    }
  }
}

// True if the tree has a value of the key, and not only keys below its name, as "camera" has.
bool holds(const Json& tree, const KeyDescription& key) {
  const Json& value = json_at(tree, key.path);
  return !value.is_null() && value.is_object() == (key.type == "name=value");
}

// The scene's keys are in the manifest's scene, of options those that change what a run writes.
TEST(EveryKey, IsInTheManifestIfItChangesWhatARunWrites) {
  const auto setup = set_up({"drape", "hysteron drape", {}, {}}, {default_scene(), {}});
  const Json scene = to_json(setup.scene);
  for (const KeyDescription& key : simulation_keys()) {
    EXPECT_EQ(holds(*setup.resolved, key), !holds(scene, key) && key.traits.is_recorded()) << key.path;
    EXPECT_TRUE(holds(scene, key) || holds(*setup.resolved, key) || !key.traits.is_recorded()) << key.path;
  }
}

TEST(EveryKey, IsTakenByAStudyUnlessItIsThePages) {
  for (const KeyDescription& key : simulation_keys()) {
    const Folder folder;
    const std::string study = folder.write("s.toml", "experiment = \"drape\"\n[[axis]]\nkey = \"" +
                                                         key.flag() + "\"\nvalues = [\"a\", \"b\"]\n");
    const std::string said = test::refusal([&] { read_study(study); });
    const bool of_page =
        key.traits.in_columns == InColumns::leave || key.traits.in_columns == InColumns::share;
    EXPECT_EQ(says(said, "is given to sweep (--" + key.flag() + ")") ? true : false, of_page) << said;
  }
}

// A condition names keys that there are, which key_conditions_test.cpp reads with those of experiments.
TEST(EveryKey, ShowsItsConditionInHelp) {
  const std::vector<KeyCondition> conditions = key_conditions(experiment_named("run"));
  for (const KeyDescription& key : simulation_keys())
    EXPECT_EQ(condition_text(conditions, key.path).empty(), !*key.traits.needs) << key.path;
}

}  // namespace
}  // namespace hysteron::experiments
