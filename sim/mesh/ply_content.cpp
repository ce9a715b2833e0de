#include "sim/mesh/ply_content.h"

#include <CGAL/IO/PLY/PLY_reader.h>

#include <exception>
#include <sstream>

#include "sim/error.h"

namespace hysteron {
namespace {

// CGAL's public functions give points and polygons only, and no reason for a failure.
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

// False where a number is missing or malformed, or a list too long for the memory.
bool read_item(Element& element, std::istream& in) {
  try {
    for (std::size_t p = 0; p < element.number_of_properties(); ++p) {
      element.property(p)->get(in);
      if (in.fail()) return false;
    }
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

// What follows the last item announced.
bool is_at_end(std::istream& in) { return (in >> std::ws).eof(); }

}  // namespace

PlyContent read_ply_content(const std::string& text, const PlyHeader& header, const std::string& what) {
  std::istringstream in(text);
  Reader reader(false);
  if (!reader.init(in)) throw Error::request(what + ": the header is malformed");
  PlyContent content;
  const PlyElement* const vertices = header.find("vertex", "vertices");
  const PlyElement* const faces = header.find("face", "faces");
  for (std::size_t e = 0; e < header.element.size(); ++e) {
    const PlyElement& announced = header.element[e];
    Element& element = reader.element(e);
    for (std::size_t i = 0; i < announced.count; ++i) {
      if (!read_item(element, in))
        throw Error::request(what + ": item " + std::to_string(i) + " of the " +
                             std::to_string(announced.count) + " of \"" + announced.name +
                             "\": a number is missing or malformed");
      if (&announced == vertices) content.vertex.push_back(position(element));
      if (&announced == vertices && announced.find("curvature"))
        element.assign(content.curvature.emplace_back(), "curvature");
      if (&announced == faces) content.face.push_back(corners(element));
    }
  }
  if (!is_at_end(in))
    throw Error::request(what + ": it goes on after the last item that its header announces");
  return content;
}

}  // namespace hysteron
