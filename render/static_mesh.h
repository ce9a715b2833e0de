// A mesh on the GPU that keeps its shape: obstacles and the ground.
#pragma once

#include "render/gl/handles.h"
#include "render/shapes.h"

namespace hysteron::render {

class StaticMesh {
 public:
  StaticMesh(const GlFunctions& gl, const TriangleMesh& mesh);
  // One draw call with the program in use; attribute 0 is the position, 1 the normal.
  void draw() const;

 private:
  const GlFunctions* gl_;
  GLsizei indices_count_;
  GlVertexArray arrays_;
  GlBuffer positions_, normals_, indices_;
};

}  // namespace hysteron::render
