// A TOML file as a tree that remembers source lines; this is the only user of the TOML library.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/scene/value_tree.h"

namespace hysteron {

// Reads a whole file.  Throws Error::system if it cannot be read, Error::invalid_input with file and line if
// it is not TOML, nests deeper than any scene, or holds what no key can take (dates, mixed arrays).
ValueTree read_toml(const std::string& file, Lists lists = Lists::refused);

// Checks that have to precede parsing.

inline constexpr int kMaxKeyParts = 32;  // "cloth.length" has two

struct TomlFault {
  int line;
  std::string what;  // "a key has more than 32 parts"
};

// Finds the first place where a text breaks TOML in a way that toml++ only asserts, or that overflows its
// recursion:
//  - a letter beyond ASCII behind a backslash, or outside of texts and comments: the library's tests for
//    white space do not expect it;
//  - brackets outside of texts and comments that do not match;
//  - a header that is not "[a.b]" or "[[a.b]]" in a line of its own;
//  - a text that begins in the middle of a key or a value: 1"a";
//  - a key of more than kMaxKeyParts parts: each part is a table in the one before.
// Other mistakes are left to the parser.
std::optional<TomlFault> fault_before_parsing(std::string_view text);

}  // namespace hysteron
