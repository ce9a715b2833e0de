// The multisampled framebuffer that a picture, or a part of it, is drawn into and read from.
#pragma once

#include <vector>

#include "render/gl/handles.h"

namespace hysteron::render {

// A rectangle of a framebuffer [pixels], counted from the bottom.
struct Area {
  int left = 0, bottom = 0, width = 0, height = 0;
};

class FrameTarget {
 public:
  // `samples` is clamped to what the driver offers.  Error::invalid_input if the driver cannot hold a picture
  // this large.
  FrameTarget(const GlFunctions& gl, int width, int height, int samples);

  Area whole() const { return {0, 0, width_, height_}; }
  int samples() const { return samples_; }  // samples per pixel

  void bind() const { gl_->BindFramebuffer(GL_FRAMEBUFFER, multisampled_.name()); }
  // Binds the framebuffer, restricts drawing to this area until finish(), and clears the area to light from
  // 0, transparent, to 1, white, and its depth to far.
  void begin(float light, const Area& area);
  // Returns the mean of each pixel's samples: RGBA in linear light, rows from the bottom.  Pixels outside the
  // area keep their earlier values.
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
