// Converts between the program's keys and Python's names and values.
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

// An array of contiguous numbers, converted if necessary.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Returns a key's name in Python, with underscores: "self_contact" for "self-contact", "fabric_b2" for
// "fabric.b2".
std::string python_name(std::string key);
// Returns the key with this Python name; an unknown name is returned unchanged, for the reader to refuse.
std::string key_named(const std::string& name, const std::vector<std::string>& keys);
std::vector<std::string> paths(const std::vector<KeyDescription>& keys);

// Converts a value to that of a scene file: bool, int, float, str, a path, or numbers.  Throws
// Error::invalid_input with the key for any other.
Value to_value(py::handle value, const std::string& key);
// Formats a value as in a file; for parameters of laws.
std::string to_text(py::handle value, const std::string& key);

// Returns a function's additional arguments as parameters of that law.
LawParameters law_parameters(const std::string& law, const py::dict& given);

// Converts a mapping to the tree of a scene file: {"cloth": {"length": 0.1}}, {"cloth.length": 0.1} and
// {"cloth_length": 0.1} are equal; lists of mappings are arrays of tables.
ValueTree to_tree(const py::dict& values);

// Passes a warning of the program to Python's `warnings`, whose filters may turn it into an error; "" is
// none.
void warn(const std::string& text);
void warn(const std::vector<std::string>& texts);

// Calls `body` while other threads of Python may run.
template <class Body>
void unlocked(const Body& body) {
  const py::gil_scoped_release released;
  body();
}

// Converts the value of a key.
py::object to_python(const Field& field);
// Converts JSON, for whole trees.
py::object from_json(const std::string& text);

// Returns a copy in an array with this number of columns.
py::array numpy_array(const std::vector<double>& values, int columns);
py::array numpy_array(const std::vector<Eigen::Vector3d>& values);

// Returns a read-only view of the memory of `owner`, which lives as long as the array; `data` has as many
// values as `shape`.
template <class T>
py::array array_view(const T* data, std::vector<py::ssize_t> shape, py::handle owner) {
  py::array_t<T> view(std::move(shape), data, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace hysteron::python
