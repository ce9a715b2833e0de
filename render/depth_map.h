// Textures of depth as a light sees it, and the framebuffers that draw them.
#pragma once

#include "render/gl/handles.h"

namespace hysteron::render {

// Compared with in lookups, between four texels; what lies outside is what lies at its border.  [texels]
GlTexture depth_map(const GlFunctions& gl, int width, int height);
// Draws depth alone into the map.
GlFramebuffer depth_target(const GlFunctions& gl, const GlTexture& map);

}  // namespace hysteron::render
