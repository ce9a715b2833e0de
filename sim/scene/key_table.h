// Keys: the named, typed, bounded values that scene files and flags may set.  A struct gets its keys from one
// table with a line per key; reading, flags, messages, checks and the manifest all come from that table:
//
//   const KeyRow<Scene> kRows[] = {
//       {"fabric.b2", at<&Scene::fabric, &Fabric::b2>, "N m", positive(), "", "bending rigidity B"}, ...
//
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "sim/base/enum_names.h"
#include "sim/base/number_in.h"

namespace hysteron {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The allowed numbers; for a vector they hold for every component.
struct Range {
  double low = -kInfinity;
  double high = kInfinity;
  bool open_low = false;  // low itself is not allowed

  bool contains(double x) const { return (open_low ? x > low : x >= low) && x <= high; }
  std::string text() const;  // ">= 0", "> 0", "in [1, 64]", "finite"
};
inline Range any() { return {}; }
inline Range positive() { return {0, kInfinity, true}; }
inline Range at_least(double low) { return {low, kInfinity, false}; }
inline Range between(double low, double high) { return {low, high, false}; }

// An enumeration of any type.
struct NamedValue {
  void* value;
  std::vector<std::string> names;  // the names of its values, in their order
  void (*set)(void* value, std::size_t place);
  std::size_t (*place)(const void* value);

  std::string name() const { return names[place(value)]; }
};
template <Named E>
NamedValue named_value(E* value) {
  const auto all = names(E{});
  return {value,
          {all.begin(), all.end()},
          [](void* of, std::size_t place) { *static_cast<E*>(of) = static_cast<E>(place); },
          [](const void* of) { return static_cast<std::size_t>(*static_cast<const E*>(of)); }};
}

// A key can point to a flag, integer, count, number, vector, text, parameters by name, an enumeration, or a
// list of numbers of any length.
using Parameters = std::map<std::string, std::string>;
using Numbers = std::vector<double>;
using Field = std::variant<bool*, int*, unsigned*, double*, Eigen::Vector3d*, std::string*, Parameters*,
                           NamedValue, Numbers*>;

struct KeyDescription {
  std::string path;                  // "fabric.b2"
  std::string type;                  // flag | integer | number | vector | text | name=value | numbers
  std::string unit;                  // "N m", "" for plain numbers and texts
  Range range;                       // the allowed numbers
  std::vector<std::string> choices;  // the allowed texts; empty: any text
  std::string doc;                   // one line
  std::string default_text;          // the value when it was described, four digits; "": none, or a flag
};

struct BoundKey {
  KeyDescription description;
  Field field;
};
using Keys = std::vector<BoundKey>;

// One line of a table.  Choices are written "sphere | box"; for an enumeration they are its names.
template <class Owner>
struct KeyRow {
  const char* path;
  Field (*field)(Owner&);
  const char* unit;
  Range range;
  const char* choices;
  const char* doc;
};

// Accessor for a table: at<&Scene::fabric, &Fabric::b2> is a function from Scene& to the address of the
// member.
template <auto... Members, class Owner>
Field at(Owner& owner) {
  auto* member = &(owner.*....*Members);
  if constexpr (Named<std::remove_reference_t<decltype(*member)>>)
    return named_value(member);
  else
    return member;
}

KeyDescription describe(const char* path, const Field& field, const char* unit, Range range,
                        const char* choices, const char* doc);

template <class Owner, class Rows>
Keys bind(const Rows& rows, Owner& owner) {
  Keys keys;
  for (const KeyRow<Owner>& row : rows) {
    const Field field = row.field(owner);
    keys.push_back({describe(row.path, field, row.unit, row.range, row.choices, row.doc), field});
  }
  return keys;
}

// A value as it stands in a file.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>>;

// Sets a key.  `origin` ("scene.toml:7", "--step") ends every message.  Throws Error::invalid_input for a
// wrong type, a number outside its range or not finite, or a text that is no choice.
void assign(const BoundKey& key, const Value& value, const std::string& origin);
// Turns a flag's text into the value that a file would hold: numbers in C notation, vectors and lists as
// numbers apart by spaces or commas.  Any other text stays text (and is refused by assign).
Value parse_text(const KeyDescription& key, const std::string& text);

// Finds a key; throws Error::invalid_input for an unknown key, naming the nearest known one.
const BoundKey& find_key(const Keys& keys, const std::string& path, const std::string& origin);

// Returns the values of all keys, nested at the dots of their paths, in the table's order.
nlohmann::ordered_json to_json(const Keys& keys);

// Returns the candidate with the fewest edits from `name`, or "" if none is near (a third of the letters, at
// least two).
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);
// Returns "; did you mean NAME?" with that candidate, for the end of a message, or "".
std::string suggestion(const std::string& name, const std::vector<std::string>& candidates);

std::string join(const std::vector<std::string>& words, const std::string& separator);

}  // namespace hysteron
