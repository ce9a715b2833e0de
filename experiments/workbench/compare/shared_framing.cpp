#include "experiments/workbench/app/case.h"
#include "experiments/workbench/compare/variants.h"
#include "experiments/workbench/pictures/framing.h"

namespace hysteron::experiments {

std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants) {
  const Experiment& experiment = experiment_named(line.experiment);
  if (!experiment.frame) return {};
  std::optional<render::Box> box;
  for (const Variant& variant : variants) {
    const std::unique_ptr<Case> own = experiment.case_of(with_variant(line, variant));
    const std::optional<render::Box> one = planned_framing(own->setup, experiment.frame);
    if (!one) return {};
    box = box ? box->merged(*one) : *one;
  }
  Numbers corners;
  for (const Eigen::Vector3f& corner : {box->low, box->high})
    corners.insert(corners.end(), corner.begin(), corner.end());
  return {{"camera.box", corners}};
}

}  // namespace hysteron::experiments
