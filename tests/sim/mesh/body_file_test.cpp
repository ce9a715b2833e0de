// Bodies of triangles from files: which they are, where they are over time, and what is refused.
#include "sim/mesh/body_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "sim/mesh/mesh_export.h"
#include "sim/mesh/point_cache.h"
#include "tests/sim/base/folder.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/bodies.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::Folder;
using test::obj_text;
using test::refusal;
using test::says;

using Vertices = std::vector<Vector3d>;

class BodyFile : public testing::Test {
 protected:
  BodyMesh read(const std::string& text, const std::string& name = "body.obj") const {
    return read_body({folder_.write(name, text), "", LengthUnit::metre, 0});
  }
  std::string reading(const std::string& text) const {
    return refusal([&] { read(text); });
  }

  const Folder folder_;
  const test::Body solid_ = test::tetrahedron();
};

TEST_F(BodyFile, IsReadFromObjAndPly) {
  const BodyMesh obj = read(obj_text(solid_)), ply = read(ply_text(solid_), "body.ply");
  for (const BodyMesh* body : {&obj, &ply}) {
    EXPECT_EQ(body->face, solid_.face);
    EXPECT_EQ(body->frames, std::vector<Vertices>{solid_.vertex});
    EXPECT_TRUE(body->closed);
    EXPECT_FALSE(body->moves());
    EXPECT_EQ(body->positions(3), solid_.vertex);
  }
}

TEST_F(BodyFile, IsOpenWithoutOneOfItsTriangles) {
  test::Body open = solid_;
  open.face.pop_back();
  EXPECT_FALSE(read(obj_text(open)).closed);
  EXPECT_TRUE(read(obj_text(test::ball(1, 2))).closed);
}

TEST_F(BodyFile, HasItsLengthsInMetresAndNoLooseVertices) {
  const std::string file = folder_.write("inches.obj", "v 9 9 9\nv 0 0 0\nv 10 0 0\nv 0 10 0\nf 2 3 4\n");
  const BodyMesh body = read_body({file, "", LengthUnit::inch, 0});
  EXPECT_EQ(body.frames.front(), (Vertices{{0, 0, 0}, {0.254, 0, 0}, {0, 0.254, 0}}));
  EXPECT_EQ(body.face, (std::vector<Eigen::Vector3i>{{0, 1, 2}}));
}

TEST_F(BodyFile, ThatIsNoSurfaceIsRefusedWithTheLine) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n", file = folder_.file("body.obj");
  EXPECT_TRUE(says(reading(start), "mesh " + file, "no faces"));
  EXPECT_TRUE(says(reading(start + "f 1 2 3\nf 2 1 4\nf 1 2 5\n"), "the edge between the vertex of line 1",
                   "is shared by 3 triangles"));
  EXPECT_TRUE(says(reading(start + "f 1 2 3\nf 1 2 4\n"), "have opposite orientation at the edge"));
  EXPECT_TRUE(
      says(reading("v 0 0 0\nv 1 0 0\nv 2 0 1e-8\nf 1 2 3\n"), "the triangle of line 4 is degenerate"));
  EXPECT_TRUE(says(reading("v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"), "line 2"));
  EXPECT_TRUE(says(refusal(
                       [&] {
                         read_body({folder_.file("none.obj"), "", LengthUnit::metre, 0});
                       },
                       1),
                   "cannot read mesh " + folder_.file("none.obj")));
  EXPECT_TRUE(says(refusal([&] { read("", "body.stl"); }), "its name must end in .obj or .ply"));
}

// The body moves along x by as many metres as frames.
class BodySequence : public BodyFile {
 protected:
  std::string frame(const std::string& name, double x) const {
    return folder_.write(name, obj_text(solid_.moved({x, 0, 0})));
  }
  BodyMesh read_sequence(const std::string& pattern, double fps = 10) const {
    return read_body(
        {folder_.write("body.obj", obj_text(solid_)), folder_.file(pattern), LengthUnit::metre, fps});
  }
  std::string reading_sequence(const std::string& pattern) const {
    return refusal([&] { read_sequence(pattern); });
  }
  static double x_at(const BodyMesh& body, double time) { return body.positions(time)[0].x(); }
};

TEST_F(BodySequence, OfFilesIsInTheOrderOfTheirNumbersAndStraightBetweenThem) {
  for (int k : {0, 1, 2, 10}) frame("walk" + std::to_string(k) + ".obj", k);
  const BodyMesh body = read_sequence("walk*.obj");
  ASSERT_EQ(body.frames.size(), 4u);
  EXPECT_TRUE(body.moves());
  EXPECT_EQ(body.fps, 10);
  EXPECT_EQ(x_at(body, -1), 0);
  EXPECT_EQ(x_at(body, 0.1), 1);
  EXPECT_NEAR(x_at(body, 0.15), 1.5, 1e-15);
  EXPECT_NEAR(x_at(body, 0.25), 6, 1e-14);
  EXPECT_EQ(x_at(body, 0.3), 10);
  EXPECT_EQ(x_at(body, 7), 10);
  EXPECT_EQ(body.positions(0.1), solid_.moved({1, 0, 0}).vertex);
}

// As shorter diagonals change, quads are cut otherwise.
TEST_F(BodySequence, KeepsTheTrianglesOfTheMeshWhereQuadsAreCutOtherwise) {
  const auto quad = [](double x) {
    return "v 0 0 0\nv 1 0 0\nv " + std::to_string(x) + " 1 0\nv " + std::to_string(x - 1) +
           " 1 0\nf 1 2 3 4\n";
  };
  folder_.write("q1.obj", quad(0.5));
  folder_.write("q2.obj", quad(1.5));
  const BodyMesh body =
      read_body({folder_.write("quad.obj", quad(1.5)), folder_.file("q?.obj"), LengthUnit::metre, 1});
  EXPECT_EQ(body.face, read(quad(1.5)).face);
  EXPECT_NE(body.face, read(quad(0.5)).face);
  EXPECT_EQ(body.frames[0][2].x(), 0.5);
}

TEST_F(BodySequence, OfAnotherMeshIsRefusedWithTheFile) {
  frame("walk1.obj", 0);
  test::Body other = solid_;
  std::swap(other.face[0], other.face[3]);
  folder_.write("walk2.obj", obj_text(other));
  EXPECT_TRUE(says(reading_sequence("walk*.obj"), "mesh " + folder_.file("walk2.obj"),
                   "its 4 triangles are others than the 4 of mesh " + folder_.file("body.obj")));
  folder_.write("walk2.obj", obj_text(test::ball(1, 0)));
  EXPECT_TRUE(says(reading_sequence("walk*.obj"), "walk2.obj: 6 vertices, and mesh ", " has 4"));
  test::Body flat = solid_;
  flat.vertex[3] = flat.vertex[1];
  folder_.write("walk2.obj", obj_text(flat));
  EXPECT_TRUE(says(reading_sequence("walk*.obj"), "mesh " + folder_.file("walk2.obj"), "is degenerate"));
  EXPECT_TRUE(
      says(reading_sequence("run*.obj"), "sequence " + folder_.file("run*.obj"), "no file has such a name"));
}

TEST_F(BodySequence, OfAPointCacheHasTheFramesThatWereWritten) {
  for (int k = 0; k < 3; ++k)
    write_to_point_cache(folder_.file("walk.pc2"), k, solid_.moved({0.5 * k, 0, 0}).vertex);
  const BodyMesh body = read_sequence("walk.pc2", 4);
  ASSERT_EQ(body.frames.size(), 3u);
  EXPECT_EQ(x_at(body, 0.25), 0.5);
  EXPECT_EQ(x_at(body, 0.5), 1);
  EXPECT_FALSE(read_sequence("walk.pc2", 0).moves()) << "it does not say how many frames a second has";
}

TEST_F(BodySequence, OfAPointCacheThatDoesNotFitIsRefused) {
  const std::string file = folder_.file("walk.pc2");
  write_to_point_cache(file, 0, test::ball(1, 0).vertex);
  EXPECT_TRUE(
      says(reading_sequence("walk.pc2"), "point cache " + file + ": 6 points, and mesh ", " has 4 vertices"));
  write_to_point_cache(file, 0, solid_.vertex);
  const std::string whole = test::file_content(file);
  folder_.write("walk.pc2", whole.substr(0, whole.size() - 1));
  EXPECT_TRUE(says(reading_sequence("walk.pc2"), "it is cut off: its header has 1 frames of 4 points"));
  folder_.write("walk.pc2", whole.substr(0, 20));
  EXPECT_TRUE(says(reading_sequence("walk.pc2"), "it is cut off in its header"));
  folder_.write("walk.pc2", "Point cache");
  EXPECT_TRUE(says(reading_sequence("walk.pc2"), "not a PC2"));
  write_to_point_cache(file, 0, {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}, {0, 0, 1}});
  EXPECT_TRUE(says(reading_sequence("walk.pc2"), "point 2 of frame 1 is not a finite number"));
}

void add_word(std::string& bytes, std::uint32_t word) {
  for (int shift : {24, 16, 8, 0}) bytes += static_cast<char>(word >> shift & 0xff);
}

// Returns an .mdd as LightWave and Blender write it: counts, times, then all points frame by frame, the high
// byte first.
std::string mdd(const std::vector<float>& time, const std::vector<Vertices>& frames) {
  std::string bytes;
  add_word(bytes, static_cast<std::uint32_t>(frames.size()));
  add_word(bytes, static_cast<std::uint32_t>(frames.front().size()));
  for (const float t : time) add_word(bytes, std::bit_cast<std::uint32_t>(t));
  for (const Vertices& frame : frames)
    for (const Vector3d& x : frame)
      for (const double c : x) add_word(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
  return bytes;
}

TEST_F(BodySequence, OfAnMddHasItsTimesUnlessFpsSaysOthers) {
  std::vector<Vertices> frames;
  for (int k = 0; k < 3; ++k) frames.push_back(solid_.moved({1.0 * k, 0, 0}).vertex);
  folder_.write("walk.mdd", mdd({2, 2.5, 3.5}, frames));
  const BodyMesh own = read_sequence("walk.mdd", 0), even = read_sequence("walk.mdd", 1);
  EXPECT_TRUE(own.moves());
  EXPECT_EQ(own.time_of(2), 1.5) << "it begins at t = 0";
  EXPECT_EQ(x_at(own, 0.25), 0.5);
  EXPECT_EQ(x_at(own, 1), 1.5);
  EXPECT_EQ(x_at(own, 2), 2);
  EXPECT_EQ(x_at(even, 0.25), 0.25);
  folder_.write("still.mdd", mdd({0, 0, 0}, frames));
  EXPECT_FALSE(read_sequence("still.mdd", 0).moves());
  folder_.write("short.mdd", mdd({2, 2.5, 3.5}, frames).substr(0, 100));
  EXPECT_TRUE(says(reading_sequence("short.mdd"), "it is cut off", "and the file 1"));
  folder_.write("none.mdd", "?");
  EXPECT_TRUE(says(reading_sequence("none.mdd"), "cut off"));
}

// Every one is read or refused.
TEST_F(BodySequence, OfADamagedPointCacheEndsInAnErrorAtMost) {
  std::vector<Vertices> frames;
  for (int k = 0; k < 2; ++k) {
    frames.push_back(solid_.moved({1.0 * k, 0, 0}).vertex);
    write_to_point_cache(folder_.file("whole.pc2"), k, frames.back());
  }
  const std::pair<std::string, std::string> kCaches[] = {
      {"part.pc2", test::file_content(folder_.file("whole.pc2"))}, {"part.mdd", mdd({0, 1}, frames)}};
  int refusals = 0;
  for (const auto& [name, whole] : kCaches)
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string damaged = whole;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x80);
      for (const std::string& bytes : {whole.substr(0, at), damaged}) {
        folder_.write(name, bytes);
        refusals += refusal([&, &name = name] { read_point_cache(folder_.file(name)); }) != test::kAccepted;
      }
    }
  EXPECT_GE(refusals, 128 + 112) << "each that is cut off";
}

}  // namespace
}  // namespace hysteron
