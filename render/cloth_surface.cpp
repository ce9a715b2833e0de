#include "render/cloth_surface.h"

#include <string>
#include <unordered_set>
#include <vector>

#include "render/gl/program.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr int kCornerStartUnit = 5;
constexpr int kCornerUnit = 6;

enum Attribute : GLuint { kPosition, kNormal, kPattern, kValue, kSky };

void require_topology(const ClothTopology& topology) {
  if (topology.vertices == 0 || topology.triangles.empty())
    throw Error::invalid_input("drawing a cloth: it has no triangles");
  for (size_t i = 0; i < topology.triangles.size(); ++i)
    if (topology.triangles[i] < 0 || static_cast<size_t>(topology.triangles[i]) >= topology.vertices)
      throw Error::invalid_input("drawing a cloth: triangle " + std::to_string(i / 3) + " names vertex " +
                                 std::to_string(topology.triangles[i]) + "; allowed: 0 to " +
                                 std::to_string(topology.vertices - 1));
  if (!topology.pattern.empty() && topology.pattern.size() != 2 * topology.vertices)
    throw Error::invalid_input("drawing a cloth: " + std::to_string(topology.pattern.size()) +
                               " pattern coordinates; allowed: none or two for each of " +
                               std::to_string(topology.vertices) + " vertices");
}

void require_count(const char* what, size_t count, size_t expected) {
  if (count != expected)
    throw Error::invalid_input("drawing a cloth: " + std::to_string(count) + " " + what + " given, " +
                               std::to_string(expected) + " expected");
}

void view_as_texture(const GlFunctions& gl, const GlTexture& texture, GLenum format, const GlBuffer& buffer) {
  gl.BindTexture(GL_TEXTURE_BUFFER, texture.name());
  gl.TexBuffer(GL_TEXTURE_BUFFER, format, buffer.name());
}

}  // namespace

ClothSurface::ClothSurface(const GlFunctions& gl, const ClothTopology& topology)
    : gl_(&gl),
      vertices_(topology.vertices),
      triangles_(topology.triangles.size() / 3),
      normal_program_(
          gl, {.vertex = "normals.vert", .fragment = "", .defines = "", .captured = {"smooth_normal"}}),
      sky_program_(
          gl,
          {.vertex = "sky.vert", .fragment = "", .defines = "#define CLOTH\n", .captured = {"vertex_sky"}}),
      arrays_(gl),
      boundary_arrays_(gl),
      point_arrays_(gl),
      no_arrays_(gl),
      positions_(gl),
      normals_(gl),
      sky_(gl),
      values_(gl),
      pattern_(gl),
      indices_(gl),
      boundary_indices_(gl),
      corner_start_(gl),
      corners_(gl),
      position_texture_(gl),
      index_texture_(gl),
      corner_start_texture_(gl),
      corner_texture_(gl) {
  require_topology(topology);
  GLint largest = 0;
  gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &largest);
  if (3 * std::max(vertices_, 2 * triangles_) > static_cast<size_t>(largest))
    throw Error::system("drawing a cloth of " + std::to_string(triangles_) +
                        " triangles: the driver's texture buffers hold " + std::to_string(largest) +
                        " items");
  upload_topology(topology);
  upload_adjacency(topology);
  upload_boundary(topology);
  bind_attributes(topology);
  set_values({});
  check_gl(gl, "uploading a cloth");
}

void ClothSurface::upload_topology(const ClothTopology& topology) {
  const std::vector<float> zeros(3 * vertices_, 0.0f);
  upload<float>(*gl_, positions_, zeros, GL_DYNAMIC_DRAW);
  upload<float>(*gl_, normals_, zeros, GL_DYNAMIC_COPY);
  upload<float>(*gl_, sky_, std::vector<float>(4 * vertices_, 0.0f), GL_DYNAMIC_COPY);
  upload<float>(*gl_, pattern_, topology.pattern, GL_STATIC_DRAW);
  upload<int>(*gl_, indices_, topology.triangles, GL_STATIC_DRAW);
  view_as_texture(*gl_, position_texture_, GL_R32F, positions_);
  view_as_texture(*gl_, index_texture_, GL_R32I, indices_);
}

// Uploads for vertex a the pairs (b, c) of its triangles (a, b, c); those of vertex i are at start[i] to
// start[i + 1] - 1.
void ClothSurface::upload_adjacency(const ClothTopology& topology) {
  const auto& triangles = topology.triangles;
  std::vector<int> start(vertices_ + 1, 0);
  for (const int vertex : triangles.first(3 * triangles_)) ++start[vertex + 1];
  for (size_t i = 0; i < vertices_; ++i) start[i + 1] += start[i];
  std::vector<int> next(start.begin(), start.end() - 1);
  std::vector<int> corners(6 * triangles_);
  for (size_t t = 0; t < triangles_; ++t)
    for (size_t k = 0; k < 3; ++k) {
      int* pair = &corners[2 * static_cast<size_t>(next[triangles[3 * t + k]]++)];
      pair[0] = triangles[3 * t + (k + 1) % 3];
      pair[1] = triangles[3 * t + (k + 2) % 3];
    }
  upload<int>(*gl_, corner_start_, start, GL_STATIC_DRAW);
  upload<int>(*gl_, corners_, corners, GL_STATIC_DRAW);
  view_as_texture(*gl_, corner_start_texture_, GL_R32I, corner_start_);
  view_as_texture(*gl_, corner_texture_, GL_RG32I, corners_);
}

void ClothSurface::upload_boundary(const ClothTopology& topology) {
  const auto& t = topology.triangles;
  const auto side = [&](int from, int to) {
    return static_cast<std::uint64_t>(from) * vertices_ + static_cast<std::uint64_t>(to);
  };
  const auto next = [](size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  std::unordered_set<std::uint64_t> sides;
  for (size_t i = 0; i < 3 * triangles_; ++i) sides.insert(side(t[i], t[next(i)]));
  std::vector<int> ends;
  for (size_t i = 0; i < 3 * triangles_; ++i)
    if (!sides.contains(side(t[next(i)], t[i]))) ends.insert(ends.end(), {t[i], t[next(i)]});
  boundary_ = ends.size() / 2;
  upload<int>(*gl_, boundary_indices_, ends, GL_STATIC_DRAW);
}

void ClothSurface::bind_attributes(const ClothTopology& topology) {
  for (const GlVertexArray* arrays : {&arrays_, &boundary_arrays_}) {
    gl_->BindVertexArray(arrays->name());
    attribute(*gl_, kPosition, positions_, 3);
    attribute(*gl_, kNormal, normals_, 3);
    attribute(*gl_, kSky, sky_, 4);
    if (!topology.pattern.empty()) attribute(*gl_, kPattern, pattern_, 2);
    const GlBuffer& indices = arrays == &arrays_ ? indices_ : boundary_indices_;
    gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
  }
  gl_->BindVertexArray(point_arrays_.name());  // these arrays lack the sky light, which is captured from them
  attribute(*gl_, kPosition, positions_, 3);
  attribute(*gl_, kNormal, normals_, 3);
}

void ClothSurface::set_positions(std::span<const float> xyz) {
  require_count("coordinates", xyz.size(), 3 * vertices_);
  gl_->BindBuffer(GL_ARRAY_BUFFER, positions_.name());
  gl_->BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(xyz.size_bytes()), xyz.data());
}

void ClothSurface::set_values(std::span<const float> values) {
  if (!values.empty()) {
    require_count("values", values.size(), vertices_);
    upload<float>(*gl_, values_, values, GL_DYNAMIC_DRAW);
  }
  for (const GlVertexArray* arrays : {&arrays_, &boundary_arrays_}) {
    gl_->BindVertexArray(arrays->name());
    if (!values.empty()) {
      attribute(*gl_, kValue, values_, 1);
    } else {
      gl_->DisableVertexAttribArray(kValue);
      gl_->VertexAttrib1f(kValue, 0.0f);
    }
  }
}

void ClothSurface::bind_buffer_texture(int unit, const GlTexture& texture) const {
  gl_->ActiveTexture(GL_TEXTURE0 + unit);
  gl_->BindTexture(GL_TEXTURE_BUFFER, texture.name());
}

void ClothSurface::update_normals() const {
  normal_program_.use();
  normal_program_.set("position", kPositionUnit);
  normal_program_.set("corner_start", kCornerStartUnit);
  normal_program_.set("corner", kCornerUnit);
  bind_buffer_texture(kPositionUnit, position_texture_);
  bind_buffer_texture(kCornerStartUnit, corner_start_texture_);
  bind_buffer_texture(kCornerUnit, corner_texture_);
  capture(*gl_, no_arrays_, static_cast<GLsizei>(vertices_), normals_);
}

void ClothSurface::update_sky(const ShadowMaps& shadows) const {
  sky_program_.use();
  shadows.bind(sky_program_);
  capture(*gl_, point_arrays_, static_cast<GLsizei>(vertices_), sky_);
}

void ClothSurface::draw() const {
  bind_buffer_texture(kPositionUnit, position_texture_);
  bind_buffer_texture(kIndexUnit, index_texture_);
  gl_->BindVertexArray(arrays_.name());
  gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles_), GL_UNSIGNED_INT, nullptr);
}

void ClothSurface::draw_boundary() const {
  gl_->BindVertexArray(boundary_arrays_.name());
  gl_->DrawElements(GL_LINES, static_cast<GLsizei>(2 * boundary_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace hysteron::render
