#include "python/fabric.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "python/module.h"
#include "sim/base/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::python {
namespace {

constexpr const char* kOfFabrics = "Fabric";  // name of the origin in messages
constexpr const char* kPrefix = "fabric.";

// Returns the key fabric.* of that attribute; null if there is none.
const BoundKey* find(const Keys& keys, const std::string& name) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const BoundKey& key) {
    return python_name(key.description.path) == python_name(kPrefix + name);
  });
  return found == keys.end() ? nullptr : &*found;
}

py::dict provenance_dict(const Provenance& from) {
  py::dict entry;
  entry["source"] = from.source;
  entry["confidence"] = from.confidence;
  entry["standard_error"] = from.standard_error;
  return entry;
}

py::list key_names() {
  py::list names;
  for (const KeyDescription& key : scene_keys()) {
    if (!key.path.starts_with(kPrefix)) continue;
    names.append(python_name(key.path.substr(std::string(kPrefix).size())));
  }
  return names;
}

py::dict provenance(const FabricValue& of) {
  py::dict all;
  for (const auto& [key, from] : of.fabric().provenance) all[py::str(key)] = provenance_dict(from);
  return all;
}

py::dict published(const FabricValue& of) {
  py::dict all;
  for (const auto& [name, number] : of.fabric().published) {
    py::dict entry = provenance_dict(number.provenance);
    entry["value"] = number.value;
    entry["unit"] = number.unit;
    if (number.tester) entry["tester"] = enum_name(*number.tester);
    all[py::str(name)] = entry;
  }
  return all;
}

}  // namespace

FabricValue::FabricValue(const std::string& name_or_file, const py::dict& keys) {
  set_key(scene_, "fabric", name_or_file, kOfFabrics);
  for (const auto& [name, value] : keys) set(py::str(name), value);
  checked();
}

const Fabric& FabricValue::checked() const {
  check_scene(scene_);
  return scene_.fabric;
}

py::object FabricValue::get(const std::string& name) const {
  Scene copy = scene_;
  const Keys keys = bind_scene(copy);
  const BoundKey* key = find(keys, name);
  if (!key) throw py::attribute_error("a fabric has no key \"" + name + "\"");
  return to_python(key->field);
}

void FabricValue::set(const std::string& name, py::handle value) {
  if (name == "name") {  // as a key it would load another fabric
    scene_.fabric.name = py::str(value);
    return;
  }
  const Keys keys = bind_scene(scene_);
  const BoundKey* key = find(keys, name);
  if (!key) find_key(keys, kPrefix + name, kOfFabrics);  // throws, with the nearest name
  set_key(scene_, *key, to_value(value, key->description.path), kOfFabrics);
}

Fabric fabric_from_python(py::handle fabric) {
  if (py::isinstance<FabricValue>(fabric)) return fabric.cast<const FabricValue&>().checked();
  return FabricValue(py::str(fabric), {}).fabric();
}

void bind_fabric(py::module_& module) {
  py::class_<FabricValue>(
      module, "Fabric",
      R"(Physics of a cloth: every key fabric.* of scene files as an attribute, in SI units.

Fabric("cotton-broad", k0=60) is a fabric of assets/fabrics (or a fabric file) with another k0; names have
underscores where keys have hyphens and dots (weft_bending, bending_stops_thresholds).
b1, b2: bending rigidity at first bending and once friction has saturated [N m]; k0: curvature where it has
[1/m]; density [kg/m^2]; thickness [m]; warp, weft, shear, coupling: membrane stiffness [N/m]; damping [s].)")
      .def(py::init(
               [](py::object fabric, const py::kwargs& keys) { return FabricValue(py::str(fabric), keys); }),
           py::arg("fabric") = "cotton-broad")
      .def("__getattr__", &FabricValue::get)
      .def("__setattr__", &FabricValue::set)
      .def("__dir__",
           [](py::object self) {
             const py::object object = py::module_::import("builtins").attr("object");
             return py::list(object.attr("__dir__")(self)) + key_names();
           })
      .def("__repr__", [](const FabricValue& f) { return "Fabric(\"" + f.fabric().name + "\")"; })
      .def("provenance", &provenance,
           "Source, confidence and standard error (or None) of each number, by its key.")
      .def("published", &published,
           "What sources print besides (B, 2HB, drape-coefficient, ...): value, unit and source, by name.")
      .def(
          "friction_moment", [](const FabricValue& f) { return f.fabric().virgin_curve().friction_moment(); },
          "M0 = HB, half the width of the moment-curvature loop [N].")
      .def(
          "copy", [](const FabricValue& f) { return f; }, "Another one with the same numbers.");
  module.def(
      "fabrics", [] { return list_assets("fabrics"); }, "Names of the fabrics that come with hysteron.");
  module.def(
      "scenes", [] { return list_assets("scenes"); }, "Names of the scenes that come with hysteron.");
}

}  // namespace hysteron::python
