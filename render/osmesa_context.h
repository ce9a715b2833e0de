// OpenGL contexts through OSMesa, Mesa's renderer into plain memory, opened at run time.  Mesa dropped it
// in 25.1.
#pragma once

#include <memory>

#include "render/offscreen.h"

namespace hysteron::render {

// Error::machine if there is no libOSMesa or it refuses.
std::unique_ptr<Offscreen> create_osmesa_context(const Candidate& candidate);

}  // namespace hysteron::render
