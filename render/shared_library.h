// A shared library opened at run time.  It is never closed: drivers keep threads and exit handlers.
#pragma once

#include <dlfcn.h>

#include <initializer_list>
#include <string>

#include "sim/base/error.h"

namespace hysteron::render {

class SharedLibrary {
 public:
  // The first of `names` that opens; is_open() tells whether one did.
  explicit SharedLibrary(std::initializer_list<const char*> names) {
    for (const char* name : names) {
      handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
      if (handle_ != nullptr) return;
      reason_ = dlerror();
    }
  }

  bool is_open() const { return handle_ != nullptr; }
  const std::string& reason() const { return reason_; }

  template <class Function>
  void load(const char* name, Function& function) const {
    function = is_open() ? reinterpret_cast<Function>(dlsym(handle_, name)) : nullptr;
    if (function == nullptr) throw Error::machine(is_open() ? std::string("it has no ") + name : reason_);
  }

 private:
  void* handle_ = nullptr;
  std::string reason_;
};

}  // namespace hysteron::render
