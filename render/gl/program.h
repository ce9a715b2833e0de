// A linked GLSL program and its uniforms by name.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>
#include <unordered_map>

#include "render/gl/handles.h"

namespace hysteron::render {

// Shader files of render/shaders/, embedded in the binary; `fragment` and `geometry` may be empty.
struct ProgramFiles {
  std::string_view vertex;
  std::string_view fragment;
  std::string_view defines;                          // lines put before every stage
  std::initializer_list<const char*> captured = {};  // outputs captured by transform feedback
  std::string_view geometry = {};
};

class Program {
 public:
  // Compiles and links; Error::system names the file and the first line of the driver's log.
  Program(const GlFunctions& gl, const ProgramFiles& files);

  void use() const { gl_->UseProgram(program_.name()); }

  // Uniforms of the program in use.  A name that the linker dropped is ignored, as in GL.
  void set(const char* name, float value) const;
  void set(const char* name, int value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  GLint location(const char* name) const;

  const GlFunctions* gl_;
  GlProgram program_;
  mutable std::unordered_map<std::string, GLint> locations_;
};

// The output of a vertex program is kept in a buffer.

// Runs the program in use for vertices 0 to count - 1 of `arrays` and writes what it captures to `output`.
void capture(const GlFunctions& gl, const GlVertexArray& arrays, GLsizei count, const GlBuffer& output);

}  // namespace hysteron::render
