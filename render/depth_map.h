// Textures of depth as a light sees it, and the framebuffers that draw them.
#pragma once

#include "render/gl/handles.h"

namespace hysteron::render {

// Looked up between four texels; what lies outside is what lies at its border; bound when it returns.
// `stored`: the format of a texel; `channels` of it.
GlTexture filtered_texture(const GlFunctions& gl, GLint stored, GLenum channels, int width, int height);
// Compared with in lookups, between four texels; what lies outside is what lies at its border.  [texels]
GlTexture depth_map(const GlFunctions& gl, int width, int height);
// Draws depth alone into the map.
GlFramebuffer depth_target(const GlFunctions& gl, const GlTexture& map);

}  // namespace hysteron::render
