# Writes OUTPUT, a C++ file that holds the bytes of every file in FILES (separated by |), for the function
# embedded_file() of namespace hysteron::NAMESPACE that HEADER declares.
string(REPLACE "|" ";" FILES "${FILES}")
set(arrays "")
set(cases "")
set(number 0)
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  # A string literal compiles much faster than a list of numbers; broken into lines, it stays readable by tools.
  string(REGEX REPLACE "((\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..)(\\\\x..))" "\\1\"\n    \"" bytes "${bytes}")
  string(APPEND arrays "constexpr char kFile${number}[] =\n    \"${bytes}\";\n")
  string(APPEND cases "  if (name == \"${name}\") return bytes_of(kFile${number});\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUTPUT}" "// Written by cmake/embed.cmake.
#include \"${HEADER}\"

#include <string>

#include \"sim/base/error.h\"

namespace hysteron::${NAMESPACE} {
namespace {

${arrays}
// The literal's closing zero is not part of the file.
template <size_t size>
std::span<const unsigned char> bytes_of(const char (&literal)[size]) {
  return {reinterpret_cast<const unsigned char*>(literal), size - 1};
}

}  // namespace

std::span<const unsigned char> embedded_file(std::string_view name) {
${cases}  throw Error::system(\"looking for \" + std::string(name) + \": it is not embedded in this binary\");
}

}  // namespace hysteron::${NAMESPACE}
")
