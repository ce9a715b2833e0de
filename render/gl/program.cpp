#include "render/gl/program.h"

#include <vector>

#include "render/shaders/embedded.h"
#include "sim/base/error.h"

namespace hysteron::render {

namespace {

constexpr std::string_view kVersion = "#version 330 core\n";
constexpr std::string_view kIncludeMark = "#include \"";

std::string shader_text(std::string_view file) {
  const auto bytes = embedded_file(file);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// GLSL has no #include; shared functions stand once in a file of their own and are put in here.
std::string with_includes(std::string text) {
  for (size_t at = text.find(kIncludeMark); at != std::string::npos; at = text.find(kIncludeMark)) {
    const size_t begin = at + kIncludeMark.size();
    const size_t end = text.find('"', begin);
    text.replace(at, end + 1 - at, shader_text(text.substr(begin, end - begin)));
  }
  return text;
}

std::string first_line(const std::string& log) { return log.substr(0, log.find('\n')); }

GLuint compile(const GlFunctions& gl, GLenum stage, std::string_view file, std::string_view defines) {
  const std::string source = std::string(kVersion) + std::string(defines) + with_includes(shader_text(file));
  const char* text = source.c_str();
  const GLuint shader = gl.CreateShader(stage);
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::vector<char> log(4096, '\0');
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  gl.DeleteShader(shader);
  throw Error::system("compiling " + std::string(file) + ": " + first_line(log.data()));
}

void attach(const GlFunctions& gl, GLuint program, GLenum stage, std::string_view file,
            std::string_view defines) {
  if (file.empty()) return;
  const GLuint shader = compile(gl, stage, file, defines);
  gl.AttachShader(program, shader);
  gl.DeleteShader(shader);
}

}  // namespace

Program::Program(const GlFunctions& gl, const ProgramFiles& files) : gl_(&gl), program_(gl) {
  const GLuint name = program_.name();
  attach(gl, name, GL_VERTEX_SHADER, files.vertex, files.defines);
  attach(gl, name, GL_GEOMETRY_SHADER, files.geometry, files.defines);
  attach(gl, name, GL_FRAGMENT_SHADER, files.fragment, files.defines);
  if (files.captured.size() > 0)
    gl.TransformFeedbackVaryings(name, static_cast<GLsizei>(files.captured.size()), files.captured.begin(),
                                 GL_INTERLEAVED_ATTRIBS);
  gl.LinkProgram(name);
  GLint linked = 0;
  gl.GetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked) return;
  std::vector<char> log(4096, '\0');
  gl.GetProgramInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  throw Error::system("linking " + std::string(files.vertex) + " and " + std::string(files.fragment) + ": " +
                      first_line(log.data()));
}

GLint Program::location(const char* name) const {
  const auto [entry, is_new] = locations_.try_emplace(name, -1);
  if (is_new) entry->second = gl_->GetUniformLocation(program_.name(), name);
  return entry->second;
}

void Program::set(const char* name, float value) const { gl_->Uniform1f(location(name), value); }
void Program::set(const char* name, int value) const { gl_->Uniform1i(location(name), value); }

void Program::set(const char* name, const Eigen::Vector2f& value) const {
  gl_->Uniform2f(location(name), value.x(), value.y());
}

void Program::set(const char* name, const Eigen::Vector3f& value) const {
  gl_->Uniform3f(location(name), value.x(), value.y(), value.z());
}

void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

void capture(const GlFunctions& gl, const GlVertexArray& arrays, GLsizei count, const GlBuffer& output) {
  gl.BindVertexArray(arrays.name());
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, output.name());
  gl.Enable(GL_RASTERIZER_DISCARD);
  gl.BeginTransformFeedback(GL_POINTS);
  gl.DrawArrays(GL_POINTS, 0, count);
  gl.EndTransformFeedback();
  gl.Disable(GL_RASTERIZER_DISCARD);
  gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

}  // namespace hysteron::render
