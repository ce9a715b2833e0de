// OpenGL contexts through EGL, opened at run time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/offscreen.h"

namespace hysteron::render {

// EGL's devices and the surfaceless platform; empty if libEGL cannot be opened.
std::vector<Candidate> egl_candidates();

// Why there are no candidates, in a few words.
std::string egl_unavailable();

// Error::machine if EGL refuses.
std::unique_ptr<Offscreen> create_egl_context(const Candidate& candidate);

}  // namespace hysteron::render
