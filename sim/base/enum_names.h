// Names of enumerations.  An enumeration that has names declares them beside it, in the order of its values:
//   enum class Fruit { apple, pear };
//   constexpr std::array<const char*, 2> names(Fruit) { return {"apple", "pear"}; }
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "sim/base/error.h"

namespace hysteron {

template <class E>
concept Named = requires(E value) {
  names(value)[0];
};

template <Named E>
std::string enum_name(E value) {
  return names(value)[static_cast<std::size_t>(value)];
}

// Returns the value of that name; throws Error::invalid_input for another, listing the names that there are.
template <Named E>
E value_named(const std::string& name) {
  std::string all;
  for (std::size_t i = 0; i < names(E{}).size(); ++i) {
    if (name == names(E{})[i]) return static_cast<E>(i);
    all += (i ? ", " : "") + std::string(names(E{})[i]);
  }
  throw Error::invalid_input(name + " is not one of: " + all);
}

}  // namespace hysteron
