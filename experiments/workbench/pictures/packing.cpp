#include "experiments/workbench/pictures/packing.h"

#include <zlib.h>

#include <algorithm>

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr int kPlanes = 4;                  // bytes of a number, from the lowest
constexpr std::size_t kMaxInflated = 1032;  // most bytes that zlib can encode in one

Error damaged() { return Error::invalid_input("packed numbers are damaged"); }

std::uint32_t folded(std::int32_t value) {  // 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
std::int32_t unfolded(std::uint32_t value) {
  return static_cast<std::int32_t>(value >> 1) ^ -static_cast<std::int32_t>(value & 1);
}

// Compresses the lowest bytes of all numbers, then the next ones: the high ones are mostly zero.
std::string packed_planes(const std::vector<std::int32_t>& values) {
  std::string bytes(kPlanes * values.size(), '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    for (int plane = 0; plane < kPlanes; ++plane)
      bytes[plane * values.size() + i] = static_cast<char>(folded(values[i]) >> (8 * plane) & 255);
  return deflated(bytes);
}

std::vector<std::int32_t> unpacked_planes(std::string_view packed, std::size_t count) {
  const std::string bytes = inflated(packed, kPlanes * count);
  std::vector<std::int32_t> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint32_t value = 0;
    for (int plane = 0; plane < kPlanes; ++plane)
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[plane * count + i]))
               << (8 * plane);
    values[i] = unfolded(value);
  }
  return values;
}

// An edge (low, high) and the corner opposite to it in one of its triangles.
using Wing = std::array<int, 3>;

std::vector<Wing> sorted_wings(std::span<const int> triangles) {
  std::vector<Wing> wings;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const int p = triangles[t + k], q = triangles[t + (k + 1) % 3];
      wings.push_back({std::min(p, q), std::max(p, q), triangles[t + (k + 2) % 3]});
    }
  std::sort(wings.begin(), wings.end());
  return wings;
}

}  // namespace

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
            bytes.size(), Z_BEST_COMPRESSION);
  packed.resize(size);
  return packed;
}

std::string inflated(std::string_view bytes, std::size_t size) {
  if (size / kMaxInflated > bytes.size()) throw damaged();  // before memory is allocated
  std::string plain(size, '\0');
  uLongf found = size;
  const int code = uncompress(reinterpret_cast<Bytef*>(plain.data()), &found,
                              reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  if (code != Z_OK || found != size) throw damaged();
  return plain;
}

std::string packed_triangles(std::span<const int> triangles) {
  std::vector<std::int32_t> steps(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t first = i - i % 3;
    const int from = i != first ? triangles[first] : first > 0 ? triangles[first - 3] : 0;
    steps[i] = triangles[i] - from;
  }
  return packed_planes(steps);
}

std::vector<int> unpacked_triangles(std::string_view bytes, std::size_t count, std::size_t vertices) {
  std::vector<int> triangles = unpacked_planes(bytes, 3 * count);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::size_t first = i - i % 3;
    const std::int64_t from = i != first ? triangles[first] : first > 0 ? triangles[first - 3] : 0;
    const std::int64_t vertex = from + triangles[i];
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices)) throw damaged();
    triangles[i] = static_cast<int>(vertex);
  }
  return triangles;
}

MeshPacker::MeshPacker(std::size_t vertices, std::span<const int> triangles) : vertices_(vertices) {
  std::vector<std::vector<std::array<int, 3>>> across(vertices), beside(vertices);
  const std::vector<Wing> wings = sorted_wings(triangles);
  for (std::size_t i = 0; i < wings.size(); ++i) {
    const auto [a, b, c] = wings[i];
    const bool first = i == 0 || wings[i - 1][0] != a || wings[i - 1][1] != b;
    if (first) {
      beside[b].push_back({a, a, -1});
    } else if (const int other = wings[i - 1][2]; c > b && other < c) {
      across[c].push_back({a, b, other});
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    first_.push_back(corners_.size());
    const auto& known = across[v].empty() ? beside[v] : across[v];
    corners_.insert(corners_.end(), known.begin(), known.end());
  }
  first_.push_back(corners_.size());
}

std::int64_t MeshPacker::expected(std::size_t vertex, std::span<const int> values, int components,
                                  int k) const {
  const auto at = [&](std::size_t v) { return static_cast<std::int64_t>(values[v * components + k]); };
  const std::size_t count = first_[vertex + 1] - first_[vertex];
  if (count == 0) return vertex > 0 ? at(vertex - 1) : 0;
  std::int64_t sum = 0;
  for (std::size_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
    const auto [a, b, c] = corners_[i];
    sum += c < 0 ? at(a) : at(a) + at(b) - at(c);
  }
  const auto n = static_cast<std::int64_t>(count);
  return sum >= 0 ? sum / n : -((-sum + n - 1) / n);  // rounds towards minus infinity
}

std::string MeshPacker::packed(std::span<const int> values, int components) const {
  std::vector<std::int32_t> rest(values.size());
  for (std::size_t v = 0; v < vertices_; ++v)
    for (int k = 0; k < components; ++k)
      rest[k * vertices_ + v] = static_cast<std::int32_t>(
          static_cast<std::int64_t>(values[v * components + k]) - expected(v, values, components, k));
  return packed_planes(rest);
}

std::vector<int> MeshPacker::unpacked(std::string_view bytes, int components) const {
  const std::vector<std::int32_t> rest = unpacked_planes(bytes, components * vertices_);
  std::vector<int> values(rest.size());
  for (std::size_t v = 0; v < vertices_; ++v)
    for (int k = 0; k < components; ++k)
      values[v * components + k] =
          static_cast<int>(expected(v, values, components, k) + rest[k * vertices_ + v]);
  return values;
}

}  // namespace hysteron::experiments
