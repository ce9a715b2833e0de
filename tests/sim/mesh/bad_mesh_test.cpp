#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::Folder;

const char* const kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kFan = std::string(kTriangle) + "v 0 0 1\nv 0 0 -1\n";

class BadObj : public testing::Test {
 protected:
  // Expects the refusal of a file with this content, in one line that names the file.
  void expect(const std::string& content, const std::string& message, double weld = 0) {
    const std::string file = folder_.write("bad.obj", content);
    EXPECT_EQ(test::refusal([&] { read_obj(file, weld); }), "mesh " + file + ": " + message);
  }

  Folder folder_;
};

TEST_F(BadObj, MissingFile) {
  const std::string file = folder_.file("none.obj");
  EXPECT_EQ(test::refusal([&] { read_obj(file, 0); }, 1),
            "cannot read mesh " + file + ": No such file or directory");
}

const char* const kNoObj = "not an OBJ: none of its lines is a vertex, \"v X Y Z\", or a face, \"f A B C\"";

TEST_F(BadObj, WhatIsNone) {
  for (const char* content : {"", "solid cube\nfacet normal 0 0 1\nvertex 0 0 0\n", "{\"asset\": {}}\n",
                              "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n0 0 0\n"})
    expect(content, kNoObj);
}

TEST_F(BadObj, VerticesWithoutFaces) { expect(kTriangle, "no triangles; a cloth needs at least one"); }

TEST_F(BadObj, BinaryContent) {
  expect(std::string("\0\1\2\377glTF\n\0\n", 10), "not an OBJ: it holds bytes that are no text");
}

TEST_F(BadObj, CoordinateThatIsNoFiniteNumber) {
  expect("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "line 2: coordinate \"nan\" must be a finite number");
  expect("v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n", "line 2: coordinate \"inf\" must be a finite number");
  expect("v 0 0 1e400\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: coordinate \"1e400\" must be a finite number");
  expect("v 0 0 0\nv 1 0,5 0\nv 0 1 0\nf 1 2 3\n", "line 2: coordinate \"0,5\" must be a finite number");
  expect(std::string(kTriangle) + "vt 0 x\nf 1 2 3\n", "line 4: coordinate \"x\" must be a finite number");
}

TEST_F(BadObj, VertexWithTwoCoordinates) { expect("v 0 0\n", "line 1: a vertex needs three coordinates"); }

TEST_F(BadObj, WeightOfAVertexThatIsNotOne) {
  expect("v 0 0 0 1\nv 2 0 0 2\nv 0 1 0\nf 1 2 3\n",
         "line 2: weight w = 2 of the vertex must be 1 or be left out: divide its coordinates by it, if they "
         "are "
         "homogeneous");
}

TEST_F(BadObj, IndicesOutOfRange) {
  expect(std::string(kTriangle) + "f 1 2 4\n", "line 4: the face uses vertex 4; the file has 3");
  expect(std::string(kTriangle) + "f 1 2 -9\n",
         "line 4: the face uses a vertex before the first; the file has 3");
  expect(std::string(kTriangle) + "vt 0 0\nf 1/1 2/1 3/2\n",
         "line 5: the face uses texture coordinate 2; the file has 1");
}

// 4294967297 is 1 in 32 bits.
TEST_F(BadObj, IndicesThatAreZeroOrBeyond32Bits) {
  const std::string allowed =
      "\" must be a vertex, vertex/texture or vertex/texture/normal, as whole numbers of 32 bits other than "
      "0";
  for (const std::string corner : {"0", "4294967297", "-4294967299", "1/99999999999", "1//99999999999", "1/",
                                   "1/2/", "1/1/1/1", "1.5", "one"})
    expect(kTriangle + ("f " + corner + " 2 3\n"), "line 4: corner \"" + corner + allowed);
}

// Records that no cloth needs may say what they like: tags announce how much is to be allocated for them.
TEST_F(BadObj, OtherRecordsArePassedOver) {
  const std::string file =
      folder_.write("other.obj", std::string(kTriangle) +
                                     "vn x y z\nl 1 99999999999\np 0\nt crease 2147483647/2147483647/-1 1\n"
                                     "vw 1 9 9\nmtllib /dev/zero\nusemtl none\nf 1//-1 2//-1 3//-1\n");
  EXPECT_EQ(read_obj(file, 0).faces(), 1);
}

TEST_F(BadObj, FaceWithTooFewOrTooManyCorners) {
  const std::string allowed = "; allowed are triangles and quads, triangulate the mesh first";
  expect(std::string(kTriangle) + "f 1 2\n", "line 4: a face of 2 corners" + allowed);
  expect(kFan + "f 1 2 3 4 5\n", "line 6: a face of 5 corners" + allowed);
}

TEST_F(BadObj, QuadWhoseSidesCross) {
  expect("v 0 0 0\nv 0.1 0.1 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3 4\n",
         "line 5: sides of the quad cross: its corners must follow one another around it");
}

// A reader that passes over unknown lines would lose the vertex and renumber all others.
TEST_F(BadObj, VertexThatIsWrittenOtherwise) {
  expect("V 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1: \"V\" must be plain \"v\"");
  expect("o a\n\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 2: \"\xEF\xBB\xBFv\" must be plain \"v\"");
}

TEST_F(BadObj, DegenerateTriangle) {
  expect(
      "v 0 0 0\nv 1 0 0\nv 2 0 0\n\nf 1 2 3\n",
      "the triangle of line 5 is degenerate (the vertex of line 1, the vertex of line 2, the vertex of line "
      "3): height over longest edge must be >= 1e-6");
  expect(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 1 2 3\n",
      "the triangle of line 4 is degenerate (the vertex of line 1, the vertex of line 2, the vertex of line "
      "2): height over longest edge must be >= 1e-6");
}

TEST_F(BadObj, WeldDistanceThatCollapsesATriangle) {
  expect(
      "v 0 0 0\nv 1 0 0\nv 1 0.01 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
      "the triangle of line 5 is degenerate (the vertex of line 1, the vertex of line 2, the vertex of line "
      "2): height over longest edge must be >= 1e-6",
      0.1);
}

TEST_F(BadObj, WeldDistanceBelowZero) { expect(kTriangle, "weld = -0.5 m must be >= 0", -0.5); }

TEST_F(BadObj, EdgeOfThreeTriangles) {
  expect(
      kFan + "f 1 2 3\nf 2 1 4\nf 1 2 5\n",
      "the edge between the vertex of line 1 and the vertex of line 2 is shared by 3 triangles (the third is "
      "the triangle of line 8), allowed are 2");
}

TEST_F(BadObj, NeighboursOfOppositeOrientation) {
  expect(
      std::string(kTriangle) + "v 0 0 1\nf 1 2 3\nf 1 2 4\n",
      "the triangle of line 5 and the triangle of line 6 have opposite orientation at the edge between the "
      "vertex of line 1 and the vertex of line 2; turn one over (a Moebius strip has no front)");
}

TEST_F(BadObj, TriangleGivenTwice) {
  expect(std::string(kTriangle) + "f 1 2 3\nf 1 3 2\n",
         "the triangle of line 4 and the triangle of line 5 have the same vertices; remove one");
}

TEST_F(BadObj, VertexOfNoTriangle) {
  expect(std::string(kTriangle) + "v 5 5 5\nf 1 2 3\n",
         "the vertex of line 4 belongs to no triangle; remove it");
}

ClothMesh triangle() {
  ClothMesh mesh;
  mesh.rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.face = {{0, 1, 2}};
  return mesh;
}

std::string refusal(ClothMesh mesh) {
  return test::refusal([&] { build_topology(mesh, "mesh made by hand"); });
}

TEST(BadTopology, MeshWithoutAFileIsNamedByNumbers) {
  ClothMesh mesh = triangle();
  mesh.face.emplace_back(1, 2, 3);
  EXPECT_EQ(refusal(mesh), "mesh made by hand: triangle 1 uses vertex 3, allowed are 0 to 2");
  mesh.face[1][2] = -1;
  EXPECT_EQ(refusal(mesh), "mesh made by hand: triangle 1 uses vertex -1, allowed are 0 to 2");
  mesh = triangle();
  mesh.rest[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(mesh), "mesh made by hand: vertex 1 is not a finite number");
  mesh = triangle();
  mesh.pattern.resize(2);
  EXPECT_EQ(refusal(mesh), "mesh made by hand: 2 pattern coordinates for 3 vertices; give one each or none");
}

TEST(BadTopology, DegenerateMeansRelativeToTheLongestEdge) {
  ClothMesh mesh = triangle();
  for (auto& x : mesh.rest) x *= 1e-9;  // tiny, but well shaped
  EXPECT_NO_THROW(build_topology(mesh, "small"));
  mesh = triangle();
  mesh.rest[2] = {0.5, 0.9e-6, 0};
  EXPECT_TRUE(test::says(refusal(mesh), "triangle 0 is degenerate"));
  mesh.rest[2] = {0.5, 1.1e-6, 0};
  EXPECT_NO_THROW(build_topology(mesh, "thin"));
}

}  // namespace
}  // namespace hysteron
