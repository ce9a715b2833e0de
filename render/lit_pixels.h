// Which pixels of a picture have to be lit: no surface that cloth hides, and after the first pass only those
// that differ from a neighbour, for further passes are for edges, threads and rims of shadows (adaptive
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
  // Of a framebuffer of so many pixels.
  LitPixels(const GlFunctions& gl, int width, int height);

  // What is drawn next, until another framebuffer is bound, is the cloth that hides.
  void begin_cloth() const;
  // To the program in use, which includes needed.glsl.
  void bind(const Program& program, bool first_pass) const;
  // Takes the first pass: RGBA rows from the bottom, linear light.
  void take_first(const std::vector<float>& rgba);
  // All that further passes have to draw lies within.
  const Area& uneven_area() const { return uneven_area_; }
  // Gives a further pass the first one's colours where it was not needed.
  void complete(std::vector<float>& rgba) const;

 private:
  const GlFunctions* gl_;
  int width_, height_;
  GlTexture depth_, uneven_;
  GlFramebuffer depth_target_;
  std::vector<float> first_;
  std::vector<std::uint8_t> is_uneven_;  // 255: it is
  Area uneven_area_;
};

}  // namespace hysteron::render
