#include "render/cloth_view.h"

#include <limits>

#include "render/srgb.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

using test::brightness;

constexpr PictureSize kSquarePicture{200, 200};

class ClothViewTest : public test::OffscreenTest {
 protected:
  std::unique_ptr<ClothView> viewed_cloth(const test::Cloth& cloth, const Look& look) {
    return test::cloth_view(*offscreen_, kSquarePicture, cloth, look);
  }
};

// Light from the left: the shadow of a square 0.1 m above the ground lies 0.1 m to its right.
TEST_F(ClothViewTest, GroundIsDarkUnderTheOccludersShadowAndNowhereElse) {
  Look look;
  look.to_light = {-1, 0, 1};
  auto view = viewed_cloth(test::flat_square(8, 0.1f, 0.1f), look);
  view->set_ground(0.0f);
  const Camera camera = Camera::top({{-0.2f, -0.2f, 0}, {0.2f, 0.2f, 0.1f}}, 1);
  const Image image = view->draw(camera);
  const double pixels_per_metre = 1 / camera.metres_per_pixel({0, 0, 0}, kSquarePicture.height);
  const int center = kSquarePicture.width / 2, shadow = center + static_cast<int>(0.11 * pixels_per_metre);
  const double dark = brightness(image, shadow, center);
  const double open = brightness(image, center - static_cast<int>(0.11 * pixels_per_metre), center);
  EXPECT_LT(dark, 0.85 * open);

  auto bare = viewed_cloth(test::flat_square(8, 0.1f, 0.1f), look);
  EXPECT_GT(brightness(bare->draw(camera), shadow, center), 1.1 * dark)
      << "without a ground there is no shadow";
}

TEST_F(ClothViewTest, AnOccluderShadesTheClothBelowIt) {
  Look look;
  look.to_light = {0, 0, 1};
  look.weave = 0;
  auto view = viewed_cloth(test::flat_square(8, 0.2f, 0.0f), look);
  const Camera camera = Camera::perspective({0, -0.6f, 0.25f}, {0, 0, 0.02f}, 30);
  const Image open = view->draw(camera);
  view->add_obstacle(sphere_mesh(0.03f), placed({0, 0, 0.12f}, {0, 0, 1}));
  const Image shaded = view->draw(camera);
  // The cloth's centre projects a little below the middle of the picture.
  EXPECT_LT(brightness(shaded, 100, 108), 0.8 * brightness(open, 100, 108));
}

TEST_F(ClothViewTest, ClothIsShownUnlessItIsBesideThePictureOrBehindAnObstacle) {
  auto view = viewed_cloth(test::flat_square(8, 0.02f, 0.0f), Look{});
  const Camera camera = Camera::perspective({0, -0.6f, 0.25f}, {0, 0, 0}, 30);
  EXPECT_FALSE(view->shows_cloth()) << "nothing is drawn yet";
  view->draw(camera);
  EXPECT_TRUE(view->shows_cloth());
  view->draw(Camera::perspective({0, -0.6f, 0.25f}, {0.5f, 0, 0}, 30));
  EXPECT_FALSE(view->shows_cloth());
  const int ball = view->add_obstacle(sphere_mesh(0.05f), placed({0, -0.2f, 0.083f}, {0, 0, 1}));
  view->draw(camera);
  EXPECT_FALSE(view->shows_cloth());
  view->show_obstacle(ball, false);
  view->draw(camera);
  EXPECT_TRUE(view->shows_cloth());
}

// A board half way to the eye ends in the middle of the picture; it is drawn smaller by 0.8 mm.
TEST_F(ClothViewTest, ABoardBeforeHalfOfTheClothHidesHalfOfIt) {
  auto view = viewed_cloth(test::flat_square(8, 0.02f, 0.0f), Look{});
  const Camera camera = Camera::perspective({0, -0.6f, 0.25f}, {0, 0, 0}, 30);
  const int board =
      view->add_obstacle(box_mesh({0.1f, 0.01f, 0.1f}, 0.001f), placed({-0.1f, -0.3f, 0.125f}, {0, 0, 1}));
  view->draw(camera);
  EXPECT_NEAR(view->hidden_fraction(), 0.5, 0.1);
  view->show_obstacle(board, false);
  view->draw(camera);
  EXPECT_EQ(view->hidden_fraction(), 0);
}

// Closed convex cloth lit from above must not speckle itself: neighbouring pixels of a flat sheet are equal.
TEST_F(ClothViewTest, AFlatSheetDoesNotShadeItself) {
  Look look;
  look.weave = 0;
  for (const Eigen::Vector3f& to_light : {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(1, 0.3f, 0.4f)}) {
    look.to_light = to_light;
    auto view = viewed_cloth(test::flat_square(16, 0.2f, 0.0f), look);
    const Image image = view->draw(Camera::top({{-0.08f, -0.08f, 0}, {0.08f, 0.08f, 0}}, 1));
    int darkest = 255, brightest = 0;
    for (int y = 10; y < 190; ++y)
      for (int x = 10; x < 190; ++x) {
        darkest = std::min<int>(darkest, image.at(x, y)[1]);
        brightest = std::max<int>(brightest, image.at(x, y)[1]);
      }
    constexpr int kRounding = 4;  // 8-bit steps: the fill light turns a little across the view
    EXPECT_LE(brightest - darkest, kRounding);
  }
}

TEST_F(ClothViewTest, FrontAndBackHaveTheirOwnColours) {
  Look look;
  look.front = {200, 40, 40};
  look.back = {40, 40, 200};
  look.weave = 0;
  const test::Cloth cloth = test::flat_square(4, 0.2f, 0.0f);
  auto view = viewed_cloth(cloth, look);
  const Image above = view->draw(Camera::perspective({0, -0.1f, 0.5f}, {0, 0, 0}, 15));
  const Image below = view->draw(Camera::perspective({0, -0.1f, -0.5f}, {0, 0, 0}, 15));
  EXPECT_GT(above.at(100, 100)[0], 2 * above.at(100, 100)[2]);
  EXPECT_GT(below.at(100, 100)[2], 2 * below.at(100, 100)[0]);
}

// Black share of a silhouette times the picture's area is the projected area, here side^2.
TEST_F(ClothViewTest, SilhouetteFromAboveHasTheClothsArea) {
  constexpr float kSide = 0.1234f;
  auto view = viewed_cloth(test::flat_square(3, kSide, 0.05f), look_named("silhouette"));
  const Camera camera = Camera::top({{-0.1f, -0.1f, 0}, {0.1f, 0.1f, 0.1f}}, 1);
  const double area =
      covered_area(view->draw(camera), camera.metres_per_pixel({0, 0, 0}, kSquarePicture.height));
  const double expected = kSide * kSide;
  // Four samples resolve a quarter of a pixel along the outline of 4 * 121 pixels.
  const double tolerance = 4 * kSide * 0.25 * camera.metres_per_pixel({0, 0, 0}, kSquarePicture.height);
  EXPECT_NEAR(area, expected, tolerance);
}

TEST_F(ClothViewTest, ValuesAreShownByTheColourMap) {
  Look look = look_named("curvature");
  look.value_low = -2;
  look.value_high = 2;
  look.to_light = {0, 0, 1};
  const test::Cloth cloth = test::flat_square(4, 0.2f, 0.0f);
  auto view = viewed_cloth(cloth, look);
  const Camera camera = Camera::top({{-0.05f, -0.05f, 0}, {0.05f, 0.05f, 0}}, 1);
  for (const float value : {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f}) {
    view->set_values(std::vector<float>(cloth.values.size(), value));
    const Rgb8 expected = map_color8(look.map, (value + 2) / 4);
    const Image image = view->draw(camera);
    // A sheet that faces the light shows the map's colour itself, up to a common factor near 1.
    const double factor =
        (image.at(100, 100)[0] + image.at(100, 100)[2] + 1.0) / (expected[0] + expected[2] + 1.0);
    EXPECT_NEAR(factor, 1.0, 0.12) << "value " << value;
    EXPECT_NEAR(image.at(100, 100)[0] - image.at(100, 100)[2], expected[0] - expected[2], 25)
        << "value " << value;
  }
}

// Outlines of a cloth turned by a quarter: pictures from opposite directions must be mirror images only if
// normals, which the GPU computes, follow the positions.
TEST_F(ClothViewTest, NormalsFollowThePositions) {
  Look look;
  look.weave = 0;
  look.to_light = {1, 0, 1};
  test::Cloth cloth = test::flat_square(4, 0.2f, 0.0f);
  auto view = viewed_cloth(cloth, look);
  const Camera camera = Camera::top({{-0.05f, -0.05f, 0}, {0.05f, 0.05f, 0}}, 1);
  const double flat = brightness(view->draw(camera), 100, 100);
  std::vector<float> toward = cloth.positions, away = cloth.positions;
  for (size_t i = 0; i < toward.size(); i += 3) {
    toward[i + 2] = -0.5f * toward[i];
    away[i + 2] = 0.5f * away[i];
  }
  view->set_positions(toward);
  EXPECT_GT(brightness(view->draw(camera), 100, 100), flat + 3);
  view->set_positions(away);
  EXPECT_LT(brightness(view->draw(camera), 100, 100), flat - 3);
}

TEST_F(ClothViewTest, WireframeDrawsDarkEdgesOnPaleCloth) {
  const test::Cloth cloth = test::flat_square(4, 0.2f, 0.0f);
  auto view = viewed_cloth(cloth, look_named("wireframe"));
  // One cell is 50 pixels; its edges run through the picture's centre.
  const Image image = view->draw(Camera::top({{-0.098f, -0.098f, 0}, {0.098f, 0.098f, 0}}, 1));
  EXPECT_LT(brightness(image, 100, 100, 0), 0.75 * brightness(image, 112, 112, 1));
}

TEST_F(ClothViewTest, BadInputIsRefused) {
  const test::Cloth cloth = test::flat_square(2, 0.2f, 0.0f);
  ClothView view(*offscreen_, {32, 32});
  EXPECT_EQ(thrown_error([&] { view.set_positions(cloth.positions); }).exit_code(), 2);
  test::Cloth broken = cloth;
  broken.triangles[4] = 99;
  EXPECT_EQ(thrown_error([&] { view.set_cloth(broken.topology()); }).exit_code(), 2);
  view.set_cloth(cloth.topology());
  EXPECT_EQ(thrown_error([&] { view.set_positions(std::vector<float>(5)); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([&] { view.set_values(std::vector<float>(1)); }).exit_code(), 2);
  std::vector<float> holed = cloth.positions;
  holed[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(thrown_error([&] { view.set_positions(holed); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([&] { view.move_obstacle(0, Eigen::Matrix4f::Identity()); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([&] { ClothView(*offscreen_, {0, 720}); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([&] { ClothView(*offscreen_, {1 << 20, 720}); }).exit_code(), 2);
  EXPECT_EQ(thrown_error([] { look_named("velvet"); }).exit_code(), 2);
}

TEST_F(ClothViewTest, AHiddenObstacleIsNeitherSeenNorCastsAShadow) {
  auto view = viewed_cloth(test::flat_square(4, 0.2f, 0.0f), Look{});
  view->set_bounds({{-0.1f, -0.1f, 0}, {0.1f, 0.1f, 0.1f}});
  const Camera camera = Camera::perspective({0, -0.5f, 0.3f}, {0, 0, 0}, 30);
  const Image without = view->draw(camera);
  const int sphere = view->add_obstacle(sphere_mesh(0.03f), placed({0, 0, 0.06f}, {0, 0, 1}));
  EXPECT_NE(view->draw(camera), without);
  view->show_obstacle(sphere, false);
  EXPECT_EQ(view->draw(camera), without);
}

// Obstacles are drawn smaller by what the triangles of the first positions need, in all pictures of a run: a
// view that goes on with later positions, on which triangles are twice as long, is told that side.
TEST_F(ClothViewTest, GoesOnWithTheTrianglesSideOfTheFirstPositions) {
  const test::Cloth small = test::flat_square(2, 0.2f, 0.0f);
  std::vector<float> wide = small.positions;
  for (float& coordinate : wide) coordinate *= 2;
  const Camera camera = Camera::perspective({0, -1, 0.5f}, {0, 0, 0}, 40);
  const auto view_of = [&](const std::vector<float>& first) {
    auto view = viewed_cloth({first, {}, {}, small.triangles}, Look{});
    view->set_bounds({{-0.2f, -0.2f, 0}, {0.2f, 0.2f, 0.2f}});
    view->add_obstacle(sphere_mesh(0.1f), placed({0, 0, 0.15f}, {0, 0, 1}));
    return view;
  };
  auto whole = view_of(small.positions);
  whole->set_positions(wide);
  auto later = view_of(wide);
  const Image expected = whole->draw(camera);
  EXPECT_NE(later->draw(camera), expected) << "the side matters";
  later->set_first_side(whole->first_side().value());
  EXPECT_EQ(later->draw(camera), expected);
}

}  // namespace
}  // namespace hysteron::render
