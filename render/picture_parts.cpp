#include "render/picture_parts.h"

#include <algorithm>
#include <string>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr int kLargestSide = 65536;  // largest side of a picture [pixels]; more is a mistake

// Returns the size with parts that the driver can hold.
PictureSize checked(Offscreen& offscreen, PictureSize size) {
  const int largest = std::min(size.width, size.height) < 1 ? 0 : std::max(size.width, size.height);
  if (largest < 1 || largest > kLargestSide || size.samples < 1 || size.supersample < 1 || size.tile < 2)
    throw Error::invalid_input("picture of " + std::to_string(size.width) + " x " +
                               std::to_string(size.height) + " pixels: 1 to " + std::to_string(kLargestSide) +
                               " a side are allowed");
  offscreen.make_current();
  GLint most = 0;
  offscreen.gl().GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  size.tile = std::clamp(most / size.supersample, 2, size.tile);
  return size;
}

// Returns the side of the equal parts of a picture; even, so that drivers group the same pixels for
// derivatives.
int part_side(int side, int most) {
  if (side <= most) return side;
  const int parts = (side + most - 1) / most;
  return ((side + parts - 1) / parts + 1) / 2 * 2;
}

void place(Image& picture, const Image& part, int left, int top) {
  const int columns = std::min(part.width(), picture.width() - left), channels = picture.channels();
  for (int y = 0; y < std::min(part.height(), picture.height() - top); ++y)
    std::copy_n(part.at(0, y), columns * channels, picture.at(left, top + y));
}

}  // namespace

void PartView::bind(const Program& program) const {
  program.set("view_projection", view_projection);
  program.set("eye", eye);
  program.set("view_forward", forward);
  program.set("orthographic", orthographic ? 1.0f : 0.0f);
}

PictureParts::PictureParts(Offscreen& offscreen, const PictureSize& size)
    : size_(checked(offscreen, size)),
      width_(part_side(size.width, size_.tile)),
      height_(part_side(size.height, size_.tile)) {}

Eigen::Vector2i PictureParts::drawn_picture() const {
  return size_.supersample * Eigen::Vector2i(size_.width, size_.height);
}

PartView PictureParts::view(const Camera& camera, int left, int top, const Shift& shift) const {
  const double width = size_.width, height = size_.height, bottom = height - top - height_;
  const double dx = shift.x / size_.supersample, dy = shift.y / size_.supersample;
  const Window window{(left + dx) / width, (bottom + dy) / height, (left + width_ + dx) / width,
                      (bottom + height_ + dy) / height};
  const auto scale = static_cast<float>(size_.supersample);
  return {camera.projection(static_cast<float>(width / height), window) * camera.view(),
          camera.eye(),
          camera.forward(),
          camera.is_orthographic(),
          scale * Eigen::Vector2f(static_cast<float>(left), static_cast<float>(bottom)),
          camera.metres_per_pixel(size_.height * size_.supersample)};
}

Image PictureParts::assembled(int channels, const std::function<Image(int left, int top)>& draw) const {
  Image picture(size_.width, size_.height, channels);
  for (int top = 0; top < size_.height; top += height_)
    for (int left = 0; left < size_.width; left += width_) place(picture, draw(left, top), left, top);
  return picture;
}

}  // namespace hysteron::render
