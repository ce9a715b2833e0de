// The multisampled framebuffer that a picture is drawn into, and the way back into an Image.
#pragma once

#include "render/gl/handles.h"
#include "render/image.h"

namespace hysteron::render {

class FrameTarget {
 public:
  // `samples` is clamped to what the driver offers.  Error::request if the driver cannot hold a picture this
  // large.
  FrameTarget(const GlFunctions& gl, int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }

  // Binds the framebuffer and clears its depth; the backdrop covers every pixel.
  void begin() const;
  // Averages the samples in linear light and reads the picture back.
  Image finish() const;

 private:
  const GlFunctions* gl_;
  int width_, height_;
  GlRenderbuffer color_, depth_, resolved_color_;
  GlFramebuffer multisampled_, resolved_;
};

}  // namespace hysteron::render
