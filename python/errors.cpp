#include "python/module.h"
#include "sim/base/error.h"

namespace hysteron::python {
namespace {

const char* exception_type(const Error& error) {
  switch (error.exit_code()) {
    case 1:
      return "MachineError";
    case 3:
      return "RunError";
    default:
      return "RequestError";
  }
}

void raise(const Error& error) {
  const py::object type = py::module_::import("hysteron_cloth.errors").attr(exception_type(error));
  PyErr_SetObject(type.ptr(), type(error.what(), error.key(), error.value()).ptr());
}

}  // namespace

void bind_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace hysteron::python
