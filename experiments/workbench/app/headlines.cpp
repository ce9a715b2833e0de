#include "experiments/workbench/app/headlines.h"

#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

constexpr double kMilli = 1e3, kPercent = 100;
constexpr bool kNoErrors = false;

// clang-format off
const Headlines kAll[] = {
    {.experiment = "drape",
     .all = {{"drape_coefficient_percent", "drape coefficient", "%", "{:.1f}"},
             {"published_drape_coefficient_percent", "published coefficient", "%", "{:.1f}", 1, kNoErrors},
             {"node_count", "folds", "", "{:.0f}"},
             {"published_node_count", "published folds", "", "{:.0f}", 1, kNoErrors}},
     .release = "drape.release",
     .paths = {"lowered", "dropped"}},
    {.experiment = "swing",
     .all = {{"decay_shape", "decay", "", "", 1, kNoErrors},
             {"decay_per_turn_percent", "decay per turn", "%", "{:.1f}"},
             {"decay_step_fraction", "second line of decay begins at", "%", "{:.0f}", kPercent},
             {"turns", "turns", "", "{:.0f}", 1, kNoErrors},
             {"bending_friction_J", "lost to friction in bending", "mJ", "{:.4g}", kMilli},
             {"viscous_J", "lost to viscosity", "mJ", "{:.4g}", kMilli, kNoErrors}}},
    {.experiment = "crease",
     .all = {{"recovery_angle_deg", "recovery angle", "degree", "{:.1f}"},
             {"release_angle_deg", "at once after release", "degree", "{:.1f}"},
             {"recovery_angle_15_s_deg", "15 s after it", "degree", "{:.1f}"},
             {"law_recovery_angle_deg", "that of the law alone", "degree", "{:.1f}", 1, kNoErrors},
             {"residual_curvature_per_m", "residual curvature", "1/m", "{:.4g}"}},
     .own_mesh = true},
    {.experiment = "fold",
     .all = {{"recovery_angle_deg", "recovery angle", "degree", "{:.1f}"},
             {"2HB_N", "2HB", "mN", "{:.4g}", kMilli},
             {"set_curvature_per_m", "set", "1/m", "{:.4g}"}}},
    {.experiment = "crumple",
     .all = {{"residual_curvature_rms_per_m", "residual curvature (rms)", "1/m", "{:.4g}"},
             {"ridge_length_m", "length of ridges", "mm", "{:.1f}", kMilli},
             {"curvature_rms_per_m", "curvature (rms)", "1/m", "{:.4g}"},
             {"intersections", "pairs of triangles that cross", "", "{:.0f}", 1, kNoErrors}}},
    {.experiment = "cantilever",
     .all = {{"tip_drop_over_length", "tip drop over length", "", "{:.4f}"},
             {"elastica_drop_over_length", "that of the elastica", "", "{:.4f}", 1, kNoErrors},
             {"bending_length_m", "bending length", "mm", "{:.2f}", kMilli}}},
    {.experiment = "buckle",
     .all = {{"critical_gamma", "critical gamma", "", "{:.3f}"},
             {"reference_gamma", "that of theory", "", "{:.3f}", 1, kNoErrors}},
     .equilibria = true},
    {.experiment = "validate",
     .all = {{"drape_coefficient_percent", "drape coefficient", "%", "{:.1f}", 1, kNoErrors},
             {"node_count", "folds", "", "{:.0f}", 1, kNoErrors},
             {"bending_length_m", "bending length", "mm", "{:.2f}", kMilli, kNoErrors}}},
    {.experiment = "run", .all = {}, .asked = true},
    {.experiment = "sweep",
     .all = {{"runs_count", "runs", "", "{:.0f}", 1, kNoErrors},
             {"failed_count", "of them not complete", "", "{:.0f}", 1, kNoErrors}}},
    {.experiment = "render",
     .all = {{"frames_count", "frames", "", "{:.0f}", 1, kNoErrors}}},
};
// clang-format on

}  // namespace

std::vector<std::string> Headlines::with_errors() const {
  std::vector<std::string> metrics;
  for (const Headline& headline : all)
    if (headline.has_errors) metrics.push_back(headline.metric);
  return metrics;
}

const Headlines& headlines_of(const std::string& experiment) {
  for (const Headlines& headlines : kAll)
    if (headlines.experiment == experiment) return headlines;
  static const Headlines kNone{};
  return kNone;
}

bool is_asked_for(const std::string& metric) {
  for (const Headlines& headlines : kAll)
    for (const Headline& headline : headlines.all)
      if (metric == headline.metric) return true;
  return false;
}

void check_errors(const std::string& experiment) {
  const auto can_have = [](const Headlines& h) { return h.asked || !h.with_errors().empty(); };
  if (can_have(headlines_of(experiment))) return;
  std::string known;
  for (const Headlines& headlines : kAll)
    if (can_have(headlines)) known += (known.empty() ? "" : ", ") + headlines.experiment;
  throw Error::invalid_input("--errors: " + experiment +
                             " has no headline whose errors can be measured; these have: " + known)
      .of("errors", "true");
}

}  // namespace hysteron::experiments
