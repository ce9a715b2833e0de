// Refuses names that are none of those a key takes.
#pragma once

#include <string>
#include <vector>

#include "sim/base/error.h"

namespace hysteron {

// Returns the refusal of a name that a flag, or a place in a file, gives to a key: "law = prandl must be
// linear | prandtl (--law; did you mean prandtl?)".
Error not_a_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices,
                   const std::string& origin);
Error not_a_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices);
// Throws it for the flag of that key unless the name is a choice.
void check_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices);

}  // namespace hysteron
