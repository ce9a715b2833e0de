// A simulation is refused before it begins where another's file has a name that it will write.
#include <fstream>

#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

// Runs have few triangles and a short time.
class ForeignFiles : public testing::TestWithParam<const char*> {};

TEST_P(ForeignFiles, AreRefusedBeforeTheSimulation) {
  const std::string command =
      std::string(GetParam()) + " --size 64x48 --threads 1 --device cpu --quiet --out ";
  const Folder first;
  finished(command + (first.path() / "out").string());
  const auto manifest = manifest_in(first.path() / "out");
  ASSERT_GT(manifest["files"].size(), 3u);
  for (const std::string name : manifest["files"]) {
    const Folder folder;
    const fs::path foreign = folder.path() / name;
    fs::create_directories(foreign.parent_path());
    std::ofstream(foreign) << "mine";
    EXPECT_TRUE(
        says(refused(command + folder.path().string()), foreign.string() + " is not of an earlier run"));
    EXPECT_EQ(file_content(foreign), "mine");
    EXPECT_EQ(fs::exists(folder.path() / "metrics.csv"), name == "metrics.csv") << name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ForeignFiles,
    testing::Values("drape --triangles 100 --seconds 0.02 --fps 100",
                    "swing --triangles 50 --seconds 0.05 --fps 20 --look cloth,curvature --probe 0.05,0.01",
                    "cantilever --triangles 32 --fps 2 --export ply",
                    "crease --crease.fold pleat --crease.recovery 0.05 --triangles 60 --fps 5"));

TEST(RunThatIsNotOver, GetsNoReport) {
  const Folder folder;
  ExperimentRun run(drape_line(), setup_in(folder.path()));
  EXPECT_EQ(refused("report " + folder.path().string()),
            "hysteron report: " + folder.path().string() + " is in use by another run: wait for its end\n");
  EXPECT_FALSE(fs::exists(folder.path() / "report.html"));
  run.finish();
}

}  // namespace
}  // namespace hysteron::experiments
