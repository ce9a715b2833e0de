// When a membrane is said to lock.
#include "sim/membrane/locking.h"

#include <gtest/gtest.h>

#include "sim/scene/cloth.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::says;
// The specimen of a drape test, in cotton broad.
Scene drape(int triangles, double stiffness) {
  Scene scene;
  scene.cloth.shape = ClothOutline::disc;
  scene.cloth.radius = 0.15;
  scene.triangles = triangles;
  scene.fabric.warp = scene.fabric.weft = stiffness;
  scene.membrane_element = MembraneElement::constant;
  return scene;
}

std::string words_on(const Scene& scene) { return locking_warning(scene, make_cloth(scene).mesh); }

TEST(Locking, NumberIsStiffnessTimesTheSquareOfAnEdgeOverRigidity) {
  Scene scene;
  scene.mesh = "equilateral";
  scene.cloth.length = 0.2;
  scene.triangles = 400;
  scene.fabric.warp = 3e4;
  scene.fabric.weft = 2e4;
  scene.membrane_element = MembraneElement::constant;
  const ClothMesh mesh = make_cloth(scene).mesh;
  const double area = 0.04 / mesh.faces();  // sqrt(3)/4 h^2
  EXPECT_NEAR(locking_number(scene, mesh), 3e4 * 4 / std::sqrt(3.0) * area / scene.fabric.b2,
              1e-9 * locking_number(scene, mesh));
}

// 600 triangles drape to 76 % with 1 kN/m, to 84 with 10, to 91 with 100.
TEST(Locking, IsSaidOfRealStiffnessOnACoarseMesh) {
  for (const double stiffness : {1e5, 1e4}) {
    EXPECT_TRUE(says(words_on(drape(600, stiffness)), "may lock"));
    EXPECT_TRUE(says(words_on(drape(600, stiffness)), "membrane.element = nodal"));
  }
}

// 600 triangles with 4 kN/m are below the number that matters, with half of the rigidity above it.
TEST(Locking, GoesByTheMeanRigidityOfBothSides) {
  Scene scene = drape(600, 4e3);
  const ClothMesh mesh = make_cloth(scene).mesh;
  const double alike = locking_number(scene, mesh);
  EXPECT_EQ(words_on(scene), "");
  scene.fabric.bending.faces.bending = 0.1;
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(locking_number(scene, mesh) / alike, 1 / 0.55, kRounding);
  EXPECT_TRUE(says(words_on(scene), "(the mean of both sides)"));
}

// Means at nodes have the stiffness then; what triangles keep locks where edges are longer.
TEST(Locking, OfMeansAtNodesIsThatOfWhatTrianglesKeep) {
  Scene stiff = drape(600, 1e5);
  stiff.membrane_element = MembraneElement::nodal;
  EXPECT_EQ(words_on(stiff), "");
  stiff.triangles = 60;
  EXPECT_TRUE(says(words_on(stiff), "may lock"));
  EXPECT_FALSE(says(words_on(stiff), "membrane.element"));
}

TEST(Locking, IsNotSaidOfTheDefaults) {
  for (const int triangles : {600, 1000, 6000}) EXPECT_EQ(words_on(drape(triangles, 1000)), "") << triangles;
  EXPECT_EQ(words_on(Scene{}), "");
}

// It drapes to 87 %.
TEST(Locking, IsSaidOfAMembraneThatIsStiffAlongOneThreadOnly) {
  Scene scene = drape(600, 1000);
  scene.fabric.warp = 1e5;
  EXPECT_TRUE(says(words_on(scene), "may lock"));
}

}  // namespace
}  // namespace hysteron
