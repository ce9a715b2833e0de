#include "python/simulation.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdio>

#include "python/module.h"
#include "sim/base/error.h"
#include "sim/bending/laws/unused_parameters.h"
#include "sim/scene/body.h"
#include "sim/scene/scene_reader.h"

namespace hysteron::python {

SimulationValue::SimulationValue(const Scene& scene) : scene_(scene) {
  check_scene(scene_);
  check_duration(scene_);
  unlocked([&] {
    load_bodies(scene_);
    cloth_ = make_cloth(scene_);
    simulation_ = make_simulation(scene_, cloth_);
  });
  warn(cloth_.warnings);
  warn(body_warnings(scene_));
  warn(unused_parameter_warnings(scene_.law, scene_.fabric.virgin_curve(), scene_.param, LawUse::cloth,
                                 scene_.fabric.name));
}

Simulation& SimulationValue::at_rest() const {
  if (in_use_) throw Error::invalid_input("the simulation is stepping on another thread");
  return *simulation_;
}

void SimulationValue::advance(int steps) {
  if (steps < 0) {
    const std::string text = std::to_string(steps);
    throw Error::invalid_input("steps = " + text + " must be >= 0").with_key("steps", text);
  }
  for (int s = 0; s < steps; ++s) {
    alone([](Simulation& simulation) { simulation.advance(1); });
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

namespace {

using S = SimulationValue;
using Vectors = std::vector<Eigen::Vector3d>;

// Returns a view of the state, or a copy of it from a GPU.
py::array in_place(py::handle self, Simulation::InPlace (Simulation::*place)() const,
                   Vectors (Simulation::*copy)()) {
  const S& value = self.cast<const S&>();
  Simulation& simulation = value.at_rest();
  const Simulation::InPlace at = (simulation.*place)();
  const std::vector<py::ssize_t> shape = {value.cloth().mesh.vertices(), 3};
  if (at.fp64) return array_view(at.fp64, shape, self);
  if (at.fp32) return array_view(at.fp32, shape, self);
  return numpy_array((simulation.*copy)());
}

py::array_t<int> triangles(const S& self) {
  const auto& face = self.cloth().mesh.face;
  py::array_t<int> result({static_cast<py::ssize_t>(face.size()), py::ssize_t(3)});
  int* to = result.mutable_data();
  for (const Eigen::Vector3i& f : face) to = std::copy(f.data(), f.data() + 3, to);
  return result;
}

// Returns a dict in the order of the rows.
template <class Rows>
py::dict dict_of(const Rows& rows) {
  py::dict result;
  for (const auto& [name, number] : rows) result[py::str(name)] = number;
  return result;
}

std::string state_hash(const S& self) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(self.at_rest().state_hash()));
  return text;
}

// Returns a measure of the elements, with as many numbers each as their curvature.
py::array of_elements(const S& self, std::vector<double> (Simulation::*measured)()) {
  Simulation& simulation = self.at_rest();
  return numpy_array((simulation.*measured)(), simulation.dimension());
}

py::tuple pin_displacement(const S& self, int pin) {
  const Keyframe at = self.at_rest().pin_displacement(pin);
  return py::make_tuple(numpy_array({at.position.x(), at.position.y(), at.position.z()}, 1), at.angle);
}

void drive(const S& self, int pin, const Numbers& velocity, double spin) {
  if (velocity.size() != 3)
    throw Error::invalid_input("velocity must have three components [m/s]").with_key("velocity", "");
  self.at_rest().drive(pin, Eigen::Map<const Eigen::Vector3d>(velocity.data()), spin);
}

// Returns the vertices that the pin holds, or held.
std::vector<int> pin_vertices(const S& self, int pin) {
  self.at_rest().pin_displacement(pin);  // throws for a missing pin
  return self.cloth().pin_vertices[pin];
}

void bind_state(py::class_<S>& simulation) {
  simulation
      .def_property_readonly(
          "positions",
          [](py::object self) {
            return in_place(self, &Simulation::positions_in_place, &Simulation::positions);
          },
          R"(Positions of the vertices [m], shape (n, 3).

On the CPU a view of the simulation's memory, not writeable and not copied, in its precision: it shows the
state until the next step; take it anew then, or copy it.  The memory lives as long as the array.
Of cloth that starts far from the origin, which is simulated relative to its start, a copy in doubles.)")
      .def_property_readonly(
          "velocities",
          [](py::object self) {
            return in_place(self, &Simulation::velocities_in_place, &Simulation::velocities);
          },
          "Velocities of the vertices [m/s], shape (n, 3); a view as `positions`.")
      .def_property_readonly(
          "curvature", [](const S& self) { return of_elements(self, &Simulation::curvature); },
          "Curvature of the elements [1/m], (hinges,) or (faces, 3): (Sxx, Syy, sqrt(2) Sxy) along warp, "
          "weft.")
      .def_property_readonly(
          "moment", [](const S& self) { return of_elements(self, &Simulation::moment); },
          "Moment of the elements [N], viscosity included, as `curvature`.")
      .def_property_readonly(
          "residual_curvature",
          [](const S& self) { return of_elements(self, &Simulation::residual_curvature); },
          "Curvature that each element would keep if it were let go now [1/m].")
      .def_property_readonly(
          "friction_share", [](const S& self) { return numpy_array(self.at_rest().friction_share(), 1); },
          "Friction moment of the elements over M0, 0 to 1.")
      .def_property_readonly(
          "handle_forces", [](const S& self) { return numpy_array(self.at_rest().pin_forces()); },
          "Forces of the pins on the vertices at the end of the last step [N], (n, 3); implicit "
          "integrators.")
      .def_property_readonly(
          "ledger", [](const S& self) { return dict_of(self.at_rest().ledger().rows()); },
          "Where the energy went since the start [J], by term.")
      .def_property_readonly("state_hash", &state_hash,
                             "Of positions and velocities, bit for bit, as manifests have it.")
      .def_property_readonly(
          "largest_stretch", [](const S& self) { return self.at_rest().largest_stretch(); },
          "Largest principal stretch, less 1.");
}

void bind_cloth(py::class_<S>& simulation) {
  simulation
      .def_property_readonly(
          "scene", [](const S& self) { return self.scene(); }, "A copy of the scene.")
      .def_property_readonly(
          "rest_positions", [](const S& self) { return numpy_array(self.cloth().mesh.rest); },
          "Vertices of the rest shape [m], (n, 3).")
      .def_property_readonly("triangles", &triangles,
                             "Corners of the triangles, counter-clockwise from the front, (m, 3).")
      .def("pin_vertices", &pin_vertices, py::arg("pin"), "Vertices of that pin of the scene.")
      .def_property_readonly(
          "dimension", [](const S& self) { return self.at_rest().dimension(); },
          "1: elements are hinges; 3: faces.")
      .def_property_readonly(
          "device", [](const S& self) { return self.at_rest().device(); }, "\"cpu: ...\" or \"cuda: ...\".")
      .def_property_readonly(
          "time", [](const S& self) { return self.at_rest().time(); }, "[s]")
      .def_property_readonly(
          "steps", [](const S& self) { return self.at_rest().steps(); }, "Taken since the start.")
      .def_property_readonly(
          "step_seconds", [](const S& self) { return self.scene().step; }, "Length of a step [s].")
      .def_property_readonly(
          "stage_seconds", [](const S& self) { return dict_of(self.at_rest().stage_seconds()); },
          "Wall time of each stage of the steps [s].");
}

void bind_control(py::class_<S>& simulation) {
  simulation
      .def("advance", &S::advance, py::arg("steps") = 1,
           R"(Takes that many steps.  Other threads run meanwhile; Ctrl-C raises between two steps.

RunError where the state is no longer finite, no equilibrium is found, or an obstacle crushes the cloth.)")
      .def("drive", &drive, py::arg("pin"), py::arg("velocity"), py::arg("spin") = 0.0,
           R"(From now on that pin goes on from where it is, whatever its motion was.

velocity [m/s]: three components; spin: about the pin's axis and centre [degree/s].  It keeps both until it is
driven again: a loop that controls a pin drives it before every step.)")
      .def("hand", &pin_displacement, py::arg("pin"),
           "How far that pin has come from its start: displacement [m] and angle [degree].")
      .def(
          "become_static", [](const S& self) { self.at_rest().become_static(); },
          "From now on steps look for equilibrium, without inertia; implicit integrators.")
      .def(
          "save", [](const S& self) { return py::bytes(self.at_rest().save()); },
          "All that outlives a step, for load() of a simulation of the same scene.")
      .def(
          "load", [](const S& self, const std::string& state) { self.at_rest().load(state); },
          py::arg("state"), "Goes on from what save() gave, to the same bits on the same device.");
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<S> simulation(module, "Simulation", R"(A scene that runs, step by step.

    sim = Simulation(scene)
    while sim.time < 2:
        sim.advance()
        height = sim.positions[:, 2].min()

The bits are those of the program on the same scene and device.)");
  simulation.def(py::init<const Scene&>(), py::arg("scene"));
  bind_control(simulation);
  bind_state(simulation);
  bind_cloth(simulation);
  module.def("devices", &device_list, "Usable devices: the CPU, then the GPUs, or why there are none.");
}

}  // namespace hysteron::python
