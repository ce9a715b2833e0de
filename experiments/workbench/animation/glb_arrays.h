// The arrays of numbers in a binary glTF file, each made when it is written, so that none has to be kept.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace hysteron::experiments {

class GlbArrays {
 public:
  using Sink = std::function<void(std::string_view bytes)>;

  struct Array {
    std::size_t count;                      // of elements
    int components;                         // of an element: 1, 2, 3 or 4
    std::function<void(const Sink&)> make;  // hands its numbers over, from the first to the last
    bool of_vertices = false;
    bool is_index = false;  // unsigned integers in place of floats
    bool bounded = false;   // with the least and largest of each component, as points and times must be

    std::size_t bytes() const { return 4 * count * static_cast<std::size_t>(components); }
  };

  // The number of its accessor.
  std::size_t add(Array array);
  std::size_t bytes() const;
  std::size_t size() const { return arrays_.size(); }
  // `buffers`, `bufferViews` and `accessors` of the file; makes the arrays that have bounds.
  void describe(nlohmann::ordered_json& file) const;
  void write(std::ostream& out) const;

 private:
  std::vector<Array> arrays_;
};

// The bytes of numbers as they lie in memory, little-endian.
template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}
// An array that is kept.
template <class T>
std::function<void(const GlbArrays::Sink&)> kept_numbers(std::vector<T> values) {
  return [all = std::make_shared<const std::vector<T>>(std::move(values))](const GlbArrays::Sink& sink) {
    sink(bytes_of(*all));
  };
}

}  // namespace hysteron::experiments
