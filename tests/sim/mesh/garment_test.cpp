#include "sim/mesh/garment.h"

#include <cmath>

#include "sim/scene/cloth.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

constexpr double kGarmentRadius = 0.1;  // [m]
constexpr double kGarmentRounding = 1e-12;

// A flat rectangle as the texture coordinates of one that is rolled about the y axis.
class Rolled : public testing::Test {
 protected:
  Rolled() {
    flat_ = make_grid(0.2, 0.1, 6, 3, MeshFamily::unionjack, 1);
    for (const Eigen::Vector3d& p : flat_.rest) {
      flat_.pattern.emplace_back(p.x(), p.y());
      rolled_.emplace_back(kGarmentRadius * std::sin(p.x() / kGarmentRadius), p.y(),
                           kGarmentRadius * (1 - std::cos(p.x() / kGarmentRadius)));
    }
    write_obj(file_.path(), flat_, rolled_);
  }

  ClothMesh flat_;
  std::vector<Eigen::Vector3d> rolled_;
  const TextFile file_{"", ".obj"};
};

TEST_F(Rolled, PatternIsTheClothAtRest) {
  const ClothMesh mesh = read_pattern(file_.path(), 0, 1);
  ASSERT_EQ(mesh.face, flat_.face);
  for (int v = 0; v < mesh.vertices(); ++v)
    EXPECT_LT((mesh.rest[v] - flat_.rest[v]).norm(), kGarmentRounding) << v;
  EXPECT_NEAR(test::total_area(mesh), 0.2 * 0.1, kGarmentRounding);
}

TEST_F(Rolled, ClothOfAPatternStartsWhereItsVerticesAre) {
  Scene scene;
  scene.cloth.shape = ClothOutline::pattern;
  scene.cloth.file = file_.path();
  scene.cloth.position = {0, 0, 1};
  const Cloth cloth = make_cloth(scene);
  for (std::size_t v = 0; v < rolled_.size(); ++v) {
    EXPECT_LT((cloth.start[v] - rolled_[v] - Eigen::Vector3d(0, 0, 1)).norm(), kGarmentRounding) << v;
    EXPECT_EQ(cloth.mesh.rest[v].z(), 0);
  }
}

TEST_F(Rolled, ClothStartsAsAnotherFileOfItsTrianglesHasIt) {
  const TextFile rest("", ".obj");
  write_obj(rest.path(), flat_, flat_.rest);
  Scene scene;
  scene.cloth.shape = ClothOutline::file;
  scene.cloth.file = rest.path();
  scene.cloth.start = file_.path();
  const Cloth cloth = make_cloth(scene);
  for (std::size_t v = 0; v < rolled_.size(); ++v) {
    EXPECT_LT((cloth.start[v] - rolled_[v]).norm(), kGarmentRounding) << v;
    EXPECT_LT((cloth.mesh.rest[v] - flat_.rest[v]).norm(), kGarmentRounding) << v;
  }
}

TEST_F(Rolled, StartOfOtherTrianglesIsRefused) {
  const ClothMesh finer = make_grid(0.2, 0.1, 8, 4, MeshFamily::unionjack, 1);
  EXPECT_TRUE(test::says(test::refusal([&] { read_start(file_.path(), 0, finer); }),
                         "36 triangles; where cloth starts it must have the same as at rest"));
}

TEST(Pattern, ThatIsNoFlatClothIsRefused) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::pair<const char*, const char*> kCases[] = {
      {"f 1 2 3\nf 1 3 4\n", "corners have none"},
      {"vt 0 0\nvt 9 0\nvt 9 9\nvt 0 9\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", "cloth.texture-scale = 0.111 m"},
      {"vt 0 0\nvt 1 0\nvt 1 1\nvt 1 0.2\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n", "triangle 2 is turned over"}};
  for (const auto& [text, message] : kCases) {
    const TextFile file(square + text, ".obj");
    EXPECT_TRUE(test::says(test::refusal([&] { read_pattern(file.path(), 0, 1); }), message)) << text;
  }
}

}  // namespace
}  // namespace hysteron
