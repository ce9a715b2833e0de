// Panels: islands of a texture that are sewn together along seams.
#include "sim/scene/cloth.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"
#include "tests/sim/mesh/panel_tube.h"

namespace hysteron {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::PanelTube;

constexpr double kPanelRounding = 1e-15;

constexpr auto moved = PanelTube::moved, turned = PanelTube::turned;

int seams(const ClothMesh& mesh) {
  int count = 0;
  for (int e = 0; e < mesh.interior_edges; ++e) count += is_seam(mesh, e);
  return count;
}

std::string refusal(const PanelTube& panels, double scale = 1) {
  return test::refusal([&] { panels.mesh(scale); });
}

TEST(Panels, SewnAtTwoSeamsMakeATube) {
  for (const auto& second : {moved, turned, PanelTube::mirrored}) {
    const ClothMesh mesh = PanelTube{.second = second}.mesh();
    EXPECT_TRUE(mesh.sewn);
    EXPECT_EQ(test::euler_characteristic(mesh), 0);
    EXPECT_EQ(seams(mesh), 2 * PanelTube::kAlong);
    EXPECT_EQ(test::total_area(mesh), PanelTube::area());
  }
}

TEST(Panels, OfTheWornClothWeighWhatTheFlatOnesDo) {
  const PanelTube larger{.second = moved, .worn = [](const Vector3d& x) { return 1.25 * x; }};
  const ClothMesh mesh = larger.mesh();
  double area = 0;
  for (const double a : mesh.vertex_area) area += a;
  EXPECT_NEAR(area, PanelTube::area(), kPanelRounding);
}

TEST(Panels, StartWhereTheVerticesAreAndPinsFindThemThere) {
  const TextFile file(PanelTube{.second = moved}.obj(), ".obj");
  Scene scene;
  scene.cloth.shape = ClothOutline::pattern;
  scene.cloth.file = file.path();
  scene.cloth.position = {0, 0, 1};
  Pin& ring = scene.pin.emplace_back();
  ring.low = {0, 0, 0};
  ring.high = {0, PanelTube::kSide, PanelTube::kSide};
  const Cloth cloth = make_cloth(scene);
  EXPECT_EQ(static_cast<int>(cloth.pin_vertices[0].size()), 4 * PanelTube::kCells);
  for (const Vector3d& x : cloth.start) {
    EXPECT_GE(x.z(), 1);
    EXPECT_LE(x.z(), 1 + PanelTube::kSide);
  }
}

TEST(Panels, RefuseAPinThatHoldsNoneOfThemWithWhereTheyAre) {
  const TextFile file(PanelTube{.second = moved}.obj(), ".obj");
  Scene scene;
  scene.cloth.shape = ClothOutline::pattern;
  scene.cloth.file = file.path();
  Pin& elsewhere = scene.pin.emplace_back();
  elsewhere.low = elsewhere.high = {0, 0, 1};
  EXPECT_TRUE(test::says(test::refusal([&] { make_cloth(scene); }),
                         "pin 1: its selection holds no vertex of the cloth, which reaches, where places are "
                         "chosen, from (0, 0, 0) to (0.5, 0.125, 0.125) m"));
}

TEST(Panels, TakeWarpFromTheirTexture) {
  ClothMesh mesh = PanelTube{.second = turned}.mesh();
  for (const double angle : {0.0, 0.7}) {  // of warp in the texture
    mesh.warp_axis = {std::cos(angle), std::sin(angle), 0};
    for (int f = 0; f < mesh.faces(); ++f) {
      EXPECT_LT((mesh.face_axes(f)[0] - mesh.warp_axis).norm(), kPanelRounding);
      EXPECT_LT((mesh.face_axes(f)[1] - Vector3d::UnitZ().cross(mesh.warp_axis)).norm(), kPanelRounding);
    }
  }
}

TEST(Panels, SeamIsAsLongAsTheMeanOfItsSides) {
  const auto longer = [](const Vector2d& at) { return Vector2d(1.5 * at.x(), at.y() + 1); };
  const ClothMesh mesh = PanelTube{.second = longer}.mesh();
  const double cell = PanelTube::kLength / PanelTube::kAlong;
  for (int e = 0; e < mesh.interior_edges; ++e)
    if (is_seam(mesh, e)) {
      EXPECT_EQ(mesh.edge_length(e), (cell + 1.5 * cell) / 2);
    }
}

TEST(Panels, TravelAsTextureCoordinates) {
  const test::Folder folder;
  const ClothMesh mesh = PanelTube{.second = turned}.mesh();
  write_obj(folder.file("tube.obj"), mesh, mesh.rest);
  const ClothMesh read = read_pattern(folder.file("tube.obj"), 0, 1);
  EXPECT_EQ(read.rest, mesh.rest);
  EXPECT_EQ(read.panel, mesh.panel);
}

TEST(Panels, InOtherUnitsAreScaled) {
  const PanelTube in_centimetres{.second = moved, .worn = [](const Vector3d& x) { return 0.01 * x; }};
  EXPECT_NEAR(test::total_area(in_centimetres.mesh(0.01)), 1e-4 * PanelTube::area(), kPanelRounding);
}

TEST(Panels, OfAnotherSizeThanTheWornClothAreRefusedWithTheScaleThatFits) {
  EXPECT_TRUE(test::says(refusal({.second = moved, .worn = [](const Vector3d& x) { return 2.5 * x; }}, 0.5),
                         "5 times as long as in texture coordinates of 0.5 m a unit, which must be 0.5 to 2; "
                         "cloth.texture-scale = 2.5 m"));
}

// Returns the warnings about the tube with other lengths along and around.
std::vector<std::string> warnings(double along, double around) {
  const auto stretched = [&](const Vector3d& x) {
    return Vector3d(along * x.x(), around * x.y(), around * x.z());
  };
  const TextFile file(PanelTube{.second = moved, .worn = stretched}.obj(), ".obj");
  std::vector<std::string> found;
  read_pattern(file.path(), 0, 1, LengthUnit::metre, &found);
  return found;
}

TEST(Panels, WhoseCoordinatesAreScaledEachByItsOwnAreDoubtedWithTheFactorThatMakesThemEqual) {
  for (const auto& [along, factor] : {std::pair(1.5, "1.5"), std::pair(0.75, "0.75")}) {
    const std::vector<std::string> found = warnings(along, 1);
    ASSERT_EQ(found.size(), 1u) << along;
    EXPECT_TRUE(test::says(found[0], std::string("multiply the first by ") + factor)) << found[0];
  }
}

TEST(Panels, OfDoubtfulSizeAreDoubtedWithTheScaleThatFitsAndThoseThatStrainAreNot) {
  const std::vector<std::string> found = warnings(0.75, 0.75);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(test::says(found[0], "sides are 0.75 times as long", "cloth.texture-scale = 0.75 m makes"));
  for (const double strained : {1 / 1.1, 1.0, 1.1}) {
    EXPECT_EQ(warnings(strained, 1), std::vector<std::string>()) << strained;
    EXPECT_EQ(warnings(strained, strained), std::vector<std::string>()) << strained;
  }
}

TEST(Panels, ThatAreFoldedOrHaveNoAreaAreRefused) {
  const PanelTube folded{
      .second = [](const Vector2d& at) { return Vector2d(std::abs(at.x() - 0.25), at.y()); }};
  EXPECT_TRUE(test::says(refusal(folded), "is turned over in its texture coordinates"));
  const PanelTube line{.second = [](const Vector2d& at) { return Vector2d(at.x(), 0); }};
  EXPECT_TRUE(test::says(refusal(line), "its texture coordinates: triangle 32 is degenerate"));
}

}  // namespace
}  // namespace hysteron
