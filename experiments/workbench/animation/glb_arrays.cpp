// The format is specified in Khronos Group 2021, glTF 2.0 Specification, 3.6 (buffers, accessors).
#include "experiments/workbench/animation/glb_arrays.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace hysteron::experiments {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

constexpr int kUnsigned = 5125, kFloat = 5126;          // codes of number types
constexpr int kVertexBuffer = 34962, kIndices = 34963;  // codes of a buffer view's purpose

// Finds the least and largest value of each component.
class Bounds {
 public:
  explicit Bounds(std::size_t components) : low_(components, INFINITY), high_(components, -INFINITY) {}
  void add(std::string_view bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += sizeof(float), ++next_) {
      float x;
      std::memcpy(&x, bytes.data() + at, sizeof x);
      const std::size_t k = next_ % low_.size();
      low_[k] = std::min(low_[k], x);
      high_[k] = std::max(high_[k], x);
    }
  }
  void describe(nlohmann::ordered_json& accessor) const {
    accessor["min"] = low_;
    accessor["max"] = high_;
  }

 private:
  std::size_t next_ = 0;
  std::vector<float> low_, high_;
};

}  // namespace

std::size_t GlbArrays::add(Array array) {
  arrays_.push_back(std::move(array));
  return arrays_.size() - 1;
}

std::size_t GlbArrays::bytes() const {
  std::size_t sum = 0;
  for (const Array& array : arrays_) sum += array.bytes();
  return sum;
}

void GlbArrays::describe(nlohmann::ordered_json& file) const {
  constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  std::size_t offset = 0;
  for (const Array& array : arrays_) {
    nlohmann::ordered_json accessor = {{"bufferView", file["bufferViews"].size()},
                                       {"componentType", array.is_index ? kUnsigned : kFloat},
                                       {"count", array.count},
                                       {"type", kTypes[array.components - 1]}};
    if (array.bounded) {
      Bounds bounds(static_cast<std::size_t>(array.components));
      array.make([&](std::string_view bytes) { bounds.add(bytes); });
      bounds.describe(accessor);
    }
    nlohmann::ordered_json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", array.bytes()}};
    if (array.is_index || array.of_vertices) view["target"] = array.is_index ? kIndices : kVertexBuffer;
    file["accessors"].push_back(std::move(accessor));
    file["bufferViews"].push_back(std::move(view));
    offset += array.bytes();
  }
  file["buffers"].push_back({{"byteLength", offset}});
}

void GlbArrays::write(std::ostream& out) const {
  for (const Array& array : arrays_)
    array.make(
        [&](std::string_view bytes) { out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())); });
}

}  // namespace hysteron::experiments
