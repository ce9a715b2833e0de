// What must be known of a TOML file before it is parsed.
#pragma once

#include <string_view>

namespace hysteron {

inline constexpr int kMostKeyParts = 32;  // "cloth.length" has two

// The first line with a key of more parts than that; 0 if there is none.  Each part is a table in the one
// before, and trees of such a depth are built and taken down by recursion.
int line_of_a_long_key(std::string_view text);

}  // namespace hysteron
