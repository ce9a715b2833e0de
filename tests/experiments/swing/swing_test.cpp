// Swinging sheets, wherever they lie: what holds them and along what they swing.
#include <fstream>
#include <sstream>

#include "experiments/swing/clamped_sheet.h"
#include "tests/experiments/program.h"

namespace hysteron::experiments {
namespace {

constexpr double kRotated = 1e-3;  // of what friction takes: rounding that other axes make, after a second
const std::vector<Flag> kShort = {{"seconds", 1.2}, {"device", "cpu"}};

Json swing_with(std::vector<Flag> flags) {
  if (last_text(flags, "cloth.file", "").empty()) flags.push_back({"triangles", 60});
  flags.insert(flags.end(), kShort.begin(), kShort.end());
  return metrics_with("swing", flags);
}

// A strip of 0.1 m by 0.03 m in 10 by 3 squares, from `low` on; `up_y`: as modellers lay it whose y is up.
fs::path strip_file(const fs::path& folder, const Eigen::Vector2d& low, bool up_y = false) {
  const fs::path file = folder / "strip.obj";
  std::ofstream obj(file);
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 10; ++i) {
      const double x = low.x() + 0.01 * i, y = low.y() + 0.01 * j;
      obj << "v " << x << ' ' << (up_y ? 0 : y) << ' ' << (up_y ? -y : 0) << '\n';
    }
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 10; ++i) {
      const int a = 11 * j + i + 1;
      obj << "f " << a << ' ' << a + 1 << ' ' << a + 12 << "\nf " << a << ' ' << a + 12 << ' ' << a + 11
          << '\n';
    }
  return file;
}

void expect_same_swing(const Json& a, const Json& b) {
  EXPECT_GE(a["turns"], 4);
  EXPECT_EQ(a["turns"], b["turns"]);
  const double lost = a["bending_friction_J"];
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(b["bending_friction_J"], lost, kRotated * lost);
}

TEST(Swing, IsTheSameWhereverTheStripPoints) {
  const Json along_x = swing_with({});
  for (const double angle : {90, 180, -30})
    expect_same_swing(along_x, swing_with({{"cloth.rotation", Numbers{0, 0, angle}}}));
}

TEST(Swing, WithoutGravityOrInertiaIsSaidToStandStill) {
  const std::vector<Flag> few = {{"seconds", 0.1}, {"triangles", 60}, {"device", "cpu"}};
  for (const Flag& still :
       {Flag{"gravity", Numbers{0, 0, 0}}, Flag{"integrator", "quasi-static"}, Flag{"fps", 30}}) {
    const Folder folder;
    std::vector<Flag> flags = few;
    flags.push_back(still);
    EXPECT_EQ(run_into(folder.path(), "swing", flags), 0);
    const std::string warnings = manifest_in(folder.path()).value("warnings", Json::array()).dump();
    EXPECT_EQ(occurrences(warnings, "nothing swings without gravity and inertia"),
              still.path == "fps" ? 0 : 1)
        << still.path << " " << warnings;
  }
}

TEST(Swing, OfAMeshIsClampedAtItsOwnLowEnd) {
  const Folder folder;
  const Json from_zero =
      swing_with({{"cloth.file", strip_file(folder.path(), {0, 0})}, {"cloth.shape", "file"}});
  const fs::path centred = strip_file(folder.path(), {-0.05, -0.015});
  expect_same_swing(from_zero, swing_with({{"cloth.file", centred}, {"cloth.shape", "file"}}));
  Scene scene;
  scene.cloth.shape = ClothOutline::file;
  scene.cloth.file = centred;
  clamp_low_end(scene);
  const Cloth cloth = make_cloth(scene);
  EXPECT_EQ(cloth.pin_vertices.at(0).size(), 2u * 4);  // the columns at -0.05 and -0.04 m
}

TEST(Swing, OfAMeshWhoseYIsUpIsRefusedUntilItIsLaidLevel) {
  const Folder folder;
  const std::string file = strip_file(folder.path(), {0, 0}, true);
  const std::string line = "swing --seconds 1.2 --no-images --cloth.shape file --cloth.file " + file +
                           out_flag(folder.path() / "out");
  EXPECT_TRUE(says(refused(line), "gravity acts in that plane"));
  EXPECT_TRUE(says(refused(line), "--cloth.rotation \"90 0 0\" lays it level"));
  const Json level =
      swing_with({{"cloth.file", file}, {"cloth.shape", "file"}, {"cloth.rotation", Numbers{90, 0, 0}}});
  const Json flat = swing_with({{"cloth.file", strip_file(folder.path(), {0, 0})}, {"cloth.shape", "file"}});
  expect_same_swing(flat, level);
}

TEST(Swing, OfAMeshThatIsClampedByItsLongSideSaysSo) {
  const Folder folder;
  const fs::path file = strip_file(folder.path(), {0, 0});
  Scene scene;
  scene.cloth.shape = ClothOutline::file, scene.cloth.file = file;
  EXPECT_EQ(long_side_warning(scene, make_cloth(scene).mesh), "");
  std::string lines = file_content(file), turned;
  std::istringstream in(lines);
  for (std::string kind, a, b, c; in >> kind >> a >> b >> c;)  // x and y change places
    turned += kind + " " + b + " " + a + " " + c + "\n";
  std::ofstream(file) << turned;
  EXPECT_TRUE(says(long_side_warning(scene, make_cloth(scene).mesh),
                   "is 0.03 m long in x and 0.1 m in y: its long side is clamped"));
}

TEST(Swing, OfAStripOnItsEdgeOrHangingDownIsRefused) {
  const Folder folder;
  for (const char* rotation : {"90 0 0", "0 90 0"}) {
    const std::string said = refused("swing --no-images --cloth.rotation \"" + std::string(rotation) + "\"" +
                                     out_flag(folder.path() / "out"));
    EXPECT_TRUE(says(said, "--cloth.rotation \"0 0 0\" lays it level")) << said;
  }
}

// It turns about the line y = 0.5 m through the corners that are held.
TEST(Swing, OfASheetThatHangsByTwoCornersIsAcrossTheirLine) {
  constexpr double kRounding = 1e-9;
  Scene scene;
  scene.cloth.length = 0.5;
  scene.triangles = 64;
  Pin left, right;
  left.select = right.select = PinSelection::nearest;
  left.point = {0, 0.5, 0};
  right.point = {0.5, 0.5, 0};
  scene.pin = {left, right};
  const Cloth cloth = make_cloth(scene);
  const SheetPlacement sheet = sheet_placement(scene, cloth, false);
  EXPECT_NEAR((sheet.along - Eigen::Vector3d(0, -1, 0)).norm(), 0, kRounding);
  EXPECT_NEAR((sheet.corner - Eigen::Vector3d(0.25, 0.5, 0)).norm(), 0, kRounding);
  EXPECT_NEAR(cloth.start[sheet.tip].y(), 0, kRounding);
}

TEST(Specimens, ThatLieWhereTheirMachineIsAreNotTurned) {
  EXPECT_TRUE(says(refused("fold --cloth.rotation \"0 0 90\""), "fold sets cloth.rotation itself"));
  EXPECT_TRUE(says(refused("fold --cloth.position \"0 0 1\""), "fold sets cloth.position itself"));
  EXPECT_TRUE(says(refused("crease --cloth.rotation \"0 0 90\""), "crease sets cloth.rotation itself"));
}

// Elasticity and friction with directions of their own: what friction takes is what is missing, and cut along
// warp the strip knows nothing of weft.
TEST(Swing, KeepsItsEnergyBalanceWhereFrictionHasDirectionsOfItsOwn) {
  const auto swung = [](const char* law, double angle, double friction) {
    return swing_with({{"law", law},
                       {"seconds", 0.3},
                       {"cloth.warp-angle", angle},
                       {"fabric.weft-bending", 0.4},
                       {"fabric.bias-bending", 0.7},
                       {"fabric.weft-friction", friction}});
  };
  for (const char* law : {"wong", "prandtl", "dahl"}) {
    const Json own = swung(law, 30, 1.4), other = swung(law, 30, 0.3);
    constexpr double kRounding = 1e-10;  // of the energy that moves
    EXPECT_LT(std::abs(own["energy_remainder_relative"].get<double>()), kRounding) << law;
    EXPECT_GT(own["bending_friction_J"], other["bending_friction_J"]) << law;
    EXPECT_GT(other["bending_friction_J"], 0) << law;
  }
}

// A fabric that is asked for brings its own.
TEST(Swing, DampsByADefaultOfItsOwnThatNoFileHasSaid) {
  const auto scene_of = [](const std::vector<Flag>& more) {
    const Folder folder;
    std::vector<Flag> flags = {{"triangles", 30}, {"seconds", 0.01}, {"device", "cpu"}};
    flags.insert(flags.end(), more.begin(), more.end());
    EXPECT_EQ(run_into(folder.path(), "swing", flags), 0);
    return manifest_in(folder.path())["scene"];
  };
  const Json own = scene_of({}), asked = scene_of({{"fabric.name", "cotton-broad"}});
  EXPECT_EQ(own["fabric"]["damping"], 1e-5);
  EXPECT_FALSE(own["origin"].contains("fabric.damping"));
  EXPECT_EQ(asked["fabric"]["damping"], 1e-4);
  EXPECT_TRUE(says(asked["origin"]["fabric.damping"], "cotton-broad.toml"));
}

}  // namespace
}  // namespace hysteron::experiments
