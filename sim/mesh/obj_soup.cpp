// tinyobjloader resolves faces and relative indices, but reads a malformed number as 0, wraps one of more
// than 32 bits and may round the last bit.  Numbers are therefore read, and refused, here, and the loader
// only sees what it resolves.
#include "sim/mesh/obj_soup.h"

#include <tiny_obj_loader.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/topology.h"

namespace hysteron {

namespace {

// The file's own vertices and texture coordinates, the lines of vertices and faces, and the loader's part of
// each line.
struct Lines {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<Eigen::Vector2d> texture;
  std::vector<int> vertex_line, face_line;
  std::string resolved;
  // The first face that counts back beyond the beginning, which some versions of the loader do not accept.
  struct BeforeFirst {
    int line;
    bool texture;
  };
  std::optional<BeforeFirst> before_first;
};

Error bad_line(const std::string& what, int line, const std::string& problem) {
  return Error::invalid_input(what + ": line " + std::to_string(line) + ": " + problem);
}

// Returns the words of a line without its comment.
std::vector<std::string_view> words(std::string_view line) {
  constexpr std::string_view kBlanks = " \t";
  line = line.substr(0, line.find('#'));
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

// Checks a corner, "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal", counted from 1,
// or from -1 backwards.
void check_corner(std::string_view corner, const std::string& what, int line, Lines& lines) {
  for (std::size_t at = 0, place = 0; place < 3; ++place) {
    const std::size_t end = std::min(corner.find('/', at), corner.size());
    std::int32_t index = 0;
    const auto [rest, code] = std::from_chars(corner.data() + at, corner.data() + end, index);
    const bool left_out = place == 1 && end == at && end < corner.size();
    const bool whole = code == std::errc() && rest == corner.data() + end && index != 0;
    if (!left_out && !whole) break;
    const std::size_t count = place == 0 ? lines.vertex.size() : lines.texture.size();
    if (whole && place < 2 && index < -static_cast<std::int64_t>(count) && !lines.before_first)
      lines.before_first = {line, place == 1};
    if (end == corner.size()) return;
    at = end + 1;
  }
  throw bad_line(what, line,
                 "corner \"" + std::string(corner) +
                     "\" must be a vertex, vertex/texture or vertex/texture/normal, as whole numbers of 32 "
                     "bits other than 0");
}

void add_face(const std::vector<std::string_view>& word, std::string& line) {
  line += "f";
  for (std::size_t i = 1; i < word.size(); ++i) line.append(" ").append(word[i]);
}

// Refuses vertices and faces behind bytes that no editor shows, or in capitals: a reader that passes over
// unknown records would miss them.
void check_record(std::string_view word, const std::string& what, int line) {
  std::string letters;
  for (const unsigned char c : word)
    if (std::isalpha(c) && c < 0x80) letters += static_cast<char>(std::tolower(c));
  if (letters != "v" && letters != "vt" && letters != "f") return;
  throw bad_line(what, line, "\"" + std::string(word) + "\" must be plain \"" + letters + "\"");
}

// Refuses weights other than 1 in "v x y z w": points of a triangle have the weight 1, and readers differ on
// others.
void check_weight(const std::vector<std::string_view>& word, const std::string& what, int line) {
  if (word.size() != 5 || finite_number(word[4], what, line) == 1) return;
  throw bad_line(
      what, line,
      "weight w = " + std::string(word[4]) +
          " of the vertex must be 1 or be left out: divide its coordinates by it, if they are homogeneous");
}

void scan_line(const std::vector<std::string_view>& word, const std::string& what, int line, Lines& lines) {
  if (word.empty()) return;
  if (word[0] == "v") {
    if (word.size() < 4) throw bad_line(what, line, "a vertex needs three coordinates");
    check_weight(word, what, line);
    lines.vertex.emplace_back(finite_number(word[1], what, line), finite_number(word[2], what, line),
                              finite_number(word[3], what, line));
    lines.vertex_line.push_back(line);
    lines.resolved += "v 0 0 0";  // only counted
  } else if (word[0] == "vt") {
    if (word.size() < 3) throw bad_line(what, line, "a texture coordinate needs two numbers");
    lines.texture.emplace_back(finite_number(word[1], what, line), finite_number(word[2], what, line));
    lines.resolved += "vt 0 0";  // only counted
  } else if (word[0] == "vn") {
    lines.resolved += "vn 0 0 1";                  // only counted
  } else if (word[0] == "f" || word[0] == "fo") {  // the notation of files before OBJ 3.0
    if (word.size() != 4 && word.size() != 5)
      throw bad_line(what, line,
                     "a face of " + std::to_string(word.size() - 1) +
                         " corners; allowed are triangles and quads, triangulate the mesh first");
    for (std::size_t i = 1; i < word.size(); ++i) check_corner(word[i], what, line, lines);
    add_face(word, lines.resolved);
    lines.face_line.push_back(line);
  } else {
    check_record(word[0], what, line);
  }
}

std::string file_text(const std::string& file, const std::string& what) {
  std::string text = plain_text(whole_file(file, "cannot read mesh " + file));
  if (text.find('\0') != text.npos)
    throw Error::invalid_input(what + ": not an OBJ: it holds bytes that are no text");
  return text;
}

Error no_such_index(const std::string& what, int line, const std::string& which, std::size_t count) {
  return bad_line(what, line, "the face uses " + which + "; the file has " + std::to_string(count));
}

// Walks through the lines of a text.  A vertex or a face continues in the next line where its line ends in a
// backslash.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : text_(text) {}

  // Reads the next line, joined with those that continue it; false at the end.
  bool next(std::string& line) {
    if (at_ >= text_.size()) return false;
    first_ = read_ + 1;
    line = physical();
    while (at_ < text_.size() && goes_on(line)) {
      line.resize(line.find_last_of('\\'));
      line.append(" ").append(physical());
    }
    return true;
  }
  // Returns the number of the line that next() has read, the first one if it is joined.
  int number() const { return first_; }

 private:
  std::string_view physical() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    ++read_;
    return line;
  }

  // Does the line continue? Names of materials and comments may end in a backslash, too.
  static bool goes_on(std::string_view line) {
    const std::vector<std::string_view> word = words(line);
    if (word.empty() || !word.back().ends_with('\\') || line.find('#') != line.npos) return false;
    const std::string_view record = word[0].ends_with('\\') ? word[0].substr(0, word[0].size() - 1) : word[0];
    return record == "v" || record == "vt" || record == "vn" || record == "f" || record == "fo";
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int read_ = 0, first_ = 0;
};

Lines scan(const std::string& text, const std::string& what) {
  Lines lines;
  TextLines all(text);
  for (std::string line; all.next(line);) {
    scan_line(words(line), what, all.number(), lines);
    lines.resolved += '\n';
  }
  if (const auto& before = lines.before_first)
    throw no_such_index(
        what, before->line,
        before->texture ? "a texture coordinate before the first" : "a vertex before the first",
        before->texture ? lines.texture.size() : lines.vertex.size());
  return lines;
}

// Resolves faces of three or four corners in the file's order, which the loader keeps.
class Faces {
 public:
  Faces(const std::string& what, const Lines& lines) : what_(what), lines_(lines) {
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    std::istringstream in(lines.resolved);
    if (!tinyobj::LoadObj(&attributes_, &shapes, &materials, &warning, &error, &in, nullptr, false, false))
      throw Error::invalid_input(what + ": " + error);
    for (const auto& shape : shapes) {
      auto corner = shape.mesh.indices.begin();
      for (const int corners : shape.mesh.num_face_vertices) {
        add_face({corner, corner + corners});
        corner += corners;
      }
    }
  }

  ObjSoup take_soup() { return std::move(soup_); }

 private:
  void add_face(const std::vector<tinyobj::index_t>& corner) {
    const int line = lines_.face_line.at(faces_++);
    for (const auto& c : corner) check_index(c.vertex_index, lines_.vertex.size(), "vertex", line);
    if (corner.size() == 3) return add_triangle(corner[0], corner[1], corner[2], line);
    const auto at = [&](int i) { return lines_.vertex[corner[i].vertex_index]; };
    if (crosses_itself(at(0), at(1), at(2), at(3))) soup_.crossed_line.push_back(line);
    if (is_cut_from_first(at(0), at(1), at(2), at(3))) {
      add_triangle(corner[0], corner[1], corner[2], line);
      add_triangle(corner[0], corner[2], corner[3], line);
    } else {
      add_triangle(corner[0], corner[1], corner[3], line);
      add_triangle(corner[1], corner[2], corner[3], line);
    }
  }

  void add_triangle(const tinyobj::index_t& a, const tinyobj::index_t& b, const tinyobj::index_t& c,
                    int line) {
    soup_.face.emplace_back(a.vertex_index, b.vertex_index, c.vertex_index);
    soup_.uv.push_back({uv(a, line), uv(b, line), uv(c, line)});
    soup_.face_line.push_back(line);
  }

  Uv uv(const tinyobj::index_t& corner, int line) const {
    if (corner.texcoord_index == -1) return {};
    check_index(corner.texcoord_index, lines_.texture.size(), "texture coordinate", line);
    return lines_.texture[corner.texcoord_index];
  }

  void check_index(int index, std::size_t count, const std::string& of, int line) const {
    if (index >= 0 && index < static_cast<int>(count)) return;
    throw no_such_index(what_, line, of + " " + std::to_string(index + 1), count);
  }

  const std::string& what_;
  const Lines& lines_;
  tinyobj::attrib_t attributes_;
  ObjSoup soup_;
  std::size_t faces_ = 0;
};

}  // namespace

namespace {

bool has_texture(const std::array<Uv, 3>& corners) {
  return std::all_of(corners.begin(), corners.end(), [](const Uv& at) { return at.has_value(); });
}

}  // namespace

ObjSoup read_obj_soup(const std::string& file, const std::string& what) {
  Lines lines = scan(file_text(file, what), what);
  if (lines.vertex.empty() && lines.face_line.empty())
    throw Error::invalid_input(
        what + ": not an OBJ: none of its lines is a vertex, \"v X Y Z\", or a face, \"f A B C\"");
  ObjSoup soup = Faces(what, lines).take_soup();
  soup.vertex = std::move(lines.vertex);
  soup.vertex_line = std::move(lines.vertex_line);
  share_texture(soup);
  return soup;
}

bool has_texture(const ObjSoup& soup) {
  return std::all_of(soup.uv.begin(), soup.uv.end(),
                     [](const std::array<Uv, 3>& corners) { return has_texture(corners); });
}

std::vector<Eigen::Vector2d> vertex_texture(const ObjSoup& soup, const std::vector<Eigen::Vector3i>& face,
                                            std::size_t vertices) {
  std::vector<Uv> known(vertices);
  for (std::size_t f = 0; f < face.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      Uv& at = known[face[f][i]];
      if (at && *at != *soup.uv[f][i]) return {};
      at = soup.uv[f][i];
    }
  }
  std::vector<Eigen::Vector2d> texture;
  texture.reserve(vertices);
  for (const Uv& at : known) texture.push_back(at.value_or(Eigen::Vector2d::Zero()));
  return texture;
}

// The following reads a Wavefront OBJ as a cloth.

namespace {

void check_weld(double distance, const std::string& what) {
  if (distance >= 0 && std::isfinite(distance)) return;
  std::ostringstream text;
  text << what << ": weld = " << distance << " m must be >= 0";
  throw Error::invalid_input(text.str());
}

// Refuses quads that cross themselves, which no two triangles can represent.
void check_quads(const ObjSoup& soup, const std::string& what) {
  if (soup.crossed_line.empty()) return;
  throw Error::invalid_input(what + ": line " + std::to_string(soup.crossed_line.front()) +
                             ": sides of the quad cross: its corners must follow one another around it");
}

// Renumbers the soup's vertices to the kept ones; fills rest and the vertices' lines.
void weld_vertices(double distance, const ObjSoup& soup, ClothMesh& mesh, MeshNames& names) {
  std::vector<int> number(soup.vertex.size());
  std::vector<int> representative;
  if (distance > 0) representative = nearby_representatives(soup.vertex, distance);
  for (std::size_t v = 0; v < soup.vertex.size(); ++v) {
    if (distance > 0 && representative[v] != static_cast<int>(v)) {
      number[v] = number[representative[v]];
      continue;
    }
    number[v] = mesh.vertices();
    mesh.rest.push_back(soup.vertex[v]);
    names.vertex_line.push_back(soup.vertex_line[v]);
  }
  for (auto& face : mesh.face) face = {number[face[0]], number[face[1]], number[face[2]]};
}

// Tells which faces lack texture coordinates: "the face has no texture coordinates, nor have 3 further
// triangles".
std::string without_texture(const std::string& what, const std::vector<int>& lines) {
  return what + ": line " + std::to_string(lines.front()) + ": the face has no texture coordinates" +
         (lines.size() > 1 ? ", nor have " + std::to_string(lines.size() - 1) + " further triangles" : "");
}

// Warns if only some faces have texture coordinates, which `continued` ones got from their neighbours.
std::string texture_warning(const ObjSoup& soup, const std::vector<int>& continued, const std::string& what) {
  std::vector<int> without;
  for (std::size_t f = 0; f < soup.uv.size(); ++f)
    if (!has_texture(soup.uv[f])) without.push_back(soup.face_line[f]);
  if (without.size() == soup.uv.size()) return "";
  if (!without.empty())
    return without_texture(what, without) + ", and no neighbour to tell them, while " +
           std::to_string(soup.uv.size() - without.size()) +
           " others have: none are used, and warp is along x at rest; give them to all faces";
  if (continued.empty()) return "";
  return without_texture(what, continued) + ": those of neighbours go on there, and warp with them";
}

// Makes the texture coordinates the pattern where each vertex has one.  Along seams it has several: then each
// triangle keeps those of its own corners.
void take_pattern(const ObjSoup& soup, ClothMesh& mesh) {
  if (!has_texture(soup)) return;
  mesh.pattern = vertex_texture(soup, mesh.face, mesh.rest.size());
  for (int f = 0; mesh.pattern.empty() && f < mesh.faces(); ++f)
    mesh.panel.push_back({*soup.uv[f][0], *soup.uv[f][1], *soup.uv[f][2]});
}

}  // namespace

ClothMesh read_obj(const std::string& file, double weld, LengthUnit unit,
                   std::vector<std::string>* warnings) {
  MeshNames names{"mesh " + file, {}, {}};
  check_weld(weld, names.what);
  ObjSoup soup = read_obj_soup(file, names.what);
  check_quads(soup, names.what);
  const std::vector<int> continued = continue_texture(soup);
  for (Eigen::Vector3d& x : soup.vertex)
    for (double& length : x) length = in_metres(length, unit);
  ClothMesh mesh;
  mesh.face = soup.face;
  names.face_line = soup.face_line;
  weld_vertices(weld, soup, mesh, names);
  take_pattern(soup, mesh);
  build_topology(mesh, names);
  if (const std::string warning = texture_warning(soup, continued, names.what); warnings && !warning.empty())
    warnings->push_back(warning);
  if (warnings)
    for (const std::string& warning : mesh_warnings(mesh, names)) warnings->push_back(warning);
  return mesh;
}

}  // namespace hysteron
