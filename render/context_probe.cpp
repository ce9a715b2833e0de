#include "render/context_probe.h"

#include <cstdlib>

#include "render/contexts.h"
#include "sim/base/error.h"
#include "sim/base/process.h"

namespace hysteron::render {

void try_in_child(const std::function<void()>& call) {
  answer_of_child([&] {
    try {
      call();
    } catch (...) {  // the parent meets the same error and reports it
    }
    return std::string();
  });
}

std::string named_driver() {
  for (const char* variable : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_DRIVERS_PATH"}) {
    const char* value = std::getenv(variable);
    const std::string driver = value ? value : "";
    if (!driver.empty() && driver != "llvmpipe" && driver != "softpipe" && driver != "swrast")
      return std::string(variable) + " = " + driver;
  }
  return "";
}

void require_no_crash(const Candidate& candidate) {
  const std::string driver = named_driver();
  if (driver.empty() || candidate.hardware) return;
  try {
    try_in_child([&] {
      if (candidate.kind == Candidate::Kind::osmesa)
        create_osmesa_context(candidate);
      else
        create_egl_context(candidate);
    });
  } catch (const Error& error) {
    throw Error::system(error.what() + (" with " + driver));
  }
}

}  // namespace hysteron::render
