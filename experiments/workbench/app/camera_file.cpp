#include "experiments/workbench/app/camera_file.h"

#include "experiments/workbench/app/json_file.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"
#include "sim/scene/value_tree.h"

namespace hysteron::experiments {
namespace {

Json vector_json(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string camera_text(const render::Camera& camera, const std::string& size) {
  const Json json = {{"camera",
                      {{"direction", vector_json(-camera.forward())},
                       {"fov", camera.fov_degree()},
                       {"target", vector_json(camera.target())},
                       {"distance", (camera.target() - camera.eye()).norm()}}},
                     {"size", size}};
  return json.dump(1) + "\n";
}

void read_camera(const std::string& file, Options& options) {
  const Json whole = json_in(file_named(file, "cannot read " + file), file);
  if (!whole.is_object() || !whole.contains("camera") || !whole["camera"].is_object())
    throw Error::invalid_input("camera = " + file +
                               ": has no object camera, as a run writes camera.json (--camera)")
        .with_key("camera", file);
  const Keys keys = bind_options(options);
  for (const ValueTree& node : json_tree(whole["camera"], file, Lists::refused, "camera").children)
    assign(keys, node, file, "camera.");
}

}  // namespace hysteron::experiments
