#include <gtest/gtest.h>

#include "sim/mesh/surface.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/mesh_measures.h"

namespace hysteron {
namespace {

using test::Folder;

TEST(ObjFile, RoundTripKeepsEveryBit) {
  const Folder folder;
  const ClothMesh mesh = make_disc(0.15, 300, MeshFamily::random, 2);
  write_obj(folder.file("disc.obj"), mesh, mesh.rest);
  EXPECT_EQ(test::fingerprint(read_obj(folder.file("disc.obj"), 0)), test::fingerprint(mesh));
  EXPECT_EQ(folder.names(), std::vector<std::string>{"disc.obj"});
}

TEST(ObjFile, WritesThePositionsGivenNotTheRestShape) {
  const Folder folder;
  const ClothMesh mesh = make_grid(1, 1, 1, 1, MeshFamily::aligned, 0);
  std::vector<Eigen::Vector3d> position = mesh.rest;
  for (auto& x : position) x.z() += 2.5;
  write_obj(folder.file("up.obj"), mesh, position);
  for (const auto& x : read_obj(folder.file("up.obj"), 0).rest) EXPECT_EQ(x.z(), 2.5);
}

TEST(ObjFile, PatternTravelsAsTextureCoordinates) {
  const Folder folder;
  ClothMesh mesh = make_grid(1, 1, 2, 2, MeshFamily::unionjack, 0);
  for (const auto& x : mesh.rest) mesh.pattern.emplace_back(x.y(), -x.x());  // warp along y
  write_obj(folder.file("turned.obj"), mesh, mesh.rest);
  const ClothMesh read = read_obj(folder.file("turned.obj"), 0);
  ASSERT_EQ(read.pattern.size(), mesh.pattern.size());
  for (int v = 0; v < mesh.vertices(); ++v) EXPECT_EQ(read.pattern[v], mesh.pattern[v]);
  for (int f = 0; f < read.faces(); ++f)
    EXPECT_NEAR((read.face_axes(f)[0] - Eigen::Vector3d(0, 1, 0)).norm(), 0, 1e-15);
}

TEST(ObjFile, QuadIsCutAlongItsShorterDiagonal) {
  const Folder folder;
  const std::string file = folder.write("kite.obj", "v -1 0 0\nv 0 -3 0\nv 1 0 0\nv 0 3 0\nf 1 2 3 4\n");
  const ClothMesh mesh = read_obj(file, 0);
  ASSERT_EQ(mesh.interior_edges, 1);
  EXPECT_EQ((mesh.rest[mesh.edge[0].p3] - mesh.rest[mesh.edge[0].p2]).norm(), 2);
}

TEST(ObjFile, DentedQuadIsCutAlongTheDiagonalInsideIt) {
  const Folder folder;
  for (const char* faces : {"f 1 2 3 4\n", "f 2 3 4 1\n"}) {  // arrow head; the short diagonal is outside
    const std::string file =
        folder.write("arrow.obj", std::string("v -1 0 0\nv 0 1 0\nv 1 0 0\nv 0 5 0\n") + faces);
    const ClothMesh mesh = read_obj(file, 0);
    EXPECT_EQ(test::total_area(mesh), 5 - 1);
  }
}

TEST(ObjFile, GroupsCommentsRelativeIndicesNormalsAndCarriageReturnsAreUnderstood) {
  const Folder folder;
  const std::string file = folder.write("exported.obj",
                                        "# exported\r\nmtllib none.mtl\r\no front\r\nv 0 0 0\r\nv +1 0 0\r\n"
                                        "v 0 1e0 0\r\nvn 0 0 1\r\ng a\r\nusemtl red\r\nf 1//1 2//1 3//1\r\n"
                                        "o back\r\nv 1 1 0\r\nf -2 -3 -1\r\n");
  const ClothMesh mesh = read_obj(file, 0);
  EXPECT_EQ(mesh.faces(), 2);
  EXPECT_EQ(test::total_area(mesh), 1);
  EXPECT_TRUE(mesh.pattern.empty());
}

TEST(ObjFile, ByteOrderMarkAndCommentsBehindRecordsAreNoPartOfThem) {
  const Folder folder;
  const std::string file = folder.write(
      "windows.obj",
      "\xEF\xBB\xBFv 5 5 5 # first\nv 6 5 5\nv 6 6 5\n   # indented\nv 5 6 5\nf 1 2 3 4# face\n#end");
  const ClothMesh mesh = read_obj(file, 0);
  EXPECT_EQ(mesh.vertices(), 4);
  EXPECT_EQ(mesh.rest[0], Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(test::total_area(mesh), 1);
}

TEST(ObjFile, RecordsGoOnBehindABackslash) {
  const Folder folder;
  const std::string comments = "# C:\\meshes\\\nusemtl C:\\red\\\n";
  const ClothMesh mesh =
      read_obj(folder.write("continued.obj",
                            comments + "v 0 0 0\nv 1 \\\n 0 \\\r\n0\nv 0 1 0\nv 1 1 0\nf 1 2\\\n4 3\n"),
               0);
  EXPECT_EQ(mesh.rest[1], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(test::total_area(mesh), 1);
  // Lines count as the file has them.
  EXPECT_TRUE(
      test::says(test::refusal([&] { read_obj(folder.write("bad.obj", "v 0 0 \\\n0\nv 1 0 x\n"), 0); }),
                 "line 3: coordinate"));
}

// A square of four triangles around its middle, whose texture is turned by 90 degrees; `uncovered` faces have
// none.
std::string partly_covered(int uncovered) {
  std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 0\nvt 0 0\nvt 0 1\nvt -1 1\nvt -1 0\nvt -0.5 0.5\n";
  for (int i = 1; i <= 4; ++i) {
    const std::string a = std::to_string(i), b = std::to_string(i % 4 + 1);
    text +=
        i > 4 - uncovered ? "f " + a + " " + b + " 5\n" : "f " + a + "/" + a + " " + b + "/" + b + " 5/5\n";
  }
  return text;
}

TEST(ObjFile, FacesWithoutTextureTakeThatOfTheirNeighbours) {
  const Folder folder;
  const std::string file = folder.file("mixed.obj");
  for (const int uncovered :
       {1, 3}) {  // the vertices of one have coordinates in other faces, those of three have none
    std::vector<std::string> warnings;
    const ClothMesh mesh =
        read_obj(folder.write("mixed.obj", partly_covered(uncovered)), 0, LengthUnit::metre, &warnings);
    ASSERT_EQ(mesh.pattern.size(), 5u);
    EXPECT_NEAR((mesh.pattern[3] - Eigen::Vector2d(-1, 0)).norm(), 0, 1e-12);
    for (int f = 0; f < mesh.faces(); ++f)
      EXPECT_NEAR((mesh.face_axes(f)[0] - Eigen::Vector3d(0, -1, 0)).norm(), 0, 1e-12) << f;
    EXPECT_EQ(read_surface(file).pattern.size(), 5u);
    if (uncovered == 1)
      EXPECT_TRUE(warnings.empty());
    else
      EXPECT_EQ(warnings,
                std::vector<std::string>{
                    "mesh " + file +
                    ": line 12: the face has no texture coordinates, nor have 2 further triangles: those of "
                    "neighbours go on there, and warp with them"});
  }
}

TEST(ObjFile, FacesWhoseTextureNoNeighbourTellsAreWarnedOf) {
  const Folder folder;
  std::vector<std::string> warnings;
  const std::string file =
      folder.write("mixed.obj", partly_covered(0) + "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 6 7 8\n");
  const ClothMesh mesh = read_obj(file, 0, LengthUnit::metre, &warnings);
  EXPECT_TRUE(mesh.pattern.empty());
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(warnings[0],
            "mesh " + file +
                ": line 18: the face has no texture coordinates, and no neighbour to tell them, while 4 "
                "others have: none are used, and warp is along x at rest; give them to all faces");
}

// OBJ had these faces before version 3.0.
TEST(ObjFile, OldFacesAreFaces) {
  const Folder folder;
  EXPECT_EQ(
      read_obj(folder.write("old.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nfo 2 4 3\n"), 0).faces(),
      2);
}

// Two panels whose edge is stored twice, as exporters write at a seam of the texture.
const char* const kSeam =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1.0000004 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\n"
    "f 5/2 6/3 7/4 8/1\n";

TEST(ObjFile, SeamStaysOpenWithoutWeldingAndCarriesAPattern) {
  const Folder folder;
  const ClothMesh mesh = read_obj(folder.write("seam.obj", kSeam), 0);
  EXPECT_EQ(mesh.vertices(), 8);
  EXPECT_EQ(mesh.interior_edges, 2);  // the quads' diagonals
  EXPECT_EQ(mesh.pattern.size(), 8u);
}

TEST(ObjFile, WeldingClosesTheSeamAndKeepsEachSidesWarp) {
  const Folder folder;
  const ClothMesh mesh = read_obj(folder.write("seam.obj", kSeam), 1e-6);
  EXPECT_EQ(mesh.vertices(), 6);
  EXPECT_EQ(mesh.interior_edges, 3);
  EXPECT_EQ(test::euler_characteristic(mesh), 1);
  EXPECT_TRUE(mesh.pattern.empty());
  for (int f = 0; f < mesh.faces(); ++f) {
    const Eigen::Vector3d expected = f < 2 ? Eigen::Vector3d(1, 0, 0) : Eigen::Vector3d(0, -1, 0);
    EXPECT_NEAR((mesh.face_axes(f)[0] - expected).norm(), 0, 1e-6);  // the seam's gap
  }
}

TEST(MeshWriters, FailingOnesNameTheFileAndLeaveNothing) {
  const Folder folder;
  const ClothMesh mesh = make_grid(1, 1, 1, 1, MeshFamily::aligned, 0);
  const std::string file = folder.file("missing/frame.obj");
  EXPECT_EQ(test::refusal([&] { write_obj(file, mesh, mesh.rest); }, 1),
            "cannot create " + file + ": No such file or directory");
  EXPECT_NE(test::refusal([&] { write_ply(folder.file("a.ply"), mesh, mesh.rest, {1.0}); }), test::kAccepted);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace hysteron
