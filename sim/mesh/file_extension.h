// Tells the kind of a mesh file by its name, in letters of either case.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace hysteron {

// Returns ".obj" for "Shirt.OBJ".
inline std::string file_extension(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

inline bool names_an_obj(const std::filesystem::path& file) { return file_extension(file) == ".obj"; }

}  // namespace hysteron
