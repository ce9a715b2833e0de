// Reads what a PLY file announces, and checks that the file can hold it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron {

// Returns the bytes of a binary number; 0: PLY has no such type.
std::size_t type_bytes(std::string_view type);

struct PlyProperty {
  std::string name, type;
  std::string count_type;  // for a list; empty: a single number
  bool is_list() const { return !count_type.empty(); }
  bool is_real() const {
    return !is_list() && (type == "float" || type == "float32" || type == "double" || type == "float64");
  }
  bool is_list_of_indices() const {
    return is_list() && (type == "int" || type == "int32" || type == "uint" || type == "uint32");
  }
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  int line = 0;  // in the file
  std::vector<PlyProperty> property;

  // Returns null if there is none of that name.
  const PlyProperty* find(std::string_view property_name) const {
    for (const PlyProperty& p : property)
      if (p.name == property_name) return &p;
    return nullptr;
  }
};

struct PlyHeader {
  bool ascii = false, big_endian = false;
  std::vector<PlyElement> element;
  std::size_t bytes = 0;  // bytes of the header itself

  // Finds an element, which may be named in singular or plural.
  const PlyElement* find(std::string_view one_name, std::string_view other_name) const {
    for (const PlyElement& e : element)
      if (e.name == one_name || e.name == other_name) return &e;
    return nullptr;
  }
};

// Reads the header.  Throws Error::invalid_input, beginning with `what` and naming the line, unless `text`
// starts with a header of PLY's own types and is long enough for the elements it announces.
PlyHeader read_ply_header(std::string_view text, const std::string& what);

// The numbers of a PLY file.
struct PlyContent {
  std::vector<Eigen::Vector3d> vertex;
  std::vector<double> curvature;                // per vertex; empty: not in the file
  std::vector<std::vector<std::int64_t>> face;  // vertices of each polygon, unchecked
};

// Reads the content of `text`, the file with that header, which has the elements and types that `read_ply`
// needs.  Throws Error::invalid_input, beginning with `what`, where the content does not fit the header.
PlyContent read_ply_content(const std::string& text, const PlyHeader& header, const std::string& what);

}  // namespace hysteron
