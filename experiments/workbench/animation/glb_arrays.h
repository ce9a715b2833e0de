// The arrays of numbers in a binary glTF file; each is generated when it is written, so that none has to be
// kept.
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
    std::size_t count;                      // number of elements
    int components;                         // numbers per element: 1, 2, 3 or 4
    std::function<void(const Sink&)> make;  // passes its numbers to the sink, from the first to the last
    bool of_vertices = false;
    bool is_index = false;  // unsigned integers instead of floats
    bool bounded = false;   // states least and largest components, required for points and times

    std::size_t bytes() const { return 4 * count * static_cast<std::size_t>(components); }
  };

  // Adds an array and returns the index of its accessor.
  std::size_t add(Array array);
  std::size_t bytes() const;
  std::size_t size() const { return arrays_.size(); }
  // Adds `buffers`, `bufferViews` and `accessors` to the file's JSON; generates the arrays that have bounds.
  void describe(nlohmann::ordered_json& file) const;
  void write(std::ostream& out) const;

 private:
  std::vector<Array> arrays_;
};

// Returns the bytes of numbers as they lie in memory, little-endian.
template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}
// Returns a generator that keeps the array's values.
template <class T>
std::function<void(const GlbArrays::Sink&)> archived_numbers(std::vector<T> values) {
  return [all = std::make_shared<const std::vector<T>>(std::move(values))](const GlbArrays::Sink& sink) {
    sink(bytes_of(*all));
  };
}

}  // namespace hysteron::experiments
