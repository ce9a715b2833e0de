// A picture is drawn in equal parts that a driver can hold, each in several passes with shifted samples.
#pragma once

#include <Eigen/Core>
#include <functional>

#include "render/camera.h"
#include "render/exposure.h"
#include "render/gl/program.h"
#include "render/image.h"
#include "render/offscreen.h"

namespace hysteron::render {

struct PictureSize {
  int width = 1280, height = 720;
  // Samples per pixel.  Four are drawn at a time, which every driver puts at the same places; the picture is
  // drawn again, shifted by a fraction of a pixel, until there are as many.
  int samples = 8;
  int supersample = 1;  // factor by which pictures are drawn larger and averaged; 2 to compare drivers
  // Largest side drawn at once [pixels]; larger pictures are drawn in parts, which bounds the driver's
  // memory.
  int tile = 2048;
  // Passes of a figure, each lit from 12 directions of its own (figure_light.h) in place of the few that a
  // sequence has time for; 0: no figure.
  int figure_passes = 0;
};

// The camera of one pass over one part of the picture.
struct PartView {
  Eigen::Matrix4f view_projection;
  Eigen::Vector3f eye, forward;
  bool orthographic;
  Eigen::Vector2f origin;  // lower left corner of the part in the picture [drawn pixels]
  float pixel;             // width of a drawn pixel where clip space's w is 1 [m]
  bool first = true;       // true in the first of a picture's passes

  // Sets the camera's uniforms in the program in use.
  void bind(const Program& program) const;
};

class PictureParts {
 public:
  // Parts are at most `size.tile` a side, less if the driver holds less.  Error::invalid_input for a side
  // below 1 or above 65536 pixels.
  PictureParts(Offscreen& offscreen, const PictureSize& size);

  const PictureSize& size() const { return size_; }
  int width() const { return width_; }  // size of a part [pixels]
  int height() const { return height_; }
  int drawn_width() const { return width_ * size_.supersample; }  // size of a part [drawn pixels]
  int drawn_height() const { return height_ * size_.supersample; }
  Eigen::Vector2i drawn_picture() const;  // size of the picture [drawn pixels]

  // Returns the view of the part whose upper left pixel is at (left, top), with its samples shifted.
  PartView view(const Camera& camera, int left, int top, const Shift& shift) const;
  // Returns the picture whose parts `draw` returns, by their upper left pixels.
  Image assembled(int channels, const std::function<Image(int left, int top)>& draw) const;

 private:
  PictureSize size_;
  int width_, height_;
};

}  // namespace hysteron::render
