// The multisampled framebuffer that a picture, or a part of it, is drawn into, and the way back to the host.
#pragma once

#include <vector>

#include "render/gl/handles.h"

namespace hysteron::render {

class FrameTarget {
 public:
  // `samples` is clamped to what the driver offers.  Error::invalid_input if the driver cannot hold a picture
  // this large.
  FrameTarget(const GlFunctions& gl, int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }  // a pixel

  // Binds the framebuffer, clears it to this light, 0 transparent and 1 white, and its depth to far.
  void begin(float light) const;
  // The mean of each pixel's samples: RGBA in linear light, rows from the bottom; until the next picture.
  std::vector<float>& finish();

 private:
  const GlFunctions* gl_;
  int width_, height_, samples_;
  GlRenderbuffer color_, depth_, resolved_color_;
  GlFramebuffer multisampled_, resolved_;
  std::vector<float> rgba_;
};

}  // namespace hysteron::render
