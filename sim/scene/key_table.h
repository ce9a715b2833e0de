// Keys: the named, typed, bounded values that scene files and flags may set.  A struct gets its keys from one
// table with a line per key; reading, flags, messages, checks and the manifest all come from that table:
//
//   const KeyRow<Scene> kRows[] = {
//       {"fabric.b2", at<&Scene::fabric, &Fabric::b2>, "N m", positive(), "bending rigidity B"}, ...
//
#pragma once

#include <Eigen/Core>
#include <array>
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
  return {value, every_name<E>(),
          [](void* of, std::size_t place) { *static_cast<E*>(of) = static_cast<E>(place); },
          [](const void* of) { return static_cast<std::size_t>(*static_cast<const E*>(of)); }};
}

// A key can point to a flag, integer, count, number, vector, text, parameters by name, an enumeration, or a
// list of numbers of any length.
using Parameters = std::map<std::string, std::string>;
using Numbers = std::vector<double>;
using Field = std::variant<bool*, int*, unsigned*, double*, Eigen::Vector3d*, std::string*, Parameters*,
                           NamedValue, Numbers*>;

// The traits of a key say who takes it and on which other values it depends.  A row states where it differs
// from a key of an experiment's own, which is part of what is simulated and recorded.

// The scope of a key names all that changes with it.
enum class Scope {
  states,  // what is simulated, and what an experiment finds
  output,  // what is drawn, exported and counted of it
  run,     // nothing of either: only where and how a run is executed, and what it prints
  preset,  // other keys, which it sets and which are recorded: a scene, a camera, --quick
};

// The group of --help.
enum class KeyGroup { own, scene, fabric, solver, pictures, running };
constexpr std::array<const char*, 6> names(KeyGroup) {
  return {"own", "scene", "fabric", "solver", "pictures", "running"};
}

// Who takes the key beside what simulates a cloth.
enum class Takers {
  simulations,  // nobody
  laws,         // tests of a fabric's bending without cloth
  files,        // pictures of mesh files
  tools,        // what simulates nothing and writes a folder
  all,          // files and tools
};

// The columns of a page are runs of a sweep or a comparison; a key can differ between them, or be shared.
enum class InColumns {
  vary,   // each can have a value of its own
  list,   // in addition several names in one flag make columns
  share,  // all have the page's
  leave,  // none has it: it is the page's alone
};

// Whether a text names a file, which may lie beside the scene's file.
enum class NamesFile { no, one, pattern };

struct KeyTraits {
  Scope scope = Scope::states;
  KeyGroup group = KeyGroup::own;
  Takers takers = Takers::simulations;
  InColumns in_columns = InColumns::vary;
  bool repeats = true;  // repeats of a run for its errors have it, too; else they have its default
  NamesFile file = NamesFile::no;
  const char* flag = "";  // its name as a flag and in studies; "": its path
  // A condition on other keys, without which nothing reads it, and its words for readers; "": none, or as
  // flags express it (experiments/workbench/app/key_conditions.h).
  const char* needs = "";
  const char* needs_text = "";

  constexpr KeyTraits needing(const char* condition, const char* words = "") const {
    KeyTraits traits = *this;
    traits.needs = condition;
    traits.needs_text = words;
    return traits;
  }
  // Does the manifest of a run hold its value, among the resolved keys?
  constexpr bool is_recorded() const { return scope == Scope::states || scope == Scope::output; }
  constexpr bool is_of_page() const { return in_columns == InColumns::leave; }
};

struct KeyDescription {
  std::string path;                  // "fabric.b2"
  std::string type;                  // flag | integer | number | vector | text | name=value | numbers
  std::string unit;                  // "N m", "" for plain numbers and texts
  Range range;                       // the allowed numbers
  std::vector<std::string> choices;  // the allowed texts; empty: any text
  std::string doc;                   // one line
  std::string default_text;          // the value when it was described, four digits; "": none, or a flag
  KeyTraits traits = {};

  std::string flag() const { return *traits.flag ? traits.flag : path; }
};

struct BoundKey {
  KeyDescription description;
  Field field;
};
using Keys = std::vector<BoundKey>;

// One line of a table.  The choices of an enumeration are its names.
template <class Owner>
struct KeyRow {
  const char* path;
  Field (*field)(Owner&);
  const char* unit;
  Range range;
  const char* doc;
  KeyTraits traits = {};
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

KeyDescription describe(const char* path, const Field& field, const char* unit, Range range, const char* doc,
                        const KeyTraits& traits = {});

template <class Owner, class Rows>
Keys bind(const Rows& rows, Owner& owner) {
  Keys keys;
  for (const KeyRow<Owner>& row : rows) {
    const Field field = row.field(owner);
    keys.push_back({describe(row.path, field, row.unit, row.range, row.doc, row.traits), field});
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
// Returns the shortest text from which parse_text() returns the value: "true", "1e-05", "0 0 1", "bdf2".
std::string value_text(const Value& value);

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
