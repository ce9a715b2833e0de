// Probes record the cloth at material points against time (--probe).
#include <algorithm>
#include <cmath>

#include "sim/base/csv.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

constexpr double kFloatRounding = 1e-12;

// The strip is equally stiff along warp and weft, without viscosity.
const std::string kSwing =
    "swing --triangles 60 --seconds 0.1 --fps 60 --device cpu --threads 1 --quiet --fabric.weft-bending 1 "
    "--fabric.bias-bending 1 --fabric.damping 0 --no-images";

std::vector<double> column(const fs::path& table, const std::string& name) {
  return read_table(table).numbers(name);
}

// M = b2 K and nothing is left without moment, in each component; a row for each of metrics.csv.
void expect_linear(const std::string& element, const std::vector<std::string>& components) {
  const FinishedRun run(kSwing + " --law linear --probe 0.024,0.008 --element " + element);
  const fs::path probes = run.out / "probes.csv";
  const double b2 = run.manifest()["scene"]["fabric"]["b2"];
  for (const std::string& component : components) {
    const auto k = column(probes, "probe1_curvature" + component + " [1/m]"),
               m = column(probes, "probe1_moment" + component + " [N]"),
               left = column(probes, "probe1_residual_curvature" + component + " [1/m]");
    for (std::size_t i = 0; i < k.size(); ++i) {
      EXPECT_NEAR(m[i], b2 * k[i], kFloatRounding * b2 * std::abs(k[i])) << component;
      EXPECT_EQ(left[i], 0);
    }
  }
  // The first component is along the strip, which bends.
  EXPECT_GT(std::abs(column(probes, "probe1_curvature" + components[0] + " [1/m]").back()), 1);
  EXPECT_EQ(column(probes, "time [s]"), column(run.out / "metrics.csv", "time [s]"));
}

TEST(Probes, InAFaceOfAnElasticLawHaveItsRigidityTimesTheCurvature) {
  expect_linear("shape", {"_warp", "_weft", "_twist"});
}

TEST(Probes, AtAHingeOfAnElasticLawHaveItsRigidityTimesTheCurvature) { expect_linear("hinge", {""}); }

// The strip is held up to 10 mm, and hangs down from there.
TEST(Probes, StayWhereTheClothIsHeldAndFallWhereItIsFree) {
  const FinishedRun run(kSwing + " --probe '0.009,0.011;0.08,0.02'");
  const fs::path probes = run.out / "probes.csv";
  for (const double x : column(probes, "probe1_x [m]")) EXPECT_NEAR(x, 0.009, kFloatRounding);
  for (const double y : column(probes, "probe1_y [m]")) EXPECT_NEAR(y, 0.011, kFloatRounding);
  for (const double z : column(probes, "probe1_z [m]")) EXPECT_EQ(z, 0);
  EXPECT_NEAR(column(probes, "probe2_x [m]").front(), 0.08, kFloatRounding);
  EXPECT_LT(column(probes, "probe2_z [m]").back(), -0.01);
  const std::vector<double> fraction = column(probes, "probe1_friction_share");
  EXPECT_LE(*std::max_element(fraction.begin(), fraction.end()), 1 + kFloatRounding);
}

TEST(Probes, AreThoseOfTheRunThatIsRunAgainAndChangeNothingInIt) {
  const FinishedRun first(kSwing + " --probe '0.02,0.01;0.08,0.02'"),
      again("rerun " + first.out.string() + " --quiet");
  EXPECT_EQ(file_content(again.out / "probes.csv"), file_content(first.out / "probes.csv"));
  const Json files = again.manifest()["files"];
  EXPECT_NE(std::find(files.begin(), files.end(), "probes.csv"), files.end());
  EXPECT_EQ(FinishedRun(kSwing).manifest()["state_hash"], first.manifest()["state_hash"]);
}

TEST(Probes, BesideTheClothAreRefusedWithWhereItLies) {
  const Folder folder;
  const fs::path out = folder.path() / "out";
  const auto refusal = [&](const std::string& experiment, const std::string& more) {
    const std::string said = refused(experiment + " --quick --device cpu" + out_flag(out) + more);
    EXPECT_FALSE(fs::exists(out));
    return said;
  };
  EXPECT_EQ(refusal("run hanging-square", " --probe '0,0;0.2,0.6'"),
            "hysteron run: probe = 0.2,0.6 is beside the cloth, which at rest has x in [0, 0.5] and y in "
            "[0, 0.5] m (--probe)\n");
  EXPECT_EQ(refusal("swing", " --probe '0.02;0.03'"),
            "hysteron swing: probe = 0.02 must be x,y[;x,y...], numbers in m (--probe)\n");
  EXPECT_TRUE(says(refusal("swing", " --probe 0.02,0.01 --cloth.shape tube"), "flat at rest"));
  EXPECT_TRUE(says(refusal("fold", " --probe 0.02,0.01 --fold.law-alone"), "no cloth"));
}

}  // namespace
}  // namespace hysteron::experiments
