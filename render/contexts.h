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
  // Opens the first of `names` that can be opened.
  explicit SharedLibrary(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) return;
      reason_ = dlerror();
    }
  }

  // Loads a function; Error::system if no library was opened or it lacks the function.
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

// Lists EGL's devices and the surfaceless platform; empty if libEGL cannot be opened.
std::vector<Candidate> egl_candidates();

// Says in a few words why there are no candidates.
std::string egl_unavailable();

// Creates a context through EGL; Error::system if EGL refuses.
std::unique_ptr<Offscreen> create_egl_context(const Candidate& candidate);

// OpenGL contexts through OSMesa, Mesa's renderer into plain memory, opened at run time.  Mesa dropped it
// in 25.1.

// Creates a context through OSMesa; Error::system if there is no libOSMesa or it refuses.
std::unique_ptr<Offscreen> create_osmesa_context(const Candidate& candidate);

}  // namespace hysteron::render
