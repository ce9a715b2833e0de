// Groups laws by how much of a bend they keep, as pages order and colour them.
#pragma once

#include <string>

#include "render/image.h"

namespace hysteron::experiments {

// Returns the name of the law's family (LawFamily), "hysteretic"; "" for an unknown law.
std::string family_of_law(const std::string& law);
// Returns the law's colour, the same on every page and different for all laws; grey for an unknown law.
render::Rgb8 color_of_law(const std::string& law);

}  // namespace hysteron::experiments
