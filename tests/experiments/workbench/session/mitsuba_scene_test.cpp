// Scenes for a path tracer: well-formed, and from the pictures' own camera.
#include "experiments/workbench/session/mitsuba_scene.h"

#include <cmath>
#include <regex>
#include <sstream>
#include <vector>

#include "render/key_light.h"
#include "render/srgb.h"
#include "sim/scene/scene_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

Setup setup_with_a_ball() {
  Setup setup{default_scene(), {}};
  setup.options.size = "400x300";
  Obstacle ball;
  ball.kind = ObstacleKind::sphere;
  ball.radius = 0.05;
  setup.scene.obstacle = {ball};
  return setup;
}

std::string exported_xml(const Setup& setup, std::optional<float> floor) {
  const PictureView view = picture_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, floor);
  return mitsuba_scene(view, setup.scene, 0, "0000.ply", {"bodies/0000.ply"});
}

// Returns the numbers of an attribute's first appearance after a word.
std::vector<double> numbers_after(const std::string& xml, const std::string& word,
                                  const std::string& attribute) {
  const std::size_t begin = xml.find(attribute + "=\"", xml.find(word)) + attribute.size() + 2;
  std::string text = xml.substr(begin, xml.find('"', begin) - begin);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream stream(text);
  std::vector<double> numbers;
  for (double x; stream >> x;) numbers.push_back(x);
  return numbers;
}

// Tags that close in the order in which they opened; attributes in quotes, each once.
bool is_well_formed(const std::string& xml) {
  static const std::regex kTag(R"(<(/?)([a-z]+)((?: [a-z_]+="[^"<&]*")*)(/?)>)");
  std::vector<std::string> open;
  std::size_t at = 0;
  for (std::sregex_iterator tag(xml.begin(), xml.end(), kTag), end; tag != end; ++tag) {
    if (xml.substr(at, static_cast<std::size_t>(tag->position()) - at).find_first_of("<>&") != xml.npos)
      return false;
    at = static_cast<std::size_t>(tag->position() + tag->length());
    if ((*tag)[1].length() > 0) {
      if (open.empty() || open.back() != (*tag)[2]) return false;
      open.pop_back();
    } else if ((*tag)[4].length() == 0) {
      open.push_back((*tag)[2]);
    }
  }
  return open.empty() && at + 1 == xml.size();
}

TEST(MitsubaScene, IsWellFormed) {
  EXPECT_TRUE(is_well_formed(exported_xml(setup_with_a_ball(), 0.0f)));
  EXPECT_FALSE(is_well_formed("<scene><a></scene>\n"));
}

TEST(MitsubaScene, LooksFromThePicturesCamera) {
  const auto setup = setup_with_a_ball();
  const std::string xml = exported_xml(setup, {});
  const render::Camera camera = picture_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, {}).camera;
  const std::vector<double> eye = numbers_after(xml, "<sensor", "origin"),
                            target = numbers_after(xml, "<sensor", "target");
  ASSERT_EQ(eye.size(), 3u);
  ASSERT_EQ(target.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(eye[k], camera.eye()[k], 1e-6);
    EXPECT_NEAR(target[k] - eye[k], camera.forward()[k], 1e-6);
  }
  EXPECT_NEAR(numbers_after(xml, "\"fov\"", "value").at(0), setup.options.camera_fov, 1e-4);
  EXPECT_TRUE(says(xml, "name=\"width\" value=\"400\""));
}

TEST(MitsubaScene, BodiesAreWhereTheyAreAtThatTime) {
  auto setup = setup_with_a_ball();
  setup.scene.obstacle[0].center = {0.1, 0.2, 0.3};
  const std::string xml = exported_xml(setup, {});
  const std::vector<double> placed =
      numbers_after(xml.substr(xml.find("bodies/0000.ply")), "<matrix", "value");
  ASSERT_EQ(placed.size(), 16u);
  EXPECT_NEAR(placed[3], 0.1, 1e-6);
  EXPECT_NEAR(placed[7], 0.2, 1e-6);
  EXPECT_NEAR(placed[11], 0.3, 1e-6);
  setup.scene.obstacle[0].from = 1;
  EXPECT_FALSE(says(exported_xml(setup, {}), "bodies/"));
}

TEST(MitsubaScene, GroundIsThereWhereItIsPictured) {
  const auto setup = setup_with_a_ball();
  const std::string there = exported_xml(setup, 0.0f), none = exported_xml(setup, {});
  EXPECT_EQ(occurrences(there, "<emitter type=\"area\">"), 1) << "the key light";
  EXPECT_EQ(occurrences(none, "<emitter type=\"area\">"), 2) << "and the studio's floor";
  EXPECT_NEAR(numbers_after(there, "\"rectangle\"", "translate value").at(2),
              0.5 * setup.scene.fabric.thickness, 1e-7);
}

// The floor of a figure: 0.9 of what 4 sin 30 + 1 of key light and sky leave on it.
TEST(MitsubaScene, TheGroundThrowsBackWhatAFiguresFloorDoes) {
  for (const double albedo :
       numbers_after(exported_xml(setup_with_a_ball(), 0.0f), "\"rectangle\"", "reflectance\" value"))
    EXPECT_NEAR(albedo, 0.30, 0.01);
}

TEST(MitsubaScene, ClothHasTheColourOfThePicturesLook) {
  auto setup = setup_with_a_ball();
  const auto red = [&](const char* look) {
    setup.options.look = look;
    return numbers_after(exported_xml(setup, {}), "\"twosided\"", "reflectance\" value").at(0);
  };
  EXPECT_NEAR(red("clay"), render::linear_of_srgb8()[render::look_named("clay").front[0]], 1e-6);
  EXPECT_EQ(red("curvature"), red("cloth")) << "a look that shows a value has no colour of its own";
}

TEST(MitsubaScene, RakingLightIsThatOfThePictures) {
  auto setup = setup_with_a_ball();
  setup.options.light = Lighting::raking;
  const PictureView view = picture_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, {});
  const std::vector<double> origin = numbers_after(exported_xml(setup, {}), "\"disk\"", "origin"),
                            target = numbers_after(exported_xml(setup, {}), "\"disk\"", "target");
  ASSERT_EQ(origin.size(), 3u);
  const Eigen::Vector3d to_light(origin[0] - target[0], origin[1] - target[1], origin[2] - target[2]);
  const Eigen::Vector3f expected = render::key_direction(view.look, view.camera, {});
  EXPECT_NEAR(to_light.normalized().dot(expected.normalized().cast<double>()), 1, 1e-6);
  EXPECT_LT(std::abs(to_light.normalized().z()), 0.4) << "almost in the plane of the picture";
}

}  // namespace
}  // namespace hysteron::experiments
