// A run is exported as one animated file, whose folder and warnings are checked.
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kExportedSwing = "swing --quick --no-images --threads 1 --device cpu --triangles 60 ";

bool has_file(const Json& manifest, const std::string& name) {
  const Json& files = manifest["files"];
  return std::find(files.begin(), files.end(), name) != files.end();
}

TEST(AnimationExport, LeavesOneFileAndNoKeptPositions) {
  const FinishedRun run(kExportedSwing + "--seconds 0.1 --export usd");
  EXPECT_TRUE(fs::exists(run.out / "mesh" / "cloth.usda"));
  EXPECT_FALSE(fs::exists(run.out / "mesh" / "cloth.pc2"));
  EXPECT_TRUE(has_file(run.manifest(), "mesh/cloth.usda"));
  EXPECT_FALSE(has_file(run.manifest(), "mesh/cloth.pc2"));
}

// Steps of a millisecond, all of which are instants.
TEST(AnimationExport, MoreMorphTargetsThanViewersBearAreWarnedOf) {
  const std::string line = kExportedSwing + "--step 1e-3 --fps 1000 --export glb --seconds ";
  EXPECT_FALSE(says(FinishedRun(line + "0.2").manifest()["warnings"].dump(), "morph targets"));
  EXPECT_TRUE(says(FinishedRun(line + "0.25").manifest()["warnings"].dump(),
                   "mesh/cloth.glb has 250 morph targets", "--fps 800 keeps no more"));
}

TEST(AnimationExport, AFileOfAnotherOriginIsNotReplaced) {
  const Folder folder;
  fs::create_directories(folder.path() / "mesh");
  folder.write("mesh/cloth.usda", "mine");
  EXPECT_TRUE(
      says(refused(kExportedSwing + "--seconds 0.1 --export usd" + out_flag(folder.path())), "cloth.usda"));
  EXPECT_EQ(file_content(folder.file("mesh/cloth.usda")), "mine");
}

}  // namespace
}  // namespace hysteron::experiments
