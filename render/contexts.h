// OpenGL contexts without a window: through EGL and through OSMesa, both opened at run time.
#pragma once

#include <dlfcn.h>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "render/offscreen.h"
#include "sim/base/error.h"

namespace hysteron::render {

// A shared library opened at run time.  It is never closed: drivers keep threads and exit handlers.
class SharedLibrary {
 public:
  // The first of `names` that opens.
  explicit SharedLibrary(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) return;
      reason_ = dlerror();
    }
  }

  // Error::system where none did, or it has nothing of that name.
  template <class Function>
  void load(const char* name, Function& function) const {
    if (handle_ == nullptr) throw Error::system(reason_);
    function = reinterpret_cast<Function>(dlsym(handle_, name));
    if (function == nullptr) throw Error::system(std::string("it has no ") + name);
  }

 private:
  void* handle_ = nullptr;
  std::string reason_;
};

// EGL's devices and the surfaceless platform; empty if libEGL cannot be opened.
std::vector<Candidate> egl_candidates();

// Why there are no candidates, in a few words.
std::string egl_unavailable();

// Error::system if EGL refuses.
std::unique_ptr<Offscreen> create_egl_context(const Candidate& candidate);

// OpenGL contexts through OSMesa, Mesa's renderer into plain memory, opened at run time.  Mesa dropped it
// in 25.1.

// Error::system if there is no libOSMesa or it refuses.
std::unique_ptr<Offscreen> create_osmesa_context(const Candidate& candidate);

}  // namespace hysteron::render
