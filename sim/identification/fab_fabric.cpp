#include "sim/identification/fab_fabric.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/reference/kes_in_plane.h"
#include "sim/scene/key_table.h"

namespace hysteron {
namespace {

constexpr double kWidestKnown = 10;  // a wider factor is decided by the prior, whose factor is 19

std::string list(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + number_text(value);
  return "[" + text + "]";
}

// Says how well the data determine a stiffness.
std::string verdict(double relative_error, bool determined) {
  if (determined) return "identified";
  const double factor = std::exp(kNormal95 * relative_error);
  return factor > kWidestKnown ? "not determined, the prior's"
                               : fmt::format("not determined, known within a factor of {:.1f}", factor);
}

// Writes the stops with a comment on each: value, standard error, and what decided about it.
std::string stops_table(const std::string& name, const FabStops& found, const char* threshold_unit,
                        const char* unit, const std::string& from) {
  const StopsLaw& law = found.law;
  std::string text;
  for (int j = 0; j < law.stops(); ++j) {
    const double error = found.stiffness_errors[j], stiffness = law.stiffnesses[j];
    text += fmt::format("#   {}{}: {:.3g} +- {:.2g} {}, {}\n", number_text(law.thresholds[j]), threshold_unit,
                        stiffness, error, unit, verdict(error / stiffness, found.determined[j + 1]));
  }
  return text + "[" + name + "]\nthresholds = " + list(law.thresholds) +
         "\nstiffnesses = " + list(law.stiffnesses) + "\nsource = \"" + from +
         "\"\nconfidence = \"fitted\"\n";
}

// Describes the shape: "; friction slips about 18.9/m, ...".
std::string shape_text(const FabBending& b) {
  const FrictionShape shape = friction_shape(b.form);
  return fmt::format(
      ";\n# of friction that slips about {:.3g}/m, known within a factor of {:.2g} (standard error), with a "
      "spread of "
      "{:.3g},\n# within a factor of {:.2g}; thresholds [1/m] and stiffnesses [N m] follow:\n",
      shape.median, std::exp(b.form_errors[1]), shape.spread, std::exp(b.form_errors[2]));
}

std::string saturation_text(const FabBending& b) {
  const double k0 = saturation_curvature(b.form);
  return fmt::format(
      ";\n# of friction that saturates at k0 = {:.3g} +- {:.2g} 1/m (standard error) along the chapter's "
      "parabola;\n# its stops' thresholds [1/m] and stiffnesses [N m] follow:\n",
      k0, b.form_errors[1] * k0);
}

std::string form_text(const FabBending& b) {
  if (b.is_shaped()) return shape_text(b);
  if (b.is_parabola()) return saturation_text(b);
  return "; thresholds [1/m] are a grid that was given, stiffnesses [N m]:\n";
}

std::string bending_tables(const FabIdentification& found) {
  std::string text;
  if (found.bending.size() == 1 && found.bending[0].is_parabola()) return text;  // b1, b2 and k0 say it
  for (std::size_t i = 0; i < std::min<std::size_t>(2, found.bending.size()); ++i) {
    const FabBending& b = found.bending[i];
    text += "\n# Bends along " + b.direction + ", identified from " + found.from + form_text(b) +
            stops_table(i == 0 ? "bending.stops" : "bending.stops.weft", b, "/m", "N m", found.from);
  }
  return text;
}

std::string tension_tables(const FabIdentification& found) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(2, found.tension.size()); ++i) {
    const FabTension& t = found.tension[i];
    text += "\n# Stretch along " + t.direction + ", identified from " + found.from +
            "; thresholds (strain) are a grid that was given, stiffnesses [N/m]:\n" +
            stops_table(i == 0 ? "membrane.stops.warp" : "membrane.stops.weft", t, "", "N/m", found.from);
  }
  return text;
}

Estimate derived(double value, const std::string& source) { return {value, kNone, true, source, "derived"}; }

// Derives b1, b2 and k0 with the same first slope, last slope and friction moment, for laws that know no
// stops.
Identification three_numbers(const FabIdentification& found) {
  Identification numbers;
  const FabBending& b = found.bending[0];
  numbers.law = "stops";
  numbers.b2 = {b.law.spring, b.spring_error, static_cast<bool>(b.determined[0]),
                "elasticity beside the stops, identified from " + found.from};
  if (b.spring_error == 0)  // a free vibration is given its rigidity
    numbers.b2 = {
        b.law.spring, kNone, true,
        "the given B, taken as exact, without what KES-FB2 reads of the stops, which are identified "
        "from " +
            found.from};
  const double b1 = b.law.initial_stiffness();
  numbers.b1 = derived(b1, "b2 and the sum of the stops' stiffnesses");
  numbers.k0 = derived(2 * b.law.friction() / (b1 - b.law.spring),
                       "2 HB/(b1 - b2) of the stops, so that M0 is their friction moment");
  if (found.bending.size() == 1 && b.is_parabola()) {
    numbers.b1 = derived(b1, "b2 + 2 HB/k0, identified from " + found.from);
    const double k0 = saturation_curvature(b.form);
    numbers.k0 = {k0, b.form_errors[1] * k0, is_determined(b.form_errors[1]),
                  "identified from " + found.from};
  }
  for (const FabBending& one : found.bending) {
    std::vector<std::string> open = one.undetermined();
    numbers.statements.push_back(
        "along " + one.direction +
        (open.empty() ? ": all stops are determined" : ": not determined: " + join(open, ", ")) +
        fmt::format(" (HB = {:.3g} +- {:.2g} N, rms {:.2g} of the noise)", one.law.friction(),
                    one.friction_error, one.residual_rms));
  }
  return numbers;
}

// Writes further entries of [parameters], behind those of write_fabric().
std::string further_parameters(const FabIdentification& found) {
  std::string text;
  if (found.bending.size() > 1) {
    const double ratio = found.bending[1].law.spring / found.bending[0].law.spring;
    const Estimate bias = found.bending.size() > 2
                              ? derived(found.bending[2].law.spring / found.bending[0].law.spring,
                                        "b2 along the bias over that along the first direction")
                              : derived((1 + ratio) / 2, "the mean of both directions, not measured");
    text += fabric_entry("weft-bending", "", derived(ratio, "b2 along the second direction over the first")) +
            fabric_entry("bias-bending", "", bias);
  }
  const char* const kNames[] = {"warp", "weft"};
  for (std::size_t i = 0; i < std::min<std::size_t>(2, found.tension.size()); ++i)
    text += fabric_entry(kNames[i], "N/m",
                         {found.tension[i].law.spring, kNone, true,
                          "stretch beside its stops, identified from " + found.from});
  return text;
}

// Returns the parabola of b1, b2 and k0 as stops.
StopsLaw of_three_numbers(const VirginCurve& curve) {
  if (!(curve.b1 > curve.b2)) return {curve.b2, {}, {}};
  const Spectrum stops = parabola_stops(curve.b1 - curve.b2, curve.k0);
  return {curve.b2, stops.thresholds, stops.stiffnesses};
}

// Returns M = sqrt(q) M_law(sqrt(q) K), by the metric with which cloth bends along weft and bias.
StopsLaw scaled(StopsLaw law, double q) {
  law.spring *= q;
  for (double& threshold : law.thresholds) threshold /= std::sqrt(q);
  for (double& stiffness : law.stiffnesses) stiffness *= q;
  return law;
}

// Returns the mean of both responses, half of each side by side.
StopsLaw mean_law(const StopsLaw& a, const StopsLaw& b) {
  StopsLaw law{(a.spring + b.spring) / 2, {}, {}};
  for (const StopsLaw* of : {&a, &b}) {
    law.thresholds.insert(law.thresholds.end(), of->thresholds.begin(), of->thresholds.end());
    for (const double stiffness : of->stiffnesses) law.stiffnesses.push_back(stiffness / 2);
  }
  return law;
}

// Returns the law of a cylinder bent along the bias under stops along warp and along weft, over the fabric's
// rigidity there: that of SpectrumStops::turn() for a hinge across it.  `curve` is the fabric's as laws see
// it, behind the metric, in which the tensor of that bend has the squares 1, weft and the rest of 4 bias.
StopsLaw turned_to_bias(const VirginCurve& curve, double weft_bending, double bias_bending) {
  const double warp = 1 / (4 * bias_bending), weft = weft_bending / (4 * bias_bending),
               twist = 1 - warp - weft;
  const Spectrum &first = curve.parts.stops, &second = curve.parts.weft_stops;
  StopsLaw law{curve.b2, {}, {}};
  for (std::size_t j = 0; j < first.size(); ++j) {
    const double p = first.stiffnesses[j], q = second.stiffnesses[j];
    const double slides = p * first.thresholds[j], other_slides = q * second.thresholds[j];
    const double stiffness = warp * p + weft * q + twist * std::sqrt(p * q);
    const double moment = std::sqrt(warp * slides * slides + weft * other_slides * other_slides +
                                    twist * slides * other_slides);
    law.stiffnesses.push_back(stiffness);
    law.thresholds.push_back(stiffness > 0 ? moment / stiffness : first.thresholds[j]);
  }
  return law;
}

// Returns the law of stretch along the bias at the width that the clamps hold: E along it is E/2 along warp
// and weft and a shear 2 E12 = E, and its force per width takes half, half, and all of their stresses.
StopsLaw bias_stretch(const Fabric& fabric) {
  const InPlaneStops& stops = fabric.in_plane;
  StopsLaw law = in_plane_law(fabric, Along::warp).shear;
  law.spring += (fabric.warp + fabric.weft + 2 * fabric.coupling) / 4;
  const bool grows = !law.growths.empty();
  for (const Spectrum* of : {&stops.warp, &stops.weft})
    for (std::size_t j = 0; j < of->size(); ++j) {
      if (grows) law.growths.push_back(0);
      law.thresholds.push_back(2 * of->thresholds[j]);
      law.stiffnesses.push_back(of->stiffnesses[j] / 4);
    }
  return law;
}

// Returns the fabric with the mean of both faces: a buckled strip between clamps bends to both sides at once,
// to one in its middle and to the other beside the clamps, so that turned over it is as stiff.
Fabric with_mean_of_faces(Fabric fabric) {
  const VirginCurve mean = mean_of_faces({fabric.b1, fabric.b2, fabric.k0, fabric.bending});
  fabric.b1 = mean.b1;
  fabric.b2 = mean.b2;
  fabric.bending = mean.parts;
  return fabric;
}

}  // namespace

void write_fab_fabric(const std::filesystem::path& file, const FabIdentification& found,
                      const FabricNotes& notes) {
  write_fabric_text(file, fabric_text(three_numbers(found), notes) + further_parameters(found) +
                              bending_tables(found) + tension_tables(found));
}

StripDirection strip_direction(const std::string& name) {
  if (name == "L" || name == "warp") return StripDirection::warp;
  if (name == "W" || name == "weft") return StripDirection::weft;
  if (name == "B" || name == "bias") return StripDirection::bias;
  throw Error::invalid_input("direction = " + name + " must be L (warp) | W (weft) | B (bias)")
      .with_key("fab.direction", name);
}

FabStrip FabFabric::strip(const std::string& direction) const {
  switch (strip_direction(direction)) {
    case StripDirection::warp:
      return {warp, warp_tension, density};
    case StripDirection::weft:
      return {weft, weft_tension, density};
    case StripDirection::bias:
      break;
  }
  return {bias ? *bias : mean_law(warp, weft),
          bias_tension ? *bias_tension : mean_law(warp_tension, weft_tension), density};
}

FabFabric fab_fabric(const Fabric& of) {
  const Fabric fabric = with_mean_of_faces(of);
  const Spectrum &stops = fabric.bending.stops, &weft = fabric.bending.weft_stops;
  FabFabric result;
  result.name = fabric.name;
  result.density = fabric.density;
  result.warp = stops.empty() ? of_three_numbers(fabric.virgin_curve())
                              : StopsLaw{fabric.b2, stops.thresholds, stops.stiffnesses};
  if (weft.empty()) {
    result.weft = scaled(result.warp, fabric.friction_ratios().weft);
    result.weft.spring = fabric.weft_bending * fabric.b2;
    result.bias = scaled(result.warp, fabric.friction_ratios().bias);
    result.bias->spring = fabric.bias_bending * fabric.b2;
  } else {
    result.weft = {fabric.weft_bending * fabric.b2, weft.thresholds, weft.stiffnesses};
    result.bias = scaled(turned_to_bias(fabric.virgin_curve(), fabric.weft_bending, fabric.bias_bending),
                         fabric.bias_bending);
  }
  result.warp_tension = in_plane_law(fabric, Along::warp).tension;
  result.weft_tension = in_plane_law(fabric, Along::weft).tension;
  result.bias_tension = bias_stretch(fabric);
  return result;
}

}  // namespace hysteron
