#include "python/module.h"

#include "experiments/workbench/app/command_line.h"
#include "experiments/workbench/app/run.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"

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

void bind_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

// Returns the names of the flags that a subcommand takes, without their "--"; none if there is no such
// subcommand.
py::list experiment_options(const std::string& name) {
  py::list names;
  const experiments::Experiment& experiment = experiments::experiment_named(name);
  if (!*experiment.name) return names;
  for (const KeyDescription& key :
       experiments::experiment_options(experiment, experiments::Defaults::left_out))
    names.append(experiments::option_name(key).substr(2));
  return names;
}

}  // namespace

PYBIND11_MODULE(_hysteron, module) {
  module.doc() = "The compiled part of hysteron; use the package `hysteron_cloth`.";
  const std::string version = experiments::program_version();
  module.attr("__version__") = version.substr(0, version.find(' '));
  module.attr("build") = version;
  module.attr("has_cuda") = HYSTERON_HAS_CUDA != 0;
  module.def("_set_assets_place", [](const std::string& folder) { set_assets_place(folder); });
  module.def("_experiment_options", &experiment_options);
  bind_errors();
  bind_fabric(module);
  bind_law(module);
  bind_scene(module);
  bind_simulation(module);
  bind_pictures(module);
  bind_fit(module);
}

}  // namespace hysteron::python
