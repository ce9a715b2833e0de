// A key that experiments decide themselves is refused as a flag, and gives a warning where a file sets it.
#include "experiments/workbench/app/fixed_keys.h"

#include <algorithm>

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/manifest.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

std::string refusal(const std::string& experiment, const Flag& flag) {
  return test::refusal([&] {
    set_up({experiment, "hysteron " + experiment, {flag}, {}}, experiment_named(experiment).defaults());
  });
}

TEST(DecidedKeys, AreRefusedByName) {
  EXPECT_EQ(
      refusal("drape", {"cloth.position", Numbers{1, 0, 0}}),
      "--cloth.position 1 0 0: drape sets cloth.position itself: the specimen lies in the middle of the "
      "pedestal");
  EXPECT_EQ(refusal("fold", {"cloth.shape", "disc"}),
            "--cloth.shape disc: fold sets cloth.shape itself: the specimen is a strip");
  EXPECT_EQ(refusal("cantilever", {"seconds", 9}),
            "--seconds 9: cantilever sets seconds itself: the weight grows in ramp and goes in unload");
  EXPECT_EQ(refusal("crease", {"mesh", "random"}),
            "--mesh random: crease does not use mesh: its mesh has its finest columns along the crease");
  refused("buckle --gravity '0 0 -1' --no-images");
  EXPECT_EQ(
      program("cantilever --gamma 1 --fabric.density 0.1 --no-images --out /nonexistent/x").err,
      "hysteron cantilever: --fabric.density 0.1: cantilever sets fabric.density itself: gamma says how "
      "heavy the strip is\n");
  EXPECT_EQ(program("swing --cloth.copies 3 --explain").err,
            "hysteron swing: --cloth.copies 3: swing does not use cloth.copies: the specimen is one flat "
            "rectangle, meshed to fit its clamp\n");
}

// With the value that the experiment has by itself, too.
TEST(DecidedKeys, OfEveryExperimentAreKeysThatItTakesNoFlagOf) {
  const std::vector<std::string> tables = {"pin", "obstacle", "command", "phase"};
  for (const Experiment& experiment : experiments()) {
    const std::vector<KeyDescription> taken = experiment_options(experiment, Defaults::left_out),
                                      known = scene_keys();
    for (const FixedKey& key : experiment.fixed_keys()) {
      EXPECT_FALSE(has_key(taken, key.path)) << experiment.name << " " << key.path;
      if (std::count(tables.begin(), tables.end(), key.path)) continue;
      EXPECT_TRUE(has_key(known, key.path)) << key.path;
      EXPECT_TRUE(refusal(experiment.name, {key.path, "1"}).starts_with("--" + key.path + " 1: "))
          << key.path;
    }
  }
}

// Paths of all that the patch changes, tables by their names.
void changed_in(const Json& patch, const std::string& prefix, std::vector<std::string>& paths) {
  for (const auto& [name, value] : patch.items())
    value.is_object() ? changed_in(value, prefix + name + ".", paths) : paths.push_back(prefix + name);
}

// The manifest tells what was asked for where the experiment has done something else: steps and sizes that
// are made to fit, a parameter that nobody gave, and what it decides.
TEST(DecidedKeys, AreAllThatAnExperimentChangesButWhatItMakesFit) {
  const std::vector<std::string> fitted = {"triangles", "step", "cloth.length", "param.fatigue.dc"};
  const std::pair<const char*, const char*> runs[] = {
      {"drape", "--triangles 150 --seconds 0.05"},
      {"fold", "--triangles 60 --fold.cycles 1 --fold.period 0.2"},
      {"cantilever", "--triangles 32"},
      {"buckle", "--triangles 80"},
      {"crease", "--triangles 60 --crease.fold pleat --crease.recovery 0.02"},
      {"swing", "--triangles 40 --seconds 0.05"}};
  for (const auto& [name, flags] : runs) {
    const FinishedRun run(std::string(name) + " " + flags + " --device cpu --no-images --quiet");
    std::vector<std::string> changed;
    changed_in(run.manifest()["asked"], "", changed);
    for (std::string path : changed) {
      if (path.starts_with("origin.")) path.erase(0, std::string("origin.").size());  // of a key it decides
      const bool known = has_key(experiment_named(name).fixed_keys(), path);
      const bool of_swing =
          name == std::string("swing") && path == "pin";  // which has one if the scene has none
      EXPECT_TRUE(known || of_swing || std::count(fitted.begin(), fitted.end(), path) ||
                  (name == std::string("drape") && path == "obstacle"))
          << name << " changes " << path;
    }
  }
}

// Runs a cantilever with this scene file.
FinishedRun strip_run(const std::string& scene) {
  return FinishedRun("cantilever --triangles 32 --device cpu --no-images --quiet --scene " + scene);
}

TEST(Strips, WarnOfWhatAFileAsksForAndDoesNotGet) {
  const Folder folder;
  const std::string scene = folder.write(
      "strip.toml", "seconds = 9\n[cloth]\ncopies = 2\nwidth = 0.02\n[[pin]]\nselect = \"nearest\"\n");
  const FinishedRun run = strip_run(scene);
  for (const std::string& words :
       {"cloth.copies = 2 (" + scene + ":3) is not used: cantilever does not use cloth.copies",
        "seconds = 9.0 (" + scene + ":1) is not used: cantilever sets seconds itself",
        "[[pin]] (" + scene + ":5) is not used: cantilever sets pin itself"}) {
    EXPECT_TRUE(says(run.outcome.err, "warning: " + words));
    EXPECT_TRUE(says(file_content(run.out / "report.html"), "Warning: " + words)) << words;
  }
  EXPECT_FALSE(says(run.outcome.err, "cloth.width"));
}

TEST(Strips, OfADumpedFileAskForNothingElse) {
  const Folder folder;
  const std::string dumped = folder.file("dumped.toml");
  finished("cantilever --triangles 32 --device cpu --dump-scene " + dumped);
  EXPECT_FALSE(says(strip_run(dumped).outcome.err, "is not used"));
}

// Its file has a density, as every fabric's has: naming it asks for nothing that is lost.
TEST(Strips, NameWhoHasSetTheirDensityAndBlameNeitherTheFabricNorLengths) {
  const FinishedRun run(
      "cantilever --triangles 32 --device cpu --no-images --quiet --fabric wool-tropical --gamma 0.1");
  const std::string warnings = run.manifest()["warnings"].dump();
  EXPECT_TRUE(says(warnings, "kg/m^2 (set by cantilever: gamma says how heavy the strip is) is unusual"));
  for (const char* blame : {"wool-tropical.toml", "is not used", "lengths are in metres"})
    EXPECT_FALSE(says(warnings, blame)) << warnings;
}

}  // namespace
}  // namespace hysteron::experiments
