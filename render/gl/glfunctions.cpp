#include "render/gl/glfunctions.h"

#include <string>

#include "sim/base/error.h"

namespace hysteron::render {
namespace {

template <class Pointer>
void load(GlLoader loader, const char* name, Pointer& pointer) {
  pointer = reinterpret_cast<Pointer>(loader(name));
  if (pointer == nullptr)
    throw Error::system(std::string("loading OpenGL: the driver has no ") + name + "; OpenGL 3.3 is needed");
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      return "unknown error";
  }
}

}  // namespace

GlFunctions load_gl_functions(GlLoader loader) {
  GlFunctions gl;
#define HYSTERON_GL_LOAD(type, name) load(loader, "gl" #name, gl.name);
  HYSTERON_GL_FUNCTIONS(HYSTERON_GL_LOAD)
#undef HYSTERON_GL_LOAD
  return gl;
}

void check_gl(const GlFunctions& gl, const char* attempted) {
  const GLenum error = gl.GetError();
  if (error != GL_NO_ERROR)
    throw Error::system(std::string(attempted) + ": OpenGL reports " + error_name(error));
}

}  // namespace hysteron::render
