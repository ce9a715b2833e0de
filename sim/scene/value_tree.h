// What a file of keys says, of whatever format: TOML (toml_file.h), JSON, or mappings of Python.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"

namespace hysteron {

struct ValueTree {
  enum class Kind { value, table, array };  // array: of tables, or of values where lists are allowed
  Kind kind = Kind::table;
  std::string key;                  // empty for elements of an array
  int line = 0;                     // 1 = first line of the file; 0: not known
  Value value;                      // Kind::value; an array of numbers is one value
  std::vector<ValueTree> children;  // Kind::table, Kind::array; in the file's order

  const ValueTree* find(const std::string& name) const;
};

// Whether arrays of texts or of truths may stand in a file, which no key of a scene takes.
enum class Lists { refused, allowed };

// JSON as such a tree.  Throws Error::invalid_input, naming `file`, for null and lists that no key can take.
ValueTree json_tree(const nlohmann::ordered_json& json, const std::string& file, Lists lists = Lists::refused,
                    const std::string& key = "");

// Those of an array of tables, [[key]].  Throws Error::invalid_input where it is none.
const std::vector<ValueTree>& tables(const ValueTree& node, const std::string& file);

// Sets the key PREFIX + node.key.  Throws Error::invalid_input as find_key and assign do, and for what is not
// one value.
void assign(const Keys& keys, const ValueTree& node, const std::string& file, const std::string& prefix = "");

// "scene.toml:7"; without a line of its own "scene.toml".
std::string place(const std::string& file, const ValueTree& node);

}  // namespace hysteron
