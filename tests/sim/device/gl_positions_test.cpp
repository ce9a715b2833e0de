// Positions that go from CUDA to OpenGL on one GPU against positions that pass the host.
#include "sim/device/gl_positions.h"

#include <gtest/gtest.h>

#include "render/cloth_view.h"
#include "sim/base/error.h"
#include "sim/time/back_end.h"
#include "tests/sim/base/refusal.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::says;
using test::Trial;

constexpr int kDrawnSteps = 50;

Scene hanging(const std::string& device, const std::string& precision) {
  Scene scene = test::hanging_square(1000);
  scene.device = value_named<DeviceChoice>(device);
  scene.precision = value_named<Precision>(precision);
  scene.solver_tolerance = 1e-5;
  return scene;
}

// Where the GPU that simulates draws too; null, and why, where it does not.
std::unique_ptr<render::Offscreen> context_of_the_gpu(std::string& reason) {
  if (gpu_count(reason) == 0) return nullptr;
  try {
    auto offscreen = render::Offscreen::create(render::Renderer::egl, 0);
    if (offscreen->cuda_device() == 0) return offscreen;
    reason = "OpenGL draws elsewhere: " + offscreen->description();
  } catch (const Error& error) {
    reason = error.what();
  }
  return nullptr;
}

struct Drawing {
  std::vector<int> triangles;
  render::ClothView view;

  Drawing(render::Offscreen& offscreen, const Cloth& cloth) : view(offscreen, {320, 240}) {
    for (const auto& t : cloth.mesh.face) triangles.insert(triangles.end(), {t[0], t[1], t[2]});
    set_cloth(cloth);
    view.set_bounds(box());
  }
  static render::Box box() { return {{-0.05f, -0.05f, -0.15f}, {0.25f, 0.25f, 0.05f}}; }
  void set_cloth(const Cloth& cloth) {
    view.set_cloth({static_cast<std::size_t>(cloth.mesh.vertices()), triangles, {}});
  }
  render::Image draw() {
    return view.draw(render::Camera::framing(box(), {0.3f, -1.0f, 0.5f}, 24, 320.0f / 240.0f));
  }
  void set_positions(Simulation& simulation) {
    std::vector<float> xyz;
    for (const auto& p : simulation.positions())
      for (int k = 0; k < 3; ++k) xyz.push_back(static_cast<float>(p[k]));
    view.set_positions(xyz);
  }
};

class CudaToOpenGl : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    std::string reason;
    offscreen_ = context_of_the_gpu(reason);
    if (!offscreen_) GTEST_SKIP() << "no GPU that both simulates and draws: " << reason;
    trial_ = std::make_unique<Trial>(test::rippled(hanging("cuda", GetParam()), 5e-3));
    simulation_ = trial_->simulation();
  }
  testing::AssertionResult share_with(Drawing& drawing) {
    std::string reason;
    auto positions =
        simulation_->share_positions(drawing.view.position_buffer(), offscreen_->cuda_device(), reason);
    if (!positions) return testing::AssertionFailure() << reason;
    drawing.view.share_positions(std::move(positions));
    return testing::AssertionSuccess();
  }
  testing::AssertionResult write(Drawing& drawing) {
    std::string reason;
    if (drawing.view.write_positions(reason)) return testing::AssertionSuccess();
    return testing::AssertionFailure() << reason;
  }

  std::unique_ptr<render::Offscreen> offscreen_;
  std::unique_ptr<Trial> trial_;
  std::unique_ptr<Simulation> simulation_;
};
INSTANTIATE_TEST_SUITE_P(Precisions, CudaToOpenGl, testing::Values("double", "float"), test::CaseName());

// Both ways round the same numbers to float, so that the same driver draws the same bits.
TEST_P(CudaToOpenGl, GivesThePicturesOfPositionsThatPassTheHost) {
  Drawing direct(*offscreen_, trial_->cloth), by_host(*offscreen_, trial_->cloth);
  ASSERT_TRUE(share_with(direct));
  render::Image earlier = direct.draw();
  for (int picture = 0; picture < 3; ++picture) {
    simulation_->advance(kDrawnSteps);
    ASSERT_TRUE(write(direct)) << "picture " << picture;
    by_host.set_positions(*simulation_);
    const render::Image image = direct.draw();
    EXPECT_TRUE(image == by_host.draw()) << "picture " << picture;
    EXPECT_FALSE(image == earlier) << "picture " << picture << " does not follow the cloth";
    earlier = image;
  }
}

TEST_P(CudaToOpenGl, GoesOnAfterTheClothWasSetAgain) {
  Drawing direct(*offscreen_, trial_->cloth), by_host(*offscreen_, trial_->cloth);
  ASSERT_TRUE(share_with(direct));
  ASSERT_TRUE(write(direct));
  direct.set_cloth(trial_->cloth);
  EXPECT_FALSE(write(direct)) << "wrote a buffer that is gone";
  ASSERT_TRUE(share_with(direct));
  ASSERT_TRUE(write(direct));
  by_host.set_positions(*simulation_);
  EXPECT_TRUE(direct.draw() == by_host.draw());
}

TEST_P(CudaToOpenGl, RefusesABufferThatIsTooSmallAndStillSimulates) {
  const Trial coarse(test::hanging_square(100));
  Drawing small(*offscreen_, coarse.cloth);
  ASSERT_TRUE(share_with(small));
  std::string reason;
  EXPECT_FALSE(small.view.write_positions(reason));
  EXPECT_TRUE(says(reason, "bytes"));
  EXPECT_NO_THROW(simulation_->advance(1));
  small.set_positions(*coarse.simulation());
  EXPECT_FALSE(small.draw().empty());
}

TEST_P(CudaToOpenGl, RefusesAContextOnAnotherDevice) {
  const Drawing drawing(*offscreen_, trial_->cloth);
  std::string reason;
  EXPECT_EQ(simulation_->share_positions(drawing.view.position_buffer(), -1, reason), nullptr);
  EXPECT_TRUE(says(reason, "CUDA device 0"));
}

TEST(GlPositions, AreNotToBeHadFromTheCpuWhichSaysSo) {
  const auto simulation = Trial(hanging("cpu", "double")).simulation();
  std::string reason;
  EXPECT_EQ(simulation->cuda_device(), -1);
  EXPECT_EQ(simulation->share_positions(1, 0, reason), nullptr);
  EXPECT_TRUE(says(reason, "CPU"));
}

}  // namespace
}  // namespace hysteron
