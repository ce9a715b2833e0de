// Units of meshes, and cloths that no unit was meant for.
#include "sim/scene/cloth.h"
#include "sim/scene/scene_reader.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using test::refusal;
using test::says;

constexpr double kRadius = 0.12;  // [m]

// A disc of kRadius in an OBJ, whose lengths are `scale` times those in metres.
class DiscFile : public testing::Test {
 protected:
  Scene read(double scale, LengthUnit unit) {
    std::vector<Eigen::Vector3d> scaled;
    for (const Eigen::Vector3d& x : disc_.rest) scaled.push_back(scale * x);
    write_obj(file_.path(), disc_, scaled);
    Scene scene;
    scene.cloth.shape = ClothOutline::file;
    scene.cloth.file = file_.path();
    scene.cloth.unit = unit;
    return scene;
  }

  const ClothMesh disc_ = make_disc(kRadius, 300, MeshFamily::random, 1);
  const TextFile file_{"", ".OBJ"};
};

TEST_F(DiscFile, ClothHasItsSizeInEveryUnit) {
  const std::pair<LengthUnit, double> kUnits[] = {{LengthUnit::metre, 1},
                                                  {LengthUnit::centimetre, 100},
                                                  {LengthUnit::millimetre, 1000},
                                                  {LengthUnit::inch, 1 / 0.0254}};
  for (const auto& [unit, in_a_metre] : kUnits) {
    const Cloth cloth = make_cloth(read(in_a_metre, unit));
    for (int v = 0; v < disc_.vertices(); ++v)
      EXPECT_LT((cloth.mesh.rest[v] - disc_.rest[v]).norm(), 1e-15) << enum_name(unit);
    EXPECT_EQ(cloth.warnings, std::vector<std::string>()) << enum_name(unit);
  }
}

// Its name ends in capitals.
TEST_F(DiscFile, IsAMeshByEitherKey) {
  Scene scene = read(1, LengthUnit::metre);
  scene.mesh = scene.cloth.file;
  scene.cloth = ClothShape();
  check_scene(scene);
  EXPECT_EQ(make_cloth(scene).mesh.face, disc_.face);
}

TEST_F(DiscFile, WrongUnitIsDoubtedAndTheRightOneNamed) {
  for (const auto& [scale, unit, right] :
       {std::tuple{100., LengthUnit::metre, "cloth.unit = centimetre would make it"},
        std::tuple{1000., LengthUnit::metre, "millimetre"}, std::tuple{1., LengthUnit::centimetre, "metre"},
        std::tuple{1., LengthUnit::millimetre, "metre"}}) {
    const Cloth cloth = make_cloth(read(scale, unit));
    ASSERT_EQ(cloth.warnings.size(), 1u) << scale << " " << enum_name(unit);
    EXPECT_TRUE(says(cloth.warnings[0], "read in " + enum_name(unit) + "s"));
    EXPECT_TRUE(says(cloth.warnings[0], right + std::string(" 0.24 m")) ||
                says(cloth.warnings[0], right + std::string(" would make it 0.24 m")))
        << cloth.warnings[0];
  }
}

TEST(Centimetres, HaveTheBitsOfMetres) {
  EXPECT_EQ(in_metres(15, LengthUnit::centimetre), 0.15);
  EXPECT_EQ(in_metres(7, LengthUnit::centimetre), 0.07);  // 7 * 0.01 is another number
  EXPECT_EQ(in_metres(1.1, LengthUnit::millimetre), 0.0011);
  EXPECT_EQ(in_metres(1, LengthUnit::inch), 0.0254);
}

TEST(BuiltCloth, TooLargeOrHeavyIsDoubted) {
  Scene scene;
  scene.cloth.length = 30;
  scene.triangles = 200;
  const std::vector<std::string> warnings = make_cloth(scene).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(says(warnings[0], "30 m long", "weighs 111 kg"));  // 900 m^2 of 0.1238 kg/m^2
  scene.cloth.length = 0.3;
  EXPECT_EQ(make_cloth(scene).warnings, std::vector<std::string>());
}

TEST(BuiltCloth, HasNoUnitOfAFile) {
  Scene scene = default_scene();
  set_key(scene, "cloth.unit", "inch", "--cloth.unit");
  EXPECT_EQ(refusal([&] { check_scene(scene); }),
            "cloth.unit = inch (--cloth.unit) is that of an OBJ, and this cloth is built: lengths of keys "
            "are metres");
}

TEST(BuiltCloth, LeavesNoFileUnread) {
  Scene scene = default_scene();
  set_key(scene, "cloth.file", "disc.obj", "--cloth.file");
  EXPECT_EQ(refusal([&] { check_scene(scene); }),
            "cloth.file = disc.obj (--cloth.file) is not read by a cloth of shape " +
                enum_name(scene.cloth.shape) + ": give cloth.shape = file, or pattern");
  set_key(scene, "cloth.shape", "disc", "--cloth.shape");
  EXPECT_NO_THROW(check_scene(scene));
}

// The start is in a file of its own.
class StartFile : public DiscFile {
 protected:
  Scene started(const std::vector<Eigen::Vector3d>& at) {
    Scene scene = read(1, LengthUnit::metre);
    write_obj(start_.path(), disc_, at);
    scene.cloth.start = start_.path();
    return scene;
  }

  const TextFile start_{"", ".obj"};
};

TEST_F(StartFile, BeginsWithoutHistory) {
  const std::vector<std::string> warnings = make_cloth(started(disc_.rest)).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(says(warnings[0], "is a shape without a history"));
}

TEST_F(StartFile, OfVerticesInAnotherOrderIsRefusedOrDoubted) {
  std::vector<Eigen::Vector3d> at = disc_.rest;
  std::swap(at.front(), at.back());
  const std::vector<std::string> warnings = make_cloth(started(at)).warnings;
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(says(warnings[0], "edges by more than 50 %"));
  for (Eigen::Vector3d& x : at) x *= 100;
  EXPECT_TRUE(says(refusal([&] { make_cloth(started(at)); }),
                   "times as long as at rest, which must be 0.5 to 2: both files must be in cloth.unit"));
}

TEST_F(StartFile, OfOtherTrianglesNamesTheFirst) {
  const Scene scene = started(disc_.rest);
  ClothMesh other = disc_;
  std::swap(other.face[3], other.face[4]);
  write_obj(start_.path(), other, other.rest);
  EXPECT_TRUE(says(refusal([&] { make_cloth(scene); }), ": its triangle 4 has the vertices "));
}

}  // namespace
}  // namespace hysteron
