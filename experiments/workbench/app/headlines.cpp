#include "experiments/workbench/app/headlines.h"

#include "sim/base/error.h"

namespace hysteron::experiments {

const Headlines* headlines_of(const std::string& experiment) {
  static const std::vector<Headlines> kAll = {
      {.experiment = "drape",
       .metrics = {"drape_coefficient_percent", "node_count"},
       .release = "drape.release",
       .paths = {"lowered", "dropped"}},
      {.experiment = "swing", .metrics = {"decay_per_turn_percent", "decay_exponent", "bending_friction_J"}},
      {.experiment = "crease",
       .metrics = {"recovery_angle_deg", "residual_curvature_per_m"},
       .own_mesh = true},
      {.experiment = "fold", .metrics = {"recovery_angle_deg", "2HB_N", "set_curvature_per_m"}},
      {.experiment = "crumple",
       .metrics = {"residual_curvature_rms_per_m", "ridge_length_m", "curvature_rms_per_m"}},
      {.experiment = "cantilever", .metrics = {"tip_drop_over_length", "bending_length_m"}},
      {.experiment = "buckle", .metrics = {"critical_gamma"}, .equilibria = true}};
  for (const Headlines& headlines : kAll)
    if (headlines.experiment == experiment) return &headlines;
  return nullptr;
}

void check_errors(const std::string& experiment) {
  if (!headlines_of(experiment))
    throw Error::request("--errors: " + experiment +
                         " has no headline; drape, swing, crease, fold, crumple, cantilever and buckle have");
}

}  // namespace hysteron::experiments
