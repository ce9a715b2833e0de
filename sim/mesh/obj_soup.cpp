#include "sim/mesh/obj_soup.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/plain_text.h"
#include "sim/base/whole_file.h"

namespace hysteron {

namespace {

// Numbers of a face's corner, counted from 0; below 0 they count back beyond the file's first.
struct Corner {
  std::int64_t vertex = 0;
  std::optional<std::int64_t> texture;
};

struct Face {
  std::vector<Corner> corner;  // three or four
  int line;
};

// The records of a file, in the order of its lines: faces may use vertices that come later.
struct Records {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<Eigen::Vector2d> texture;
  std::vector<int> vertex_line;
  std::vector<Face> face;
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

// Reads a corner, "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal", counted from 1, or
// from -1 backwards.
Corner corner_in(std::string_view word, const std::string& what, int line, const Records& records) {
  const auto from_first = [](std::int32_t index, std::size_t count) {
    return index > 0 ? index - std::int64_t{1} : static_cast<std::int64_t>(count) + index;
  };
  Corner corner;
  for (std::size_t at = 0, place = 0; place < 3; ++place) {
    const std::size_t end = std::min(word.find('/', at), word.size());
    std::int32_t index = 0;
    const auto [rest, code] = std::from_chars(word.data() + at, word.data() + end, index);
    const bool left_out = place == 1 && end == at && end < word.size();
    const bool whole = code == std::errc() && rest == word.data() + end && index != 0;
    if (!left_out && !whole) break;
    if (whole && place == 0) corner.vertex = from_first(index, records.vertex.size());
    if (whole && place == 1) corner.texture = from_first(index, records.texture.size());
    if (end == word.size()) return corner;
    at = end + 1;
  }
  throw bad_line(what, line,
                 "corner \"" + std::string(word) +
                     "\" must be a vertex, vertex/texture or vertex/texture/normal, as whole numbers of 32 "
                     "bits other than 0");
}

Face face_in(const std::vector<std::string_view>& word, const std::string& what, int line,
             const Records& records) {
  if (word.size() != 4 && word.size() != 5)
    throw bad_line(what, line,
                   "a face of " + std::to_string(word.size() - 1) +
                       " corners; allowed are triangles and quads, triangulate the mesh first");
  Face face{{}, line};
  for (std::size_t i = 1; i < word.size(); ++i)
    face.corner.push_back(corner_in(word[i], what, line, records));
  return face;
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

void read_line(const std::vector<std::string_view>& word, const std::string& what, int line,
               Records& records) {
  if (word.empty()) return;
  const auto number = [&](std::size_t i) { return finite_number(word[i], what, line); };
  if (word[0] == "v") {
    if (word.size() < 4) throw bad_line(what, line, "a vertex needs three coordinates");
    check_weight(word, what, line);
    records.vertex.emplace_back(number(1), number(2), number(3));
    records.vertex_line.push_back(line);
  } else if (word[0] == "vt") {
    if (word.size() < 3) throw bad_line(what, line, "a texture coordinate needs two numbers");
    records.texture.emplace_back(number(1), number(2));
  } else if (word[0] == "f" || word[0] == "fo") {  // the notation of files before OBJ 3.0
    records.face.push_back(face_in(word, what, line, records));
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

Records records_of(const std::string& text, const std::string& what) {
  Records records;
  TextLines all(text);
  for (std::string line; all.next(line);) read_line(words(line), what, all.number(), records);
  if (records.vertex.empty() && records.face.empty())
    throw Error::invalid_input(
        what + ": not an OBJ: none of its lines is a vertex, \"v X Y Z\", or a face, \"f A B C\"");
  return records;
}

// Makes triangles of the faces, in the file's order.
class Triangles {
 public:
  Triangles(const std::string& what, const Records& records) : what_(what), records_(records) {
    for (const Face& face : records.face) add_face(face);
  }

  ObjSoup take_soup() { return std::move(soup_); }

 private:
  void add_face(const Face& face) {
    for (const Corner& c : face.corner) check_index(c.vertex, records_.vertex.size(), "vertex", face.line);
    for (const Corner& c : face.corner)
      if (c.texture) check_index(*c.texture, records_.texture.size(), "texture coordinate", face.line);
    if (face.corner.size() == 3) return add_triangle(face, {0, 1, 2});
    const auto at = [&](int i) { return records_.vertex[face.corner[i].vertex]; };
    if (crosses_itself(at(0), at(1), at(2), at(3))) soup_.crossed_line.push_back(face.line);
    if (is_cut_from_first(at(0), at(1), at(2), at(3))) {
      add_triangle(face, {0, 1, 2});
      add_triangle(face, {0, 2, 3});
    } else {
      add_triangle(face, {0, 1, 3});
      add_triangle(face, {1, 2, 3});
    }
  }

  void add_triangle(const Face& face, const std::array<int, 3>& corners) {
    Eigen::Vector3i vertices;
    std::array<Uv, 3> uv;
    for (int i = 0; i < 3; ++i) {
      const Corner& corner = face.corner[corners[i]];
      vertices[i] = static_cast<int>(corner.vertex);
      if (corner.texture) uv[i] = records_.texture[*corner.texture];
    }
    soup_.face.push_back(vertices);
    soup_.uv.push_back(uv);
    soup_.face_line.push_back(face.line);
  }

  void check_index(std::int64_t index, std::size_t count, const std::string& of, int line) const {
    if (index >= 0 && index < static_cast<std::int64_t>(count)) return;
    throw bad_line(what_, line,
                   "the face uses " +
                       (index < 0 ? "a " + of + " before the first" : of + " " + std::to_string(index + 1)) +
                       "; the file has " + std::to_string(count));
  }

  const std::string& what_;
  const Records& records_;
  ObjSoup soup_;
};

}  // namespace

ObjSoup read_obj_soup(const std::string& file, const std::string& what) {
  Records records = records_of(file_text(file, what), what);
  ObjSoup soup = Triangles(what, records).take_soup();
  soup.vertex = std::move(records.vertex);
  soup.vertex_line = std::move(records.vertex_line);
  share_texture(soup);
  return soup;
}

bool has_texture(const ObjSoup& soup) { return std::all_of(soup.uv.begin(), soup.uv.end(), is_whole); }

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

}  // namespace hysteron
