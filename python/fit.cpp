// Identifies a fabric from a measured loop.
#include <pybind11/stl.h>

#include <cmath>
#include <optional>

#include "python/fabric.h"
#include "python/module.h"
#include "sim/base/error.h"
#include "sim/identification/curve.h"
#include "sim/identification/fabric_file.h"
#include "sim/identification/loop_warnings.h"
#include "sim/scene/fabric_reader.h"

namespace hysteron::python {
namespace {

constexpr const char* kFrom = "arrays in Python";

std::vector<double> column(const Numbers& values, const std::string& name, std::size_t rows) {
  if (values.ndim() != 1 || static_cast<std::size_t>(values.size()) != rows)
    throw Error::invalid_input(name + " must have " + std::to_string(rows) + " numbers, as many as curvature")
        .with_key(name, std::to_string(values.size()));
  return {values.data(), values.data() + values.size()};
}

MomentSeries moment_series(const Numbers& curvature, const Numbers& moment,
                           const std::optional<Numbers>& time, double ripple, const std::string& units) {
  if (units != "si" && units != "kes")
    throw Error::invalid_input("units = " + units + " must be si | kes").with_key("units", units);
  MomentSeries series;
  series.name = "the loop";
  const auto rows = static_cast<std::size_t>(curvature.size());
  series.curvature = column(curvature, "curvature", rows);
  series.moment = column(moment, "moment", rows);
  if (units == "kes") {
    constexpr double kPerCentimetre = 100;  // [1/m] in 1/cm
    for (double& k : series.curvature) k *= kPerCentimetre;
    for (double& m : series.moment) m *= kGramForceCentimetrePerCentimetre;
  }
  if (time) {
    series.seconds = column(*time, "time", rows);
    for (std::size_t i = rows; i-- > 1;) series.seconds[i] -= series.seconds[i - 1];
    if (rows > 0) series.seconds[0] = 0;
    for (std::size_t i = 1; i < rows; ++i)
      if (series.seconds[i] < 0)
        throw Error::invalid_input("time must not fall, as it does at row " + std::to_string(i))
            .with_key("time", "");
  }
  prepare(series, ripple);
  return series;
}

Identification fit(const Numbers& curvature, const Numbers& moment, const std::optional<Numbers>& time,
                   const std::string& law, const std::string& units, bool offset, bool curvature_offset,
                   double ripple, const py::kwargs& parameters) {
  const MomentSeries series = moment_series(curvature, moment, time, ripple, units);
  CurveQuestion question;
  question.law.name = law;
  question.offset = offset;
  question.curvature_offset = curvature_offset;
  question.law.parameters = law_parameters(law, parameters);
  Identification found;
  unlocked([&] { found = identify_curve(series, question); });
  warn(loop_warnings(series, {question.law}, curvature_offset));
  warn(misses_warning(found));
  return found;
}

std::optional<double> estimate_error(const Estimate& estimate) {
  if (std::isnan(estimate.standard_error)) return {};
  return estimate.standard_error;
}

// Returns a fabric with the three numbers found; it also needs a density and a thickness.
FabricValue fabric_found(const Identification& found, const std::string& name, double density,
                         double thickness) {
  Fabric fabric = fabric_from_python(py::str("cotton-broad"));
  fabric.name = name;
  fabric.bending = {};
  fabric.published.clear();
  for (auto& [key, from] : fabric.provenance) from.confidence = "assumed";
  const std::pair<const char*, const Estimate&> numbers[] = {
      {"b1", found.b1}, {"b2", found.b2}, {"k0", found.k0}};
  for (const auto& [key, estimate] : numbers)
    fabric.provenance[key] = {estimate.source, estimate.confidence, estimate_error(estimate)};
  fabric.b1 = found.b1.value;
  fabric.b2 = found.b2.value;
  fabric.k0 = found.k0.value;
  for (const char* key : {"density", "thickness"}) fabric.provenance[key] = {kFrom, "given"};
  fabric.density = density;
  fabric.thickness = thickness;
  return FabricValue(fabric);
}

void write(const Identification& found, const std::string& file, const std::string& name, double density,
           double thickness) {
  write_fabric(file, found, {name, kFrom, density, thickness});
}

}  // namespace

void bind_fit(py::module_& module) {
  using I = Identification;
  py::class_<I>(module, "Fit",
                "What fit() has found: three numbers of a fabric, and how well the data fix them.")
      .def_property_readonly(
          "b1", [](const I& f) { return f.b1.value; }, "[N m]")
      .def_property_readonly(
          "b2", [](const I& f) { return f.b2.value; }, "[N m]")
      .def_property_readonly(
          "k0", [](const I& f) { return f.k0.value; }, "[1/m]")
      .def_property_readonly(
          "b1_stderr", [](const I& f) { return estimate_error(f.b1); }, "[N m]; None: not known")
      .def_property_readonly(
          "b2_stderr", [](const I& f) { return estimate_error(f.b2); }, "[N m]; None: not known")
      .def_property_readonly(
          "k0_stderr", [](const I& f) { return estimate_error(f.k0); }, "[1/m]; None: not known")
      .def_readonly("law", &I::law, "That the numbers were identified with.")
      .def_property_readonly("undetermined", &I::undetermined, "Names of what the data cannot fix.")
      .def_readonly("statements", &I::statements, "Sentences on what the data say and do not say.")
      .def_property_readonly(
          "model", [](const I& f) { return numpy_array(f.model, 1); },
          "Moments of the law at the data's curvatures [N], (n,).")
      .def_property_readonly("residual_rms", &I::residual_rms, "[N]")
      .def("fabric", &fabric_found, py::arg("name") = "fitted", py::kw_only(), py::arg("density"),
           py::arg("thickness"),
           R"(The fabric with these numbers, a density [kg/m^2] and a thickness [m].

What else a cloth needs (membrane, damping, friction) is cotton broad's, and marked as assumed.)")
      .def("write", &write, py::arg("file"), py::arg("name") = "fitted", py::kw_only(), py::arg("density"),
           py::arg("thickness"), "Writes it as a fabric file, with sources and standard errors.");
  module.def("fit", &fit, py::arg("curvature"), py::arg("moment"), py::arg("time") = py::none(),
             py::arg("law") = "prandtl", py::arg("units") = "si", py::arg("offset") = false,
             py::arg("curvature_offset") = false, py::arg("ripple") = 0.05,
             R"(A fabric from a measured moment-curvature loop, by least squares of its moments.

curvature [1/m], moment [N], time [s]: arrays of shape (n,) in the order of measurement; units "kes": 1/cm and
gf cm/cm.  Further arguments are the law's parameters.  offset, curvature_offset: the instrument's zero of moment, of
curvature is sought, too.
ripple: curvature that comes back by less than this share of its range is noise.  RequestError for what is no
moment-curvature curve.)");
}

}  // namespace hysteron::python
