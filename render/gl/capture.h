// A vertex program's output kept in a buffer.
#pragma once

#include "render/gl/handles.h"

namespace hysteron::render {

// Runs the program in use for vertices 0 to count - 1 of `arrays` and writes what it captures to `output`.
void capture(const GlFunctions& gl, const GlVertexArray& arrays, GLsizei count, const GlBuffer& output);

}  // namespace hysteron::render
