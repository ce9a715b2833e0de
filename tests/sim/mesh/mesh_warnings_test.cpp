// These tests check warnings about meshes that can be simulated but are hardly intended.
#include "sim/mesh/topology.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"

namespace hysteron {
namespace {

using test::says;
using Warnings = std::vector<std::string>;

// Returns the warnings about an OBJ with this content, without "mesh FILE: ".
Warnings obj_warnings(const std::string& content, double weld = 0) {
  const test::Folder folder;
  const std::string file = folder.write("cloth.obj", content);
  Warnings warnings;
  read_obj(file, weld, LengthUnit::metre, &warnings);
  for (std::string& warning : warnings) warning = warning.substr(("mesh " + file + ": ").size());
  return warnings;
}

// Every triangle with vertices of its own, as STL has them, with six digits.
std::string stl_soup(const ClothMesh& mesh) {
  std::ostringstream text;
  for (const Eigen::Vector3i& face : mesh.face)
    for (const int v : face) text << "v " << mesh.rest[v].transpose() << "\n";
  for (int f = 0; f < mesh.faces(); ++f)
    text << "f " << 3 * f + 1 << " " << 3 * f + 2 << " " << 3 * f + 3 << "\n";
  return text.str();
}

TEST(MeshWarnings, TrianglesThatShareNoVerticesAreCountedAndTheWeldIsNamed) {
  const ClothMesh mesh = make_grid(0.2, 0.2, 10, 10, MeshFamily::aligned, 0);
  const std::string soup = stl_soup(mesh);
  const Warnings warnings = obj_warnings(soup);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], "200 triangles in 200 parts that share no edge, with 0 hinges");
  const int coincident = 3 * mesh.faces() - mesh.vertices();
  EXPECT_TRUE(says(warnings[1], std::to_string(coincident) + " vertices on its boundary lie on others"));
  // The weld is a thousandth of the mean edge (20 mm and its diagonals), rounded down to a power of ten.
  EXPECT_TRUE(says(warnings[1], "cloth.weld = 1e-05 m joins them"));
  EXPECT_EQ(obj_warnings(soup, 1e-5), Warnings());
}

// The seam between two strips of n cells is stored twice.
TEST(MeshWarnings, SeamThatIsStoredTwiceIsCounted) {
  constexpr int n = 7;
  std::ostringstream text;
  for (const double low : {0.0, 0.02})
    for (int row = 0; row < 2; ++row)
      for (int i = 0; i <= n; ++i) text << "v " << 0.02 * i << " " << low + 0.02 * row << " 0\n";
  for (const int first : {1, 2 * (n + 1) + 1})
    for (int i = 0; i < n; ++i) {
      const int a = first + i, b = a + n + 1;
      text << "f " << a << " " << a + 1 << " " << b + 1 << " " << b << "\n";
    }
  const Warnings warnings = obj_warnings(text.str());
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(says(warnings[0], "in 2 parts"));
  EXPECT_TRUE(says(warnings[1], std::to_string(n + 1) + " vertices on its boundary"));
}

TEST(MeshWarnings, FansThatMeetInOneVertexAreNamed) {
  const Warnings warnings =
      obj_warnings("v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv -0.1 0 0\nv -0.1 -0.1 0\nf 1 2 3\nf 1 4 5\n");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], "2 triangles in 2 parts that share no edge, with 0 hinges");
  EXPECT_TRUE(says(warnings[1], "meet in 1 vertex alone (the first is the vertex of line 1)"));
}

// Closed fans have no boundary there that could be counted.
TEST(MeshWarnings, TipsOfTwoClosedConesMeet) {
  std::string text = "v 0 0 0\n";
  for (const char* z : {" 1", " -1"})
    for (const char* xy : {"v 1 0", "v 0 1", "v -1 -1"}) text += xy + std::string(z) + "\n";
  const Warnings warnings = obj_warnings(text + "f 1 2 3\nf 1 3 4\nf 1 4 2\nf 1 6 5\nf 1 7 6\nf 1 5 7\n");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(says(warnings[1], "two fans of triangles meet in 1 vertex"));
}

TEST(MeshWarnings, VertexWithinASideOfATriangleIsNamed) {
  const Warnings warnings = obj_warnings(
      "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nv 0.1 0.05 0\nv 0.2 0 0\nv 0.2 0.1 0\n"
      "f 1 2 3 4\nf 2 6 5\nf 5 6 7\nf 5 7 3\n");
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_TRUE(says(warnings[1], "1 vertex lies within sides of triangles"));
  EXPECT_TRUE(says(warnings[1], "the first is the vertex of line 5 on the triangle of line 8"));
  // The parts hang together at both ends of that side.
  EXPECT_TRUE(says(warnings[2], "meet in 2 vertices alone"));
}

TEST(MeshWarnings, LoneTriangleCannotBend) {
  EXPECT_EQ(obj_warnings("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
            Warnings{"one triangle with 0 hinges: it cannot bend"});
}

TEST(MeshWarnings, ThereAreNoneAboutAWholeCloth) {
  for (const MeshFamily family : {MeshFamily::aligned, MeshFamily::equilateral, MeshFamily::random}) {
    const MeshNames names{"mesh", {}, {}};
    EXPECT_EQ(mesh_warnings(make_rectangle(0.3, 0.2, 400, family, 1), names), Warnings());
    EXPECT_EQ(mesh_warnings(make_disc(0.15, 400, family, 1), names), Warnings());
  }
  EXPECT_EQ(mesh_warnings(make_tube(0.3, 0.05, 400, MeshFamily::unionjack, 1), {"mesh", {}, {}}), Warnings());
}

}  // namespace
}  // namespace hysteron
