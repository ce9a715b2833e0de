// Splits lists as flags give them: "linear,prandtl".
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace hysteron {

inline std::vector<std::string> split(const std::string& list, char separator = ',') {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

}  // namespace hysteron
