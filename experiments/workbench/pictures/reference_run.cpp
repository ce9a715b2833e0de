#include "experiments/workbench/pictures/reference_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_file.h"
#include "sim/base/error.h"
#include "sim/mesh/surface.h"

namespace hysteron::experiments {

namespace fs = std::filesystem;

ReferenceRun::ReferenceRun(fs::path folder) : folder_(std::move(folder)) {
  const fs::path file = folder_ / "manifest.json";
  const Json json = json_or_none(file);
  if (json.is_object())
    if (const Manifest manifest = checked_manifest(json, file); manifest.frames)
      for (const Frames::Instant& instant : manifest.frames->instants) time_.push_back(instant.time);
  std::error_code ignored;
  if (time_.empty() || !fs::exists(folder_ / "mesh" / "0000.ply", ignored))
    throw Error::invalid_input("reference = " + folder_.string() +
                               " must be the folder of a run with pictures and --export ply (--reference)")
        .with_key("reference", folder_.string());
}

std::vector<float> ReferenceRun::curvature(const ClothMesh& mesh, double time) const {
  const auto nearest = std::min_element(time_.begin(), time_.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  const std::string name = fmt::format("{:04}.ply", nearest - time_.begin());
  const Surface surface = read_surface((folder_ / "mesh" / name).string());
  if (surface.face != mesh.face || surface.curvature.size() != mesh.rest.size())
    throw Error::invalid_input("reference = " + folder_.string() + " has other triangles than this cloth (" +
                               std::to_string(surface.face.size()) + " and " +
                               std::to_string(mesh.face.size()) +
                               "): run it with the same mesh (--reference)")
        .with_key("reference", folder_.string());
  return {surface.curvature.begin(), surface.curvature.end()};
}

}  // namespace hysteron::experiments
