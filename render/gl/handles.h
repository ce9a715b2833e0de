// Owners of GL names: each deletes its name with the table of the context that made it.  That context must be
// current when they are made and destroyed.
#pragma once

#include <span>
#include <utility>

#include "render/gl/glfunctions.h"

namespace hysteron::render {

template <class Kind>
class Handle {
 public:
  explicit Handle(const GlFunctions& gl) : gl_(&gl), name_(Kind::make(gl)) {}
  Handle(Handle&& other) noexcept : gl_(other.gl_), name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_ != 0) Kind::destroy(*gl_, name_);
  }

  GLuint name() const { return name_; }

 private:
  const GlFunctions* gl_ = nullptr;
  GLuint name_ = 0;
};

#define HYSTERON_GL_HANDLE(Owner, Generate, Delete)                                  \
  struct Owner##Kind {                                                               \
    static GLuint make(const GlFunctions& gl) {                                      \
      GLuint name = 0;                                                               \
      gl.Generate(1, &name);                                                         \
      return name;                                                                   \
    }                                                                                \
    static void destroy(const GlFunctions& gl, GLuint name) { gl.Delete(1, &name); } \
  };                                                                                 \
  using Owner = Handle<Owner##Kind>;

HYSTERON_GL_HANDLE(GlBuffer, GenBuffers, DeleteBuffers)
HYSTERON_GL_HANDLE(GlVertexArray, GenVertexArrays, DeleteVertexArrays)
HYSTERON_GL_HANDLE(GlTexture, GenTextures, DeleteTextures)
HYSTERON_GL_HANDLE(GlFramebuffer, GenFramebuffers, DeleteFramebuffers)
HYSTERON_GL_HANDLE(GlSampler, GenSamplers, DeleteSamplers)
HYSTERON_GL_HANDLE(GlQuery, GenQueries, DeleteQueries)
HYSTERON_GL_HANDLE(GlRenderbuffer, GenRenderbuffers, DeleteRenderbuffers)
#undef HYSTERON_GL_HANDLE

// Binds a two-dimensional texture to a texture unit.
inline void bind_texture(const GlFunctions& gl, int unit, const GlTexture& texture) {
  gl.ActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
}

struct GlProgramKind {
  static GLuint make(const GlFunctions& gl) { return gl.CreateProgram(); }
  static void destroy(const GlFunctions& gl, GLuint name) { gl.DeleteProgram(name); }
};
using GlProgram = Handle<GlProgramKind>;

template <class Item>
void upload(const GlFunctions& gl, const GlBuffer& buffer, std::span<const Item> items, GLenum usage) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size_bytes()), items.data(), usage);
}

// Gives the bound vertex array an attribute of so many floats per vertex.
inline void attribute(const GlFunctions& gl, GLuint index, const GlBuffer& buffer, GLint components) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.EnableVertexAttribArray(index);
  gl.VertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
}

}  // namespace hysteron::render
