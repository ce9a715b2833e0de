// Numbers of a mesh in few bytes: neighbours predict each other, and zlib packs what is left.
//
//        b                 The vertex of highest number is expected where a parallelogram over the edge (a,
//        b)
//      / | \               would put it: at a + b - c (Touma & Gotsman 1998).  Several such edges give the
//      mean
//    c   |   v             of theirs; a vertex without one the mean of its neighbours of lower number, and
//    one
//      \ | /               without these the vertex before it.
//        a
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron::experiments {

// zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);
// Throws Error::invalid_input unless the bytes stand for `size` others.
std::string inflated(std::string_view bytes, std::size_t size);

// Three vertices a triangle: the first less that of the triangle before, the others less the first.
std::string packed_triangles(std::span<const int> triangles);
// `count` triangles.  Throws Error::invalid_input if the bytes are not that many or name a vertex beyond
// `vertices`.
std::vector<int> unpacked_triangles(std::string_view bytes, std::size_t count, std::size_t vertices);

class MeshPacker {
 public:
  MeshPacker(std::size_t vertices, std::span<const int> triangles);

  // `components` whole numbers a vertex.
  std::string packed(std::span<const int> values, int components) const;
  // Throws Error::invalid_input if the bytes are not those of so many numbers.
  std::vector<int> unpacked(std::string_view bytes, int components) const;

 private:
  std::int64_t expected(std::size_t vertex, std::span<const int> values, int components, int k) const;

  std::size_t vertices_;
  std::vector<std::size_t> first_;           // of each vertex in corners_
  std::vector<std::array<int, 3>> corners_;  // a, b, c; c = -1: of a neighbour a alone
};

}  // namespace hysteron::experiments
