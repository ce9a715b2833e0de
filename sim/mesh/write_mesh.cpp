// Writes one frame of a cloth as OBJ or PLY.
#include <bit>
#include <cstdint>
#include <cstring>

#include "sim/base/atomic_file.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/mesh/cloth_mesh.h"

namespace hysteron {
namespace {

static_assert(std::endian::native == std::endian::little, "write_ply stores numbers as they lie in memory");

void check_counts(const std::string& file, const ClothMesh& mesh, std::size_t positions, std::size_t values) {
  const std::size_t n = mesh.rest.size();
  if (positions == n && (values == 0 || values == n)) return;
  throw Error::invalid_input("cannot write mesh " + file + ": " + std::to_string(positions) +
                             " positions and " + std::to_string(values) + " values for " + std::to_string(n) +
                             " vertices");
}

template <int N>
void append_line(std::string& text, const char* key, const Eigen::Matrix<double, N, 1>& x) {
  text += key;
  for (int i = 0; i < N; ++i) text += ' ' + number_text(x[i]);
  text += '\n';
}

template <class T>
void append_bytes(std::string& bytes, T value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

void write_whole(const std::string& file, const std::string& content) {
  AtomicFile out(file);
  out.stream().write(content.data(), static_cast<std::streamsize>(content.size()));
  out.commit();
}

std::string ply_header(const ClothMesh& mesh, bool with_value) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices()) +
         "\nproperty double x\nproperty double y\nproperty double z\n" +
         (with_value ? "property double curvature\n" : "") + "element face " + std::to_string(mesh.faces()) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

void write_obj(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position) {
  check_counts(file, mesh, position.size(), 0);
  std::string text;
  for (const auto& x : position) append_line<3>(text, "v", x);
  for (const auto& u : mesh.pattern) append_line<2>(text, "vt", u);
  for (const auto& corners : mesh.panel)
    for (const auto& u : corners) append_line<2>(text, "vt", u);
  for (int f = 0; f < mesh.faces(); ++f) {
    text += 'f';
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.face[f][k];
      text += ' ' + std::to_string(v + 1);
      if (!mesh.panel.empty())
        text += '/' + std::to_string(3 * f + k + 1);
      else if (!mesh.pattern.empty())
        text += '/' + std::to_string(v + 1);
    }
    text += '\n';
  }
  write_whole(file, text);
}

void write_ply(const std::string& file, const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& position,
               const std::vector<double>& value) {
  check_counts(file, mesh, position.size(), value.size());
  std::string bytes = ply_header(mesh, !value.empty());
  for (std::size_t v = 0; v < position.size(); ++v) {
    for (const double x : position[v]) append_bytes(bytes, x);
    if (!value.empty()) append_bytes(bytes, value[v]);
  }
  for (const auto& face : mesh.face) {
    append_bytes(bytes, std::uint8_t{3});
    for (const int v : face) append_bytes(bytes, std::int32_t{v});
  }
  write_whole(file, bytes);
}

}  // namespace hysteron
