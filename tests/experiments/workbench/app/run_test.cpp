#include "experiments/workbench/app/run.h"

#include <fstream>
#include <optional>

#include "sim/base/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

TEST(Manifest, ReportsWhatTheRunFound) {
  const Folder folder;
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  run.manifest().device = "cpu";
  run.manifest().triangles = 4608;
  run.metric("node_count", 5);
  run.metric("drape_coefficient_percent", 49.8);
  run.manifest().energy = {{"kinetic", 0.5}, {"bending_friction", 0.25}};
  run.add_seconds("solve", 2);
  run.add_seconds("solve", 3);
  { const ExperimentRun::Stage stage = run.stage("io"); }
  run.path("frames/0000.png");
  run.finish();
  const Json manifest = manifest_in(folder.path());
  EXPECT_EQ(manifest["device"], "cpu");
  EXPECT_EQ(manifest["triangles"], 4608);
  EXPECT_EQ(manifest["metrics"].dump(), R"({"node_count":5,"drape_coefficient_percent":49.8})");
  EXPECT_EQ(manifest["energy"]["bending_friction"], 0.25);
  EXPECT_EQ(manifest["wall_seconds"]["solve"], 5.0);
  EXPECT_GT(manifest["wall_seconds"]["io"], 0.0);
  EXPECT_EQ(manifest["files"], Json::array({"frames/0000.png"}));
  EXPECT_TRUE(fs::is_directory(folder.path() / "frames"));
  EXPECT_EQ(manifest["complete"], true);
}

TEST(Manifest, OfAnExperimentWithoutASceneHoldsItsOwnKeysAsTheScene) {
  const Folder folder;
  const Json keys = {{"law", "wong"}, {"fabric", {{"name", "mine"}}}};
  ExperimentRun run({"kes", "hysteron kes --law wong", {}, {}}, setup_in(folder.path()).options, keys);
  run.finish();
  const Json manifest = manifest_in(folder.path());
  EXPECT_EQ(manifest["scene"], keys);
  EXPECT_EQ(manifest["law"], "wong");
  for (const char* key : {"element", "precision", "triangles"}) {
    EXPECT_TRUE(manifest.contains(key) && manifest[key].is_null()) << key;
  }
}

TEST(Run, GoesOnWithoutAPlotThatFailsAndSaysSo) {
  const Folder folder;
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  const std::string page = "plot_b";
  run.plot(
      "plot_a", page, +[](const fs::path&, const std::string&) { throw Error::system("no gnuplot"); });
  run.plot(
      page, page, +[](const fs::path& base, const std::string& its) { EXPECT_EQ(base.filename(), its); });
  run.finish();
  const Json manifest = manifest_in(folder.path());
  EXPECT_EQ(manifest["plots_missing"], Json::array({"plot_a: no gnuplot"}));
  EXPECT_EQ(manifest["warnings"], Json::array({"the plot plot_a is missing: no gnuplot"}));
  EXPECT_EQ(manifest["files"], Json::array({"plot_b.png", "plot_b.svg"}));
}

// A disk that is full before the run ends.
TEST(Run, LeavesItToOthersToSayThatItsManifestCouldNotBeWritten) {
  const auto run_out_of_disk = [] {
    const Folder folder;
    std::optional<test::SmallDisk> full;  // until the run is gone
    testing::internal::CaptureStderr();
    try {
      ExperimentRun run(drape_line(), setup_in(folder.path()));
      full.emplace(10);
      throw Error::system("cannot write metrics.csv: No space left on device");
    } catch (const Error&) {
    }
    full.reset();
    const bool silent = testing::internal::GetCapturedStderr().empty();
    return silent && ExperimentRun::unwritten().find("manifest.json") != std::string::npos ? 0 : 1;
  };
  EXPECT_EQ(on_a_disk_with(1 << 20, run_out_of_disk), 0);
  EXPECT_EQ(ExperimentRun::unwritten(), "");
}

TEST(Manifest, OfARunThatCouldNotGoOnIsKeptAndIncomplete) {
  const Folder folder;
  try {
    ExperimentRun run(drape_line(), setup_in(folder.path()));
    run.metric("steps_done", 7);
    throw Error::simulation("no convergence");
  } catch (const Error&) {
  }
  const Json manifest = manifest_in(folder.path());
  EXPECT_EQ(manifest["complete"], false);
  EXPECT_EQ(manifest["metrics"]["steps_done"], 7);
}

TEST(Run, NeverRemovesWhatAManifestNamesOutsideItsFolder) {
  const Folder folder;
  const fs::path outside = folder.path() / "outside.txt", run_folder = folder.path() / "run";
  std::ofstream(outside) << "keep";
  fs::create_directories(run_folder);
  std::ofstream(run_folder / "manifest.json")
      << Json{{"hysteron", {}}, {"files", {"../outside.txt", outside.string()}}}.dump();
  ExperimentRun run(drape_line(), setup_in(run_folder));
  EXPECT_TRUE(fs::exists(outside));
}

TEST(Run, InAFolderThatCannotBeMadeIsAMachineErrorBeforeAnythingElse) {
  const Folder folder;
  std::ofstream(folder.path() / "file") << "no folder";
  const Error error =
      test::thrown_error([&] { ExperimentRun(drape_line(), setup_in(folder.path() / "file" / "out")); });
  EXPECT_EQ(error.exit_code(), 1);
  EXPECT_TRUE(says(error.what(), "cannot create the folder"));
}

TEST(Run, OnAFullDiskIsAMachineErrorAndLeavesNothingHalfWritten) {
  const Folder folder;
  const int exit_code = on_a_disk_with(100, [&] {
    try {
      ExperimentRun run(drape_line(), setup_in(folder.path()));
    } catch (const Error& error) {
      return error.exit_code();
    }
    return 0;
  });
  EXPECT_EQ(exit_code, 1);
  EXPECT_EQ(folder.names(), std::vector<std::string>{});
}

TEST(Run, PrintsItsManifestWhenAsked) {
  const Folder folder;
  auto setup = setup_in(folder.path());
  setup.options.json = true;
  testing::internal::CaptureStdout();
  ExperimentRun run(drape_line(), setup);
  run.metric("node_count", 5);
  run.finish();
  const Json printed = json_in(testing::internal::GetCapturedStdout(), "stdout");
  EXPECT_EQ(printed["metrics"]["node_count"], 5);
  EXPECT_EQ(printed["complete"], true);
}

}  // namespace
}  // namespace hysteron::experiments
