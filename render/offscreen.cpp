#include "render/offscreen.h"

#include <algorithm>

#include "render/context_probe.h"
#include "render/contexts.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

std::string gl_string(const GlFunctions& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text ? reinterpret_cast<const char*>(text) : "unknown";
}

bool draws_in_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "SwiftShader"})
    if (renderer.find(name) != std::string::npos) return true;
  return false;
}

std::unique_ptr<Offscreen> create_or_explain(const Candidate& candidate, std::string& tried) {
  constexpr int kAttempts = 2;
  std::string reason;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      return Offscreen::create(candidate);
    } catch (const Error& error) {
      reason = error.what();
    }
  }
  tried += (tried.empty() ? "" : "; ") + candidate.name() + " (" + reason + ")";
  return nullptr;
}

}  // namespace

std::string Candidate::name() const {
  if (kind == Kind::osmesa) return "OSMesa";
  if (kind == Kind::egl_surfaceless) return "EGL surfaceless";
  return "EGL device " + std::to_string(device);
}

std::vector<Candidate> Offscreen::candidates(Renderer renderer, int preferred_cuda_device) {
  std::vector<Candidate> list;
  if (renderer != Renderer::osmesa) list = egl_candidates();
  if (renderer != Renderer::egl) list.push_back({.kind = Candidate::Kind::osmesa});
  const auto rank = [preferred_cuda_device](const Candidate& candidate) {
    if (candidate.cuda_device >= 0 && candidate.cuda_device == preferred_cuda_device) return 0;
    if (candidate.hardware) return 1;
    return 2 + static_cast<int>(candidate.kind);
  };
  std::stable_sort(list.begin(), list.end(),
                   [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); });
  return list;
}

std::unique_ptr<Offscreen> Offscreen::create(const Candidate& candidate) {
  require_no_crash(candidate);
  if (candidate.kind == Candidate::Kind::osmesa) return create_osmesa_context(candidate);
  return create_egl_context(candidate);
}

std::unique_ptr<Offscreen> Offscreen::create(Renderer renderer, int preferred_cuda_device) {
  const auto list = candidates(renderer, preferred_cuda_device);
  const bool has_egl = !list.empty() && list.front().kind != Candidate::Kind::osmesa;
  std::string tried = has_egl || renderer == Renderer::osmesa ? "" : "EGL (" + egl_unavailable() + ")";
  for (const Candidate& candidate : list)
    if (auto context = create_or_explain(candidate, tried)) return context;
  throw Error::system("creating an OpenGL 3.3 context without a display: tried " + tried +
                      "; install libegl1 with libgl1-mesa-dri, or libosmesa6");
}

void Offscreen::describe(GlLoader loader) {
  gl_ = load_gl_functions(loader);
  const std::string renderer = gl_string(gl_, GL_RENDERER);
  GLint major = 0, minor = 0;
  gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
  gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
  if (major * 10 + minor < 33)
    throw Error::system(renderer + " offers OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
                        ", 3.3 is needed");
  hardware_ = candidate_.hardware && !draws_in_software(renderer);
  description_ = candidate_.name() + ": " + renderer + ", " + gl_string(gl_, GL_VENDOR) + ", GL " +
                 gl_string(gl_, GL_VERSION);
}

}  // namespace hysteron::render
