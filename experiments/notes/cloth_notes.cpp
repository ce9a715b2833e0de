// Notes on runs that simulate a cloth.
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/notes/notes.h"
#include "experiments/workbench/app/law_family.h"
#include "experiments/workbench/pages/error_notes.h"
#include "experiments/workbench/pages/manifest.h"
#include "sim/base/number_in.h"
#include "sim/bending/laws/law_parameters.h"

namespace hysteron::experiments {
namespace {

std::string rest_note(const Manifest& manifest, const std::string& number) {
  if (!manifest.metrics["settled"].is(false)) return "";
  return fmt::format(
      "the cloth is still moving, so that its {} is no result: --seconds {:.2g} gives it more time", number,
      2 * manifest.seconds_simulated.value_or(1));
}

// The numbers come from recorded studies of the same four fabrics: specimen-uneven (0) and drapes-jis
// (docs/validation.md).
std::string drape_mesh_note(const Manifest& manifest) {
  const std::string metric = "drape_coefficient_percent";
  if (!has_number(manifest, metric) || manifest.metrics.contains(metric + kMeshError))
    return errors_note(manifest, metric, "drape coefficient");
  constexpr std::int64_t kCoarse = 6000;
  const std::int64_t triangles = manifest.triangles.value_or(kCoarse);
  const std::string few =
      triangles < kCoarse ? number_text(triangles, kCount) + " triangles are few, and " : "";
  return few +
         "drapes of 6,000 and of 24,000 triangles differ by 2 to 5 points: --errors measures how far the "
         "mesh "
         "moves this one";
}

std::string tester_note(const Manifest& manifest) {
  const double disc = option_number(manifest, "drape.disc"), radius = manifest.number("cloth.radius");
  const std::string tester =
      fmt::format("a disc of {:.0f} mm on a pedestal of {:.0f} mm", 2e3 * radius, 2e3 * disc);
  const double measured = manifest.metrics.number("published_drape_coefficient_percent");
  const double difference = manifest.metrics.number("drape_coefficient_percent") - measured;
  if (std::isfinite(difference))
    return fmt::format(
        "a laboratory's tester read {:.1f} %, {:.1f} points {}: `hysteron validate --parts spread` says "
        "whether the numbers of {} that are uncertain explain it",
        measured, std::abs(difference), difference > 0 ? "less" : "more", manifest.text("fabric.name"));
  const MetricValue& other = manifest.metrics["published_drape"];
  const std::string said = other.is_text() ? other.text() : "";
  const std::size_t flag = said.find("--");
  const std::string published =
      flag == said.npos ? "" : ": the published one is read with " + said.substr(flag);
  return "a coefficient holds for its tester alone, here " + tester + published;
}

std::string assumed_note(const Manifest& manifest) {
  // The keys are in the order in which they move the drapes of the shipped fabrics (validate --parts budget).
  const std::vector<std::string> assumed =
      assumed_of(manifest, {"bias-bending", "shear", "weft-bending", "k0"});
  if (assumed.empty()) return "";
  const std::string fabric = manifest.text("fabric.name");
  bool is_validated = false;
  for (const SourcedNumber& number : manifest.published_numbers())
    is_validated = is_validated || number.name == "drape-coefficient";
  const std::string next =
      is_validated
          ? "`hysteron validate --parts budget --fabrics " + fabric + "` says what each moves"
          : "drapes at both ends of what they may be (--fabric." + assumed.front() + ") say what they move";
  return enumerated(assumed) + (assumed.size() > 1 ? " are" : " is") + " assumed, not measured: " + next;
}

std::string set_note(const Manifest& manifest, const std::string& kept) {
  if (!has_friction_alone(manifest)) return "";
  return kept +
         " by friction alone: real cloth also sets and relaxes, for which this fabric has no numbers "
         "([bending.set], [bending.branches])";
}

// Explains what the shape of a decay says about friction.
std::string decay_note(const Manifest& manifest, const std::string& shape) {
  if (shape == "saturating") {
    const double knee = manifest.metrics.number("decay_knee_fraction");
    return fmt::format(
        "above {:.0f} % of the first amplitude friction has saturated and every half period loses the "
        "same, below it ever less",
        100 * knee);
  }
  if (shape == "linear")
    return "amplitudes fall along a line: friction has saturated, every half period loses the same";
  if (shape == "two-step")
    return fmt::format(
        "amplitudes fall along a line while friction slips; from {:.0f} % of the first one on the strip "
        "rings with what no longer slips",
        100 * manifest.metrics.number("decay_step_fraction"));
  if (shape == "hyperbolic")
    return "amplitudes fall along a hyperbola: friction has not saturated anywhere in this swing";
  if (shape == "exponential") return "amplitudes fall exponentially: viscosity takes them, not friction";
  if (shape == "plateau") return "amplitudes stay: below the least that slips friction takes nothing";
  return "";
}

}  // namespace

Notes drape_notes(const Manifest& manifest) {
  const std::string moving = rest_note(manifest, "coefficient");
  if (!moving.empty()) return {moving};
  return {drape_mesh_note(manifest), tester_note(manifest), assumed_note(manifest)};
}

Notes swing_notes(const Manifest& manifest) {
  const MetricValue& decay = manifest.metrics["decay_shape"];
  if (!decay.is_text()) return {};
  if (decay.text() == "unknown")
    return {fmt::format("too little was seen, {}, to tell how the swing dies: --seconds {:.2g} shows more",
                        counted(static_cast<std::size_t>(manifest.metrics.number("turns")), "turn"),
                        10 * manifest.seconds_simulated.value_or(1))};
  std::string k0;
  if (decay.text() != "exponential" && !assumed_of(manifest, {"k0"}).empty())
    k0 = fmt::format(
        "where friction saturates, k0 = {:g}/m, is assumed: `hysteron fit --decay` finds it from a swing "
        "that was measured",
        manifest.number("fabric.k0"));
  const char* const metric = "decay_per_half_period_percent_at_50";
  return {decay_note(manifest, decay.text()), k0,
          errors_note(manifest, metric, "loss at half of the amplitude")};
}

Notes crease_notes(const Manifest& manifest) {
  return {errors_note(manifest, "recovery_angle_deg", "recovery angle"),
          set_note(manifest, "the crease is kept")};
}

Notes fold_notes(const Manifest& manifest) {
  std::string fatigue;
  if (has_number(manifest, "recovery_angle_deg"))
    fatigue = option_number(manifest, "fold.fatigue") > 0
                  ? fmt::format(
                        "how fast folds weaken friction, --fold.fatigue {:g} J/m2, is assumed: read how the "
                        "numbers change, not after how many folds",
                        option_number(manifest, "fold.fatigue"))
                  : "without fatigue every fold is like the one before: --fold.fatigue weakens friction";
  return {fatigue, errors_note(manifest, "recovery_angle_deg", "recovery angle")};
}

Notes crumple_notes(const Manifest& manifest) {
  std::string crossing;
  if (has_number(manifest, "intersections") && manifest.metrics.number("intersections") > 0)
    crossing = fmt::format(
        "{:.0f} pairs of triangles cross, so that this is no cloth any more: a smaller --step keeps "
        "them apart",
        manifest.metrics.number("intersections"));
  return {crossing, errors_note(manifest, "residual_curvature_rms_per_m", "residual curvature"),
          set_note(manifest, "wrinkles are kept")};
}

// Returns a list of numbers of the scene, or nothing if there is none at this path.
std::vector<double> numbers_at(const Manifest& manifest, const std::string& path) {
  const Json list = Json::parse(manifest.text(path), nullptr, false);
  std::vector<double> numbers;
  if (list.is_array())
    for (const Json& entry : list) numbers.push_back(entry.is_number() ? entry.get<double>() : NAN);
  return numbers;
}

// Returns gravity [m/s^2] across a level strip, as in the standard; 0 if it is not level.
double level_gravity(const Manifest& manifest) {
  const std::vector<double> gravity = numbers_at(manifest, "gravity"),
                            rotation = numbers_at(manifest, "cloth.rotation");
  if (gravity.size() != 3 || gravity[0] != 0 || gravity[1] != 0) return 0;
  if (rotation.size() == 3 && (rotation[0] != 0 || rotation[1] != 0)) return 0;
  return std::abs(gravity[2]);
}

// Returns the rigidity [N m] that KES-FB2 reads along the strip as it sags: towards its back, or of both
// sides for laws with the mean; 0 if the strip lies along neither warp nor weft.
double sagging_rigidity(const Manifest& manifest) {
  const double warp_angle = std::abs(manifest.number("cloth.warp-angle")),
               weft = manifest.number("fabric.weft-bending"), back = manifest.number("fabric.back-bending");
  if (warp_angle != 0 && warp_angle != 90) return 0;
  const double b = manifest.number("fabric.b2") * (warp_angle == 90 && weft > 0 ? weft : 1);
  if (!(back > 0)) return b;
  return has_faces(manifest.law.value_or("")) ? back * b : (1 + back) / 2 * b;
}

Notes cantilever_notes(const Manifest& manifest) {
  std::string elastica, rigidity;
  const double error = manifest.metrics.number("error_percent");
  if (std::isfinite(error))
    elastica = fmt::format("the strip sags {:.2g} % {} than a curve with the same law does: mesh and step",
                           std::abs(error), error < 0 ? "less" : "more");
  const double length = manifest.metrics.number("bending_length_m"), b = sagging_rigidity(manifest),
               gravity = level_gravity(manifest);
  if (std::isfinite(length) && b > 0 && gravity > 0 &&
      family_of_law(manifest.law.value_or("")) == "hysteretic")
    rigidity = fmt::format(
        "ASTM D1388 reads a rigidity of {:.1f} uN m from this bending length, KES-FB2 reads {:.1f}: "
        "friction holds the strip up as well",
        1e6 * std::pow(length, 3) * manifest.number("fabric.density") * gravity, 1e6 * b);
  return {rigidity, elastica, errors_note(manifest, "tip_drop_over_length", "sag")};
}

Notes buckle_notes(const Manifest& manifest) {
  const double error = manifest.metrics.number("error_percent");
  if (!std::isfinite(error)) return {};
  return {fmt::format("the strip buckles at a weight {:.2g} % {} than theory's: the mesh's share",
                      std::abs(error), error < 0 ? "less" : "more"),
          errors_note(manifest, "critical_gamma", "critical gamma")};
}

Notes scene_notes(const Manifest& manifest) {
  if (manifest.requested_metrics.empty())
    return {rest_note(manifest, "shape"),
            "the scene asks for no number: a table [[metric]] names one to be measured"};
  const std::string& first = manifest.requested_metrics.front();
  return {rest_note(manifest, "shape"), errors_note(manifest, first, split_unit(first).name)};
}

}  // namespace hysteron::experiments
