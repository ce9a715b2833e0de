#include "python/values.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <set>

#include "sim/base/error.h"
#include "sim/scene/keys.h"

namespace hysteron::python {
namespace {

[[noreturn]] void refuse(const std::string& key, py::handle value, const std::string& allowed) {
  const std::string text = py::repr(value);
  throw Error::invalid_input(key + " = " + text + " must be " + allowed).with_key(key, text);
}

bool is_mapping(py::handle value) { return py::isinstance<py::dict>(value); }

// True for a list of mappings, or an empty one for a key of tables.
bool is_tables(const std::string& key, py::handle value) {
  static const std::set<std::string> kTables = {"pin", "obstacle", "command", "phase", "keys"};
  if (!py::isinstance<py::list>(value) && !py::isinstance<py::tuple>(value)) return false;
  const auto items = py::reinterpret_borrow<py::sequence>(value);
  return items.size() > 0 ? is_mapping(items[0]) : kTables.contains(key);
}

ValueTree value_node(const std::string& key, Value value) {
  return {ValueTree::Kind::value, key, 0, std::move(value), {}};
}

ValueTree table_from_python(const py::dict& values);

ValueTree tables_node(const std::string& key, py::handle value) {
  ValueTree node{ValueTree::Kind::array, key, 0, {}, {}};
  for (py::handle item : py::reinterpret_borrow<py::sequence>(value)) {
    if (!is_mapping(item)) refuse(key, item, "a dict");
    node.children.push_back(table_from_python(py::reinterpret_borrow<py::dict>(item)));
  }
  return node;
}

// Converts an element of an array of tables: its keys have hyphens where Python has underscores.
ValueTree table_from_python(const py::dict& values) {
  ValueTree table;
  for (const auto& [name, value] : values) {
    std::string key = py::str(name);
    std::replace(key.begin(), key.end(), '_', '-');
    table.children.push_back(is_tables(key, value) ? tables_node(key, value)
                                                   : value_node(key, to_value(value, key)));
  }
  return table;
}

void flatten(const std::string& prefix, const py::dict& values, const std::vector<std::string>& keys,
             ValueTree& root) {
  for (const auto& [name, value] : values) {
    const std::string path = prefix + std::string(py::str(name));
    if (prefix == "param.") {
      root.children.push_back(value_node(path, to_text(value, path)));
    } else if (is_mapping(value)) {
      flatten(path + ".", py::reinterpret_borrow<py::dict>(value), keys, root);
    } else if (is_tables(path, value)) {
      root.children.push_back(tables_node(path, value));
    } else {
      const std::string key = key_named(path, keys);
      root.children.push_back(value_node(key, to_value(value, key)));
    }
  }
}

// Converts one number of numpy's, or a list of them.
Value numbers_from_python(py::handle value, const std::string& key) {
  const Numbers numbers = value.is_none() ? Numbers() : Numbers::ensure(value);
  if (!numbers || value.is_none() || numbers.ndim() > 1) {
    PyErr_Clear();
    refuse(key, value, "a bool, a number, a text or a list of numbers");
  }
  if (numbers.ndim() == 0) return *numbers.data();
  return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
}

struct ToPython {
  py::object operator()(const NamedValue& named) const { return py::str(named.name()); }
  py::object operator()(const Eigen::Vector3d* v) const { return py::make_tuple(v->x(), v->y(), v->z()); }
  template <class Held>
  py::object operator()(const Held* value) const {
    return py::cast(*value);
  }
};

}  // namespace

std::string python_name(std::string key) {
  std::replace_if(
      key.begin(), key.end(), [](char c) { return c == '.' || c == '-'; }, '_');
  return key;
}

std::vector<std::string> paths(const std::vector<KeyDescription>& keys) {
  std::vector<std::string> result;
  for (const KeyDescription& key : keys) result.push_back(key.path);
  return result;
}

std::string key_named(const std::string& name, const std::vector<std::string>& keys) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const std::string& key) {
    return python_name(key) == python_name(name);
  });
  return found == keys.end() ? name : *found;
}

Value to_value(py::handle value, const std::string& key) {
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (PyIndex_Check(value.ptr()) && !py::isinstance<py::array>(value)) return value.cast<std::int64_t>();
  if (PyFloat_Check(value.ptr())) return value.cast<double>();
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__fspath__")) return std::string(py::str(value.attr("__fspath__")()));
  return numbers_from_python(value, key);
}

std::string to_text(py::handle value, const std::string& key) {
  const Value read = to_value(value, key);
  if (const auto* text = std::get_if<std::string>(&read)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&read)) return std::to_string(*whole);
  if (const auto* number = std::get_if<double>(&read)) return number_text(*number);
  refuse(key, value, "a number or a text");
}

void warn(const std::string& text) {
  if (text.empty()) return;
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) < 0) throw py::error_already_set();
}

void warn(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warn(text);
}

LawParameters law_parameters(const std::string& law, const py::dict& given) {
  const std::vector<std::string> known = law_parameter_names(law);
  LawParameters parameters;
  for (const auto& [key, value] : given) {
    const std::string parameter = key_named(py::str(key), known);
    parameters[parameter] = to_text(value, parameter);
  }
  return parameters;
}

ValueTree to_tree(const py::dict& values) {
  ValueTree root;
  flatten("", values, paths(scene_keys()), root);
  return root;
}

py::object to_python(const Field& field) { return std::visit(ToPython{}, field); }

py::object from_json(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

py::array numpy_array(const std::vector<double>& values, int columns) {
  const auto rows = static_cast<py::ssize_t>(values.size()) / columns;
  std::vector<py::ssize_t> shape = {rows};
  if (columns > 1) shape.push_back(columns);
  return py::array_t<double>(shape, values.data());
}

py::array numpy_array(const std::vector<Eigen::Vector3d>& values) {
  py::array_t<double> result({static_cast<py::ssize_t>(values.size()), py::ssize_t(3)});
  double* to = result.mutable_data();
  for (const Eigen::Vector3d& v : values) to = std::copy(v.data(), v.data() + 3, to);
  return result;
}

}  // namespace hysteron::python
