// Flags that nothing reads are refused, with what would read them; keys of files are told of.
#include "experiments/workbench/app/key_conditions.h"

#include <algorithm>
#include <regex>

#include "experiments/workbench/app/command_line.h"
#include "sim/base/comma_list.h"
#include "sim/bending/laws/law_run.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

CommandLine line_with(const std::string& experiment, const std::vector<Flag>& flags) {
  return {experiment, "hysteron " + experiment, flags, {}};
}

// Returns the subcommand's message to these flags.
std::string said_to(const std::string& experiment, const std::vector<Flag>& flags) {
  return test::refusal([&] { run_experiment(line_with(experiment, flags)); });
}

// The names in a condition, "crease.fold" of "crease.fold = rod and not fab".
std::vector<std::string> names_in(const std::string& needs) {
  const std::regex separator(" or | and ");
  std::vector<std::string> names;
  for (std::sregex_token_iterator term(needs.begin(), needs.end(), separator, -1), end; term != end; ++term) {
    const std::string text = term->str(), positive = text.starts_with("not ") ? text.substr(4) : text;
    names.push_back(positive.substr(0, positive.find(' ')));
  }
  return names;
}

TEST(KeyConditions, OfEverySubcommandAreOfKeysThatItHas) {
  for (const Experiment& experiment : experiments()) {
    std::vector<KeyDescription> known = experiment.own_keys();
    for (const KeyDescription& key : experiment_options(experiment, Defaults::left_out)) known.push_back(key);
    for (const KeyCondition& condition : key_conditions(experiment)) {
      for (const std::string& name : names_in(condition.needs))
        EXPECT_TRUE(has_key(known, name)) << experiment.name << " " << condition.needs;
      if (experiment.conditions.empty()) continue;
      const std::regex separator(" \\| ");
      const std::string keys = condition.keys;
      for (std::sregex_token_iterator key(keys.begin(), keys.end(), separator, -1), end; key != end; ++key) {
        const bool found = std::any_of(known.begin(), known.end(), [&](const KeyDescription& other) {
          return key->str().ends_with('.') || key->str().ends_with('-') ? other.path.starts_with(key->str())
                                                                        : other.path == key->str();
        });
        EXPECT_TRUE(found || !experiment.fixed_keys().empty()) << experiment.name << " " << key->str();
      }
    }
  }
}

TEST(KeyConditions, RefuseFlagsThatNothingReadsWithWhatWouldReadThem) {
  const struct {
    const char* experiment;
    std::vector<Flag> flags;
    const char* message;
  } cases[] = {
      {"crease",
       {{"crease.radius", 0.02}},
       "--crease.radius 0.02 is not used: crease.radius needs --crease.fold rod (crease.fold = plate)"},
      {"crease",
       {{"crease.fold", "rod"}, {"crease.pleat", 40}},
       "--crease.pleat 40 is not used: crease.pleat needs --crease.fold pleat (crease.fold = rod)"},
      {"crease", {{"seed", 3}}, "--seed 3: crease does not use seed: no part of its mesh is drawn at random"},
      {"fold",
       {{"fold.curvature", 90}},
       "--fold.curvature 90 is not used: fold.curvature needs --fold.law-alone (no --fold.law-alone)"},
      {"fold",
       {{"fold.law-alone", true}, {"triangles", 90}},
       "--triangles 90 is not used: triangles needs no --fold.law-alone (fold.law-alone = true)"},
      {"fold",
       {{"law", "linear"}, {"fold.fatigue", 3}},
       "--fold.fatigue 3 is not used: law linear knows no fatigue"},
      {"drape",
       {{"drape.shakes", 3}},
       "--drape.shakes 3 is not used: drape.shakes needs --drape.release shaken (drape.release = lowered)"},
      {"drape",
       {{"renderer", "osmesa"}, {"no-images", true}},
       "--renderer osmesa is not used: renderer needs no --no-images (no-images = true)"},
      {"kes",
       {{"on", "strip"}, {"renderer", "osmesa"}, {"no-images", true}},
       "--renderer osmesa is not used: renderer needs --test bending and --on strip and no --no-images "
       "(no-images = true)"},
      {"drape",
       {{"errors.draws", 3}},
       "--errors.draws 3 is not used: errors.draws needs --errors (no --errors)"},
      {"drape",
       {{"substeps", 30}},
       "--substeps 30 is not used: substeps needs --integrator semi-implicit or explicit (integrator = "
       "tr-bdf2)"},
      {"drape",
       {{"mesh", "unionjack"}, {"seed", 3}},
       "--seed 3 is not used: seed needs --mesh random, --cloth.copy-turn or --cloth.copy-scatter (mesh = "
       "unionjack, no --cloth.copy-turn, no --cloth.copy-scatter)"},
      {"kes",
       {{"test", "shear"}, {"law", "kim"}},
       "--law kim is not used: law needs --test bending (test = shear)"},
      {"kes",
       {{"test", "shear"}, {"fabric.b1", 1e-5}},
       "--fabric.b1 1e-05 is not used: fabric.b1 needs --test bending (test = shear)"},
      {"kes", {{"mesh", "random"}}, "--mesh random is not used: mesh needs --on strip (on = law)"},
      {"kes",
       {{"rate", 5}},
       "--rate 5 is not used: rate needs a law that takes time: --law chapman, gong, kim, terzopoulos or all "
       "(law = prandtl)"},
      {"kes",
       {{"rate", 5}, {"law", "linear,chapman"}},
       "--rate 5 is not used: law linear, chapman takes no time, fabric cotton-broad having no branches that "
       "relax (fabric.bending.branches)"},
      {"fold",
       {{"fold.law-alone", true}, {"fold.period", 3}},
       "--fold.period 3 is not used: fold.period needs cloth, or a law that takes time: --law chapman, gong, "
       "kim or terzopoulos (fold.law-alone = true, law = prandtl)"},
      {"fab", {{"units", "fab"}}, "--units fab is not used: units needs --fab.data (no --fab.data)"},
      {"fab",
       {{"fab.test", "S1"}, {"fab.slack", 0.001}},
       "--fab.slack 0.001 is not used: fab.slack needs a test that bends (fab.test = S1)"},
      {"bench", {{"budget", 9}}, "--budget 9 is not used: budget needs --sizes (no --sizes)"},
      {"validate",
       {{"parts", "figure"}, {"samples", 9}},
       "--samples 9 is not used: samples needs --parts spread (parts = figure)"},
      {"fit",
       {{"kes.b", 1e-5}, {"kes.2hb", 1e-3}, {"ripple", 0.1}},
       "--ripple 0.1 is not used: ripple needs --loop (no --loop)"},
      {"fit",
       {{"virgin.b1", 1e-5}, {"virgin.c1", -1e-7}, {"kes.k0", 30}},
       "--kes.k0 30 is not used: kes.k0 needs --kes.2hb (no --kes.2hb)"},
      {"fit",
       {{"decay", "d.csv"}, {"units", "kes"}},
       "--units kes is not used: units needs --loop, or --fab (no --loop, no --fab)"},
      {"fit", {{"fab", "f.csv"}, {"offset", true}}, "--offset is not used: offset needs --loop (no --loop)"},
      {"fit",
       {{"loop", "f.csv"}, {"fab.noise", 0.1}},
       "--fab.noise 0.1 is not used: fab.noise needs --fab (no --fab)"}};
  for (const auto& [experiment, flags, message] : cases) EXPECT_EQ(said_to(experiment, flags), message);
}

// The conditions name the laws that take time, which the laws themselves know.
TEST(UnreadFlags, OfTimeAreReadByEveryLawThatTakesIt) {
  VirginCurve relaxing = Fabric{}.virgin_curve();
  relaxing.parts.branches = {{1.0}, {1e-5}};
  for (const LawEntry& law : law_catalogue())
    for (const auto& [experiment, key] : {std::pair{"kes", "rate"}, {"fold", "fold.period"}}) {
      const CommandLine line = {experiment, "", {{key, "5"}}, {}};
      const std::string said = test::refusal(
          [&, key = key] {
            refuse_unread_flags(
                line, {{"law", law.name}, {"fold.law-alone", true}, {"test", "bending"}, {key, 5.0}});
          },
          2);
      EXPECT_EQ(said == test::kAccepted, takes_time({law.name, relaxing, {}}))
          << experiment << " " << law.name;
    }
}

TEST(KeyConditions, RefuseKeysOfABuiltMeshBesideOneOfAFile) {
  const Folder folder;
  const std::string mesh = folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* key : {"triangles", "seed", "cloth.length", "cloth.radius", "cloth.texture-scale"})
    EXPECT_TRUE(
        said_to("run", {{"scene", "hanging-square"}, {"cloth.shape", "file"}, {"cloth.file", mesh}, {key, 2}})
            .starts_with("--" + std::string(key) + " 2 is not used: "))
        << key;
}

TEST(KeyConditions, CountADefaultAsGivenAndAnEmptyTextOrFalseNot) {
  const KeyValues values = {{"fold.law-alone", false}, {"errors", false}, {"look", "cloth"}};
  const auto refused = [&](const std::string& path, const std::string& text) {
    return test::refusal([&] {
             refuse_unread_flags(line_with("fold", {{path, text}}), values);
           }) != test::kAccepted;
  };
  EXPECT_TRUE(refused("fold.curvature", "150"));  // its default
  EXPECT_TRUE(refused("reference", "a-run"));
  EXPECT_FALSE(refused("reference", ""));
  EXPECT_FALSE(refused("fold.stroke", "0.4"));
}

TEST(KeyConditions, LeaveToEachOfSeveralRunsWhatDependsOnTheirDifference) {
  const KeyValues values = {{"integrator", "implicit"}, {"self-contact", false}};
  CommandLine line = line_with("crumple", {{"substeps", 20}});
  EXPECT_THROW(refuse_unread_flags(line, values), Error);
  line.listed = {"integrator"};
  EXPECT_NO_THROW(refuse_unread_flags(line, values));
}

// The standard is read first, and says how the specimen is let go.
TEST(KeyConditions, OfADrapeAreThoseOfItsStandard) {
  finished("drape --drape.standard jis --drape.shakes 2 --triangles 100 --explain");
  EXPECT_TRUE(says(refused("drape --drape.standard jis --drape.folds 2"), "(drape.release = shaken)"));
  const CommandLine line = line_with("drape", {{"drape.lowering", 1}, {"drape.disc", 0.08}});
  EXPECT_EQ(without_unread_flags(line, {"drape.release", "dropped"}),
            (std::vector<Flag>{{"drape.disc", 0.08}}));
}

// How pictures look may be said where none are drawn, what draws them may not; a repetition without pictures
// leaves it out.
TEST(KeyConditions, LeaveTheLookOfPicturesBesideNoImages) {
  const Flag size = {"size", "160x120"}, renderer = {"renderer", "osmesa"};
  const CommandLine line = line_with("drape", {size, {"quality", "draft"}, {"fps", 5}, {"no-images", true}});
  EXPECT_NO_THROW(refuse_unread_flags(line, {{"no-images", true}}));
  EXPECT_EQ(without_unread_flags(line_with("drape", {size, renderer}), {"no-images", true}),
            (std::vector<Flag>{size}));
}

TEST(KeyConditions, AreShownByHelp) {
  EXPECT_TRUE(says(finished("crease --help").out, "needs --crease.fold rod"));
  EXPECT_TRUE(says(finished("fit --help").out, "needs --loop"));
}

TEST(KeyConditions, OfAFileAreToldOfUnlessTheyAskForNothing) {
  const Folder folder;
  const std::string scene =
                        folder.write("s.toml",
                                     "seconds = 0.02\nstep = 0.01\ntriangles = 20\nsubsteps = 9\nramp = 0\n"
                                     "[cloth]\nradius = 0.2\nwidth = 0.5\n"),
                    dumped = folder.file("dumped.toml");
  const FinishedRun run("run --device cpu --no-images --scene " + scene);
  for (const char* warning :
       {"warning: substeps = 9 of the scene's file is not used: substeps needs --integrator semi-implicit or "
        "explicit (integrator = implicit)",
        "warning: cloth.radius = 0.2 of the scene's file is not used: "})
    EXPECT_TRUE(says(run.outcome.err, warning));
  EXPECT_FALSE(says(run.outcome.err, "ramp")) << "0 is its default";
  EXPECT_FALSE(says(run.outcome.err, "cloth.width")) << "0.5 m is its default";
  finished("run hanging-square --seconds 0.02 --triangles 20 --device cpu --dump-scene " + dumped);
  EXPECT_FALSE(says(FinishedRun("run --device cpu --no-images --scene " + dumped).outcome.err, "not used"));
}

TEST(LateTables, AreRefusedUnlessAFlagHasMadeTheSceneShorter) {
  const Folder folder;
  const std::string scene =
      folder.write("s.toml",
                   "seconds = 0.1\nstep = 0.01\ntriangles = 20\n"
                   "[[pin]]\nselect = \"nearest\"\nfrom = 0.1\n"
                   "[[obstacle]]\nkind = \"ground\"\ncenter = [0, 0, -1]\nfrom = 0.05\n");
  const std::string run = "run --device cpu --no-images --scene " + scene;
  EXPECT_TRUE(says(refused(run + " --explain"),
                   "pin[0].from = 0.1 s (" + scene +
                       ":6) is not used: the scene is over at seconds = 0.1 s (" + scene + ":1)"));
  const std::string shorter = FinishedRun(run + " --seconds 0.03").outcome.err;
  EXPECT_TRUE(says(shorter, "warning: pin[0].from = 0.1 s"));
  EXPECT_TRUE(says(shorter, "warning: obstacle[0].from = 0.05 s"));
  finished(run + " --seconds 0.2 --explain");
  const std::string dumped = folder.file("dumped.toml");
  finished(run + " --seconds 0.03 --dump-scene " + dumped);
  EXPECT_TRUE(says(FinishedRun("run --device cpu --no-images --scene " + dumped).outcome.err,
                   "warning: pin[0].from = 0.1 s"));
}

}  // namespace
}  // namespace hysteron::experiments
