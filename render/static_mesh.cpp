#include "render/static_mesh.h"

namespace hysteron::render {
namespace {

void upload_vectors(const GlFunctions& gl, GLuint attribute, const GlBuffer& buffer,
                    const std::vector<Eigen::Vector3f>& vectors) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.name());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vectors.size() * sizeof(Eigen::Vector3f)),
                vectors.data(), GL_STATIC_DRAW);
  gl.EnableVertexAttribArray(attribute);
  gl.VertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
}

}  // namespace

StaticMesh::StaticMesh(const GlFunctions& gl, const TriangleMesh& mesh)
    : gl_(&gl),
      indices_count_(static_cast<GLsizei>(mesh.triangles.size())),
      arrays_(gl),
      positions_(gl),
      normals_(gl),
      indices_(gl) {
  gl.BindVertexArray(arrays_.name());
  upload_vectors(gl, 0, positions_, mesh.positions);
  upload_vectors(gl, 1, normals_, mesh.normals);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)), mesh.triangles.data(),
                GL_STATIC_DRAW);
}

void StaticMesh::draw() const {
  gl_->BindVertexArray(arrays_.name());
  gl_->DrawElements(GL_TRIANGLES, indices_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace hysteron::render
