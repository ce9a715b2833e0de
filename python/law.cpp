// Evaluates a moment-curvature law on many elements at once by the loop that cloths run, on the CPU.
#include <pybind11/stl.h>

#include <memory>

#include "python/fabric.h"
#include "python/module.h"
#include "sim/base/archive.h"
#include "sim/base/error.h"
#include "sim/bending/law_loop.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/device/device.h"

namespace hysteron::python {
namespace {

using Loop = LawLoop<double, Cpu>;

struct Law {
  LawParams choice;
  int dimension;
};

// The elements of one law with their histories.
struct LawState {
  LawState(const Law& of, int count, int threads)
      : law(of),
        elements(count),
        cpu(std::make_unique<Cpu>(threads)),
        loop(make_law_loop<double>(*cpu, of.choice, of.dimension, count)),
        area(count, 1),
        coefficient(static_cast<std::size_t>(count) * of.dimension * of.dimension),
        start(count + 1),
        hinge(static_cast<std::size_t>(count) * of.dimension) {
    const int d = of.dimension;
    for (int i = 0; i <= count; ++i) start[i] = i * d;
    for (int h = 0; h < count * d; ++h) {
      hinge[h] = h;
      coefficient[static_cast<std::size_t>(h) * d + h % d] = 1;
    }
  }

  OperatorView<double> view() const {
    return {elements, area.data(), start.data(), hinge.data(), coefficient.data()};
  }

  Law law;
  int elements;
  std::unique_ptr<Cpu> cpu;
  std::unique_ptr<Loop> loop;
  // These are the identity operator of curvatures: an element of unit area for each, with hinges of its own.
  std::vector<double> area, coefficient;
  std::vector<int> start, hinge;
};

LawState at_rest(const Law& law, int elements, int threads) {
  if (elements < 1)
    throw Error::invalid_input("elements = " + std::to_string(elements) + " must be >= 1")
        .with_key("elements", std::to_string(elements));
  return {law, elements, threads};
}

LawState copied(const LawState& state) {
  LawState copy(state.law, state.elements, state.cpu->threads);
  Archive saved;
  state.loop->serialise(saved, *state.cpu);
  const std::string bytes = saved.take();
  Archive loaded(bytes);
  copy.loop->serialise(loaded, *copy.cpu);
  return copy;
}

// Returns the curvature's data, `dimension` numbers an element [1/m], row by row; results have the same
// shape.  The functions below are called with the interpreter's lock held.
const double* checked(const LawState& state, const Numbers& curvature) {
  const int d = state.law.dimension;
  const bool fits =
      d == 1 ? curvature.ndim() == 1 && curvature.shape(0) == state.elements
             : curvature.ndim() == 2 && curvature.shape(0) == state.elements && curvature.shape(1) == d;
  if (fits) return curvature.data();
  const std::string shape = py::str(curvature.attr("shape")), n = std::to_string(state.elements);
  throw Error::invalid_input("curvature has shape " + shape + ", must be " +
                             (d == 1 ? "(" + n + ",)" : "(" + n + ", " + std::to_string(d) + ")"))
      .with_key("curvature", shape);
}

py::array_t<double> make_array(const LawState& state, int columns, int of_each = 1) {
  std::vector<py::ssize_t> shape = {state.elements};
  for (int i = 0; i < of_each && columns > 1; ++i) shape.push_back(columns);
  return py::array_t<double>(shape);
}

// Returns a trial that builds up no rate.
Loop::Trial steady_trial(double dt) { return {dt, dt, 0, nullptr}; }

py::array step(const Law&, LawState& state, const Numbers& curvature, double dt, py::object out) {
  const double* k = checked(state, curvature);
  py::array_t<double> moment = make_array(state, state.law.dimension);
  if (!out.is_none()) {
    using Doubles = py::array_t<double, py::array::c_style>;
    if (!Doubles::check_(out) || py::reinterpret_borrow<py::array>(out).size() != moment.size())
      throw Error::invalid_input("out must be a C-contiguous array of doubles, as many as curvature has")
          .with_key("out", "");
    moment = py::reinterpret_borrow<py::array_t<double>>(out);
  }
  double* m = moment.mutable_data();
  unlocked([&] { state.loop->commit(*state.cpu, state.view(), k, dt, {0, nullptr, nullptr}, m); });
  return moment;
}

py::array trial(const Law&, const LawState& state, const Numbers& curvature, double dt) {
  const double* k = checked(state, curvature);
  py::array_t<double> moment = make_array(state, state.law.dimension);
  double* m = moment.mutable_data();
  std::vector<double> energy(state.elements);
  unlocked([&] { state.loop->trial(*state.cpu, state.view(), k, steady_trial(dt), m, energy.data()); });
  return moment;
}

// Returns whole matrices from rows of lower triangles.
py::array tangent(const Law&, const LawState& state, const Numbers& curvature, double dt) {
  const int d = state.law.dimension;
  const double* k = checked(state, curvature);
  py::array_t<double> tangent = make_array(state, d, 2);
  double* to = tangent.mutable_data();
  unlocked([&] {
    std::vector<double> lower(static_cast<std::size_t>(state.elements) * d * (d + 1) / 2);
    state.loop->tangents(*state.cpu, state.view(), k, steady_trial(dt), lower.data());
    const double* row = lower.data();
    for (int i = 0; i < state.elements; ++i, to += d * d)
      for (int a = 0; a < d; ++a)
        for (int b = 0; b <= a; ++b) to[a * d + b] = to[b * d + a] = *row++;
  });
  return tangent;
}

py::array measured(const LawState& state, LawMeasure what, const double* curvature, int numbers) {
  py::array_t<double> values = make_array(state, numbers);
  double* to = values.mutable_data();
  unlocked([&] { state.loop->measure(*state.cpu, state.view(), curvature, what, to); });
  return values;
}

py::array stored(const Law&, const LawState& state, const Numbers& curvature) {
  return measured(state, LawMeasure::stored_energy, checked(state, curvature), 1);
}

py::array friction_share(const Law&, const LawState& state, const Numbers& curvature) {
  return measured(state, LawMeasure::slip, checked(state, curvature), 1);
}

py::array residual(const Law&, const LawState& state) {
  return measured(state, LawMeasure::residual_curvature, nullptr, state.law.dimension);
}

py::array dissipated(const Law&, const LawState& state) {
  const double* lost = state.loop->dissipated();
  const auto n = static_cast<std::size_t>(state.elements);
  return numpy_array(lost ? std::vector<double>(lost, lost + n) : std::vector<double>(n), 1);
}

Law make_law(const std::string& name, py::object fabric, int dimension, const py::kwargs& parameters) {
  if (dimension != 1 && dimension != 3)
    throw Error::invalid_input("dimension = " + std::to_string(dimension) + " must be 1 or 3")
        .with_key("dimension", std::to_string(dimension));
  const LawParameters texts = law_parameters(name, parameters);
  const Fabric of = fabric_from_python(fabric);
  const LawParams choice = choose_law(name, of.virgin_curve(), texts);
  warn(unused_parameter_warnings(name, of.virgin_curve(), texts, LawUse::cloth, of.name));
  return {choice, dimension};
}

py::dict laws() {
  py::dict all;
  for (const LawEntry& law : law_catalogue()) all[py::str(law.name)] = law.description;
  return all;
}

void bind_state(py::module_& module) {
  py::class_<LawState>(module, "LawState",
                       R"(The histories of n elements under one law; made by Law.rest().)")
      .def("__len__", [](const LawState& state) { return state.elements; })
      .def("copy", &copied, "Elements with the same histories that go on by themselves.")
      .def_property_readonly(
          "history_bytes", [](const LawState& state) { return state.loop->history_bytes(); },
          "Memory of all histories [bytes].");
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
          "largest_stiffness", [](const Law& law) { return at_rest(law, 1, 1).loop->largest_stiffness(); },
          "Bound on the eigenvalues of dM/dK [N m].")
      .def("rest", &at_rest, py::arg("elements"), py::arg("threads") = 1,
           "Virgin elements, flat and without history.  threads: of the loops; 0: all cores.")
      .def(
          "step", &step, py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0,
          py::arg("out") = py::none(),
          R"(Takes all elements to their curvature [1/m] in dt [s] and returns their moments [N], of its shape.

The histories go on.  dt matters to laws that creep or relax.  out: where moments are written, instead of a
new array.)")
      .def("trial", &trial, py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0,
           "Moments [N] of a step that is not taken: the histories stay.")
      .def("tangent", &tangent, py::arg("state"), py::arg("curvature"), py::arg("dt") = 1.0,
           R"(dM/dK of a step to these curvatures that is not taken [N m], shape (n,) or (n, 3, 3).

As Newton's method uses it: what is negative of it, where a moment falls with curvature, is left out.)")
      .def("stored", &stored, py::arg("state"), py::arg("curvature"),
           "Recoverable energy at these curvatures, those of the last step [J/m^2], shape (n,).")
      .def("dissipated", &dissipated, py::arg("state"), "Lost since rest [J/m^2], shape (n,).")
      .def("residual", &residual, py::arg("state"),
           "Curvature that each element keeps when it is let go now [1/m].")
      .def("friction_share", &friction_share, py::arg("state"), py::arg("curvature"),
           "How far friction is used at these curvatures, 0 (not) to 1 (slides), shape (n,).");
  module.def("laws", &laws, "What each law is, by its name.");
  module.def("law_parameters", &law_parameter_names, py::arg("law"),
             "Names of the parameters that a law takes.");
}

}  // namespace hysteron::python
