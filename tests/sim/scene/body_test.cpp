// Bodies of triangles in scenes: keys, where they are, what is refused and what is doubted.
#include "sim/scene/body.h"

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "sim/scene/cloth.h"
#include "sim/scene/scene_text.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/mesh/bodies.h"
#include "tests/sim/scene/scene_file.h"

namespace hysteron {
namespace {

using Eigen::Vector3d;
using test::obj_text;
using test::refusal;
using test::says;

const std::string kBody = "[[obstacle]]\nkind = \"mesh\"\nfile = \"body.obj\"\n";

// A scene's file has a ball of 10 cm beside it.
class SceneWithBody : public testing::Test {
 protected:
  SceneWithBody() { folder_.write("body.obj", obj_text(ball_)); }

  Scene read(const std::string& text) const {
    Scene scene = default_scene();
    apply_scene_file(scene, folder_.write("scene.toml", text));
    return scene;
  }
  Scene loaded(const std::string& text) const {
    Scene scene = read(text);
    check_scene(scene);
    load_bodies(scene);
    return scene;
  }
  std::string refused(const std::string& text) const {
    return refusal([&] { loaded(text); });
  }
  std::vector<std::string> warnings(const std::string& text) const { return body_warnings(loaded(text)); }

  const test::Folder folder_;
  const test::Body ball_ = test::ball(0.1, 2);
};

TEST_F(SceneWithBody, HasItBesideItsFile) {
  const Scene scene = loaded(kBody + "center = [1, 2, 3]\n");
  ASSERT_EQ(scene.obstacle.size(), 1u);
  EXPECT_EQ(scene.obstacle[0].file, folder_.file("body.obj"));
  EXPECT_EQ(scene.obstacle[0].mesh->face, ball_.face);
  EXPECT_EQ(body_positions(scene.obstacle[0], 5), ball_.moved({1, 2, 3}).vertex);
  EXPECT_EQ(body_warnings(scene), std::vector<std::string>());
}

TEST_F(SceneWithBody, MovesItByKeyframesAndItsSequence) {
  for (int k : {1, 2}) folder_.write("walk" + std::to_string(k) + ".obj", obj_text(ball_.scaled(k)));
  const Scene scene =
      loaded(kBody +
             "sequence = \"walk?.obj\"\nfps = 2\ncenter = [1, 0, 0]\nmotion-center = [0, 0, 0]\n"
             "motion-axis = [0, 0, 1]\nkeys = [{time = 0, angle = 90, scale = 3}]\n");
  const Eigen::Matrix3d quarter =
      Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix();
  const std::vector<Vector3d> x = body_positions(scene.obstacle[0], 0.25);  // half way to twice its size
  ASSERT_EQ(x.size(), ball_.vertex.size());
  for (std::size_t v = 0; v < x.size(); ++v)
    EXPECT_LT((x[v] - 3 * quarter * (1.5 * ball_.vertex[v] + Vector3d(1, 0, 0))).norm(), 1e-14);
}

// Half a second there and half a second back, in each of three cycles of one second; frames are at quarters.
TEST_F(SceneWithBody, RepeatsItsSequenceWithThePhases) {
  for (int k = 0; k < 5; ++k)
    folder_.write("walk" + std::to_string(k) + ".obj",
                  obj_text(ball_.moved({0.1 * (2 - std::abs(k - 2)), 0, 0})));
  const std::string text = "cycles = 3\n" + kBody +
                           "sequence = \"walk?.obj\"\nfps = 4\n[[phase]]\nname = \"walk\"\nrepeat = true\n";
  const Obstacle body = loaded(text).obstacle[0];
  const auto place = [&](double time) { return (body_positions(body, time)[0] - ball_.vertex[0]).x(); };
  for (const double cycle : {0, 1, 2}) {
    EXPECT_NEAR(place(cycle + 0.25), 0.1, 1e-12);
    EXPECT_NEAR(place(cycle + 0.5), 0.2, 1e-12);
    EXPECT_NEAR(place(cycle + 0.875), 0.05, 1e-12);
  }
  EXPECT_NEAR(place(3), 0, 1e-12);
  folder_.write("walk4.obj", obj_text(ball_.moved({0.01, 0, 0})));
  EXPECT_TRUE(says(refused(text), "obstacle[0].sequence must come back from 0 s to 1 s, which cycles = 3",
                   "a vertex ends 0.01 m beside where it begins", "scene.toml:5"));
}

// The middle of a simulation's coordinates may be anywhere.
TEST_F(SceneWithBody, HasItAtTheSamePlaceSeenFromElsewhere) {
  const Scene scene =
      loaded(kBody +
             "center = [1, 0, 0]\nmotion-center = [1, 1, 0]\nmotion-axis = [1, 1, 1]\n"
             "keys = [{time = 0}, {time = 1, angle = 50, scale = 1.5, position = [0, 1, 0]}]\n");
  const Vector3d origin(100, -200, 50);
  const std::vector<Vector3d> here = body_positions(scene.obstacle[0], 0.7),
                              there = body_positions(relative_to(origin, scene).obstacle[0], 0.7);
  for (std::size_t v = 0; v < here.size(); ++v) EXPECT_LT((here[v] - origin - there[v]).norm(), 1e-12);
}

TEST_F(SceneWithBody, IsWrittenOutAndReadBack) {
  folder_.write("walk1.obj", obj_text(ball_));
  folder_.write("walk2.obj", obj_text(ball_));
  const Scene scene = loaded(kBody + "unit = \"centimetre\"\nsequence = \"walk*.obj\"\nfps = 24\n");
  Scene again = default_scene();
  apply_scene_file(again, folder_.write("resolved.toml", scene_toml(scene)));
  ASSERT_EQ(again.obstacle.size(), 1u);
  const Obstacle &before = scene.obstacle[0], &after = again.obstacle[0];
  EXPECT_EQ(after.kind, ObstacleKind::mesh);
  EXPECT_EQ(after.file, before.file);
  EXPECT_EQ(after.unit, LengthUnit::centimetre);
  EXPECT_EQ(after.sequence, before.sequence);
  EXPECT_EQ(after.fps, 24);
}

TEST_F(SceneWithBody, IsRefusedWithWhatItLacks) {
  const std::string file = folder_.file("scene.toml");
  EXPECT_TRUE(says(refused("[[obstacle]]\nkind = \"mesh\"\n"),
                   "obstacle[0].kind = mesh needs obstacle[0].file, an OBJ or PLY (" + file + ":1)"));
  EXPECT_TRUE(says(refused(kBody + "from = 1\n"), "obstacle[0].from = 1 s (" + file + ":4)", "keyframes"));
  EXPECT_TRUE(says(refused(kBody + "until = 2\n"), "obstacle[0].until = 2 s"));
  EXPECT_TRUE(says(refused(kBody + "fps = 24\n"), "obstacle[0].fps = 24 1/s", "needs obstacle[0].sequence"));
  EXPECT_TRUE(says(refused(kBody + "fps = -1\n"), "obstacle[0].fps = -1 1/s must be >= 0"));
  folder_.write("walk1.obj", obj_text(ball_));
  folder_.write("walk2.obj", obj_text(ball_));
  EXPECT_TRUE(says(refused(kBody + "sequence = \"walk*.obj\"\n"), "sequence " + folder_.file("walk*.obj"),
                   "of 2 frames needs obstacle[0].fps", file + ":4"));
  folder_.write("body.obj", "v 0 0 0\n");
  EXPECT_TRUE(says(refused(kBody),
                   "mesh " + folder_.file("body.obj") + ": no faces (obstacle[0].file, " + file + ":3)"));
}

TEST_F(SceneWithBody, IsRefusedInAnotherUnitWithThatInWhichItFits) {
  folder_.write("body.obj", obj_text(ball_.scaled(1000)));
  const std::string said = refused(kBody);
  EXPECT_TRUE(says(said, "mesh " + folder_.file("body.obj") + ", read in metres, is 200 m long",
                   "must be in [0.001, 100] m",
                   "obstacle[0].unit = centimetre would make it 2 m, millimetre 0.2 m"));
  EXPECT_NEAR(loaded(kBody + "unit = \"millimetre\"\n").obstacle[0].mesh->frames[0][0].x(), 0.1, 1e-15);
  folder_.write("body.obj", obj_text(ball_.scaled(1e-3)));
  EXPECT_TRUE(says(refused(kBody), "is 0.0002 m long"));
}

TEST_F(SceneWithBody, NeedsStepsThatFindAnEquilibrium) {
  const std::string reason =
      "obstacle[0].kind = mesh (" + folder_.file("scene.toml") + ":3) needs integrator = implicit";
  EXPECT_TRUE(says(refused("integrator = \"explicit\"\n" + kBody), reason, "not explicit", "barrier"));
  EXPECT_TRUE(says(refused("integrator = \"semi-implicit\"\n" + kBody), reason, "not semi-implicit"));
  EXPECT_EQ(refused("integrator = \"semi-implicit\"\nself-contact = true\n" + kBody), test::kAccepted);
  EXPECT_EQ(refused("integrator = \"quasi-static\"\n" + kBody), test::kAccepted);
}

// Two bodies of which the second has moved by `way` [m].
test::Body with_second(const test::Body& body, const Eigen::Vector3d& way) {
  test::Body both = body;
  const test::Body other = body.moved(way);
  for (const Eigen::Vector3i& f : other.face)
    both.face.emplace_back(f.array() + static_cast<int>(body.vertex.size()));
  both.vertex.insert(both.vertex.end(), other.vertex.begin(), other.vertex.end());
  return both;
}

TEST_F(SceneWithBody, IsDoubtedWhereItPassesThroughItself) {
  folder_.write("body.obj", obj_text(with_second(ball_, {0.1, 0.003, 0.005})));
  const std::vector<std::string> said = warnings(kBody);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(says(said[0], "obstacle[0], mesh " + folder_.file("body.obj"),
                   "passes through itself in its first frame: triangles ", "pairs in all"));
}

TEST_F(SceneWithBody, IsDoubtedWhereItComesToPassThroughItself) {
  folder_.write("body.obj", obj_text(with_second(ball_, {0.21, 0, 0})));
  folder_.write("walk1.obj", obj_text(with_second(ball_, {0.21, 0, 0})));
  folder_.write("walk2.obj", obj_text(with_second(ball_, {0.18, 0.003, 0.005})));
  const std::vector<std::string> said = warnings(kBody + "sequence = \"walk*.obj\"\nfps = 10\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(says(said[0], "passes through itself in its frame 2, at t = 0.1 s: triangles "));
}

TEST_F(SceneWithBody, IsDoubtedWhereItsTrianglesFaceInward) {
  folder_.write("body.obj", obj_text(test::tetrahedron().inside_out()));
  const std::vector<std::string> said = warnings(kBody);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(says(said[0], "face inward (signed volume -0.167 m^3)", "turn its faces over"));  // -1/6
  test::Body open = test::tetrahedron().inside_out();
  open.face.pop_back();
  folder_.write("body.obj", obj_text(open));
  EXPECT_EQ(warnings(kBody), std::vector<std::string>()) << "a sheet has no inside";
}

TEST_F(SceneWithBody, IsDoubtedWhereItJumpsFromFrameToFrame) {
  const std::string walk = kBody + "sequence = \"walk*.obj\"\n";
  const auto frames = [&](std::initializer_list<double> xs) {
    int k = 0;
    for (const double x : xs)
      folder_.write("walk" + std::to_string(++k) + ".obj", obj_text(ball_.moved({x, 0, 0})));
  };
  frames({0, 0.01, 0.02});
  EXPECT_EQ(warnings(walk + "fps = 30\n"), std::vector<std::string>());
  frames({0, 0.011, 0.021});
  const std::vector<std::string> fast = warnings(walk + "fps = 6000\n");
  ASSERT_EQ(fast.size(), 1u);
  EXPECT_TRUE(
      says(fast[0], "goes 0.011 m from frame 1 to frame 2, at t = 0 s, with 66 m/s", "of 2 such ways"));
  frames({0, 0.01, 0.11});  // of a diagonal of 0.2 * 3^1/2
  const std::vector<std::string> far = warnings(walk + "fps = 30\n");
  ASSERT_EQ(far.size(), 1u);
  EXPECT_TRUE(says(
      far[0],
      "goes 0.1 m from frame 2 to frame 3, at t = 0.03333 s, with 3 m/s, 28.9 % of the body's diagonal"));
}

TEST_F(SceneWithBody, IsDoubtedWhereFramesAreMissing) {
  for (const int k : {1, 2, 4}) folder_.write("walk" + std::to_string(k) + ".obj", obj_text(ball_));
  const std::vector<std::string> said = warnings(kBody + "sequence = \"walk*.obj\"\nfps = 30\n");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_TRUE(says(said[0], "after walk2.obj comes walk4.obj"));
}

TEST_F(SceneWithBody, HasALineForIt) {
  EXPECT_EQ(body_lines(loaded(kBody)),
            (std::vector<std::string>{"obstacle[0], mesh " + folder_.file("body.obj") +
                                      ": 128 triangles, 66 vertices, closed, 0.2 x 0.2 x 0.2 m, rigid"}));
}

}  // namespace
}  // namespace hysteron
