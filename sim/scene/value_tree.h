// The content of a file of keys in any format: TOML (toml_file.h), JSON, or mappings of Python.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/key_table.h"

namespace hysteron {

struct ValueTree {
  enum class Kind { value, table, array };  // array: of tables, or of values where lists are allowed
  Kind kind = Kind::table;
  std::string key;                  // empty for elements of an array
  int line = 0;                     // 1 = first line of the file; 0: not known
  Value value;                      // for Kind::value; an array of numbers is one value
  std::vector<ValueTree> children;  // for Kind::table and Kind::array, in the file's order

  const ValueTree* find(const std::string& name) const;
  // Returns the number that the node is, if it is a single one.
  std::optional<double> number() const;
};

// May arrays of texts or of truth values, which no key of a scene takes, stand in a file?
enum class Lists { refused, allowed };

// Converts JSON to such a tree.  Throws Error::invalid_input, naming `file`, for null and lists that no key
// can take.
ValueTree json_tree(const nlohmann::ordered_json& json, const std::string& file, Lists lists = Lists::refused,
                    const std::string& key = "");

// Returns the tables of an array of tables, [[key]].  Throws Error::invalid_input where the node is none.
const std::vector<ValueTree>& tables(const ValueTree& node, const std::string& file);

// Sets the key PREFIX + node.key.  Throws Error::invalid_input as find_key and assign do, and for a node that
// is not one value.
void assign(const Keys& keys, const ValueTree& node, const std::string& file, const std::string& prefix = "");

// Returns "scene.toml:7", or "scene.toml" if the node has no line.
std::string place(const std::string& file, const ValueTree& node);

}  // namespace hysteron
