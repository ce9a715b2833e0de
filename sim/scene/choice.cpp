#include "sim/scene/choice.h"

#include <algorithm>

#include "sim/scene/key_table.h"

namespace hysteron {

Error not_a_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices,
                   const std::string& origin) {
  return Error::invalid_input(key + " = " + name + " must be " + join(choices, " | "))
      .with_origin(origin + suggestion(name, choices))
      .with_key(key, name);
}

Error not_a_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices) {
  return not_a_choice(key, name, choices, "--" + key);
}

void check_choice(const std::string& key, const std::string& name, const std::vector<std::string>& choices) {
  if (!std::count(choices.begin(), choices.end(), name)) throw not_a_choice(key, name, choices);
}

}  // namespace hysteron
