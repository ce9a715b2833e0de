// What outlives a step, as bytes: one visit() of a class serves saving and loading, so that the two agree.
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

// Bytes are those of this machine and this program: whoever keeps them says which, and that they are whole.
class Archive {
 public:
  Archive() = default;                                                        // saves
  explicit Archive(std::string_view bytes) : loaded_(bytes), loads_(true) {}  // loads what was saved

  bool loads() const { return loads_; }
  std::string take() { return std::move(saved_); }        // what was saved
  bool at_end() const { return loaded_.empty(); }         // all has been loaded
  std::string_view remainder() const { return loaded_; }  // what has not been loaded yet

  // Bytes of an array, as they stand in memory.
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
  // A count of what follows: no more of it than there are bytes left, so that nothing damaged asks for
  // memory.
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
  // Several, one after the other.
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
