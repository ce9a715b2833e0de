// Compresses numbers of a mesh: neighbours predict each other, and zlib packs the differences.
//
//        b                 The vertex of highest index is predicted at a + b - c, as in a parallelogram
//      / | \               over the edge (a, b) (Touma & Gotsman 1998).  Several such edges give the mean
//    c   |   v             of their predictions; a vertex without one has the mean of its neighbours of
//      \ | /               lower index, and one without these the vertex before it.
//        a
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron::experiments {

// Compresses in zlib's format (RFC 1950).
std::string deflated(std::string_view bytes);
// Decompresses.  Throws Error::invalid_input unless the result has `size` bytes.
std::string inflated(std::string_view bytes, std::size_t size);

// Packs three vertices a triangle: the first relative to that of the previous triangle, the others relative
// to the first.
std::string packed_triangles(std::span<const int> triangles);
// Unpacks `count` triangles.  Throws Error::invalid_input if the bytes are not that many or name a vertex
// beyond `vertices`.
std::vector<int> unpacked_triangles(std::string_view bytes, std::size_t count, std::size_t vertices);

class MeshPacker {
 public:
  MeshPacker(std::size_t vertices, std::span<const int> triangles);

  // Packs `components` whole numbers a vertex.
  std::string packed(std::span<const int> values, int components) const;
  // Unpacks as many.  Throws Error::invalid_input if the bytes do not hold that many numbers.
  std::vector<int> unpacked(std::string_view bytes, int components) const;

 private:
  std::int64_t expected(std::size_t vertex, std::span<const int> values, int components, int k) const;

  std::size_t vertices_;
  std::vector<std::size_t> first_;           // by vertex: its first index in corners_
  std::vector<std::array<int, 3>> corners_;  // a, b, c of the prediction; c = -1: that of a neighbour a alone
};

}  // namespace hysteron::experiments
