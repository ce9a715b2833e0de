#include "experiments/workbench/session/mitsuba_scene.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "experiments/workbench/pictures/drawing.h"
#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/cloth_view.h"
#include "render/inset.h"
#include "render/srgb.h"
#include "sim/base/atomic_file.h"

namespace hysteron::experiments {
namespace {

constexpr int kSamples = 256, kDepth = 8;     // paths a pixel, reflections
constexpr double kKeyRadius = 0.15;           // of the key light over its distance
constexpr double kFar = 40;                   // that distance, in radii of what is lit
constexpr double kExposure = 1.0 / 3;         // open ground is as bright as its colour
const Eigen::Vector3d kKey{4.1, 4.0, 3.87};   // light on a surface that faces the key light
const Eigen::Vector3d kSky{0.96, 1.0, 1.06};  // of the sky on one that faces up

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("{:.9g}, {:.9g}, {:.9g}", v.x(), v.y(), v.z());
}

std::string rgb(const char* name, const Eigen::Vector3d& color) {
  return fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, numbers(color));
}

std::string diffuse(const render::Rgb8& color) {
  Eigen::Vector3d linear;
  for (int k = 0; k < 3; ++k) linear[k] = render::linear_of_srgb8()[color[static_cast<std::size_t>(k)]];
  return "<bsdf type=\"diffuse\">" + rgb("reflectance", linear) + "</bsdf>";
}

std::string looking(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& up) {
  return fmt::format("<lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>", numbers(from), numbers(to),
                     numbers(up));
}

std::string matrix(const Eigen::Matrix4f& m) {
  std::string text;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", m(i, j));
  return "<transform name=\"to_world\"><matrix value=\"" + text + "\"/></transform>";
}

std::string sensor(const MitsubaView& view) {
  const float aspect = static_cast<float>(view.width) / static_cast<float>(view.height);
  const double slope = 1 / view.camera.projection(aspect)(1, 1);  // half a height at unit distance, or at all
  const Eigen::Vector3d eye = view.camera.eye().cast<double>(),
                        forward = view.camera.forward().cast<double>(),
                        up = view.camera.view().block<1, 3>(1, 0).transpose().cast<double>();
  const bool flat = view.camera.is_orthographic();
  const std::string lens = flat ? fmt::format("<scale x=\"{0:.9g}\" y=\"{0:.9g}\"/>", slope * aspect) : "";
  const std::string angle =
      flat ? ""
           : fmt::format("<string name=\"fov_axis\" value=\"y\"/><float name=\"fov\" value=\"{:.9g}\"/>",
                         360 / std::numbers::pi * std::atan(slope));
  return fmt::format(
      "  <sensor type=\"{}\">\n    {}\n    <transform name=\"to_world\">{}{}</transform>\n"
      "    <sampler type=\"multijitter\"><integer name=\"sample_count\" value=\"$spp\"/></sampler>\n"
      "    <film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" "
      "value=\"{}\"/>"
      "<string name=\"pixel_format\" value=\"rgba\"/><rfilter type=\"gaussian\"/></film>\n  </sensor>\n",
      flat ? "orthographic" : "perspective", angle, lens, looking(eye, eye + forward, up), view.width,
      view.height);
}

Eigen::Vector3d key_light_direction(const MitsubaView& view) {
  return view.look.to_light.value_or(render::key_beside(view.camera)).normalized().cast<double>();
}

// Radiance of a disc that throws the key light's irradiance, and of a sky that throws its own; a diffuse
// surface is as bright as its colour under light of kExposure's inverse.
std::string lights(const MitsubaView& view) {
  const Eigen::Vector3d to_light = key_light_direction(view), middle = view.bounds.center().cast<double>();
  const double distance = kFar * view.bounds.radius(), room = view.look.room;
  const Eigen::Vector3d key = kExposure / (kKeyRadius * kKeyRadius) * kKey, sky = room * kExposure * kSky,
                        side = Eigen::Vector3d::UnitX().cross(to_light).normalized();
  const double radius = kKeyRadius * distance;
  return fmt::format(
             "  <shape type=\"disk\">\n    <transform name=\"to_world\"><scale "
             "value=\"{:.9g}\"/>{}</transform>\n"
             "    <emitter type=\"area\">{}</emitter>\n  </shape>\n",
             radius, looking(middle + distance * to_light, middle, side), rgb("radiance", key)) +
         "  <emitter type=\"constant\">" + rgb("radiance", sky) + "</emitter>\n";
}

// A page: white under the whole sky and key light.
std::string ground(const MitsubaView& view) {
  if (!view.floor) return "";
  const double facing = std::max(0.0, key_light_direction(view).z());
  const Eigen::Array3d open = kExposure * (facing * kKey + view.look.room * kSky).array();
  const Eigen::Vector3d middle(view.bounds.center().x(), view.bounds.center().y(), *view.floor);
  return fmt::format(
      "  <shape type=\"rectangle\">\n    <transform name=\"to_world\"><scale value=\"{:.9g}\"/><translate "
      "value=\"{}\"/></transform>\n    {}\n  </shape>\n",
      kFar * view.bounds.radius(), numbers(middle),
      "<bsdf type=\"diffuse\">" + rgb("reflectance", (1 / open).min(1.0)) + "</bsdf>");
}

void shrink(render::TriangleMesh& mesh, const render::Look& look, float side) {
  const render::BodyMeasure body(mesh);
  const float inset = render::body_inset(body, side, look.obstacle_inset);
  const Eigen::Array3f kept = 1 - inset / body.half_extent.array();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.positions[i] = mesh.centred ? (kept * mesh.positions[i].array()).matrix().eval()
                                     : (mesh.positions[i] - inset * mesh.normals[i]).eval();
}

std::string surface(const std::string& file, const std::string& placement, const std::string& material) {
  return "  <shape type=\"ply\">\n    <string name=\"filename\" value=\"" + file + "\"/>\n" +
         (placement.empty() ? "" : "    " + placement + "\n") + "    " + material + "\n  </shape>\n";
}

}  // namespace

MitsubaView mitsuba_view(const Setup& setup, const render::Box& bounds, std::optional<float> floor) {
  for (const Obstacle& o : setup.scene.obstacle)
    if (o.kind == ObstacleKind::ground && !floor) floor = static_cast<float>(o.center.z());
  const Options& options = setup.options;
  return {framed_camera(options, bounds),
          scene_look(setup.scene, options, "cloth"),
          options.width(),
          options.height(),
          bounds,
          floor};
}

std::string mitsuba_scene(const MitsubaView& view, const Scene& scene, double time, const std::string& cloth,
                          const std::vector<std::string>& bodies) {
  std::string xml = fmt::format(
      "<scene version=\"3.0.0\">\n  <default name=\"spp\" value=\"{}\"/>\n"
      "  <integrator type=\"path\"><integer name=\"max_depth\" value=\"{}\"/>"
      "<boolean name=\"hide_emitters\" value=\"true\"/></integrator>\n",
      kSamples, kDepth);
  xml += sensor(view) + lights(view) + ground(view);
  xml += surface(cloth, "",
                 "<bsdf type=\"twosided\">" + diffuse(view.look.front) + diffuse(view.look.back) + "</bsdf>");
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Obstacle& o = scene.obstacle[i];
    if (bodies[i].empty() || time < o.from || time >= o.until) continue;
    xml += surface(bodies[i], matrix(placed_at(o, time)), diffuse(view.look.obstacle));
  }
  return xml + "</scene>\n";
}

void write_body(const std::string& file, render::TriangleMesh mesh, const render::Look& look, float side) {
  shrink(mesh, look, side);
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      mesh.positions.size(), mesh.triangle_count());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Eigen::Vector3f &p = mesh.positions[i], &n = mesh.normals[i];
    text +=
        fmt::format("{:.7g} {:.7g} {:.7g} {:.5g} {:.5g} {:.5g}\n", p.x(), p.y(), p.z(), n.x(), n.y(), n.z());
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    text += fmt::format("3 {} {} {}\n", mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]);
  write_text(file, text);
}

}  // namespace hysteron::experiments
