#include "experiments/notes/notes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/workbench/pages/error_notes.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {

double option_number(const Manifest& manifest, const std::string& path) {
  Manifest options;
  options.keys = manifest.options;
  return options.keys ? options.number(path) : 0;
}

bool has_number(const Manifest& manifest, const std::string& metric) {
  return manifest.metrics[metric].is_number();
}

std::vector<std::string> assumed_of(const Manifest& manifest, const std::vector<std::string>& keys) {
  const std::vector<SourcedNumber> numbers = manifest.fabric_numbers();
  std::vector<std::string> assumed;
  for (const std::string& key : keys)
    if (std::any_of(numbers.begin(), numbers.end(), [&](const SourcedNumber& number) {
          return number.name == key && number.confidence == "assumed";
        }))
      assumed.push_back(key);
  return assumed;
}

std::string enumerated(const std::vector<std::string>& names) {
  if (names.size() < 2) return join(names, "");
  return join({names.begin(), names.end() - 1}, ", ") + " and " + names.back();
}

bool has_friction_alone(const Manifest& manifest) {
  return manifest.text("fabric.name") != "" && manifest.number("fabric.bending.set.hardening") == 0 &&
         manifest.number("fabric.bending.set.yield") == 0 &&
         manifest.names("fabric.bending.branches.times").empty();
}

std::string errors_note(const Manifest& manifest, const std::string& metric, const std::string& name) {
  if (!has_number(manifest, metric)) return "";
  if (!manifest.metrics.contains(metric + kMeshError)) {
    const std::string size =
        manifest.triangles ? fmt::format(" on these {} triangles", *manifest.triangles) : "";
    return "how far mesh and step move the " + name + size + " is not known: --errors measures it";
  }
  struct Share {
    double error;  // in the metric's unit; NaN if unknown
    const char* note;
  };
  const Share shares[] = {
      {manifest.metrics.number(metric + kStepError), "the step: a smaller --step lessens it"},
      {manifest.metrics.number(metric + kMeshError), "the mesh's size: more --triangles lessen it"},
      {manifest.metrics.number(metric + kDrawError),
       "chance: the mean over more meshes lessens it (--errors.draws)"}};
  const Share* largest = nullptr;
  for (const Share& share : shares)
    if (std::isfinite(share.error) && (!largest || share.error > largest->error)) largest = &share;
  if (!largest || largest->error == 0) return "";
  return "the largest error of the " + name + " is that of " + largest->note;
}

}  // namespace hysteron::experiments
