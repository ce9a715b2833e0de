#include "experiments/workbench/session/mitsuba_scene.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "experiments/workbench/pictures/scene_renderer.h"
#include "render/exposure.h"
#include "render/figure_light.h"
#include "render/inset.h"
#include "render/key_light.h"
#include "render/srgb.h"
#include "sim/base/atomic_file.h"

namespace hysteron::experiments {
namespace {

constexpr int kSamples = 256, kDepth = 8;  // paths per pixel, reflections per path
constexpr double kFar = 40;                // distance of the key light, in radii of the lit bounds
constexpr double kThrough = 0.10;          // share of light that passes cloth, as in figure_cloth.frag

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format("{:.9g}, {:.9g}, {:.9g}", v.x(), v.y(), v.z());
}

std::string rgb(const char* name, const Eigen::Vector3d& color) {
  return fmt::format("<rgb name=\"{}\" value=\"{}\"/>", name, numbers(color));
}

Eigen::Vector3d linear(const render::Rgb8& color) {
  Eigen::Vector3d light;
  for (int k = 0; k < 3; ++k) light[k] = render::linear_of_srgb8()[color[static_cast<std::size_t>(k)]];
  return light;
}

std::string diffuse(const render::Rgb8& color) {
  return "<bsdf type=\"diffuse\">" + rgb("reflectance", linear(color)) + "</bsdf>";
}

// Returns the material of a sheet with a colour on either side that transmits a share of its light.
// Mitsuba's one such material is Disney's for thin surfaces, which without a step of the refractive index
// shines at no angle.
std::string cloth_material(const render::Look& look) {
  return fmt::format(
      "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"{}\"/><bsdf type=\"twosided\">{}{}</bsdf>"
      "<bsdf type=\"principledthin\">{}<float name=\"roughness\" value=\"1\"/>"
      "<float name=\"diff_trans\" value=\"2\"/><float name=\"eta\" value=\"1.001\"/></bsdf></bsdf>",
      kThrough, diffuse(look.front), diffuse(look.back),
      rgb("base_color", 0.5 * (linear(look.front) + linear(look.back))));
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

std::string sensor(const PictureView& view) {
  const float aspect = view.aspect();
  // Half the height at unit distance, or of parallel rays.
  const double slope = 1 / view.camera.projection(aspect)(1, 1);
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
      "<string name=\"pixel_format\" value=\"rgba\"/><rfilter type=\"gaussian\"><float name=\"stddev\" "
      "value=\"{}\"/></rfilter></film>\n  "
      "</sensor>\n",
      flat ? "orthographic" : "perspective", angle, lens, looking(eye, eye + forward, up), view.width,
      view.height, render::kBell);
}

Eigen::Vector3d key_light_direction(const PictureView& view) {
  return render::key_direction(view.look, view.camera, {}).normalized().cast<double>();
}

// Returns a disc whose radiance gives the key light's irradiance, and a sky with its own radiance; a diffuse
// surface is as bright as its colour under light of the exposure's inverse.
std::string lights(const PictureView& view) {
  const render::StudioLight studio = render::studio_light(view.look.room);
  const Eigen::Vector3d to_light = key_light_direction(view), middle = view.bounds.center().cast<double>();
  const double distance = kFar * view.bounds.radius(), slope = studio.key_radius;
  const double disc = slope * slope / (1 + slope * slope);  // its share of a hemisphere's irradiance
  const Eigen::Vector3d key = studio.exposure / disc * studio.key.cast<double>(),
                        sky = studio.exposure * studio.sky.cast<double>(),
                        side = Eigen::Vector3d::UnitX().cross(to_light).normalized();
  return fmt::format(
             "  <shape type=\"disk\">\n    <transform name=\"to_world\"><scale "
             "value=\"{:.9g}\"/>{}</transform>\n"
             "    <emitter type=\"area\">{}</emitter>\n  </shape>\n",
             slope * distance, looking(middle + distance * to_light, middle, side), rgb("radiance", key)) +
         "  <emitter type=\"constant\">" + rgb("radiance", sky) + "</emitter>\n";
}

std::string level(double height, const PictureView& view, const std::string& material) {
  const Eigen::Vector3d middle(view.bounds.center().x(), view.bounds.center().y(), height);
  return fmt::format(
      "  <shape type=\"rectangle\">\n    <transform name=\"to_world\"><scale value=\"{:.9g}\"/><translate "
      "value=\"{}\"/></transform>\n    {}\n  </shape>\n",
      kFar * view.bounds.radius(), numbers(middle), material);
}

// Returns the grey table that lights a figure from below, where pictures draw it; without a ground the
// studio's floor, which is too far below to be shaded.
std::string ground(const PictureView& view) {
  const render::StudioLight studio = render::studio_light(view.look.room);
  const Eigen::Vector3d floor = studio.floor.cast<double>();
  if (!view.floor)
    return level(view.bounds.low.z() - view.bounds.radius(), view,
                 "<emitter type=\"area\">" + rgb("radiance", studio.exposure * floor) + "</emitter>");
  const double facing = std::max(0.0, key_light_direction(view).z());
  const Eigen::Vector3d open = facing * studio.key.cast<double>() + studio.sky.cast<double>();
  return level(
      *view.floor + 0.5f * view.look.thickness, view,
      "<bsdf type=\"diffuse\">" + rgb("reflectance", floor.cwiseQuotient(open).cwiseMin(1)) + "</bsdf>");
}

std::string surface(const std::string& file, const std::string& placement, const std::string& material) {
  return "  <shape type=\"ply\">\n    <string name=\"filename\" value=\"" + file + "\"/>\n" +
         (placement.empty() ? "" : "    " + placement + "\n") + "    " + material + "\n  </shape>\n";
}

}  // namespace

std::string mitsuba_scene(const PictureView& view, const Scene& scene, double time, const std::string& cloth,
                          const std::vector<std::string>& bodies) {
  std::string xml = fmt::format(
      "<scene version=\"3.0.0\">\n  <default name=\"spp\" value=\"{}\"/>\n"
      "  <integrator type=\"path\"><integer name=\"max_depth\" value=\"{}\"/>"
      "<boolean name=\"hide_emitters\" value=\"true\"/></integrator>\n",
      kSamples, kDepth);
  xml += sensor(view) + lights(view) + ground(view);
  xml += surface(cloth, "", cloth_material(view.look));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Obstacle& o = scene.obstacle[i];
    if (bodies[i].empty() || time < o.from || time >= o.until) continue;
    xml += surface(bodies[i], matrix(placed_at(o, time)), diffuse(view.look.obstacle));
  }
  return xml + "</scene>\n";
}

void write_body(const std::string& file, const render::TriangleMesh& body, const render::Look& look,
                float side) {
  const float inset = render::body_inset(render::BodyMeasure(body), side, look.obstacle_inset);
  const render::TriangleMesh mesh = render::shrunk(body, inset);
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
