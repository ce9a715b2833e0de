// The notes that end a run: from its facts, at most three lines, text alone.
#include "experiments/notes/notes.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest_file.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// The lines of a run's text that are notes.
std::vector<std::string> notes_in(const std::string& text) {
  std::vector<std::string> notes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("note: ")) notes.push_back(line);
  return notes;
}

Manifest manifest_of(const std::string& experiment, const Metrics& metrics,
                     const Json& keys = Json::object()) {
  Manifest manifest;
  manifest.experiment = experiment;
  manifest.metrics = metrics;
  manifest.keys = std::make_shared<const Json>(keys);
  manifest.complete = true;
  return manifest;
}

std::string first_note(const Manifest& manifest) {
  const Notes notes = notes_on(manifest);
  return notes.empty() ? "" : notes.front();
}

TEST(Notes, OfADrapeSayWhatMeshTesterAndAssumedNumbersLeaveOpen) {
  const FinishedRun run("drape --quick --no-images --triangles 100");
  const std::vector<std::string> notes = notes_in(run.outcome.out);
  ASSERT_EQ(notes.size(), kMostNotes) << run.outcome.out;
  EXPECT_TRUE(says(notes[0], " triangles are few, and "));
  EXPECT_TRUE(says(notes[0], "--errors"));
  EXPECT_TRUE(says(notes[1], "a disc of 300 mm on a pedestal of 180 mm"));
  EXPECT_TRUE(says(notes[1], "--drape.standard jis"));
  EXPECT_TRUE(says(notes[2], "bias-bending, shear, weft-bending and k0 are assumed"));
  EXPECT_TRUE(says(notes[2], "--fabrics cotton-broad"));
  EXPECT_TRUE(run.outcome.out.ends_with(notes[2] + "\n")) << "notes are the last lines";
  EXPECT_FALSE(says(run.manifest().dump(), "are assumed, not measured")) << "no file has them";
}

TEST(Notes, OfASwingThatIsTooShortAskForMoreOfIt) {
  const FinishedRun run("swing --quick --no-images --triangles 60");
  const std::vector<std::string> notes = notes_in(run.outcome.out);
  ASSERT_EQ(notes.size(), 1u) << run.outcome.out;
  EXPECT_TRUE(says(
      notes[0],
      "too little was seen, 1 turn, to tell how the swing dies: --seconds 4 "));  // ten times --quick's 0.4 s
}

TEST(Notes, OfAKesTestSayWhatALaboratoryPrintsAndWhatTheTesterDoesNotSee) {
  const FinishedRun run("kes --quick --no-images");
  const std::vector<std::string> notes = notes_in(run.outcome.out);
  ASSERT_EQ(notes.size(), kMostNotes) << run.outcome.out;
  EXPECT_TRUE(says(notes[0], "B = 0.118 gf cm2/cm and 2HB = 0.124 gf cm/cm"));  // as published for it
  EXPECT_TRUE(says(notes[1], "k0 = 8/m, assumed, does not show here"));
  EXPECT_TRUE(says(notes[2], "--on strip"));
}

TEST(Notes, OfAFitSayWhatIsOpenAndHowItIsDraped) {
  const FinishedRun run("fit --kes.b 8e-6 --kes.2hb 1e-3");
  const std::vector<std::string> notes = notes_in(run.outcome.out);
  ASSERT_EQ(notes.size(), 2u) << run.outcome.out;
  EXPECT_TRUE(says(notes[0], "the data do not determine b1 and k0: "));
  EXPECT_EQ(notes[1],
            "note: drape it: hysteron drape --errors --fabric " + (run.out / "fabric.toml").string());
}

TEST(Notes, AreAbsentFromQuietRunsAndFromJson) {
  for (const std::string flag : {" --quiet", " --json"})
    EXPECT_FALSE(says(FinishedRun("kes --quick --no-images" + flag).outcome.out, "note: ")) << flag;
}

TEST(Notes, AreOnlyGivenWhereThereIsSomethingToSay) {
  EXPECT_TRUE(notes_on(manifest_of("bench", {{"copy_bandwidth_GB_per_s", 20.0}})).empty());
  EXPECT_TRUE(notes_on(manifest_of("crease", {})).empty()) << "no angle was found";
  Manifest cut_short = manifest_of("drape", {{"drape_coefficient_percent", 80.0}});
  EXPECT_FALSE(notes_on(cut_short).empty());
  cut_short.complete = false;
  EXPECT_TRUE(notes_on(cut_short).empty()) << "its error says what there is to say";
}

TEST(Notes, NameTheLargestErrorAndWhatLessensIt) {
  Metrics metrics = {{"drape_coefficient_percent", 80.0},
                     {"drape_coefficient_percent_step_error", 0.2},
                     {"drape_coefficient_percent_mesh_error", 2.0},
                     {"drape_coefficient_percent_draw_error", 0.5}};
  EXPECT_EQ(
      first_note(manifest_of("drape", metrics)),
      "the largest error of the drape coefficient is that of the mesh's size: more --triangles lessen it");
  metrics.set("drape_coefficient_percent_draw_error", 3.0);
  EXPECT_TRUE(says(first_note(manifest_of("drape", metrics)), "--errors.draws"));
}

TEST(Notes, DoNotCallACoefficientOfMovingClothAResult) {
  Manifest manifest = manifest_of("drape", {{"drape_coefficient_percent", 80.0}, {"settled", false}});
  manifest.seconds_simulated = 2;
  EXPECT_EQ(
      notes_on(manifest),
      Notes{
          "the cloth is still moving, so that its coefficient is no result: --seconds 4 gives it more time"});
}

TEST(Notes, OfAValidationCountMeasuredDrapesAlone) {
  Metrics metrics = {{"mine.spread_has_measured", nullptr}};
  EXPECT_EQ(first_note(manifest_of("validate", metrics)), "");
  metrics.set("wool.spread_has_measured", true);
  EXPECT_TRUE(says(first_note(manifest_of("validate", metrics)), "1 of 1 measured drapes"));
}

TEST(Notes, OfABudgetNameTheNumberToMeasureFirst) {
  const Manifest manifest = manifest_of("validate", {{"wool.shear=30.change_percent", -2.0},
                                                     {"wool.bias-bending=1.42.change_percent", 4.0},
                                                     {"wool.tester=jis.change_percent", -9.9},
                                                     {"wool.mesh=24000.change_percent", 3.6}});
  EXPECT_TRUE(says(first_note(manifest), "bias-bending = 1.42 moves the drape of wool most, by +4.0 points"));
  EXPECT_TRUE(says(notes_on(manifest).at(1), "24000 triangles move it by +3.6 points"));
}

TEST(Notes, OfAComparisonWeighDifferencesByErrors) {
  Metrics metrics = {{"linear.drape_coefficient_percent", 62.0}, {"prandtl.drape_coefficient_percent", 82.0}};
  const Json keys = {{"compared", "drape"}, {"match", "fabric"}};
  EXPECT_EQ(first_note(manifest_of("compare", metrics, keys)),
            "the drape coefficient is 20 points more in prandtl than in linear; whether that is the mesh's "
            "doing is "
            "not known: "
            "--errors measures it");
  metrics.set("linear.drape_coefficient_percent_mesh_error", 2.0);
  EXPECT_TRUE(says(first_note(manifest_of("compare", metrics, keys)), ", 10 times the largest error"));
  metrics.set("linear.drape_coefficient_percent_mesh_error", 15.0);
  EXPECT_TRUE(says(first_note(manifest_of("compare", metrics, keys)), "no more than the errors allow"));
}

// The rigidity is c^3 times the weight of an area (ASTM D1388).
TEST(Notes, OfACantileverSayWhatAStandardReadsFromItsLength) {
  Json keys = {{"fabric", {{"name", "test"}, {"b2", 1e-5}, {"density", 0.1}, {"weft-bending", 0.4}}},
               {"gravity", {0, 0, -9.81}},
               {"cloth", {{"rotation", {0, 0, 0}}, {"warp-angle", 0}}}};
  const auto note = [&](const char* law) {
    Manifest manifest = manifest_of("cantilever", {{"bending_length_m", 0.03}}, keys);
    manifest.law = law;
    return first_note(manifest);
  };
  EXPECT_TRUE(says(note("prandtl"), "a rigidity of 26.5 uN m"));  // 0.03^3 * 0.1 * 9.81
  EXPECT_TRUE(says(note("prandtl"), "KES-FB2 reads 10.0"));
  for (const char* law : {"linear", "pabst", "obrien"}) EXPECT_EQ(note(law), "") << law << " has no friction";
  keys["cloth"]["warp-angle"] = 90;
  EXPECT_TRUE(says(note("prandtl"), "KES-FB2 reads 4.0")) << "along weft";
  keys["cloth"]["warp-angle"] = 45;
  EXPECT_EQ(note("prandtl"), "") << "KES-FB2 reads warp and weft";
  keys["cloth"]["warp-angle"] = 0;
  keys["gravity"] = {0, 0, -1.62};
  EXPECT_TRUE(says(note("prandtl"), "a rigidity of 4.4 uN m")) << "on the moon";
  keys["cloth"]["rotation"] = {0, 20, 0};
  EXPECT_EQ(note("prandtl"), "") << "the standard's strip is level";
}

// The strip sags to its back; a law without sides has the mean of both.
TEST(Notes, OfACantileverWhoseFacesDifferGoByTheSideThatItSagsTo) {
  const Json keys = {{"fabric", {{"name", "test"}, {"b2", 1e-5}, {"density", 0.1}, {"back-bending", 1.6}}},
                     {"gravity", {0, 0, -9.81}}};
  Manifest manifest = manifest_of("cantilever", {{"bending_length_m", 0.03}}, keys);
  manifest.law = "prandtl";
  EXPECT_TRUE(says(first_note(manifest), "KES-FB2 reads 16.0"));
  manifest.law = "dahl";
  EXPECT_TRUE(says(first_note(manifest), "KES-FB2 reads 13.0"));
}

TEST(Notes, OfAStudyCountWhatFailed) {
  EXPECT_TRUE(
      says(first_note(manifest_of("sweep", {{"runs_count", 8}, {"failed_count", 3}})), "3 of 8 runs"));
  EXPECT_TRUE(says(first_note(manifest_of("sweep", {{"runs_count", 8}, {"failed_count", 0}})), "seeds = 8"));
}

}  // namespace
}  // namespace hysteron::experiments
