#include "python/law.h"

#include <pybind11/stl.h>

#include "python/fabric.h"
#include "python/module.h"
#include "sim/base/archive.h"
#include "sim/base/error.h"

namespace hysteron::python {
namespace {

using Loop = LawLoop<double, Cpu>;

std::string shape_text(py::array array) { return py::str(array.attr("shape")); }

// A trial that builds up no rate.
Loop::Trial steady_trial(double dt) { return {dt, dt, 0, nullptr}; }

}  // namespace

LawState::LawState(const LawChoice& choice, int dimension, int elements, int threads)
    : choice_(choice),
      dimension_(dimension),
      elements_(elements),
      cpu_(std::make_unique<Cpu>(threads)),
      loop_(make_law_loop<double>(*cpu_, choice, dimension, elements)),
      area_(elements, 1),
      coefficient_(static_cast<std::size_t>(elements) * dimension * dimension),
      start_(elements + 1),
      hinge_(static_cast<std::size_t>(elements) * dimension) {
  for (int i = 0; i <= elements; ++i) start_[i] = i * dimension;
  for (int h = 0; h < elements * dimension; ++h) {
    hinge_[h] = h;
    coefficient_[static_cast<std::size_t>(h) * dimension + h % dimension] = 1;
  }
}

LawState LawState::copy() const {
  LawState copy(choice_, dimension_, elements_, cpu_->threads);
  Archive saved;
  loop_->serialise(saved, *cpu_);
  const std::string bytes = saved.take();
  Archive loaded(bytes);
  copy.loop_->serialise(loaded, *copy.cpu_);
  return copy;
}

OperatorView<double> LawState::view() const {
  return {elements_, area_.data(), start_.data(), hinge_.data(), coefficient_.data()};
}

const double* LawState::checked(const Numbers& curvature) const {
  const bool fits = dimension_ == 1 ? curvature.ndim() == 1 && curvature.shape(0) == elements_
                                    : curvature.ndim() == 2 && curvature.shape(0) == elements_ &&
                                          curvature.shape(1) == dimension_;
  if (fits) return curvature.data();
  const std::string shape = shape_text(curvature), n = std::to_string(elements_);
  throw Error::invalid_input(
      "curvature has shape " + shape + ", must be " +
      (dimension_ == 1 ? "(" + n + ",)" : "(" + n + ", " + std::to_string(dimension_) + ")"))
      .with_key("curvature", shape);
}

py::array_t<double> LawState::make_array(int columns, int of_each) const {
  std::vector<py::ssize_t> shape = {elements_};
  for (int i = 0; i < of_each && columns > 1; ++i) shape.push_back(columns);
  return py::array_t<double>(shape);
}

py::array LawState::step(const Numbers& curvature, double dt, py::object out) {
  const double* k = checked(curvature);
  py::array_t<double> moment = make_array(dimension_);
  if (!out.is_none()) {
    using Doubles = py::array_t<double, py::array::c_style>;
    if (!Doubles::check_(out) || py::reinterpret_borrow<py::array>(out).size() != moment.size())
      throw Error::invalid_input("out must be a C-contiguous array of doubles, as many as curvature has")
          .with_key("out", "");
    moment = py::reinterpret_borrow<py::array_t<double>>(out);
  }
  double* m = moment.mutable_data();
  unlocked([&] { loop_->commit(*cpu_, view(), k, dt, {0, nullptr, nullptr}, m); });
  return moment;
}

py::array LawState::trial(const Numbers& curvature, double dt) const {
  const double* k = checked(curvature);
  py::array_t<double> moment = make_array(dimension_);
  double* m = moment.mutable_data();
  std::vector<double> energy(elements_);
  unlocked([&] { loop_->trial(*cpu_, view(), k, steady_trial(dt), m, energy.data()); });
  return moment;
}

// Rows of lower triangles as whole matrices.
void LawState::tangents(const double* k, double dt, double* to) const {
  const int d = dimension_;
  std::vector<double> lower(static_cast<std::size_t>(elements_) * d * (d + 1) / 2);
  loop_->tangents(*cpu_, view(), k, steady_trial(dt), lower.data());
  const double* row = lower.data();
  for (int i = 0; i < elements_; ++i, to += d * d)
    for (int a = 0; a < d; ++a)
      for (int b = 0; b <= a; ++b) to[a * d + b] = to[b * d + a] = *row++;
}

py::array LawState::tangent(const Numbers& curvature, double dt) const {
  const double* k = checked(curvature);
  py::array_t<double> tangent = make_array(dimension_, 2);
  double* to = tangent.mutable_data();
  unlocked([&] { tangents(k, dt, to); });
  return tangent;
}

py::array LawState::measured(LawMeasure what, const double* curvature, int numbers) const {
  py::array_t<double> values = make_array(numbers);
  double* to = values.mutable_data();
  unlocked([&] { loop_->measure(*cpu_, view(), curvature, what, to); });
  return values;
}

py::array LawState::stored(const Numbers& curvature) const {
  return measured(LawMeasure::stored_energy, checked(curvature), 1);
}

py::array LawState::friction_share(const Numbers& curvature) const {
  return measured(LawMeasure::slip, checked(curvature), 1);
}

py::array LawState::residual() const { return measured(LawMeasure::residual_curvature, nullptr, dimension_); }

py::array LawState::dissipated() const {
  const double* lost = loop_->dissipated();
  return numpy_array(lost ? std::vector<double>(lost, lost + elements_) : std::vector<double>(elements_), 1);
}

namespace {

struct Law {
  LawChoice choice;
  int dimension;

  LawState rest(int elements, int threads) const {
    if (elements < 1)
      throw Error::invalid_input("elements = " + std::to_string(elements) + " must be >= 1")
          .with_key("elements", std::to_string(elements));
    return {choice, dimension, elements, threads};
  }
};

Law make_law(const std::string& name, py::object fabric, int dimension, const py::kwargs& parameters) {
  if (dimension != 1 && dimension != 3)
    throw Error::invalid_input("dimension = " + std::to_string(dimension) + " must be 1 or 3")
        .with_key("dimension", std::to_string(dimension));
  const std::vector<std::string> known = law_parameter_names(name);
  LawParameters texts;
  for (const auto& [key, value] : parameters) {
    const std::string parameter = key_named(py::str(key), known);
    texts[parameter] = to_text(value, parameter);
  }
  return {choose_law(name, fabric_from_python(fabric).virgin_curve(), texts), dimension};
}

py::dict laws() {
  py::dict all;
  for (const LawEntry& law : law_catalogue()) all[py::str(law.name)] = law.description;
  return all;
}

void bind_state(py::module_& module) {
  py::class_<LawState>(module, "LawState",
                       R"(The histories of n elements under one law; made by Law.rest().)")
      .def("__len__", &LawState::elements)
      .def("copy", &LawState::copy, "Elements with the same histories that go on by themselves.")
      .def_property_readonly("history_bytes", &LawState::history_bytes, "Memory of all histories [bytes].");
}

}  // namespace

void bind_law(py::module_& module) {
  bind_state(module);
  py::class_<Law>(module, "Law",
                  R"(A moment-curvature law of a fabric, on many elements at once.

Law("prandtl", fabric, dimension=1, stops=16): fabric is a Fabric, a name or a file; parameters are those of
the program's --param, with underscores for hyphens and dots (fatigue_dc), and its defaults are a cloth's.
dimension: 1 (hinge; arrays of shape (n,)) or 3 (shape; (n, 3), S = (Sxx, Syy, sqrt(2) Sxy)).

    state = law.rest(n)                # virgin elements
    moment = law.step(state, K)        # [N] at curvature K [1/m]; the histories go on

Histories live in the state, so that a law can have many.  All calls release the interpreter's lock.)")
      .def(py::init(&make_law), py::arg("name") = "prandtl", py::arg("fabric") = "cotton-broad",
           py::arg("dimension") = 1)
      .def_property_readonly(
          "name", [](const Law& law) { return law.choice.name; }, "One of laws().")
      .def_readonly("dimension", &Law::dimension, "Components of a curvature: 1 or 3.")
      .def(
          "largest_stiffness", [](const Law& law) { return law.rest(1, 1).largest_stiffness(); },
          "Bound on the eigenvalues of dM/dK [N m].")
      .def("rest", &Law::rest, py::arg("elements"), py::arg("threads") = 1,
           "Virgin elements, flat and without history.  threads: of the loops; 0: all cores.")
      .def(
          "step",
          [](const Law&, LawState& state, const Numbers& k, double dt, py::object out) {
            return state.step(k, dt, out);
          },
          py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0, py::arg("out") = py::none(),
          R"(Takes all elements to their curvature [1/m] in dt [s] and returns their moments [N], of its shape.

The histories go on.  dt matters to laws that creep or relax.  out: where moments are written, instead of a
new array.)")
      .def(
          "trial",
          [](const Law&, const LawState& state, const Numbers& k, double dt) { return state.trial(k, dt); },
          py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0,
          "Moments [N] of a step that is not taken: the histories stay.")
      .def(
          "tangent",
          [](const Law&, const LawState& state, const Numbers& k, double dt) { return state.tangent(k, dt); },
          py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0,
          R"(dM/dK of a step to these curvatures that is not taken [N m], shape (n,) or (n, 3, 3).

As Newton's method uses it: what is negative of it, where a moment falls with curvature, is left out.)")
      .def(
          "stored", [](const Law&, const LawState& state, const Numbers& k) { return state.stored(k); },
          py::arg("state"), py::arg("curvature"),
          "Recoverable energy at these curvatures, those of the last step [J/m^2], shape (n,).")
      .def(
          "dissipated", [](const Law&, const LawState& state) { return state.dissipated(); },
          py::arg("state"), "Lost since rest [J/m^2], shape (n,).")
      .def(
          "residual", [](const Law&, const LawState& state) { return state.residual(); }, py::arg("state"),
          "Curvature that each element keeps when it is let go now [1/m].")
      .def(
          "friction_share",
          [](const Law&, const LawState& state, const Numbers& k) { return state.friction_share(k); },
          py::arg("state"), py::arg("curvature"),
          "How far friction is used at these curvatures, 0 (not) to 1 (slides), shape (n,).");
  module.def("laws", &laws, "What each law is, by its name.");
  module.def("law_parameters", &law_parameter_names, py::arg("law"),
             "Names of the parameters that a law takes.");
}

}  // namespace hysteron::python
