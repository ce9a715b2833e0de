// Laws by what they keep of a bend, as pages group and colour them.
#pragma once

#include <string>

#include "render/image.h"

namespace hysteron::experiments {

// "elastic": nothing is kept; "plastic": a rest curvature beyond a yield; "hysteretic": friction; "" of a law
// that is unknown.
std::string family_of_law(const std::string& law);
// The same on every page; no two laws have one colour.  Grey of a law that is unknown.
render::Rgb8 color_of_law(const std::string& law);

}  // namespace hysteron::experiments
