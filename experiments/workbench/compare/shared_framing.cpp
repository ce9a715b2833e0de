#include "experiments/workbench/compare/shared_framing.h"

#include "render/camera.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {

std::vector<Flag> shared_framing(const CommandLine& line, const std::vector<Variant>& variants) {
  const auto framing = experiment_named(line.experiment).framing;
  if (!framing) return {};
  std::optional<render::Box> box;
  for (const Variant& variant : variants) {
    const std::optional<render::Box> one = framing(with_variant(line, variant));
    if (!one) return {};
    box = box ? box->merged(*one) : *one;
  }
  std::string corners;
  for (const Eigen::Vector3f& corner : {box->low, box->high})
    for (int k = 0; k < 3; ++k) corners += number_text(corner[k]) + " ";
  return {{"camera.box", corners}};
}

std::vector<Flag> for_sheets(const CommandLine& line) {
  std::vector<Flag> flags = {{"plain", "true"}};
  if (last_text(line.flags, "look", "cloth").starts_with("cloth") &&
      last_text(line.flags, "background", "").empty())
    flags.push_back({"background", "white"});
  return flags;
}

}  // namespace hysteron::experiments
