#include "render/depth_map.h"

namespace hysteron::render {

GlTexture filtered_texture(const GlFunctions& gl, GLint stored, GLenum channels, int width, int height) {
  GlTexture texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, stored, width, height, 0, channels, GL_FLOAT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

GlTexture depth_map(const GlFunctions& gl, int width, int height) {
  GlTexture texture = filtered_texture(gl, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  return texture;
}

GlFramebuffer depth_target(const GlFunctions& gl, const GlTexture& map) {
  GlFramebuffer target(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, map.name(), 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  return target;
}

}  // namespace hysteron::render
