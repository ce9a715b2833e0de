// PLY in, as a surface.  Read here and not by CGAL, whose reader passes over what it does not know, so that
// the numbers of one property become those of another, and gives no reason for a failure.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string_view>

#include "sim/base/error.h"
#include "sim/base/number_in.h"
#include "sim/base/whole_file.h"
#include "sim/mesh/obj_soup.h"
#include "sim/mesh/surface.h"

namespace hysteron {
namespace {

// What a PLY file announces, and whether it can hold it.

struct PlyType {
  enum Kind { natural, integer, real };

  std::string_view name;
  std::size_t bytes;  // in binary files
  Kind kind;
};
constexpr PlyType kPlyTypes[] = {
    {"char", 1, PlyType::integer},   {"int8", 1, PlyType::integer},   {"uchar", 1, PlyType::natural},
    {"uint8", 1, PlyType::natural},  {"short", 2, PlyType::integer},  {"int16", 2, PlyType::integer},
    {"ushort", 2, PlyType::natural}, {"uint16", 2, PlyType::natural}, {"int", 4, PlyType::integer},
    {"int32", 4, PlyType::integer},  {"uint", 4, PlyType::natural},   {"uint32", 4, PlyType::natural},
    {"float", 4, PlyType::real},     {"float32", 4, PlyType::real},   {"double", 8, PlyType::real},
    {"float64", 8, PlyType::real}};

struct PlyProperty {
  std::string name;
  const PlyType* type;
  const PlyType* count;  // of a list; null: a single number

  bool is_real() const { return !count && type->kind == PlyType::real; }
  bool is_list_of_indices() const { return count && type->kind != PlyType::real && type->bytes == 4; }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  int line = 0;  // of the file
  std::vector<PlyProperty> property;

  // Null if there is none of that name.
  const PlyProperty* find(std::string_view property_name) const {
    for (const PlyProperty& p : property)
      if (p.name == property_name) return &p;
    return nullptr;
  }
};

struct PlyHeader {
  bool ascii = false, big_endian = false;
  std::vector<PlyElement> element;
  std::size_t bytes = 0;  // of the header itself

  // Elements are named in singular or plural.
  const PlyElement* find(std::string_view one_name, std::string_view other_name) const {
    for (const PlyElement& e : element)
      if (e.name == one_name || e.name == other_name) return &e;
    return nullptr;
  }
};

// Fewest bytes of one item: an ASCII number takes a digit and a separator, a list may be empty.
std::size_t least_bytes(const PlyElement& element, bool ascii) {
  std::size_t sum = 0;
  for (const PlyProperty& p : element.property) sum += ascii ? 2 : (p.count ? p.count : p.type)->bytes;
  return sum;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::string& what) : text_(text), what_(what) {}

  PlyHeader read() {
    if (next_line() != std::vector<std::string>{"ply"}) throw bad("a PLY file begins with \"ply\"");
    read_format(next_line());
    for (std::vector<std::string> word = next_line(); word != std::vector<std::string>{"end_header"};
         word = next_line()) {
      if (word.empty()) throw bad("an empty line in the header");
      if (word[0] == "element")
        read_element(word);
      else if (word[0] == "property")
        read_property(word);
      else if (word[0] != "comment" && word[0] != "obj_info")
        throw bad("\"" + word[0] +
                  "\" is unknown; allowed: element, property, comment, obj_info, end_header");
    }
    header_.bytes = at_;
    for (const PlyElement& element : header_.element) check_room(element);
    return header_;
  }

 private:
  Error bad(const std::string& problem) const {
    return Error::invalid_input(what_ + ": line " + std::to_string(line_) + ": " + problem);
  }

  std::vector<std::string> next_line() {
    ++line_;
    const std::size_t end = text_.find('\n', at_);
    if (end == text_.npos) throw bad("the header has no end_header");
    std::istringstream words{std::string(text_.substr(at_, end - at_))};
    at_ = end + 1;
    std::vector<std::string> found;
    for (std::string word; words >> word;) found.push_back(word);
    return found;
  }

  void read_format(const std::vector<std::string>& word) {
    const bool known =
        word.size() == 3 && word[0] == "format" &&
        (word[1] == "ascii" || word[1] == "binary_little_endian" || word[1] == "binary_big_endian");
    if (!known)
      throw bad("needs \"format\" with ascii, binary_little_endian or binary_big_endian, and a version");
    header_.ascii = word[1] == "ascii";
    header_.big_endian = word[1] == "binary_big_endian";
  }

  void read_element(const std::vector<std::string>& word) {
    if (word.size() != 3) throw bad("an element needs a name and a number");
    const auto count = number_in<std::size_t>(word[2]);
    if (!count) throw bad("\"" + word[2] + "\" is no number of elements");
    header_.element.push_back({word[1], *count, line_, {}});
  }

  void read_property(const std::vector<std::string>& word) {
    const bool list = word.size() == 5 && word[1] == "list";
    if (!list && word.size() != 3) throw bad("a property needs a type and a name, a list two types");
    if (header_.element.empty()) throw bad("a property before the first element");
    const PlyType* const type = type_named(word[word.size() - 2]);
    const PlyType* const count = list ? type_named(word[2]) : nullptr;
    if (count && count->kind == PlyType::real) throw bad("a list counts its items in integers");
    header_.element.back().property.push_back({word.back(), type, count});
  }

  const PlyType* type_named(const std::string& name) const {
    for (const PlyType& type : kPlyTypes)
      if (type.name == name) return &type;
    throw bad("the type \"" + name + "\" is unknown");
  }

  // Before anything is allocated for them.
  void check_room(const PlyElement& element) const {
    const std::size_t least = least_bytes(element, header_.ascii), left = text_.size() - at_ + 1;
    if (element.count == 0 || (least > 0 && element.count <= left / least)) return;
    throw Error::invalid_input(what_ + ": line " + std::to_string(element.line) +
                               ": the file is too short for " + std::to_string(element.count) +
                               " items of \"" + element.name + "\"");
  }

  std::string_view text_;
  const std::string& what_;
  PlyHeader header_;
  std::size_t at_ = 0;
  int line_ = 0;
};

// The numbers behind a header.

// Takes them in their order.
class PlyNumbers {
 public:
  PlyNumbers(std::string_view text, const PlyHeader& header)
      : header_(header), text_(text.substr(header.bytes)) {}

  // Those of a property; false where one is missing or malformed.
  bool read(const PlyProperty& property, std::vector<double>& numbers) {
    const std::optional<double> count = property.count ? next(*property.count) : 1;
    numbers.clear();
    if (!count || *count < 0) return false;
    while (static_cast<double>(numbers.size()) < *count) {
      const std::optional<double> number = next(*property.type);
      if (!number) return false;
      numbers.push_back(*number);
    }
    return true;
  }

  bool at_end() const { return text_.find_first_not_of(kBlanks) == text_.npos; }

 private:
  static constexpr std::string_view kBlanks = " \t\n\v\f\r";

  std::optional<double> next(const PlyType& type) { return header_.ascii ? written(type) : binary(type); }

  std::optional<double> written(const PlyType& type) {
    text_.remove_prefix(std::min(text_.find_first_not_of(kBlanks), text_.size()));
    std::string_view word = text_.substr(0, text_.find_first_of(kBlanks));
    text_.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    if (type.kind == PlyType::natural) return number_in<std::uint32_t>(word);
    if (type.kind == PlyType::integer) return number_in<std::int32_t>(word);
    const std::optional<double> number = number_in(word);
    const double x = number.value_or(NAN), rounded = type.bytes == 4 ? static_cast<float>(x) : x;
    return std::isfinite(rounded) ? std::optional(rounded) : std::nullopt;
  }

  std::optional<double> binary(const PlyType& type) {
    if (text_.size() < type.bytes) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.bytes; ++i) {
      const char byte = text_[header_.big_endian ? type.bytes - 1 - i : i];
      bits |= std::uint64_t{static_cast<unsigned char>(byte)} << 8 * i;
    }
    text_.remove_prefix(type.bytes);
    if (type.kind == PlyType::real && type.bytes == 4)
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    if (type.kind == PlyType::real) return std::bit_cast<double>(bits);
    const double number = static_cast<double>(bits), span = std::ldexp(1.0, 8 * static_cast<int>(type.bytes));
    return type.kind == PlyType::integer && number >= span / 2 ? number - span : number;  // two's complement
  }

  const PlyHeader& header_;
  std::string_view text_;  // that is left
};

// Of a header: where a surface stands in it.
struct PlyParts {
  const PlyElement *vertex, *face;
  const PlyProperty *axis[3], *curvature, *corners;  // curvature: null where there is none
};

PlyParts parts_of(const PlyHeader& header, const std::string& what) {
  PlyParts parts{header.find("vertex", "vertices"), header.find("face", "faces"), {}, nullptr, nullptr};
  if (!parts.vertex || !parts.face || parts.face->count == 0) throw Error::invalid_input(what + ": no faces");
  const auto refusal = [&](const PlyElement* element, const std::string& problem) {
    return Error::invalid_input(what + ": line " + std::to_string(element->line) + ": " + problem);
  };
  const char* const axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    parts.axis[k] = parts.vertex->find(axes[k]);
    if (!parts.axis[k] || !parts.axis[k]->is_real())
      throw refusal(parts.vertex, "the vertices need x, y and z of type float or double");
  }
  parts.curvature = parts.vertex->find("curvature");
  if (parts.curvature && !parts.curvature->is_real())
    throw refusal(parts.vertex, "the vertices' curvature must be of type float or double");
  parts.corners = parts.face->find("vertex_indices");
  if (!parts.corners) parts.corners = parts.face->find("vertex_index");
  if (!parts.corners || !parts.corners->is_list_of_indices())
    throw refusal(parts.face, "the faces need a list vertex_indices or vertex_index of type int or uint");
  return parts;
}

using Polygon = std::vector<std::int64_t>;  // its vertices, unchecked

// Fills the surface's vertices with their curvature.
std::vector<Polygon> read_numbers(std::string_view text, const PlyHeader& header, const std::string& what,
                                  Surface& surface) {
  const PlyParts parts = parts_of(header, what);
  PlyNumbers numbers(text, header);
  std::vector<Polygon> polygons;
  std::vector<double> found;
  for (const PlyElement& element : header.element)
    for (std::size_t i = 0; i < element.count; ++i) {
      if (&element == parts.vertex) surface.vertex.emplace_back();
      for (const PlyProperty& property : element.property) {
        if (!numbers.read(property, found))
          throw Error::invalid_input(what + ": item " + std::to_string(i) + " of the " +
                                     std::to_string(element.count) + " of \"" + element.name +
                                     "\": a number is missing or malformed");
        for (int k = 0; k < 3; ++k)
          if (&property == parts.axis[k]) surface.vertex.back()[k] = found[0];
        if (&property == parts.curvature) surface.curvature.push_back(found[0]);
        if (&property == parts.corners) polygons.emplace_back(found.begin(), found.end());
      }
    }
  if (!numbers.at_end())
    throw Error::invalid_input(what + ": it goes on after the last item that its header announces");
  return polygons;
}

void check_polygon(const Polygon& corner, std::size_t vertices, const std::string& which) {
  if (corner.size() != 3 && corner.size() != 4)
    throw Error::invalid_input(which + " has " + std::to_string(corner.size()) +
                               " corners; allowed are triangles and quads, triangulate the mesh first");
  for (const std::int64_t v : corner)
    if (v < 0 || v >= static_cast<std::int64_t>(vertices))
      throw Error::invalid_input(which + " uses vertex " + std::to_string(v) + "; the file has " +
                                 std::to_string(vertices) + ", counted from 0");
}

void add_polygon(const Polygon& corner, Surface& surface) {
  std::vector<Eigen::Vector3d> at;
  for (const std::int64_t v : corner) at.push_back(surface.vertex[v]);
  const auto v = [&](int i) { return static_cast<int>(corner[i]); };
  for (const auto& [i, j, k] : triangles_of(at)) surface.face.emplace_back(v(i), v(j), v(k));
}

}  // namespace

Surface read_ply(const std::string& file) {
  const std::string what = "mesh " + file, text = whole_file(file, "cannot read mesh " + file);
  Surface surface;
  const std::vector<Polygon> polygons = read_numbers(text, HeaderReader(text, what).read(), what, surface);
  for (std::size_t v = 0; v < surface.vertex.size(); ++v)
    if (!surface.vertex[v].allFinite())
      throw Error::invalid_input(what + ": vertex " + std::to_string(v) + " is not a finite number");
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    check_polygon(polygons[f], surface.vertex.size(), what + ": face " + std::to_string(f));
    add_polygon(polygons[f], surface);
  }
  return without_loose_vertices(std::move(surface));
}

}  // namespace hysteron
