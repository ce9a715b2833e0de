// A TOML file as a plain tree that remembers source lines; the only door to the TOML library.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/key_table.h"

namespace hysteron {

struct TomlNode {
  enum class Kind { value, table, array };  // array: of tables, or of values where lists are allowed
  Kind kind = Kind::table;
  std::string key;                 // empty for elements of an array
  int line = 0;                    // 1 = first line of the file; 0: of no file
  Value value;                     // Kind::value; an array of numbers is one value
  std::vector<TomlNode> children;  // Kind::table, Kind::array; in the file's order

  const TomlNode* find(const std::string& name) const;
};

// Whether arrays of texts or of truths may stand in a file, which no key of a scene takes.
enum class TomlLists { refused, allowed };

// Reads a whole file.  Throws Error::system if it cannot be read, Error::invalid_input with file and line if
// it is no TOML, nests deeper than any scene, or holds what no key can take (dates, mixed arrays).
TomlNode read_toml(const std::string& file, TomlLists lists = TomlLists::refused);

// "scene.toml:7"; without a line of its own "scene.toml".
std::string place(const std::string& file, const TomlNode& node);

}  // namespace hysteron
