// Scenes for a path tracer: well-formed, and from the pictures' own camera.
#include "experiments/workbench/session/mitsuba_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <vector>

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
  const MitsubaView view = mitsuba_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, floor);
  return mitsuba_scene(view, setup.scene, 0, "0000.ply", {"bodies/0000.ply"});
}

// The numbers of an attribute's first appearance after a word.
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
  const render::Camera camera = mitsuba_view(setup, {{-0.2f, -0.1f, 0}, {0.2f, 0.1f, 0.3f}}, {}).camera;
  const std::vector<double> eye = numbers_after(xml, "<sensor", "origin"),
                            target = numbers_after(xml, "<sensor", "target");
  ASSERT_EQ(eye.size(), 3u);
  ASSERT_EQ(target.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(eye[k], camera.eye()[k], 1e-6);
    EXPECT_NEAR(target[k] - eye[k], camera.forward()[k], 1e-6);
  }
  EXPECT_NEAR(numbers_after(xml, "\"fov\"", "value").at(0), setup.options.camera_fov, 1e-4);
  EXPECT_NE(xml.find("name=\"width\" value=\"400\""), std::string::npos);
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
  EXPECT_EQ(exported_xml(setup, {}).find("bodies/"), std::string::npos);
}

TEST(MitsubaScene, GroundIsThereWhereItIsPictured) {
  const auto setup = setup_with_a_ball();
  EXPECT_NE(exported_xml(setup, 0.0f).find("type=\"rectangle\""), std::string::npos);
  EXPECT_EQ(exported_xml(setup, {}).find("type=\"rectangle\""), std::string::npos);
}

}  // namespace
}  // namespace hysteron::experiments
