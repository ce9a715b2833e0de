// The geometry from which pictures are drawn is packed and unpacked here.
#include "experiments/workbench/pictures/archived_geometry.h"

#include <cmath>
#include <fstream>

#include "experiments/workbench/pictures/frame_source.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

constexpr int kSide = 20;
constexpr double kQuantum = 2e-5;  // [m]

// Returns a square grid of 1 cm on a wave, cut by parallel diagonals.
DrawnMesh grid() {
  DrawnMesh mesh{kSide * kSide, {}, {}, kQuantum};
  for (int j = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int v = j * kSide + i;
      for (const int corner : {v, v + 1, v + kSide + 1, v, v + kSide + 1, v + kSide})
        mesh.triangles.push_back(corner);
    }
  return mesh;
}

std::vector<float> wave() {
  std::vector<float> xyz;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i)
      for (const double x : {0.01 * i, 0.01 * j, 0.01 * std::sin(0.4 * i + 0.3 * j)})
        xyz.push_back(static_cast<float>(x));
  return rounded(xyz, kQuantum);
}

std::vector<int> steps(const std::vector<float>& values) {
  std::vector<int> all;
  for (const float value : values) all.push_back(quantum_count(value, kQuantum));
  return all;
}

TEST(ArchivedGeometry, NumbersComeBackAsTheyWere) {
  const DrawnMesh mesh = grid();
  const MeshPacker packer(mesh.vertices, mesh.triangles);
  const std::vector<int> values = steps(wave());
  EXPECT_EQ(packer.unpacked(packer.packed(values, 3), 3), values);
  EXPECT_EQ(unpacked_triangles(packed_triangles(mesh.triangles), mesh.triangles.size() / 3, mesh.vertices),
            mesh.triangles);
  std::vector<int> extreme(mesh.vertices, 0);
  extreme[3] = 1 << 29, extreme[7] = -(1 << 29);
  EXPECT_EQ(packer.unpacked(packer.packed(extreme, 1), 1), extreme);
}

TEST(ArchivedGeometry, AVertexTakesLessThanFourBytes) {
  const DrawnMesh mesh = grid();
  const std::string packed = MeshPacker(mesh.vertices, mesh.triangles).packed(steps(wave()), 3);
  EXPECT_LT(static_cast<double>(packed.size()) / static_cast<double>(mesh.vertices), 4);
}

TEST(ArchivedGeometry, RoundingTwiceIsRoundingOnce) {
  const std::vector<float> once = wave();
  EXPECT_EQ(rounded(once, kQuantum), once);
}

// The point moves to and fro by a fifth of a quantum about the middle between two multiples, then by more
// than one.
TEST(ArchivedGeometry, StaysWhereItWasUntilItMovesByMostOfAQuantum) {
  const auto at = [](double steps) { return std::vector<float>{static_cast<float>(steps * kQuantum)}; };
  std::vector<float> now = rounded(at(3.4), kQuantum);
  for (const double steps : {3.6, 3.4, 3.6, 3.7}) {
    now = rounded(at(steps), kQuantum, now);
    EXPECT_EQ(now, at(3)) << steps;
  }
  EXPECT_EQ(rounded(at(3.8), kQuantum, now), at(4));
  EXPECT_EQ(rounded(at(2), kQuantum, now), at(2)) << "multiples are kept as they are";
  EXPECT_EQ(rounded(at(3.6), kQuantum, {}), at(4));
}

TEST(ArchivedGeometry, DamagedBytesAreRefused) {
  const DrawnMesh mesh = grid();
  const MeshPacker packer(mesh.vertices, mesh.triangles);
  const std::string good = packer.packed(steps(wave()), 3);
  std::string bad = good;
  bad[bad.size() / 2] = static_cast<char>(~bad[bad.size() / 2]);
  for (const std::string& bytes : {bad, good.substr(0, good.size() / 2), std::string()})
    EXPECT_NE(test::refusal([&] { packer.unpacked(bytes, 3); }), "");
  EXPECT_NE(test::refusal([&] { unpacked_triangles(packed_triangles(mesh.triangles), 722, 10); }), "");
  EXPECT_NE(test::refusal([&] { inflated(deflated("hysteron"), std::size_t{1} << 60); }), "");
}

// A file that was being written when its run was killed.
TEST(ArchivedGeometry, AFileThatEndsWithinARecordHasAllBeforeIt) {
  const Folder folder;
  const DrawnMesh mesh = grid();
  const MeshPacker packer(mesh.vertices, mesh.triangles);
  const ArchivedCloth cloth{"", 0, {{"scene", Json::object()}}, {{-1, -2, -3}, {1, 2, 3}}, -0.5f, {}};
  std::string text = record_text(mesh_record(mesh)) + record_text(cloth_record(cloth));
  for (const double time : {0.0, 0.1})
    text += record_text(instant_record(mesh, packer, {time, wave(), {}, 0}, {}));
  std::ofstream(folder.path() / "frames.hyg", std::ios::binary) << text.substr(0, text.size() - 5);
  const Archived kept = read_archived(folder.path() / "frames.hyg");
  ASSERT_EQ(kept.cloths.size(), 1u);
  ASSERT_EQ(kept.cloths[0].instants.size(), 1u);
  EXPECT_EQ(kept.cloths[0].instants[0].xyz, wave());
  EXPECT_EQ(kept.cloths[0].floor, -0.5f);
  EXPECT_EQ(kept.cloths[0].bounds.high.z(), 3);
}

TEST(ArchivedSource, ShowsHeightsFromTheLowestToTheHighestPoint) {
  const DrawnMesh mesh{3, {0, 1, 2}, {}, 1e-3};
  const std::vector<ArchivedState> instants = {{0, {0, 0, 2, 1, 0, 3, 0, 1, 4}, {}, 0},
                                               {1, {0, 0, 1, 1, 0, 1, 0, 1, 1}, {}, 0}};
  ArchivedSource subject(mesh, instants);
  EXPECT_EQ(subject.values("height"), (std::vector<float>{0, 0.5f, 1}));
  subject.go_to(1);
  EXPECT_EQ(subject.values("height"), (std::vector<float>{0, 0, 0})) << "flat";
}

}  // namespace
}  // namespace hysteron::experiments
