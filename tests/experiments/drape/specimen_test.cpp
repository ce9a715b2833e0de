// A draped specimen is measured where it is, and refused where it is not a disc.
#include "experiments/drape/apparatus.h"

#include <cmath>
#include <fstream>
#include <numbers>

#include "experiments/drape/outline.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

constexpr double kRadius = 0.12;  // [m]

// The fixture drapes an OBJ with these vertices.
class Draped : public testing::Test {
 protected:
  Scene disc_scene(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& at) {
    write_obj(file(), mesh, at);
    Scene scene = default_scene();
    scene.cloth.shape = ClothOutline::file;
    scene.cloth.file = file();
    return scene;
  }
  std::string refusal(const Scene& scene) {
    return test::refusal([&] { disc_specimen(scene, make_cloth(scene)); });
  }
  // Returns a command line.
  std::string drape(const std::string& flags) const {
    return "drape --quick --no-images --quiet --device cpu --threads 1" + out_flag(folder_.path() / "out") +
           " " + flags;
  }
  std::string file() const { return (folder_.path() / "disc.obj").string(); }

  Folder folder_;
};

TEST_F(Draped, DiscIsMeasuredWhereverItLies) {
  const ClothMesh disc = make_disc(kRadius, 300, MeshFamily::random, 1);
  const Eigen::Vector3d middle(0.3, -0.2, 0.05);
  std::vector<Eigen::Vector3d> at;
  for (const Eigen::Vector3d& x : disc.rest) at.push_back(x + middle);
  const Scene scene = disc_scene(disc, at);
  const Specimen found = disc_specimen(scene, make_cloth(scene));
  EXPECT_NEAR(found.radius, kRadius, 1e-12);
  EXPECT_LT((found.middle - middle).norm(), 1e-12);
}

TEST_F(Draped, WhatIsNoFlatDiscIsRefused) {
  const ClothMesh square = make_grid(0.2, 0.2, 8, 8, MeshFamily::unionjack, 1);
  EXPECT_TRUE(says(refusal(disc_scene(square, square.rest)), "is no disc: its edge is 0.1 to 0.141 m"));
  const ClothMesh disc = make_disc(kRadius, 300, MeshFamily::random, 1);
  std::vector<Eigen::Vector3d> upright;
  for (const Eigen::Vector3d& x : disc.rest) upright.emplace_back(x.x(), 0, x.y());
  Scene scene = disc_scene(disc, upright);
  EXPECT_TRUE(says(refusal(scene), "m high and must lie flat"));
  scene.cloth.rotation = {90, 0, 0};
  EXPECT_NEAR(disc_specimen(scene, make_cloth(scene)).radius, kRadius, 1e-12);
}

TEST_F(Draped, CoefficientRefersToTheFileThatIsRead) {
  const ClothMesh disc = make_disc(kRadius, 200, MeshFamily::random, 1);
  disc_scene(disc, disc.rest);
  finished(drape("--cloth.shape file --cloth.file " + file() + " --seconds 0.01 --drape.release dropped"));
  const Json manifest = manifest_in(folder_.path() / "out");
  EXPECT_NEAR(manifest["specimen_radius_m"].get<double>(), kRadius, 1e-12);
  // It lies flat at first: the polygon of its rim, less the pedestal, over the ring.
  const int rim = 2 * disc.vertices() - disc.faces() - 2;
  const double polygon = rim / 2. * std::sin(2 * std::numbers::pi / rim) * kRadius * kRadius;
  std::ifstream series(folder_.path() / "out" / "metrics.csv");
  std::string line, time, fastest, percent;
  std::getline(series, line);
  ASSERT_TRUE(line.starts_with("time [s],fastest [m/s],drape_coefficient [%],")) << line;
  std::getline(std::getline(std::getline(series, time, ','), fastest, ','), percent, ',');
  EXPECT_EQ(std::stod(time), 0);
  constexpr double kRays = 1e-3;  // of the outline, 3600
  EXPECT_NEAR(std::stod(percent), drape_coefficient(polygon, 0.09, kRadius), kRays);
}

TEST_F(Draped, DiscThatLiesOnThePedestalIsRefused) {
  const ClothMesh disc = make_disc(0.08, 200, MeshFamily::random, 1);
  disc_scene(disc, disc.rest);
  EXPECT_TRUE(says(refused(drape("--cloth.shape file --cloth.file " + file())),
                   "drape.disc = 0.09 m must be < 0.08 m, the radius of mesh " + file()));
  refused(drape("--cloth.shape square --cloth.length 0.3"));
}

// The ring is 6 cm wide, and the pedestal has a radius of 9 cm; on one of 5 cm the ring is wider.
TEST_F(Draped, SpecimenThatLiesBesideThePedestalIsRefused) {
  EXPECT_TRUE(says(refused(drape("--drape.offset 0.06 --triangles 100")),
                   "drape.offset = 0.06 m must be < 0.06 m, the width of its ring"));
  EXPECT_TRUE(
      says(refused(drape("--drape.offset 0.2 --drape.disc 0.05 --triangles 100")),
           "drape.offset = 0.2 m must be < 0.05 m, drape.disc: the specimen's middle would lie beside"));
  finished("drape --drape.offset 0.055 --triangles 100 --explain");
}

// The specimen slides off the pedestal where there is no friction and the slope is steep.
TEST_F(Draped, CoefficientThatNoShadowHasIsNoResult) {
  const Outcome outcome = ended(
      3,
      drape("--triangles 200 --seconds 0.3 --drape.release dropped --fabric.friction 0 --gravity '60 0 -61' "
            "--integrator semi-implicit"));
  EXPECT_TRUE(says(outcome.err, "% of the ring, which must be 0 to 101"));
  const Json manifest = manifest_in(folder_.path() / "out");
  EXPECT_EQ(manifest["complete"], false);
  EXPECT_FALSE(manifest["metrics"].contains("drape_coefficient_percent"));
}

}  // namespace
}  // namespace hysteron::experiments
