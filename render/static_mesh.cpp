#include "render/static_mesh.h"

#include "render/gl/program.h"

namespace hysteron::render {

StaticMesh::StaticMesh(const GlFunctions& gl, const TriangleMesh& mesh)
    : gl_(&gl),
      vertices_(static_cast<GLsizei>(mesh.positions.size())),
      indices_count_(static_cast<GLsizei>(mesh.triangles.size())),
      arrays_(gl),
      point_arrays_(gl),
      positions_(gl),
      normals_(gl),
      sky_(gl),
      indices_(gl) {
  upload<Eigen::Vector3f>(gl, positions_, mesh.positions, GL_STATIC_DRAW);
  upload<Eigen::Vector3f>(gl, normals_, mesh.normals, GL_STATIC_DRAW);
  gl.BindBuffer(GL_ARRAY_BUFFER, sky_.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(4 * sizeof(float)) * vertices_, nullptr,
                GL_DYNAMIC_COPY);
  gl.BindVertexArray(point_arrays_.name());  // these arrays lack the sky light, which is captured from them
  attribute(gl, 0, positions_, 3);
  attribute(gl, 1, normals_, 3);
  gl.BindVertexArray(arrays_.name());
  attribute(gl, 0, positions_, 3);
  attribute(gl, 1, normals_, 3);
  attribute(gl, 4, sky_, 4);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)), mesh.triangles.data(),
                GL_STATIC_DRAW);
}

void StaticMesh::update_sky() const { capture(*gl_, point_arrays_, vertices_, sky_); }

void StaticMesh::draw() const {
  gl_->BindVertexArray(arrays_.name());
  gl_->DrawElements(GL_TRIANGLES, indices_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace hysteron::render
