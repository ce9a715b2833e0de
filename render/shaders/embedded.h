// Files that the build puts into the binary, so that it runs anywhere: shaders and the captions' font.
#pragma once

#include <span>
#include <string_view>

namespace hysteron::render {

// Returns the bytes of a file by its name without folder ("surface.vert", "DejaVuSans.ttf").  Error::system
// if it is unknown, which a list forgotten in render/CMakeLists.txt causes.
std::span<const unsigned char> embedded_file(std::string_view name);

}  // namespace hysteron::render
