// Saves and loads the state that outlives a step, as bytes: one visit() of a class serves both directions, so
// that the two agree.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/base/error.h"

namespace hysteron {

// The bytes are those of this machine and this program: whoever stores them records which, and checks that
// they are whole.
class Archive {
 public:
  Archive() = default;                                                        // saves
  explicit Archive(std::string_view bytes) : loaded_(bytes), loads_(true) {}  // loads what was saved

  bool loads() const { return loads_; }
  std::string take() { return std::move(saved_); }        // hands over the bytes saved so far
  bool at_end() const { return loaded_.empty(); }         // true once all bytes are loaded
  std::string_view remainder() const { return loaded_; }  // the bytes that are not loaded yet

  // Saves or loads `count` bytes at `memory`, as they stand there.
  void bytes(void* memory, std::size_t count) {
    if (!loads_) {
      saved_.append(static_cast<const char*>(memory), count);
      return;
    }
    if (count > loaded_.size()) throw Error::invalid_input("ends too early");
    if (count) std::memcpy(memory, loaded_.data(), count);
    loaded_.remove_prefix(count);
  }

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&value, sizeof value);
  }
  // Saves or loads the number of elements that follow.  A loaded number never exceeds the bytes that are
  // left, so that a damaged archive cannot ask for memory.
  std::size_t size(std::size_t count) {
    std::uint64_t number = count;
    (*this)(number);
    if (loads_ && number > loaded_.size()) throw Error::invalid_input("ends too early");
    return static_cast<std::size_t>(number);
  }
  void operator()(std::string& text) {
    text.resize(size(text.size()));
    bytes(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(size(values.size()));
    if constexpr (std::is_trivially_copyable_v<T>)
      bytes(values.data(), values.size() * sizeof(T));
    else
      for (T& value : values) (*this)(value);
  }
  template <class A, class B>
  void operator()(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  // Visits several objects, one after the other.
  template <class First, class... Others>
  requires(sizeof...(Others) > 0) void operator()(First& first, Others&... others) {
    (*this)(first);
    ((*this)(others), ...);
  }

 private:
  std::string saved_;
  std::string_view loaded_;
  bool loads_ = false;
};

}  // namespace hysteron
