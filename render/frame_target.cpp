#include "render/frame_target.h"

#include <algorithm>
#include <string>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

void require_size(const GlFunctions& gl, int width, int height) {
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width < 1 || height < 1 || width > largest || height > largest)
    throw Error::invalid_input("picture of " + std::to_string(width) + " x " + std::to_string(height) +
                               " pixels: this driver allows 1 to " + std::to_string(largest) + " a side");
}

void attach(const GlFunctions& gl, GLenum attachment, const GlRenderbuffer& buffer) {
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
}

void require_complete(const GlFunctions& gl) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error::system("making the framebuffer: the driver calls it incomplete, status " +
                        std::to_string(status));
}

}  // namespace

FrameTarget::FrameTarget(const GlFunctions& gl, int width, int height, int samples)
    : gl_(&gl),
      width_(width),
      height_(height),
      samples_(1),
      color_(gl),
      depth_(gl),
      resolved_color_(gl),
      multisampled_(gl),
      resolved_(gl) {
  require_size(gl, width, height);
  GLint most_samples = 1;
  gl.GetIntegerv(GL_MAX_SAMPLES, &most_samples);
  samples_ = std::clamp(samples, 1, std::max(most_samples, 1));
  gl.BindRenderbuffer(GL_RENDERBUFFER, color_.name());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA32F, width, height);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depth_.name());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_DEPTH_COMPONENT24, width, height);
  gl.BindRenderbuffer(GL_RENDERBUFFER, resolved_color_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);

  gl.BindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
  attach(gl, GL_COLOR_ATTACHMENT0, color_);
  attach(gl, GL_DEPTH_ATTACHMENT, depth_);
  require_complete(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
  attach(gl, GL_COLOR_ATTACHMENT0, resolved_color_);
  require_complete(gl);
  check_gl(gl, "making the framebuffer");
}

void FrameTarget::begin(float light, const Area& area) {
  area_ = area;
  gl_->BindFramebuffer(GL_FRAMEBUFFER, multisampled_.name());
  gl_->Viewport(0, 0, width_, height_);
  gl_->Enable(GL_SCISSOR_TEST);
  gl_->Scissor(area.left, area.bottom, area.width, area.height);
  gl_->DepthMask(GL_TRUE);
  gl_->ClearColor(light, light, light, light);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::vector<float>& FrameTarget::finish() {
  const auto [left, bottom, width, height] = area_;
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, multisampled_.name());
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
  gl_->BlitFramebuffer(left, bottom, left + width, bottom + height, left, bottom, left + width,
                       bottom + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
  rgba_.resize(static_cast<size_t>(width_) * height_ * 4);
  gl_->PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, width_);
  gl_->ReadPixels(left, bottom, width, height, GL_RGBA, GL_FLOAT,
                  &rgba_[4 * (static_cast<size_t>(bottom) * width_ + left)]);
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, 0);
  check_gl(*gl_, "drawing a picture");
  return rgba_;
}

}  // namespace hysteron::render
