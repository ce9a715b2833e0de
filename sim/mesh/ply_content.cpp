#include "sim/mesh/ply_header.h"

#include <CGAL/IO/PLY/PLY_reader.h>

#include <sstream>

#include "sim/base/error.h"

namespace hysteron {
namespace {

// CGAL's public functions return points and polygons only, and no reason for a failure.
using Element = CGAL::IO::internal::PLY_element;
using Reader = CGAL::IO::internal::PLY_reader;

Eigen::Vector3d position(Element& element) {
  Eigen::Vector3d x;
  element.assign(x[0], "x");
  element.assign(x[1], "y");
  element.assign(x[2], "z");
  return x;
}

template <class Index>
std::vector<std::int64_t> corners(Element& element, const char* list) {
  std::vector<Index> index;
  element.assign(index, list);
  return {index.begin(), index.end()};
}

std::vector<std::int64_t> corners(Element& element) {
  for (const char* list : {"vertex_indices", "vertex_index"}) {
    if (element.has_property<std::vector<std::int32_t>>(list)) return corners<std::int32_t>(element, list);
    if (element.has_property<std::vector<std::uint32_t>>(list)) return corners<std::uint32_t>(element, list);
  }
  return {};
}

// Reads a binary integer of so many bytes, as two's complement.
std::int64_t binary_integer(std::istream& in, std::size_t bytes, bool big_endian, bool with_sign) {
  unsigned char byte[8] = {};
  in.read(reinterpret_cast<char*>(byte), static_cast<std::streamsize>(bytes));
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes; ++i)
    value |= std::uint64_t{byte[big_endian ? bytes - 1 - i : i]} << 8 * i;
  const std::uint64_t half = std::uint64_t{1} << (8 * bytes - 1);
  return static_cast<std::int64_t>(value) -
         (with_sign && value >= half ? static_cast<std::int64_t>(2 * half) : 0);
}

// Returns the largest number of items that a list can count.
std::int64_t most_items(const PlyProperty& list) {
  const int bits = 8 * static_cast<int>(type_bytes(list.count_type)) - !list.count_type.starts_with('u');
  return (std::int64_t{1} << bits) - 1;
}

// Does a list that begins here fit into the rest of the file? The reader allocates the announced number of
// items, and goes through all of them behind the end.  A number that the type of the count does not hold
// wraps there.
bool has_room(const PlyProperty& list, const PlyHeader& header, std::size_t file_bytes, std::istream& in) {
  const std::streamoff begin = in.tellg();
  std::int64_t count = -1;
  if (header.ascii)
    in >> count;
  else
    count =
        binary_integer(in, type_bytes(list.count_type), header.big_endian, !list.count_type.starts_with('u'));
  if (begin < 0 || in.fail() || count < 0 || count > most_items(list)) return false;
  in.clear();  // the end of the file, where the list is empty
  const std::size_t left = file_bytes - static_cast<std::size_t>(in.tellg());
  in.seekg(begin);
  const std::size_t least = header.ascii ? 2 : type_bytes(list.type);  // at least a number and a separator
  return static_cast<std::size_t>(count) <= (left + 1) / least;
}

// Reads items of the file, each with the properties that its header announces.
struct ItemReader {
  const PlyHeader& header;
  std::size_t file_bytes;
  std::istream& in;

  // Returns false where a number is missing or malformed, or a list longer than the file.
  bool read(const PlyElement& announced, Element& element) const {
    for (std::size_t p = 0; p < announced.property.size(); ++p) {
      const PlyProperty& property = announced.property[p];
      if (property.is_list() && !has_room(property, header, file_bytes, in)) return false;
      element.property(p)->get(in);
      if (in.fail()) return false;
    }
    return true;
  }
};

// Do both readers agree on the header?
bool agree(Reader& reader, const PlyHeader& header) {
  if (reader.number_of_elements() != header.element.size()) return false;
  for (std::size_t e = 0; e < header.element.size(); ++e)
    if (reader.element(e).number_of_properties() != header.element[e].property.size()) return false;
  return true;
}

// Is nothing left after the last item announced?
bool is_at_end(std::istream& in) { return (in >> std::ws).eof(); }

}  // namespace

PlyContent read_ply_content(const std::string& text, const PlyHeader& header, const std::string& what) {
  std::istringstream in(text);
  Reader reader(false);
  if (!reader.init(in) || !agree(reader, header))
    throw Error::invalid_input(what + ": the header is malformed");
  const ItemReader items{header, text.size(), in};
  PlyContent content;
  const PlyElement* const vertices = header.find("vertex", "vertices");
  const PlyElement* const faces = header.find("face", "faces");
  for (std::size_t e = 0; e < header.element.size(); ++e) {
    const PlyElement& announced = header.element[e];
    Element& element = reader.element(e);
    for (std::size_t i = 0; i < announced.count; ++i) {
      if (!items.read(announced, element))
        throw Error::invalid_input(what + ": item " + std::to_string(i) + " of the " +
                                   std::to_string(announced.count) + " of \"" + announced.name +
                                   "\": a number is missing or malformed");
      if (&announced == vertices) content.vertex.push_back(position(element));
      if (&announced == vertices && announced.find("curvature"))
        element.assign(content.curvature.emplace_back(), "curvature");
      if (&announced == faces) content.face.push_back(corners(element));
    }
  }
  if (!is_at_end(in))
    throw Error::invalid_input(what + ": it goes on after the last item that its header announces");
  return content;
}

}  // namespace hysteron
