// Surfaces of files that another program wrote: what is taken, what is refused.
#include "sim/mesh/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::Folder;

const std::string kVertices = "property float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "property list uchar int vertex_indices\n";

// Returns an ASCII file of that many vertices and faces.
std::string ascii(int vertices, int faces, const std::string& body,
                  const std::string& vertex_properties = kVertices,
                  const std::string& face_properties = kFaces) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) + "\n" + vertex_properties +
         "element face " + std::to_string(faces) + "\n" + face_properties + "end_header\n" + body;
}

const std::string kCorners = "0 0 0\n1 0 0\n0 1 0\n";

TEST(PlySurface, ReadsWhatThisProgramWritesBitForBit) {
  const Folder folder;
  const ClothMesh mesh = make_disc(0.15, 300, MeshFamily::random, 2);
  std::vector<double> curvature;
  for (int v = 0; v < mesh.vertices(); ++v) curvature.push_back(1.0 / (v + 3));
  write_ply(folder.file("disc.ply"), mesh, mesh.rest, curvature);
  const Surface surface = read_surface(folder.file("disc.ply"));
  EXPECT_EQ(surface.vertex, mesh.rest);
  EXPECT_EQ(surface.face, mesh.face);
  EXPECT_EQ(surface.curvature, curvature);
  EXPECT_TRUE(surface.pattern.empty());
}

TEST(PlySurface, WithoutTheCurvaturePropertyHasNone) {
  const Folder folder;
  const ClothMesh mesh = make_grid(1, 1, 1, 1, MeshFamily::aligned, 0);
  write_ply(folder.file("a.ply"), mesh, mesh.rest, {});
  EXPECT_TRUE(read_ply(folder.file("a.ply")).curvature.empty());
}

TEST(PlySurface, AsciiWithCommentsOtherPropertiesElementsAndCarriageReturns) {
  const Folder folder;
  const std::string file = folder.write(
      "exported.ply",
      "ply\r\nformat ascii 1.0\r\ncomment exported\r\nobj_info none\r\nelement vertex 3\r\n"
      "property double x\r\nproperty double y\r\nproperty double z\r\nproperty uchar red\r\n"
      "property float32 curvature\r\nelement material 1\r\nproperty list uchar float colour\r\n"
      "element face 1\r\nproperty uchar flags\r\nproperty list uint8 uint32 vertex_index\r\nend_header\r\n"
      "0 0 -2.5e-1 255 0.5\r\n1 0 0 255 1\r\n0 1 0 255 1.5\r\n3 0.1 0.2 0.3\r\n7 3 2 0 1\r\n");
  const Surface surface = read_ply(file);
  ASSERT_EQ(surface.vertex.size(), 3u);
  EXPECT_EQ(surface.vertex[0], Eigen::Vector3d(0, 0, -0.25));
  EXPECT_EQ(surface.curvature, (std::vector<double>{0.5, 1, 1.5}));
  EXPECT_EQ(surface.face, std::vector<Eigen::Vector3i>{Eigen::Vector3i(2, 0, 1)});
}

// Returns the bytes of a number with the most significant one first.
template <class T>
std::string big_endian(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

TEST(PlySurface, BinaryOfTheOtherByteOrder) {
  const Folder folder;
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex 3\n" + kVertices +
                      "element face 1\nproperty list int int vertex_indices\nend_header\n";
  for (const float x : {0.f, 0.f, 0.f, 1.5f, 0.f, 0.f, 0.f, -2.25f, 0.f}) bytes += big_endian(x);
  for (const int i : {3, 0, 1, 2}) bytes += big_endian(i);
  const Surface surface = read_ply(folder.write("big.ply", bytes));
  EXPECT_EQ(surface.vertex[1], Eigen::Vector3d(1.5, 0, 0));
  EXPECT_EQ(surface.vertex[2], Eigen::Vector3d(0, -2.25, 0));
  EXPECT_EQ(surface.face, std::vector<Eigen::Vector3i>{Eigen::Vector3i(0, 1, 2)});
}

TEST(PlySurface, VerticesOfNoFaceAreLeftOutWithTheirCurvature) {
  const Folder folder;
  const Surface surface =
      read_ply(folder.write("loose.ply", ascii(5, 1, "9 9 9 1\n0 0 0 2\n1 0 0 3\n8 8 8 4\n0 1 0 5\n3 1 2 4\n",
                                               kVertices + "property double curvature\n")));
  EXPECT_EQ(surface.vertex, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(surface.curvature, (std::vector<double>{2, 3, 5}));
  EXPECT_EQ(surface.face, std::vector<Eigen::Vector3i>{Eigen::Vector3i(0, 1, 2)});
}

// A surface that could not be simulated can be drawn.
TEST(ObjSurface, TakesEdgesOfThreeFacesTurnedNeighboursAndFacesWithoutArea) {
  const Folder folder;
  const Surface surface = read_surface(folder.write(
      "soup.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 2\n"));
  EXPECT_EQ(surface.face.size(), 4u);
}

TEST(ObjSurface, TextureBecomesThePatternUnlessItHasSeams) {
  const Folder folder;
  const std::string start = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 7 7 7\nvt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\n";
  const Surface whole = read_surface(folder.write("a.obj", start + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n"));
  EXPECT_EQ(whole.pattern, (std::vector<Eigen::Vector2d>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_TRUE(read_surface(folder.write("b.obj", start + "f 1/1 2/2 3/3\nf 1/2 3/3 4/4\n")).pattern.empty());
  // A face without texture continues that of its neighbour.
  const Surface partly = read_surface(folder.write("c.obj", start + "f 1/1 2/2 3/3\nf 1 3 4\n"));
  ASSERT_EQ(partly.pattern.size(), 4u);
  for (int v = 0; v < 4; ++v) EXPECT_NEAR((partly.pattern[v] - whole.pattern[v]).norm(), 0, 1e-12) << v;
}

class BadSurface : public testing::Test {
 protected:
  // Expects the refusal of a file with this content, in one line that names the file.
  void expect(const std::string& content, const std::string& message, const std::string& name = "bad.ply") {
    const std::string file = folder_.write(name, content);
    EXPECT_EQ(test::refusal([&] { read_surface(file); }), "mesh " + file + ": " + message);
  }

  Folder folder_;
};

TEST_F(BadSurface, MissingFileIsTheMachinesFault) {
  EXPECT_NE(test::refusal([&] { read_surface(folder_.file("none.ply")); }, 1), test::kAccepted);
}

TEST_F(BadSurface, OtherEnding) { expect("", "its name must end in .obj or .ply", "bad.stl"); }

TEST_F(BadSurface, WithoutFaces) {
  expect("v 0 0 0\n", "no faces", "bad.obj");
  expect(ascii(3, 0, kCorners), "no faces");
  expect("ply\nformat ascii 1.0\nelement vertex 3\n" + kVertices + "end_header\n" + kCorners, "no faces");
}

TEST_F(BadSurface, HeaderThatIsNone) {
  expect("", "line 1: the header has no end_header");
  expect("solid cube\n", "line 1: a PLY file begins with \"ply\"");
  expect("ply\nformat ascii 1.0\n", "line 3: the header has no end_header");
  expect("ply\ncomment first\nformat ascii 1.0\nend_header\n",
         "line 2: needs \"format\" with ascii, binary_little_endian or binary_big_endian, and a version");
  expect("ply\nformat ascii 1.0\nproperty int x\nend_header\n",
         "line 3: a property before the first element");
  expect("ply\nformat ascii 1.0\nelement vertex many\nend_header\n",
         "line 3: \"many\" is no number of elements");
  expect("ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\nend_header\n",
         "line 4: the type \"half\" is unknown");
  expect("ply\nformat ascii 1.0\nvertices 3\nend_header\n",
         "line 3: \"vertices\" is unknown; allowed: element, property, comment, obj_info, end_header");
}

TEST_F(BadSurface, PropertiesOfOtherTypes) {
  expect(ascii(3, 1, kCorners + "3 0 1 2\n", "property int x\nproperty int y\nproperty int z\n"),
         "line 3: the vertices need x, y and z of type float or double");
  expect(ascii(3, 1, kCorners + "3 0 1 2\n", "property float x\nproperty float y\n"),
         "line 3: the vertices need x, y and z of type float or double");
  expect(ascii(3, 1, "0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2\n", kVertices + "property int curvature\n"),
         "line 3: the vertices' curvature must be of type float or double");
  expect(ascii(3, 1, kCorners + "3 0 1 2\n", kVertices, "property list uchar float vertex_indices\n"),
         "line 7: the faces need a list vertex_indices or vertex_index of type int or uint");
}

TEST_F(BadSurface, NumbersThatAreMissingOrTooMany) {
  expect(ascii(3, 1, kCorners + "3 0 1\n"), "item 0 of the 1 of \"face\": a number is missing or malformed");
  expect(ascii(3, 1, "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"),
         "item 1 of the 3 of \"vertex\": a number is missing or malformed");
  expect(ascii(3, 1, kCorners + "3 0 1 2\n3 0 1 2\n"),
         "it goes on after the last item that its header announces");
  const std::string huge = std::to_string(1000 * 1000 * 1000);
  expect("ply\nformat ascii 1.0\nelement vertex " + huge + "\n" + kVertices + "element face 1\n" + kFaces +
             "end_header\n" + kCorners,
         "line 3: the file is too short for " + huge + " items of \"vertex\"");
  expect("ply\nformat ascii 1.0\nelement vertex 3\n" + kVertices + "element face 1\n" + kFaces +
             "element nothing " + huge + "\nend_header\n" + kCorners + "3 0 1 2\n",
         "line 9: the file is too short for " + huge + " items of \"nothing\"");
}

TEST_F(BadSurface, BinaryThatBreaksOff) {
  const ClothMesh mesh = make_grid(1, 1, 2, 2, MeshFamily::aligned, 0);
  write_ply(folder_.file("whole.ply"), mesh, mesh.rest, {});
  const std::string bytes = test::file_content(folder_.file("whole.ply"));
  expect(bytes.substr(0, bytes.size() - 3), "item 7 of the 8 of \"face\": a number is missing or malformed");
}

// Nothing is allocated for a list before it is known to be there.
TEST_F(BadSurface, ListsLongerThanTheFile) {
  const std::string problem = "item 0 of the 1 of \"face\": a number is missing or malformed";
  const std::string faces = "property list uint int vertex_indices\n";
  for (const std::string count : {"4294967295", "99999999999", "100", "-1", "x"})
    expect(ascii(3, 1, kCorners + count + " 0 1 2\n", kVertices, faces), problem);
  std::string binary = ascii(1, 1, "", kVertices, faces) + std::string(12, '\0');
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  expect(binary + std::string(4, '\xFF') + std::string(12, '\0'), problem);
  expect(ascii(3, 1, kCorners + "3 0 1 2\n", kVertices, "property list float int vertex_indices\n"),
         "line 8: a list counts its items in integers");
}

TEST_F(BadSurface, PositionsThatAreNotFinite) {
  ClothMesh mesh = make_grid(1, 1, 1, 1, MeshFamily::aligned, 0);
  mesh.rest[2].y() = std::numeric_limits<double>::quiet_NaN();
  write_ply(folder_.file("nan.ply"), mesh, mesh.rest, {});
  expect(test::file_content(folder_.file("nan.ply")), "vertex 2 is not a finite number");
  expect("v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "line 2: coordinate \"nan\" must be a finite number",
         "bad.obj");
}

TEST_F(BadSurface, FacesThatCannotBeDrawn) {
  expect(ascii(3, 1, kCorners + "3 0 1 3\n"), "face 0 uses vertex 3; the file has 3, counted from 0");
  expect(ascii(3, 1, kCorners + "3 0 1 -1\n"), "face 0 uses vertex -1; the file has 3, counted from 0");
  expect(ascii(3, 2, kCorners + "3 0 1 2\n2 0 1\n"),
         "face 1 has 2 corners; allowed are triangles and quads, triangulate the mesh first");
  expect(ascii(5, 1, kCorners + "1 1 0\n2 2 0\n5 0 1 2 3 4\n"),
         "face 0 has 5 corners; allowed are triangles and quads, triangulate the mesh first");
}

}  // namespace
}  // namespace hysteron
