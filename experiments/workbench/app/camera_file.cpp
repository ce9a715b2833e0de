#include "experiments/workbench/app/camera_file.h"

#include <nlohmann/json.hpp>

#include "experiments/workbench/app/manifest.h"
#include "sim/base/error.h"
#include "sim/base/whole_file.h"

namespace hysteron::experiments {
namespace {

Json vector_json(const Eigen::Vector3f& v) { return {v.x(), v.y(), v.z()}; }

Error refusal(const std::string& file, const std::string& what) {
  return Error::invalid_input("camera = " + file + ": " + what + " (--camera)").with_key("camera", file);
}

double camera_number(const Json& value, const std::string& name, const std::string& file) {
  if (!value.is_number()) throw refusal(file, name + " must be a number");
  return value.get<double>();
}

Eigen::Vector3d camera_vector(const Json& value, const std::string& name, const std::string& file) {
  if (!value.is_array() || value.size() != 3) throw refusal(file, name + " must be three numbers");
  return {camera_number(value[0], name, file), camera_number(value[1], name, file),
          camera_number(value[2], name, file)};
}

Json parsed(const std::string& file) {
  const Json whole = Json::parse(file_named(file, "cannot read " + file), nullptr, false);
  if (whole.is_discarded() || !whole.is_object() || !whole.contains("camera") || !whole["camera"].is_object())
    throw refusal(file, "is no JSON with an object camera, as a run writes camera.json");
  return whole["camera"];
}

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
  const Json camera = parsed(file);
  for (const auto& [name, value] : camera.items()) {
    if (name == "direction") {
      options.camera_direction = camera_vector(value, name, file);
    } else if (name == "fov") {
      options.camera_fov = camera_number(value, name, file);
    } else if (name == "target") {
      const Eigen::Vector3d target = camera_vector(value, name, file);
      options.camera_target.assign(target.begin(), target.end());
    } else if (name == "distance") {
      options.camera_distance = camera_number(value, name, file);
    } else {
      throw refusal(file, "camera." + name + " is unknown; direction, fov, target and distance are allowed");
    }
  }
  if (!(options.camera_fov >= 1 && options.camera_fov <= 120) || !(options.camera_distance >= 0))
    throw refusal(file, "fov must be in [1, 120] degree and distance >= 0 m");
}

}  // namespace hysteron::experiments
