// Read here and not by tinyobjloader, which takes a malformed number for 0, wraps one of more than 32 bits,
// may round the last bit and keeps no line for its messages.
#include "sim/mesh/obj_soup.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/topology.h"

namespace hysteron {

namespace {

// What a corner of a face names, counted from 0; below 0 where that is before the first.
struct Corner {
  std::optional<int> vertex, texture, normal;
};

// Of a line without its comment.
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

// Text may begin with a byte order mark.
std::string file_text(const std::string& file, const std::string& what) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string text = whole_file(file, "cannot read mesh " + file);
  if (text.find('\0') != text.npos)
    throw Error::invalid_input(what + ": not an OBJ: it holds bytes that are no text");
  return text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
}

// Takes the lines of a file in their order.
class ObjReader {
 public:
  explicit ObjReader(const std::string& what) : what_(what) {}

  ObjSoup read(const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      ++line_;
      read_line(words(std::string_view(text).substr(at, end - at)));
      at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    }
    if (soup_.vertex.empty() && face_.empty())
      throw Error::invalid_input(
          what_ + ": not an OBJ: none of its lines is a vertex, \"v X Y Z\", or a face, \"f A B C\"");
    for (const Face& face : face_) add(face);
    return std::move(soup_);
  }

 private:
  struct Face {
    int line;
    std::vector<Corner> corner;
  };

  Error bad_line(const std::string& problem) const {
    return Error::invalid_input(what_ + ": line " + std::to_string(line_) + ": " + problem);
  }

  void read_line(const std::vector<std::string_view>& word) {
    if (word.empty()) return;
    if (word[0] == "v") {
      if (word.size() < 4) throw bad_line("a vertex needs three coordinates");
      soup_.vertex.emplace_back(finite_number(word[1]), finite_number(word[2]), finite_number(word[3]));
      soup_.vertex_line.push_back(line_);
    } else if (word[0] == "vt") {
      if (word.size() < 3) throw bad_line("a texture coordinate needs two numbers");
      texture_.emplace_back(finite_number(word[1]), finite_number(word[2]));
    } else if (word[0] == "vn") {
      ++normals_;
    } else if (word[0] == "f" || word[0] == "fo") {  // as files before OBJ 3.0 have it
      if (word.size() != 4 && word.size() != 5)
        throw bad_line("a face of " + std::to_string(word.size() - 1) +
                       " corners; allowed are triangles and quads, triangulate the mesh first");
      face_.push_back({line_, {}});
      for (std::size_t i = 1; i < word.size(); ++i) face_.back().corner.push_back(corner(word[i]));
    } else {
      check_record(word[0]);
    }
  }

  double finite_number(std::string_view word) const {
    const std::optional<double> value = number_in(word.substr(word.starts_with('+') ? 1 : 0));
    if (!value || !std::isfinite(*value))
      throw bad_line("coordinate \"" + std::string(word) + "\" must be a finite number");
    return *value;
  }

  // "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal", counted from 1, or from -1
  // backwards.
  Corner corner(std::string_view word) const {
    const std::size_t count[] = {soup_.vertex.size(), texture_.size(), normals_};
    Corner result;
    std::optional<int>* const part[] = {&result.vertex, &result.texture, &result.normal};
    for (std::size_t at = 0, place = 0; place < 3; ++place) {
      const std::size_t end = std::min(word.find('/', at), word.size());
      const std::optional<std::int32_t> index = number_in<std::int32_t>(word.substr(at, end - at));
      const bool left_out = place == 1 && end == at && end < word.size();
      if (!left_out && index.value_or(0) == 0) break;
      if (!left_out) *part[place] = *index > 0 ? *index - 1 : counted_back(*index, count[place]);
      if (end == word.size()) return result;
      at = end + 1;
    }
    throw bad_line("corner \"" + std::string(word) +
                   "\" must be a vertex, vertex/texture or vertex/texture/normal, as whole numbers of 32 "
                   "bits other than 0");
  }
  static int counted_back(std::int64_t index, std::size_t count) {
    return static_cast<int>(std::max<std::int64_t>(static_cast<std::int64_t>(count) + index, -1));
  }

  // A vertex or a face behind bytes that no editor shows, or in capitals, is none to a reader that passes
  // over what it does not know.
  void check_record(std::string_view word) const {
    std::string letters;
    for (const unsigned char c : word)
      if (std::isalpha(c) && c < 0x80) letters += static_cast<char>(std::tolower(c));
    if (letters != "v" && letters != "vt" && letters != "f") return;
    throw bad_line("\"" + std::string(word) + "\" must be plain \"" + letters + "\"");
  }

  // What a face names may follow it.
  void add(const Face& face) {
    line_ = face.line;
    std::vector<int> vertex;
    std::vector<Eigen::Vector3d> at;
    std::vector<Uv> uv;
    for (const Corner& c : face.corner) {
      check_index(*c.vertex, soup_.vertex.size(), "vertex");
      vertex.push_back(*c.vertex);
      at.push_back(soup_.vertex[*c.vertex]);
    }
    for (const Corner& c : face.corner) {
      if (c.texture) check_index(*c.texture, texture_.size(), "texture coordinate");
      if (c.normal.value_or(0) < 0) check_index(*c.normal, normals_, "normal");  // none is read
      uv.push_back(c.texture ? Uv(texture_[*c.texture]) : Uv());
    }
    if (at.size() == 4 && crosses_itself(at[0], at[1], at[2], at[3])) soup_.crossed_line.push_back(line_);
    for (const auto& [i, j, k] : triangles_of(at)) {
      soup_.face.emplace_back(vertex[i], vertex[j], vertex[k]);
      soup_.uv.push_back({uv[i], uv[j], uv[k]});
      soup_.face_line.push_back(line_);
    }
  }

  void check_index(int index, std::size_t count, const std::string& of) const {
    if (index >= 0 && index < static_cast<int>(count)) return;
    const std::string which =
        index < 0 ? "a " + of + " before the first" : of + " " + std::to_string(index + 1);
    throw bad_line("the face uses " + which + "; the file has " + std::to_string(count));
  }

  const std::string& what_;
  int line_ = 0;
  ObjSoup soup_;
  std::vector<Eigen::Vector2d> texture_;
  std::size_t normals_ = 0;
  std::vector<Face> face_;
};

}  // namespace

ObjSoup read_obj_soup(const std::string& file, const std::string& what) {
  return ObjReader(what).read(file_text(file, what));
}

bool has_texture(const ObjSoup& soup) {
  for (const auto& corners : soup.uv)
    for (const Uv& at : corners)
      if (!at) return false;
  return true;
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

// Wavefront OBJ in, as a cloth.

namespace {

void check_weld(double distance, const std::string& what) {
  if (distance >= 0 && std::isfinite(distance)) return;
  std::ostringstream text;
  text << what << ": weld = " << distance << " m must be >= 0";
  throw Error::invalid_input(text.str());
}

// No two triangles are such a quad.
void check_quads(const ObjSoup& soup, const std::string& what) {
  if (soup.crossed_line.empty()) return;
  throw Error::invalid_input(what + ": line " + std::to_string(soup.crossed_line.front()) +
                             ": sides of the quad cross: its corners must follow one another around it");
}

// Texture coordinates become the pattern where each vertex has one.  Along seams it has several: then each
// triangle keeps those of its own corners.
void take_pattern(const ObjSoup& soup, ClothMesh& mesh) {
  if (!has_texture(soup)) return;
  mesh.pattern = vertex_texture(soup, mesh.face, mesh.rest.size());
  for (int f = 0; mesh.pattern.empty() && f < mesh.faces(); ++f)
    mesh.panel.push_back({*soup.uv[f][0], *soup.uv[f][1], *soup.uv[f][2]});
}

}  // namespace

ClothMesh read_obj(const std::string& file, double weld, LengthUnit unit, std::vector<std::string>* doubts) {
  MeshNames names{"mesh " + file, {}, {}};
  check_weld(weld, names.what);
  ObjSoup soup = read_obj_soup(file, names.what);
  check_quads(soup, names.what);
  for (Eigen::Vector3d& x : soup.vertex)
    for (double& length : x) length = in_metres(length, unit);
  ClothMesh mesh;
  mesh.rest = soup.vertex;
  mesh.face = soup.face;
  names.face_line = soup.face_line;
  names.vertex_line = soup.vertex_line;
  if (weld > 0) {
    names.vertex_line.clear();
    for (const int kept : weld_vertices(mesh, weld)) names.vertex_line.push_back(soup.vertex_line[kept]);
  }
  take_pattern(soup, mesh);
  build_topology(mesh, names);
  if (doubts)
    for (const std::string& doubt : mesh_doubts(mesh, names)) doubts->push_back(doubt);
  return mesh;
}

}  // namespace hysteron
