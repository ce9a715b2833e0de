// The cloth on the GPU: positions change with every picture, and normals are computed from them there.
#pragma once

#include <cstddef>
#include <span>

#include "render/gl/handles.h"
#include "render/gl/program.h"
#include "render/shadow_maps.h"

namespace hysteron::render {

struct ClothTopology {
  size_t vertices = 0;
  std::span<const int> triangles;  // 3 per triangle, counter-clockwise seen from the front
  std::span<const float>
      pattern;  // (warp, weft) coordinates, 2 per vertex [m]; if empty, no threads are drawn
};

// Texture units of the buffers that shaders read vertex by vertex.
inline constexpr int kPositionUnit = 3;
inline constexpr int kIndexUnit = 4;

class ClothSurface {
 public:
  // Error::invalid_input for a triangle that names a vertex beyond `vertices`, or a pattern of another
  // length.
  ClothSurface(const GlFunctions& gl, const ClothTopology& topology);

  size_t vertices() const { return vertices_; }
  size_t triangles() const { return triangles_; }

  // Takes x, y, z of each vertex [m].  Error::invalid_input if their number is not the topology's.
  void set_positions(std::span<const float> xyz);
  // Takes one value per vertex for the colour map; an empty span stands for zero everywhere.
  void set_values(std::span<const float> values);
  // The buffer of x, y, z floats, for a writer on the same GPU (CUDA interop); update_normals() reads it.
  GLuint position_buffer() const { return positions_.name(); }

  // Computes area-weighted normals from the position buffer on the GPU; they are summed in the adjacency's
  // order.
  void update_normals() const;
  // Computes the sky light at every vertex from up-to-date maps and normals; draw() passes it on.
  void update_sky(const ShadowMaps& shadows) const;
  // Draws all triangles in one call with the program in use.
  void draw() const;
  // Draws the sides that belong to one triangle only as lines, in that triangle's direction.
  void draw_boundary() const;

 private:
  void upload_topology(const ClothTopology& topology);
  void upload_adjacency(const ClothTopology& topology);
  void upload_boundary(const ClothTopology& topology);
  void bind_attributes(const ClothTopology& topology);
  void bind_buffer_texture(int unit, const GlTexture& texture) const;

  const GlFunctions* gl_;
  size_t vertices_, triangles_, boundary_ = 0;
  Program normal_program_, sky_program_;
  GlVertexArray arrays_, boundary_arrays_, point_arrays_, no_arrays_;
  GlBuffer positions_, normals_, sky_, values_, pattern_, indices_, boundary_indices_, corner_start_,
      corners_;
  GlTexture position_texture_, index_texture_, corner_start_texture_, corner_texture_;
};

}  // namespace hysteron::render
