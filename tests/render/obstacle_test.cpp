// Bodies below coarse cloth: what is drawn of them, and the room's light on them.

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "render/inset.h"
#include "render/shapes.h"
#include "render/srgb.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kObstaclePicture = 300;
constexpr float kMin = 0.8e-3f;  // [m]

Look red_bodies() {
  Look look;
  look.obstacle = {220, 40, 40};
  look.front = look.back = {40, 40, 220};
  look.weave = 0;
  return look;
}

bool is_red(const std::uint8_t* pixel) { return pixel[0] > 1.5 * pixel[2]; }

int red_pixels(const Image& image) { return test::count_pixels(image, is_red); }

class ObstacleTest : public test::OffscreenTest {
 protected:
  std::unique_ptr<ClothView> viewed_cloth(const test::Cloth& cloth, const Look& look = red_bodies()) {
    return test::cloth_view(*offscreen_, {kObstaclePicture, kObstaclePicture}, cloth, look);
  }
};

// Returns a square of `cells` a side, 0.3 m, laid around a horizontal cylinder about the y axis through the
// origin: its vertices touch the upper half, the rest hangs straight down.
test::Cloth around_cylinder(int cells, float radius) {
  test::Cloth cloth = test::flat_square(cells, 0.3f, 0.0f);
  const float quarter = 0.5f * std::numbers::pi_v<float> * radius;
  for (size_t i = 0; i < cloth.positions.size(); i += 3) {
    float& x = cloth.positions[i];
    const float arc = std::abs(x), angle = std::min(arc, quarter) / radius;
    cloth.positions[i + 2] = radius * std::cos(angle) - std::max(arc - quarter, 0.0f);
    x = std::copysign(radius * std::sin(angle), x);
  }
  return cloth;
}

// Sides of 20 mm on 40 mm: the sagitta 1.3 mm is more than the least inset.
TEST_F(ObstacleTest, NoCylinderShowsThroughTheClothAroundIt) {
  constexpr float kRadius = 0.04f;
  for (const int cells : {12, 15, 30}) {
    auto view = viewed_cloth(around_cylinder(cells, kRadius));
    view->add_obstacle(cylinder_mesh(kRadius, 0.2f, 0.002f), placed({0, 0, 0}, {0, 1, 0}));
    for (const Eigen::Vector3f& eye : {Eigen::Vector3f(0, -0.2f, 0.8f), Eigen::Vector3f(0.6f, -0.1f, 0.4f)})
      EXPECT_EQ(red_pixels(view->draw(Camera::perspective(eye, {0, 0, 0}, 18))), 0) << cells << " cells";
  }
}

// The drape hides its pedestal from above, however coarse it is.
TEST_F(ObstacleTest, NoRimShowsThroughACoarseDrape) {
  for (const int rings : {7, 8, 11, 16}) {
    auto view = viewed_cloth(test::draped_disc(rings, 4 * rings));
    view->add_obstacle(cylinder_mesh(0.045f, 0.12f, 0.002f), placed({0, 0, 0.06f}, {0, 0, 1}));
    EXPECT_EQ(red_pixels(view->draw(Camera::top({{-0.1f, -0.1f, 0}, {0.1f, 0.1f, 0.12f}}, 1))), 0)
        << rings << " rings";
  }
}

// A plate of 2 mm beside cloth of 50 mm sides keeps three tenths of its height.
TEST_F(ObstacleTest, AThinPlateIsStillSeen) {
  constexpr float kThick = 2e-3f;
  auto view = viewed_cloth(test::flat_square(4, 0.2f, 0.1f));
  view->add_obstacle(box_mesh({0.02f, 0.02f, kThick / 2}, 0.5e-3f), placed({0, 0, 0}, {0, 0, 1}));
  const Camera camera = Camera::perspective({0, -0.2f, 0}, {0, 0, 0}, 4);
  const double rows = 0.3 * kThick / camera.metres_per_pixel({0, -0.02f, 0}, kObstaclePicture);
  const int middle = kObstaclePicture / 2;
  EXPECT_NEAR(test::count_pixels(view->draw(camera), is_red, middle, 0, middle + 1), rows, 2);
}

TEST_F(ObstacleTest, ABodyOnTheGroundKeepsStandingOnIt) {
  const Camera camera = Camera::perspective({0, -0.5f, 0.02f}, {0, 0, 0.02f}, 20);
  std::vector<int> lowest;
  for (const int cells : {40, 4}) {
    auto view = viewed_cloth(test::flat_square(cells, 0.2f, 0.2f));
    view->add_obstacle(cylinder_mesh(0.03f, 0.06f, 1e-3f), placed({0, 0, 0.03f}, {0, 0, 1}));
    view->set_ground(0.0f);
    const Image image = view->draw(camera);
    int row = kObstaclePicture - 1;
    while (row > 0 && !is_red(image.at(kObstaclePicture / 2, row))) --row;
    lowest.push_back(row);
  }
  EXPECT_NEAR(lowest[0], lowest[1], 1);
}

TEST(Inset, IsTheSagittaOnRoundBodiesAndAShareOfTheSideAtEdges) {
  EXPECT_FLOAT_EQ(cut_depth(0.02f, 0.1f), 0.02f * 0.02f / 0.6f);
  const float edge = 0.02f / 4 / (0.5f + std::sqrt(3.0f) / 2);
  EXPECT_FLOAT_EQ(cut_depth(0.02f, 0), edge);
  EXPECT_FLOAT_EQ(cut_depth(0.02f, 1e-3f), edge);
  const BodyMeasure sphere(sphere_mesh(0.1f));
  EXPECT_FLOAT_EQ(body_inset(sphere, 0.01f, kMin), kMin) << "the cloth would float";
  EXPECT_GT(body_inset(sphere, 0.04f, kMin), 2 * kMin);
  const BodyMeasure plate(box_mesh({0.1f, 0.1f, 0.5e-3f}, 0.1e-3f));
  EXPECT_LT(body_inset(plate, 0.04f, kMin), 0.5e-3f) << "the plate would be turned inside out";
}

TEST(Inset, ABodyIsSmallerByItOnAllSides) {
  constexpr float kInset = 2e-3f;
  for (const TriangleMesh& body : {box_mesh({0.1f, 0.2f, 0.3f}, 5e-3f), torus_mesh(0.1f, 0.02f)}) {
    const Eigen::Vector3f before = BodyMeasure(body).half_extent,
                          after = BodyMeasure(shrunk(body, kInset)).half_extent;
    EXPECT_LT((before - after - Eigen::Vector3f::Constant(kInset)).norm(), 1e-6f);
  }
}

TEST(Inset, SeesTheLongSidesOfACloth) {
  const test::Cloth cloth = test::flat_square(4, 0.2f, 0.0f);
  EXPECT_NEAR(long_side(cloth.triangles, cloth.positions, 3), 0.05f * std::sqrt(2.0f), 1e-6);
  EXPECT_EQ(long_side({}, cloth.positions, 3), 0);
}

// Returns a cuboid of eight corners.
TriangleMesh cuboid(const Eigen::Vector3f& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3f sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.positions.emplace_back(sign.cwiseProduct(half));
    mesh.normals.emplace_back(sign.normalized());
  }
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    for (const int k : {a, b, c, a, c, d}) mesh.triangles.push_back(static_cast<std::uint32_t>(k));
  return mesh;
}

TEST(Refine, KeepsTheSurfaceClosedAndLeavesNoLongSide) {
  constexpr float kLongest = 0.011f;
  const TriangleMesh fine = refined(cuboid({0.1f, 0.05f, 0.01f}), kLongest);
  double volume = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (size_t t = 0; t < fine.triangles.size(); t += 3) {
    const std::uint32_t* corner = &fine.triangles[t];
    Eigen::Matrix3f points;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[k], b = corner[(k + 1) % 3];
      points.col(k) = fine.positions[a];
      EXPECT_LE((fine.positions[a] - fine.positions[b]).norm(), kLongest);
      ++sides[{a, b}];
    }
    volume += points.determinant() / 6;
  }
  EXPECT_NEAR(volume, 0.2 * 0.1 * 0.02, 1e-8);
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({side.second, side.first}), 1u) << "a gap";
  }
  EXPECT_EQ(thrown_error([] { refined(cuboid({1, 1, 1}), 0); }).exit_code(), 2);
}

// With the key light off: the corners of a bare cuboid see all of the sky, its middle below a sheet does not.
TEST_F(ObstacleTest, APlateOfEightCornersIsDarkBelowASheet) {
  const Camera camera = Camera::perspective({0, -0.6f, 0.13f}, {0, 0, 0.01f}, 25);
  std::vector<double> light;
  for (const float height : {0.02f, 0.3f}) {
    Look look = red_bodies();
    look.room = 19.0f / 9;  // the key light's 1.9 - 0.9 room is 0
    auto view = viewed_cloth(test::flat_square(20, 0.1f, height), look);
    view->add_obstacle(cuboid({0.15f, 0.15f, 0.01f}), Eigen::Matrix4f::Identity());
    view->set_bounds({{-0.15f, -0.15f, -0.01f}, {0.15f, 0.15f, 0.3f}});
    // A point 1 cm before the middle is seen below the sheet's near edge.
    const Image image = view->draw(camera);
    light.push_back(linear_of_srgb8()[image.at(kObstaclePicture / 2, kObstaclePicture / 2 + 3)[0]]);
  }
  EXPECT_LT(light[0], 0.6 * light[1]);
}

// Returns a square without thickness that faces up.
TriangleMesh open_square(float half, float z) {
  const std::vector<Eigen::Vector3d> corner = {
      {-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}};
  const std::vector<Eigen::Vector3i> face = {{0, 1, 2}, {0, 2, 3}};
  TriangleMesh mesh = smooth_mesh(corner, face);
  mesh.closed = false;
  return mesh;
}

TEST_F(ObstacleTest, AnOpenBodyIsSeenFromBothSides) {
  for (const bool closed : {false, true}) {
    auto view = viewed_cloth(test::flat_square(4, 0.02f, 0.2f));
    TriangleMesh square = open_square(0.1f, 0);
    square.closed = closed;
    view->add_obstacle(square, placed({0, 0, 0}, {0, 0, 1}));
    const int above = red_pixels(view->draw(Camera::perspective({0, -0.4f, 0.4f}, {0, 0, 0}, 30))),
              below = red_pixels(view->draw(Camera::perspective({0, -0.4f, -0.4f}, {0, 0, 0}, 30)));
    EXPECT_GT(above, 1000);
    if (closed) {
      EXPECT_EQ(below, 0);
    } else {
      EXPECT_NEAR(below, above, 0.1 * above);
    }
  }
}

TEST_F(ObstacleTest, AReshapedBodyIsDrawnAsOneThatHasHadThisShapeFromTheStart) {
  const Camera camera = Camera::perspective({0, -0.6f, 0.3f}, {0, 0, 0}, 30);
  const auto drawn = [&](const TriangleMesh& mesh) {
    auto view = viewed_cloth(test::flat_square(10, 0.2f, 0.15f));
    view->add_obstacle(mesh, placed({0, 0, 0}, {0, 0, 1}));
    return view->draw(camera);
  };
  const TriangleMesh small = sphere_mesh(0.05f), large = sphere_mesh(0.1f);
  auto view = viewed_cloth(test::flat_square(10, 0.2f, 0.15f));
  const int body = view->add_obstacle(small, placed({0, 0, 0}, {0, 0, 1}));
  EXPECT_TRUE(std::ranges::equal(view->draw(camera).pixels(), drawn(small).pixels()));
  view->reshape_obstacle(body, large);
  EXPECT_TRUE(std::ranges::equal(view->draw(camera).pixels(), drawn(large).pixels()));
}

}  // namespace
}  // namespace hysteron::render
