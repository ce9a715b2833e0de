// Names of enumerations.  One that has names declares them beside it, in the order of its values:
//   enum class Fruit { apple, pear };
//   constexpr std::array<const char*, 2> names(Fruit) { return {"apple", "pear"}; }
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace hysteron {

template <class E>
concept Named = requires(E value) {
  names(value)[0];
};

template <Named E>
std::string name_of(E value) {
  return names(value)[static_cast<std::size_t>(value)];
}

}  // namespace hysteron
