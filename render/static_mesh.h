// A mesh on the GPU that keeps its shape: obstacles and the ground.
#pragma once

#include "render/gl/handles.h"
#include "render/shapes.h"

namespace hysteron::render {

class StaticMesh {
 public:
  StaticMesh(const GlFunctions& gl, const TriangleMesh& mesh);
  // Draws the mesh in one call with the program in use; attribute 0 is the position, 1 the normal.
  void draw() const;
  // Stores the output of the program in use at every vertex, 4 floats, as attribute 4 of draw().
  void update_sky() const;

 private:
  const GlFunctions* gl_;
  GLsizei vertices_, indices_count_;
  GlVertexArray arrays_, point_arrays_;
  GlBuffer positions_, normals_, sky_, indices_;
};

}  // namespace hysteron::render
