#include <algorithm>
#include <bit>
#include <cstdint>
#include <sstream>

#include "sim/base/error.h"
#include "sim/mesh/ply_header.h"

namespace hysteron {
namespace {

// Reads the items of a file, each with the properties that its header announces.
class ItemReader {
 public:
  ItemReader(const std::string& text, const PlyHeader& header)
      : header_(header), in_(text.substr(header.bytes)) {}

  // Reads one item: the numbers of each property, one unless it is a list.  Returns false where a number is
  // missing or malformed, or a list longer than the file.
  bool read(const PlyElement& element, std::vector<std::vector<double>>& item) {
    item.resize(element.property.size());
    for (std::size_t p = 0; p < item.size(); ++p) {
      const PlyProperty& property = element.property[p];
      const double count = property.is_list() ? number(property.count_type) : 1;
      if (in_.fail() || (property.is_list() && !has_room(property, count))) return false;
      item[p].resize(static_cast<std::size_t>(count));
      for (double& x : item[p]) x = number(property.type);
      if (in_.fail()) return false;
    }
    return true;
  }

  // Is nothing left but blanks?
  bool is_at_end() { return (in_ >> std::ws).eof(); }

 private:
  // Reads a number of one of PLY's types, which doubles hold.
  double number(std::string_view type) {
    const std::size_t bytes = type_bytes(type);
    const bool real = type.starts_with('f') || type.starts_with('d');
    if (header_.ascii)
      return !real ? extracted<std::int64_t>() : bytes == 4 ? extracted<float>() : extracted<double>();
    const std::uint64_t bits = binary(bytes);
    if (real)
      return bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                        : std::bit_cast<double>(bits);
    const std::uint64_t half = std::uint64_t{1} << (8 * bytes - 1);
    const bool negative = !type.starts_with('u') && bits >= half;  // two's complement
    return static_cast<double>(bits) - (negative ? 2 * static_cast<double>(half) : 0);
  }

  template <class Number>
  double extracted() {
    Number x = 0;
    in_ >> x;
    return static_cast<double>(x);
  }

  std::uint64_t binary(std::size_t bytes) {
    unsigned char byte[8] = {};
    in_.read(reinterpret_cast<char*>(byte), static_cast<std::streamsize>(bytes));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      bits |= std::uint64_t{byte[header_.big_endian ? bytes - 1 - i : i]} << 8 * i;
    return bits;
  }

  // Can a list have so many items? Nothing is allocated for more than the rest of the file holds, or than the
  // type of the count does.
  bool has_room(const PlyProperty& list, double count) const {
    const int bits = 8 * static_cast<int>(type_bytes(list.count_type)) - !list.count_type.starts_with('u');
    const auto left = static_cast<double>(std::max<std::streamsize>(in_.rdbuf()->in_avail(), 0));
    const std::size_t least = header_.ascii ? 2 : type_bytes(list.type);  // at least a number and a separator
    return count >= 0 && count < static_cast<double>(std::uint64_t{1} << bits) &&
           count <= (left + 1) / static_cast<double>(least);
  }

  const PlyHeader& header_;
  std::istringstream in_;
};

}  // namespace

PlyContent read_ply_content(const std::string& text, const PlyHeader& header, const std::string& what) {
  ItemReader items(text, header);
  PlyContent content;
  const PlyElement* const vertices = header.find("vertex", "vertices");
  const PlyElement* const faces = header.find("face", "faces");
  std::vector<std::vector<double>> item;
  for (const PlyElement& element : header.element) {
    const auto numbers = [&](const char* name) -> const std::vector<double>& {
      return item[static_cast<std::size_t>(element.find(name) - element.property.data())];
    };
    for (std::size_t i = 0; i < element.count; ++i) {
      if (!items.read(element, item))
        throw Error::invalid_input(what + ": item " + std::to_string(i) + " of the " +
                                   std::to_string(element.count) + " of \"" + element.name +
                                   "\": a number is missing or malformed");
      if (&element == vertices) {
        content.vertex.emplace_back(numbers("x")[0], numbers("y")[0], numbers("z")[0]);
        if (element.find("curvature")) content.curvature.push_back(numbers("curvature")[0]);
      }
      if (&element == faces) {
        const auto& corners = numbers(element.find("vertex_indices") ? "vertex_indices" : "vertex_index");
        content.face.emplace_back(corners.begin(), corners.end());
      }
    }
  }
  if (!items.is_at_end())
    throw Error::invalid_input(what + ": it goes on after the last item that its header announces");
  return content;
}

}  // namespace hysteron
