// The multisampled framebuffer that a picture, or a part of it, is drawn into, and the way back to the host.
#pragma once

#include <vector>

#include "render/gl/handles.h"

namespace hysteron::render {

// Pixels of a framebuffer, from the bottom.
struct Area {
  int left = 0, bottom = 0, width = 0, height = 0;
};

class FrameTarget {
 public:
  // `samples` is clamped to what the driver offers.  Error::invalid_input if the driver cannot hold a picture
  // this large.
  FrameTarget(const GlFunctions& gl, int width, int height, int samples);

  Area whole() const { return {0, 0, width_, height_}; }
  int samples() const { return samples_; }  // a pixel

  void bind() const { gl_->BindFramebuffer(GL_FRAMEBUFFER, multisampled_.name()); }
  // Binds the framebuffer and clears this area of it, which alone is drawn until finish(), to light from 0,
  // transparent, to 1, white, and its depth to far.
  void begin(float light, const Area& area);
  // The mean of each pixel's samples: RGBA in linear light, rows from the bottom.  Beside the area it is what
  // it was.
  std::vector<float>& finish();

 private:
  const GlFunctions* gl_;
  int width_, height_, samples_;
  GlRenderbuffer color_, depth_, resolved_color_;
  GlFramebuffer multisampled_, resolved_;
  Area area_;
  std::vector<float> rgba_;
};

}  // namespace hysteron::render
