// Wavefront OBJ in.  tinyobjloader resolves faces, groups and relative indices; it reads a malformed number
// as 0 and may round the last bit, so that the vertices' numbers are read, and refused, here.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/error.h"
#include "sim/mesh/topology.h"
#include "sim/mesh/weld.h"

namespace hysteron {
namespace {

using Uv = std::optional<Eigen::Vector2d>;

// The file's own vertices, and the lines on which vertices and faces stand.
struct Lines {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<int> vertex_line, face_line;
};

// Triangles with their texture coordinates at each corner.
struct Soup {
  std::vector<Eigen::Vector3i> face;
  std::vector<std::array<Uv, 3>> uv;
  std::vector<int> face_line;
};

Error bad_line(const std::string& what, int line, const std::string& problem) {
  return Error::request(what + ": line " + std::to_string(line) + ": " + problem);
}

void check_weld(double distance, const std::string& what) {
  if (distance >= 0 && std::isfinite(distance)) return;
  std::ostringstream text;
  text << what << ": weld = " << distance << " m must be >= 0";
  throw Error::request(text.str());
}

std::string read_text(const std::string& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error::machine("cannot read mesh " + file + ": " + std::strerror(errno));
  std::string text;
  std::vector<char> block(1 << 16);
  while (in.read(block.data(), block.size()), in.gcount() > 0) text.append(block.data(), in.gcount());
  if (in.bad() || std::filesystem::is_directory(file))
    throw Error::machine("cannot read mesh " + file + ": not a readable file");
  return text;
}

std::vector<std::string_view> words(std::string_view line) {
  constexpr std::string_view kBlanks = " \t";
  std::vector<std::string_view> found;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    found.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return found;
}

double finite_number(std::string_view word, const std::string& what, int line) {
  double value = 0;
  const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (code != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    throw bad_line(what, line, "coordinate \"" + std::string(word) + "\" must be a finite number");
  return value;
}

void scan_line(const std::vector<std::string_view>& word, const std::string& what, int line, Lines& lines) {
  if (word.empty()) return;
  if (word[0] == "v") {
    if (word.size() < 4) throw bad_line(what, line, "a vertex needs three coordinates");
    lines.vertex.emplace_back(finite_number(word[1], what, line), finite_number(word[2], what, line),
                              finite_number(word[3], what, line));
    lines.vertex_line.push_back(line);
  } else if (word[0] == "vt") {
    if (word.size() < 3) throw bad_line(what, line, "a texture coordinate needs two numbers");
    for (int i = 1; i <= 2; ++i) finite_number(word[i], what, line);
  } else if (word[0] == "f") {
    if (word.size() != 4 && word.size() != 5)
      throw bad_line(what, line,
                     "a face of " + std::to_string(word.size() - 1) +
                         " corners; allowed are triangles and quads, triangulate the mesh first");
    lines.face_line.push_back(line);
  }
}

Lines scan(const std::string& text, const std::string& what) {
  Lines lines;
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    scan_line(words(std::string_view(text).substr(at, end - at)), what, ++number, lines);
    at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
  }
  return lines;
}

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

// Faces of three or four corners in the file's order, which the loader keeps.
class Faces {
 public:
  Faces(const std::string& text, const std::string& what, const Lines& lines) : what_(what), lines_(lines) {
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    std::istringstream in(text);
    if (!tinyobj::LoadObj(&attributes_, &shapes, &materials, &warning, &error, &in, nullptr, false, false))
      throw Error::request(what + ": " + one_line(error));
    for (const auto& shape : shapes) {
      auto corner = shape.mesh.indices.begin();
      for (const int corners : shape.mesh.num_face_vertices) {
        add_face({corner, corner + corners});
        corner += corners;
      }
    }
  }

  const Soup& soup() const { return soup_; }

 private:
  void add_face(const std::vector<tinyobj::index_t>& corner) {
    const int line = lines_.face_line.at(faces_++);
    for (const auto& c : corner) check_index(c.vertex_index, lines_.vertex.size(), "vertex", line);
    if (corner.size() == 3) return add_triangle(corner[0], corner[1], corner[2], line);
    if (splits_from_first(corner)) {
      add_triangle(corner[0], corner[1], corner[2], line);
      add_triangle(corner[0], corner[2], corner[3], line);
    } else {
      add_triangle(corner[0], corner[1], corner[3], line);
      add_triangle(corner[1], corner[2], corner[3], line);
    }
  }

  // A quad is cut along its shorter diagonal, unless only the other one lies inside it.
  bool splits_from_first(const std::vector<tinyobj::index_t>& corner) const {
    const auto at = [&](int i) { return lines_.vertex[corner[i].vertex_index]; };
    const auto folded = [&](int a, int b, int c, int d) {  // along a-c
      return (at(b) - at(a)).cross(at(c) - at(a)).dot((at(c) - at(a)).cross(at(d) - at(a))) <= 0;
    };
    const bool first = folded(0, 1, 2, 3), second = folded(1, 2, 3, 0);
    if (first != second) return second;
    return (at(2) - at(0)).norm() <= (at(3) - at(1)).norm();
  }

  void add_triangle(const tinyobj::index_t& a, const tinyobj::index_t& b, const tinyobj::index_t& c,
                    int line) {
    soup_.face.emplace_back(a.vertex_index, b.vertex_index, c.vertex_index);
    soup_.uv.push_back({uv(a, line), uv(b, line), uv(c, line)});
    soup_.face_line.push_back(line);
  }

  Uv uv(const tinyobj::index_t& corner, int line) const {
    if (corner.texcoord_index == -1) return {};
    check_index(corner.texcoord_index, attributes_.texcoords.size() / 2, "texture coordinate", line);
    return Eigen::Vector2d(attributes_.texcoords[2 * corner.texcoord_index],
                           attributes_.texcoords[2 * corner.texcoord_index + 1]);
  }

  void check_index(int index, std::size_t count, const std::string& of, int line) const {
    if (index >= 0 && index < static_cast<int>(count)) return;
    const std::string which =
        index < 0 ? "a " + of + " before the first" : of + " " + std::to_string(index + 1);
    throw bad_line(what_, line, "the face uses " + which + "; the file has " + std::to_string(count));
  }

  const std::string& what_;
  const Lines& lines_;
  tinyobj::attrib_t attributes_;
  Soup soup_;
  std::size_t faces_ = 0;
};

// Renumbers the soup's vertices to the kept ones; fills rest and the vertices' lines.
void weld_vertices(double distance, const Lines& lines, ClothMesh& mesh, MeshNames& names) {
  std::vector<int> number(lines.vertex.size());
  std::vector<int> representative;
  if (distance > 0) representative = nearby_representatives(lines.vertex, distance);
  for (std::size_t v = 0; v < lines.vertex.size(); ++v) {
    if (distance > 0 && representative[v] != static_cast<int>(v)) {
      number[v] = number[representative[v]];
      continue;
    }
    number[v] = mesh.vertices();
    mesh.rest.push_back(lines.vertex[v]);
    names.vertex_line.push_back(lines.vertex_line[v]);
  }
  for (auto& face : mesh.face) face = {number[face[0]], number[face[1]], number[face[2]]};
}

bool complete(const std::vector<std::array<Uv, 3>>& uv) {
  for (const auto& corners : uv)
    for (const Uv& at : corners)
      if (!at) return false;
  return true;
}

// Texture coordinates become the pattern where each vertex has one.  Along seams it has several: then each
// triangle keeps the warp direction of its own corners.
void take_pattern(const std::vector<std::array<Uv, 3>>& uv, ClothMesh& mesh) {
  if (!complete(uv)) return;
  std::vector<Uv> pattern(mesh.rest.size());
  bool seams = false;
  for (int f = 0; f < mesh.faces(); ++f) {
    for (int i = 0; i < 3; ++i) {
      Uv& known = pattern[mesh.face[f][i]];
      seams = seams || (known && *known != *uv[f][i]);
      known = uv[f][i];
    }
  }
  for (int f = 0; seams && f < mesh.faces(); ++f)
    mesh.face_warp.push_back(pattern_warp(mesh, f, {*uv[f][0], *uv[f][1], *uv[f][2]}));
  for (std::size_t v = 0; !seams && v < pattern.size(); ++v)
    mesh.pattern.push_back(pattern[v].value_or(Eigen::Vector2d::Zero()));
}

}  // namespace

ClothMesh read_obj(const std::string& file, double weld) {
  MeshNames names{"mesh " + file, {}, {}};
  check_weld(weld, names.what);
  const std::string text = read_text(file);
  const Lines lines = scan(text, names.what);
  const Faces faces(text, names.what, lines);
  ClothMesh mesh;
  mesh.face = faces.soup().face;
  names.face_line = faces.soup().face_line;
  weld_vertices(weld, lines, mesh, names);
  take_pattern(faces.soup().uv, mesh);
  build_topology(mesh, names);
  return mesh;
}

}  // namespace hysteron
