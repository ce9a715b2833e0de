// Names of enumerations.  An enumeration that has names declares them beside it, in the order of its values:
//   enum class Fruit { apple, pear };
//   constexpr std::array<const char*, 2> names(Fruit) { return {"apple", "pear"}; }
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

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

// Returns all values, and all names.
template <Named E>
constexpr auto every_value() {
  std::array<E, names(E{}).size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<E>(i);
  return all;
}
template <Named E>
std::vector<std::string> every_name() {
  const auto all = names(E{});
  return {all.begin(), all.end()};
}

// Returns the value of that name; nothing for another.
template <Named E>
std::optional<E> value_if_named(const std::string& name) {
  for (std::size_t i = 0; i < names(E{}).size(); ++i)
    if (name == names(E{})[i]) return static_cast<E>(i);
  return std::nullopt;
}

// Returns the value of that name; throws Error::invalid_input for another, listing the names that there are.
template <Named E>
E value_named(const std::string& name) {
  if (const std::optional<E> value = value_if_named<E>(name)) return *value;
  std::string all;
  for (const char* known : names(E{})) all += (all.empty() ? "" : ", ") + std::string(known);
  throw Error::invalid_input(name + " is not one of: " + all);
}

}  // namespace hysteron
