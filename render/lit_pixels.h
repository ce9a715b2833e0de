// Selects the pixels of a picture to be lit: those that cloth does not hide and, after the first pass, only
// those that differ from a neighbour, for further passes are for edges, threads and rims of shadows (adaptive
// sampling by contrast: Mitchell 1987).
#pragma once

#include <cstdint>
#include <vector>

#include "render/frame_target.h"
#include "render/gl/handles.h"
#include "render/gl/program.h"

namespace hysteron::render {

class LitPixels {
 public:
  // Takes the size of the framebuffer [pixels].
  LitPixels(const GlFunctions& gl, int width, int height);

  // Starts the depth of the cloth that hides other surfaces, drawn next until another framebuffer is bound.
  void begin_cloth() const;
  // Sets the uniforms of needed.glsl in the program in use.
  void bind(const Program& program, bool first_pass) const;
  // Takes the first pass: RGBA rows from the bottom, linear light.
  void take_first(const std::vector<float>& rgba);
  // The area that holds all that further passes have to draw.
  const Area& uneven_area() const { return uneven_area_; }
  // Copies the first pass's colours to pixels that a further pass did not need to draw.
  void complete(std::vector<float>& rgba) const;

 private:
  const GlFunctions* gl_;
  int width_, height_;
  GlTexture depth_, uneven_;
  GlFramebuffer depth_target_;
  std::vector<float> first_;
  std::vector<std::uint8_t> is_uneven_;  // 255 where a pixel is uneven, else 0
  Area uneven_area_;
};

}  // namespace hysteron::render
