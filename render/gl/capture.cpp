#include "render/gl/capture.h"

namespace hysteron::render {

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
