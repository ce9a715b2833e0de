// Cloth that does not move looks the same in every picture of a sequence, whatever moves beside it.
#include <algorithm>
#include <cmath>

#include "render/lab.h"
#include "render/shapes.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFlicker = 0.3;  // of L*
constexpr double kLit = 1;        // where what moves takes more of the room's light
constexpr float kRoom = 0.45f;    // of raking light

// As films are drawn: sequences in quality `final`.  Its right half swings, a ball falls beside it.
class StillCloth : public test::OffscreenTest {
 protected:
  StillCloth() {
    Look look;
    look.background = Background::white;
    look.raking = true;
    look.room = kRoom;
    view_ = test::cloth_view(*offscreen_, {.width = kWidth, .height = kHeight}, cloth_, look);
    view_->set_bounds({{-0.2f, -0.2f, -0.1f}, {0.3f, 0.2f, 0.2f}});
    ball_ = view_->add_obstacle(sphere_mesh(0.02f), placed({0.2f, 0, 0.1f}, {0, 0, 1}));
  }

  Image picture(int instant) {
    std::vector<float> now = cloth_.positions;
    for (std::size_t i = 0; i < now.size(); i += 3)
      if (const float beyond = now[i] - kStill; beyond > 0)
        now[i + 2] += 0.05f * static_cast<float>(instant) * beyond;
    view_->set_positions(now);
    view_->move_obstacle(ball_, placed({0.2f, 0, 0.1f - 0.02f * static_cast<float>(instant)}, {0, 0, 1}));
    return view_->draw(camera_);
  }

  static constexpr float kStill = 0.03f;  // x up to which nothing moves [m]
  test::Cloth cloth_ = test::draped_disc(20, 80);
  Camera camera_ = Camera::framing({{-0.13f, -0.13f, 0}, {0.2f, 0.13f, 0.12f}}, {0.35f, -1, 0.5f}, 24,
                                   static_cast<float>(kWidth) / kHeight);
  std::unique_ptr<ClothView> view_;
  int ball_ = 0;
};

// Returns the changes of the means of three by three pixels, which are cloth, to the left of `end`; a single
// pixel changes by a step of its 8 bits if at all, 0.3 to 0.5 where cloth is dark.
std::vector<double> changes(const Image& before, const Image& now, int end) {
  constexpr int kBright = 200;  // of cloth that is lit
  std::vector<double> all;
  for (int y = 1; y + 1 < kHeight; ++y)
    for (int x = 1; x + 1 < end; ++x) {
      double change = 0;
      for (int j = y - 1; j <= y + 1; ++j)
        for (int i = x - 1; i <= x + 1; ++i) change += lightness(now.at(i, j)) - lightness(before.at(i, j));
      if (now.at(x, y)[0] < kBright) all.push_back(std::abs(change) / 9);
    }
  return all;
}

double quantile(std::vector<double> values, double q) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1))];
}

TEST_F(StillCloth, DoesNotFlickerFromPictureToPicture) {
  constexpr int kEnd = 100;  // [pixels] up to where the half that moves is seen
  Image before = picture(0);
  for (int instant = 1; instant < 5; ++instant) {
    const Image now = picture(instant);
    const std::vector<double> still = changes(before, now, kEnd), all = changes(before, now, kWidth);
    ASSERT_GT(still.size(), 1500u);
    EXPECT_LE(quantile(still, 0.99), kFlicker) << "instant " << instant;
    EXPECT_LE(quantile(still, 1), kLit) << "instant " << instant;
    EXPECT_GT(*std::ranges::max_element(all), 10) << "something has to move";
    before = now;
  }
}

}  // namespace
}  // namespace hysteron::render
