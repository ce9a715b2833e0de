// Between the program's keys and Python's names and values.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "sim/bending/laws/law_parameters.h"
#include "sim/scene/key_table.h"
#include "sim/scene/value_tree.h"

namespace hysteron::python {

namespace py = pybind11;

// Numbers in one run of memory, converted where they are not.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// A key as Python names it, with underscores: "self_contact" of "self-contact", "fabric_b2" of "fabric.b2".
std::string python_name(std::string key);
// A name of Python's as one of these keys; as it stands where it is none, for the reader to refuse.
std::string key_named(const std::string& name, const std::vector<std::string>& keys);
std::vector<std::string> paths(const std::vector<KeyDescription>& keys);

// A value as a scene file would hold it: bool, int, float, str, a path, or numbers.  Error::invalid_input of
// the key for any other.
Value to_value(py::handle value, const std::string& key);
// As a file would spell it; for parameters of laws.
std::string to_text(py::handle value, const std::string& key);

// Arguments beyond those that a function names, as parameters of that law.
LawParameters law_parameters(const std::string& law, const py::dict& given);

// A mapping as the tree of a scene file: {"cloth": {"length": 0.1}}, {"cloth.length": 0.1} and
// {"cloth_length": 0.1} are one; lists of mappings are arrays of tables.
ValueTree to_tree(const py::dict& values);

// Hands a warning of the program to Python's `warnings`, whose filters may make an error of it; "" is none.
void warn(const std::string& text);
void warn(const std::vector<std::string>& texts);

// Lets other threads of Python run meanwhile.
template <class Body>
void unlocked(const Body& body) {
  const py::gil_scoped_release released;
  body();
}

// What a key holds.
py::object to_python(const Field& field);
// The same of JSON, for whole trees.
py::object from_json(const std::string& text);

// A copy in an array of this shape.
py::array numpy_array(const std::vector<double>& values, int columns);
py::array numpy_array(const std::vector<Eigen::Vector3d>& values);

// Memory of `owner`, which lives as long as the array; not writeable.
template <class T>
py::array array_view(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array_t<T> view(std::move(shape), data, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace hysteron::python
