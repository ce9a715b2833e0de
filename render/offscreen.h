// An OpenGL 3.3 core context without a display: EGL on a GPU, EGL in software, or OSMesa, whichever answers
// first.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "render/gl/glfunctions.h"

namespace hysteron::render {

enum class Renderer { automatic, egl, osmesa };
constexpr std::array<const char*, 3> names(Renderer) { return {"auto", "egl", "osmesa"}; }

// One way to get a context, before it is tried.
struct Candidate {
  enum class Kind { egl_device, egl_surfaceless, osmesa };
  Kind kind = Kind::egl_device;
  int device = -1;        // index among EGL's devices, egl_device only
  bool hardware = false;  // the device's extensions lack EGL_MESA_device_software
  int cuda_device = -1;   // the CUDA device behind it (EGL_NV_device_cuda), -1 if none

  std::string name() const;
};

class Offscreen {
 public:
  // Creates the first candidate's context that succeeds; each failing one is tried twice, because GPU drivers
  // fail now and then while another process starts.  `preferred_cuda_device` is tried first, so that
  // positions need not leave it. Error::system lists in one line what was tried.  The new context is current.
  static std::unique_ptr<Offscreen> create(Renderer renderer, int preferred_cuda_device = -1);
  static std::unique_ptr<Offscreen> create(const Candidate& candidate);

  // Lists candidates in the order in which create() tries them: EGL hardware devices, EGL software devices,
  // surfaceless, OSMesa.
  static std::vector<Candidate> candidates(Renderer renderer, int preferred_cuda_device = -1);

  virtual ~Offscreen() = default;
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;

  // Binds the context to the calling thread.
  virtual void make_current() = 0;

  const GlFunctions& gl() const { return gl_; }
  // Names the candidate, vendor, renderer and version, for logs and manifests.
  const std::string& description() const { return description_; }
  bool egl_device_is_hardware() const { return hardware_; }
  int cuda_device() const { return candidate_.cuda_device; }

 protected:
  explicit Offscreen(const Candidate& candidate) : candidate_(candidate) {}
  // Loads the table and asks the driver what it is; the context must be current.
  void describe(GlLoader loader);

 private:
  Candidate candidate_;
  GlFunctions gl_;
  std::string description_;
  bool hardware_ = false;
};

}  // namespace hysteron::render
