#include <pybind11/stl.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/options.h"
#include "python/fabric.h"
#include "python/module.h"
#include "sim/scene/keys.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::python {
namespace {

constexpr const char* kOfScenes = "Scene";  // name of the origin in messages

// Moves a fabric that is an object from the values to the scene.
void take_fabric(Scene& scene, py::dict& values) {
  if (!values.contains("fabric") || !py::isinstance<FabricValue>(values["fabric"])) return;
  scene.fabric = fabric_from_python(values["fabric"]);
  scene.origin["fabric.name"] = kOfScenes;
  PyDict_DelItemString(values.ptr(), "fabric");
}

void apply(Scene& scene, const py::dict& given) {
  py::dict values = given.attr("copy")();
  take_fabric(scene, values);
  apply_scene_tree(scene, to_tree(values), kOfScenes);
}

// Reads a scene's file as `hysteron run` does; its keys of pictures and metrics are ignored.
void apply_file(Scene& scene, const std::string& file) {
  experiments::Options unused;
  apply_scene_file(scene, file, experiments::bind_options(unused), {"metric"});
}

Scene make_scene(py::object source, const py::kwargs& keys) {
  Scene scene = default_scene();
  if (py::isinstance<py::dict>(source))
    apply(scene, source);
  else if (!source.is_none())
    apply_file(scene, py::str(source));
  apply(scene, keys);
  check_scene(scene);
  return scene;
}

py::object get(const Scene& scene, const std::string& name) {
  Scene copy = scene;
  const Keys keys = bind_scene(copy);
  const std::string path = key_named(name, paths(scene_keys()));
  return to_python(find_key(keys, key_of_flag(path), kOfScenes).field);
}

void set(Scene& scene, const std::string& name, py::object value) {
  py::dict one;
  one[py::str(name)] = value;
  apply(scene, one);
}

// Returns the scene as Python's json reads it from a manifest.
py::object tree(const Scene& scene) { return from_json(to_json(scene).dump()); }

py::list keys() {
  py::list all;
  for (const KeyDescription& key : scene_keys()) {
    py::dict row;
    row["key"] = key.path;
    row["type"] = key.type;
    row["unit"] = key.unit;
    row["default"] = key.default_text;
    row["choices"] = key.choices;
    row["doc"] = key.doc;
    all.append(row);
  }
  return all;
}

}  // namespace

void bind_scene(py::module_& module) {
  py::class_<Scene>(module, "Scene", R"(What is simulated: cloth, fabric, law, pins, obstacles, method.

Scene("strip-over-sphere", fabric="wool-tropical", cloth_length=0.2, self_contact=True)

source: a scene of assets/scenes, a TOML file, a dict, or None: the program's defaults (a square of cotton
broad, implicit steps of 1/60 s).  What a file says of pictures and metrics is left aside.  Further keys are
those of docs/scenes.md, in SI units; names may have underscores for their hyphens and dots.  fabric: a name,
a file or a Fabric.  param: a dict, the law's parameters.  pin, obstacle, command, phase: lists of dicts with
the keys of their tables, and `keys`, a list of keyframes, where they move.)")
      .def(py::init(&make_scene), py::arg("source") = py::none())
      .def("__getitem__", &get, py::arg("key"))
      .def("__setitem__", &set, py::arg("key"), py::arg("value"))
      .def_property(
          "fabric", [](const Scene& scene) { return FabricValue(scene.fabric); },
          [](Scene& scene, py::object fabric) { set(scene, "fabric", fabric); },
          "A copy of its fabric; assign one, or a name or a file, to change it.")
      .def("to_dict", &tree, "The resolved scene as manifests have it: every key, and where each was set.")
      .def(
          "copy", [](const Scene& scene) { return scene; }, "Another one with the same keys.")
      .def("__repr__", [](const Scene& scene) {
        return "Scene(" + enum_name(scene.cloth.shape) + " of " + scene.fabric.name + ", law " + scene.law +
               ")";
      });
  module.def("scene_keys", &keys, "Every key of a scene: its type, unit, default, choices and meaning.");
}

}  // namespace hysteron::python
