#include "sim/mesh/mesh_text.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "sim/error.h"

namespace hysteron {

std::string read_mesh_text(const std::string& file) {
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error::machine("cannot read mesh " + file + ": " + std::strerror(errno));
  std::string text;
  std::vector<char> block(1 << 16);
  while (in.read(block.data(), block.size()), in.gcount() > 0) text.append(block.data(), in.gcount());
  if (in.bad() || std::filesystem::is_directory(file))
    throw Error::machine("cannot read mesh " + file + ": not a readable file");
  return text;
}

}  // namespace hysteron
