// These tests compare the curvature of a cloth with that of another run of the same mesh.
#include <cmath>
#include <vector>

#include "sim/mesh/surface.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

const std::string kSmallSwing =
    " --triangles 60 --seconds 0.1 --fps 30 --device cpu --size 160x120 --quality draft --quiet";

double last_difference(const fs::path& column) {  // [1/m]
  const auto manifest = manifest_in(column);
  return manifest["frames"]["moments"].back()["difference_rms_per_m"].get<double>();
}

TEST(Compare, SubtractsTheCurvatureOfAColumn) {
  const FinishedRun run(
      "compare swing --fabrics cotton-broad,feng2022-median --law prandtl --compare.to "
      "cotton-broad --compare.difference curvature --compare.rows 2" +
      kSmallSwing);
  EXPECT_TRUE(fs::exists(run.out / "cotton-broad/mesh/0003.ply"));
  EXPECT_TRUE(fs::exists(run.out / "feng2022-median/frames-difference/0003.png"));
  EXPECT_GT(last_difference(run.out / "feng2022-median"), 1);
  // Colours mean the same in every column: the larger k0 of the two counts, as half of 2 k0.
  const auto looks = manifest_in(run.out / "feng2022-median")["frames"]["looks"];
  EXPECT_NEAR(looks["difference"]["high"].get<double>(), 98.43617921, 1e-4);
}

// By a flag or by the scene's file, before any column has run.
TEST(Compare, SubtractsNoCurvatureWithoutPictures) {
  const Folder folder;
  const std::string scene = folder.write("still.toml", "no-images = true\nseconds = 0.01\n");
  for (const std::string& what : {std::string("swing --no-images"), scene}) {
    const Outcome outcome = program(
        "compare " + what + " --laws linear,prandtl --compare.to linear --compare.difference curvature" +
        out_flag(folder.path() / "never"));
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "compare.difference = curvature needs pictures, and no-images draws none"));
  }
  EXPECT_FALSE(fs::exists(folder.path() / "never"));
}

// The same run gives no difference; another law gives what their exported meshes differ by.
TEST(Difference, OfARunToItselfIsNone) {
  const Folder folder;
  const auto run = [&](const std::string& name, const std::string& more) {
    return program("swing" + out_flag(folder.path() / name) + kSmallSwing + " " + more);
  };
  const std::string less = " --look difference --reference " + (folder.path() / "first").string();
  ASSERT_EQ(run("first", "--law linear --export ply").exit_code, 0);
  ASSERT_EQ(run("again", "--law linear" + less).exit_code, 0);
  ASSERT_EQ(run("other", "--law prandtl --export ply" + less).exit_code, 0);
  EXPECT_EQ(last_difference(folder.path() / "again"), 0);
  const auto curvature = [&](const char* name) {
    return read_surface((folder.path() / name / "mesh/0003.ply").string()).curvature;
  };
  const std::vector<double> a = curvature("first"), b = curvature("other");
  // Over the area of the strip, which is flat at first: a vertex stands for a third of its triangles.
  const Surface flat = read_surface((folder.path() / "first/mesh/0000.ply").string());
  double square = 0, area = 0;
  for (const Eigen::Vector3i& f : flat.face) {
    const Eigen::Vector3d &p = flat.vertex[f[0]], q = flat.vertex[f[1]] - p, r = flat.vertex[f[2]] - p;
    const double own = q.cross(r).norm() / 2;
    area += own;
    for (const int i : f) square += own / 3 * (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double expected = std::sqrt(square / area);
  ASSERT_GT(expected, 1);
  EXPECT_NEAR(last_difference(folder.path() / "other") / expected, 1, 1e-6);

  EXPECT_EQ(run("none", "--look difference").exit_code, 2);
  EXPECT_EQ(run("empty", "--look difference --reference " + (folder.path() / "again").string()).exit_code, 2);
  const Outcome finer = run("finer", "--triangles 200" + less);
  EXPECT_EQ(finer.exit_code, 2);
  EXPECT_TRUE(says(finer.err, "other triangles"));
}

// Among instants at 0, 1/30, 2/30 and 0.1 s those at 0 and 0.1 s are also the other run's and that at 0.05 s
// is none of them; a run that ended at 0.04 s has none at 0.05 and at 0.1 s.
TEST(Difference, LeavesOutInstantsThatTheOtherRunDoesNotHave) {
  const Folder folder;
  const auto run = [&](const std::string& name, const std::string& more) {
    const Outcome outcome = program("swing" + out_flag(folder.path() / name) + kSmallSwing + " " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  };
  const auto reference = [&](const char* name) {
    return " --look difference --reference " + (folder.path() / name).string();
  };
  const auto has_difference = [&](const char* name) {
    std::vector<bool> has;
    const Json manifest = manifest_in(folder.path() / name);
    for (const auto& instant : manifest["frames"]["moments"])
      has.push_back(instant.contains("difference_rms_per_m"));
    return has;
  };
  run("first", "--law linear --export ply");
  run("short", "--law linear --export ply --seconds 0.04");
  const Outcome other = run("other", "--fps 20" + reference("first"));
  EXPECT_TRUE(says(other.err, "has no instant within half a step of some of this run's pictures"));
  EXPECT_EQ(has_difference("other"), (std::vector<bool>{true, false, true}));
  run("beyond", "--fps 20" + reference("short"));
  EXPECT_EQ(has_difference("beyond"), (std::vector<bool>{true, false, false}));
}

// In a fraction of gravity the strip bends by less than 1/m in 0.03 s, so that its curvature is known between
// its instants, too: a run of the same strip differs by what a straight line between them leaves out.
TEST(Difference, IsTakenBetweenInstantsOfARunThatAllButRests) {
  const Folder folder;
  const auto run = [&](const std::string& name, const std::string& more) {
    const Outcome outcome = program("swing" + out_flag(folder.path() / name) + kSmallSwing +
                                    " --law linear --gravity 0,0,-0.5 " + more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  };
  run("first", "--export ply");
  const auto curvature = [&](const char* file) {
    return read_surface((folder.path() / "first/mesh" / file).string()).curvature;
  };
  const std::vector<double> a = curvature("0001.ply"), b = curvature("0002.ply");  // at 1/30 and at 2/30 s
  double change = 0;
  for (std::size_t i = 0; i < a.size(); ++i) change += (b[i] - a[i]) * (b[i] - a[i]);
  change = std::sqrt(change / static_cast<double>(a.size()));
  ASSERT_GT(change, 0.05);

  const Outcome between =
      run("between", "--fps 20 --look difference --reference " + (folder.path() / "first").string());
  EXPECT_FALSE(says(between.err, "has no instant")) << between.err;
  const Json at = manifest_in(folder.path() / "between")["frames"]["moments"][1];  // at 0.05 s
  EXPECT_GT(at["difference_rms_per_m"].get<double>(), 0);
  EXPECT_LT(at["difference_rms_per_m"].get<double>(), 0.2 * change);
}

// The triangles are the same, with every side twice as long.
TEST(Difference, RefusesARunOfAnotherRestShape) {
  const Folder folder;
  const std::string scene =
      folder.write("falling.toml",
                   "mesh = \"unionjack\"\ntriangles = 32\nstep = 0.01\nseconds = 0.02\n[cloth]\n"
                   "shape = \"square\"\nlength = 0.1\n");
  const auto run = [&](const std::string& name, const std::string& more) {
    return program("run " + scene + out_flag(folder.path() / name) +
                   " --fps 50 --device cpu --size 160x120 --quality draft --quiet " + more);
  };
  ASSERT_EQ(run("first", "--export ply").exit_code, 0);
  const std::string less = " --look difference --reference " + (folder.path() / "first").string();
  EXPECT_EQ(run("same", less).exit_code, 0);
  const Outcome larger = run("larger", "--cloth.length 0.2" + less);
  EXPECT_EQ(larger.exit_code, 2);
  EXPECT_TRUE(says(larger.err, "another rest shape")) << larger.err;
}

}  // namespace
}  // namespace hysteron::experiments
