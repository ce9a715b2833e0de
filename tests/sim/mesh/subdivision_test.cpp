#include "sim/mesh/builders.h"

#include <gtest/gtest.h>

#include "sim/scene/cloth.h"
#include "tests/sim/mesh/mesh_measures.h"
#include "tests/sim/mesh/panel_tube.h"

namespace hysteron {
namespace {

TEST(Subdivision, CutsEachTriangleIntoFourEqualOnes) {
  const ClothMesh mesh = make_disc(0.15, 200, MeshFamily::random, 1), fine = subdivided(mesh);
  EXPECT_EQ(fine.vertices(), mesh.vertices() + static_cast<int>(mesh.edge.size()));
  EXPECT_EQ(test::euler_characteristic(fine), 1);
  ASSERT_EQ(fine.faces(), 4 * mesh.faces());
  for (int f = 0; f < fine.faces(); ++f)
    EXPECT_NEAR(fine.face_area[f], mesh.face_area[f / 4] / 4, test::kSumRounding) << f;
}

TEST(Subdivision, TurnsNoTriangleOver) {
  const ClothMesh fine = subdivided(make_rectangle(1, 1, 50, MeshFamily::random, 1));
  for (int f = 0; f < fine.faces(); ++f)
    EXPECT_NEAR(fine.face_axes(f)[0].cross(fine.face_axes(f)[1]).z(), 1, 1e-14);
}

TEST(Subdivision, KeepsPanelsAndTheirSeams) {
  const ClothMesh fine = subdivided(test::PanelTube{.second = test::PanelTube::turned}.mesh());
  EXPECT_TRUE(fine.sewn);
  EXPECT_EQ(test::total_area(fine), test::PanelTube::area());
  int seams = 0;
  for (int e = 0; e < fine.interior_edges; ++e) seams += is_seam(fine, e);
  EXPECT_EQ(seams, 4 * test::PanelTube::kAlong);
}

TEST(Subdivision, StartsInTheMiddlesOfTheFilesEdges) {
  const ClothMesh flat = make_grid(0.2, 0.1, 2, 1, MeshFamily::aligned, 1);
  std::vector<Eigen::Vector3d> bent = flat.rest;
  for (Eigen::Vector3d& x : bent) x.z() = x.x() * x.x();
  const TextFile rest("", ".obj"), start("", ".obj");
  write_obj(rest.path(), flat, flat.rest);
  write_obj(start.path(), flat, bent);
  Scene scene;
  scene.cloth.shape = ClothOutline::file;
  scene.cloth.file = rest.path();
  scene.cloth.start = start.path();
  scene.cloth.subdivisions = 1;
  const Cloth cloth = make_cloth(scene);
  ASSERT_EQ(cloth.mesh.faces(), 4 * flat.faces());
  for (std::size_t e = 0; e < flat.edge.size(); ++e) {
    const Eigen::Vector3d middle = (bent[flat.edge[e].p2] + bent[flat.edge[e].p3]) / 2;
    EXPECT_EQ(cloth.start[flat.vertices() + e], middle);
  }
}

}  // namespace
}  // namespace hysteron
