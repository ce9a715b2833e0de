// libFuzzer calls this file, for one format a program: HYSTERON_FORMAT, as the build names it.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>

#include "tests/fuzz/formats.h"

namespace {

using namespace hysteron::fuzz;
namespace fs = std::filesystem;

Format chosen() {
  const std::vector<Format> all = formats();
  return *std::find_if(all.begin(), all.end(),
                       [](const Format& format) { return format.name == HYSTERON_FORMAT; });
}

// Readers take files; libFuzzer may run several processes side by side.
fs::path place(const Format& format) {
  return fs::temp_directory_path() / ("input-" + std::to_string(getpid()) + format.ending);
}

void read(const Format& format, const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
  taken(format, file);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Format format = chosen();
  static const fs::path file = place(format);
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(format, file, bytes);
  if (format.repaired) read(format, file, format.repaired(bytes));
  return 0;
}
