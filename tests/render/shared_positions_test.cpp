// A view's position buffer is written from outside; here by a writer that needs no GPU.

#include <optional>

#include "render/cloth_view.h"
#include "tests/render/test_scene.h"

namespace hysteron::render {
namespace {

constexpr PictureSize kSharedPicture{200, 200};

// Writes through OpenGL; notes whether its buffer still existed when it was closed.
class HostPositions : public GlPositions {
 public:
  HostPositions(const GlFunctions& gl, GLuint buffer, std::vector<float> xyz,
                std::optional<bool>& closed_in_time)
      : gl_(gl), buffer_(buffer), xyz_(std::move(xyz)), closed_in_time_(closed_in_time) {}
  ~HostPositions() override {
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);  // refused by a core context if the name is gone
    closed_in_time_ = gl_.GetError() == GL_NO_ERROR;
  }
  bool write(std::string& reason) override {
    if (xyz_.empty()) {
      reason = "nothing to write";
      return false;
    }
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
    gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(xyz_.size() * sizeof(float)), xyz_.data());
    return true;
  }

 private:
  const GlFunctions& gl_;
  GLuint buffer_;
  std::vector<float> xyz_;
  std::optional<bool>& closed_in_time_;
};

class SharedPositions : public test::OffscreenTest {
 protected:
  std::unique_ptr<ClothView> new_view() {
    auto view = std::make_unique<ClothView>(*offscreen_, kSharedPicture);
    view->set_cloth(cloth_.topology());
    view->set_bounds({{-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}});
    return view;
  }
  void share_with(ClothView& view, std::vector<float> xyz) {
    view.share_positions(std::make_unique<HostPositions>(offscreen_->gl(), view.position_buffer(),
                                                         std::move(xyz), closed_in_time_));
  }
  Image draw(ClothView& view) { return view.draw(Camera::perspective({0.1f, -0.6f, 0.3f}, {0, 0, 0}, 25)); }

  test::Cloth cloth_ = test::flat_square(8, 0.2f, 0.02f);
  std::optional<bool> closed_in_time_;
  std::string reason_;
};

TEST_F(SharedPositions, GiveThePictureOfPositionsThatWereSet) {
  auto shared = new_view(), set = new_view();
  share_with(*shared, cloth_.positions);
  EXPECT_TRUE(shared->write_positions(reason_));
  set->set_positions(cloth_.positions);
  EXPECT_EQ(draw(*shared), draw(*set));
  shared->set_positions(std::vector<float>(cloth_.positions.size()));
  EXPECT_NE(draw(*shared), draw(*set)) << "the picture does not depend on the positions";
  EXPECT_TRUE(shared->write_positions(reason_));
  EXPECT_EQ(draw(*shared), draw(*set));
  EXPECT_FALSE(closed_in_time_.has_value());
}

TEST_F(SharedPositions, AreClosedBeforeTheirBufferGoes) {
  auto view = new_view();
  share_with(*view, cloth_.positions);
  view->set_cloth(cloth_.topology());
  EXPECT_EQ(closed_in_time_, true);
  EXPECT_FALSE(view->write_positions(reason_)) << "wrote a buffer that is gone";

  closed_in_time_.reset();
  share_with(*view, cloth_.positions);
  EXPECT_TRUE(view->write_positions(reason_));
  const auto another = Offscreen::create(Renderer::automatic);  // is current now
  view.reset();
  EXPECT_EQ(closed_in_time_, true);
}

TEST_F(SharedPositions, AreGivenUpWhenWritingFails) {
  auto view = new_view();
  EXPECT_FALSE(view->write_positions(reason_));
  EXPECT_EQ(reason_, "") << "nothing was shared, so nothing failed";
  share_with(*view, {});
  EXPECT_FALSE(view->write_positions(reason_));
  EXPECT_EQ(reason_, "nothing to write");
  EXPECT_EQ(closed_in_time_, true);
  EXPECT_NO_THROW(view->set_positions(cloth_.positions));
}

}  // namespace
}  // namespace hysteron::render
