#include "experiments/workbench/pictures/reference_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "experiments/workbench/app/json_file.h"
#include "experiments/workbench/app/manifest_check.h"
#include "sim/base/error.h"
#include "sim/mesh/surface.h"

namespace hysteron::experiments {

namespace fs = std::filesystem;

ReferenceRun::ReferenceRun(fs::path folder) : folder_(std::move(folder)) {
  const fs::path file = folder_ / "manifest.json";
  const Json manifest = json_or_none(file);
  if (manifest.is_object()) check_manifest(manifest, file);
  if (manifest.is_object() && manifest.contains("frames"))
    for (const Json& moment : manifest["frames"].value("moments", Json::array()))
      time_.push_back(moment["s"]);
  std::error_code ignored;
  if (time_.empty() || !fs::exists(folder_ / "mesh" / "0000.ply", ignored))
    throw Error::request("reference = " + folder_.string() +
                         " must be the folder of a run with pictures and --export ply (--reference)");
}

std::vector<float> ReferenceRun::curvature(const ClothMesh& mesh, double time) const {
  const auto nearest = std::min_element(time_.begin(), time_.end(), [&](double a, double b) {
    return std::abs(a - time) < std::abs(b - time);
  });
  char name[16];
  std::snprintf(name, sizeof name, "%04d.ply", static_cast<int>(nearest - time_.begin()));
  const Surface surface = read_surface((folder_ / "mesh" / name).string());
  if (surface.face != mesh.face || surface.curvature.size() != mesh.rest.size())
    throw Error::request("reference = " + folder_.string() + " has other triangles than this cloth (" +
                         std::to_string(surface.face.size()) + " and " + std::to_string(mesh.face.size()) +
                         "): run it with the same mesh (--reference)");
  return {surface.curvature.begin(), surface.curvature.end()};
}

}  // namespace hysteron::experiments
