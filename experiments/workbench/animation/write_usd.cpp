// The format is specified in Pixar 2016-2024, OpenUSD, "USD Crate and Text File Formats" and the schemas
// usdGeom, usdLux and usdShade (openusd.org).
#include "experiments/workbench/animation/write_usd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "render/figure_light.h"
#include "render/key_light.h"
#include "sim/base/atomic_file.h"
#include "sim/base/rotation.h"

namespace hysteron::experiments {
namespace {

constexpr double kDefaultRate = 24;    // the format's default of time codes per second
constexpr double kCodes = 1e6;         // time codes are rounded to 1/kCodes
constexpr double kFilmHeight = 0.024;  // height of the camera's film of 36 x 24 mm [m]
constexpr double kTenths = 10;         // lenses and films are measured in tenths of a unit of length
constexpr double kDull = 0.9;          // roughness of cloth and bodies

double codes_a_second(const AnimatedScene& scene) { return scene.rate > 0 ? scene.rate : kDefaultRate; }

std::string triple(const Eigen::Vector3f& v) { return fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }

// Formats a list; `append` writes one value behind a text.
template <class Values, class Append>
std::string list(const Values& values, const Append& append) {
  std::string all = "[";
  for (const auto& value : values) {
    if (all.size() > 1) all += ", ";
    append(all, value);
  }
  return all + "]";
}

template <class Number>
std::string number_list(const std::vector<Number>& numbers) {
  return list(numbers, [](std::string& to, Number n) { fmt::format_to(std::back_inserter(to), "{}", n); });
}

std::string point_list(const std::vector<Eigen::Vector3f>& points) {
  return list(points, [](std::string& to, const Eigen::Vector3f& v) {
    fmt::format_to(std::back_inserter(to), "({}, {}, {})", v.x(), v.y(), v.z());
  });
}

// Formats unit vectors, rounded to five digits, which rotates them by at most 0.0006 degrees.
std::string direction_list(const std::vector<Eigen::Vector3f>& directions) {
  return list(directions, [](std::string& to, const Eigen::Vector3f& v) {
    fmt::format_to(std::back_inserter(to), "({:.5g}, {:.5g}, {:.5g})", v.x(), v.y(), v.z());
  });
}

std::string extent(const std::vector<Eigen::Vector3f>& points) {
  Eigen::Vector3f low = points.front(), high = low;
  for (const Eigen::Vector3f& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return "[" + triple(low) + ", " + triple(high) + "]";
}

// Formats the transposed matrix, as the format's matrices act on row vectors.
std::string transform_rows(const Eigen::Matrix4d& m) {
  std::string rows;
  for (int j = 0; j < 4; ++j)
    rows += fmt::format("{}({}, {}, {}, {})", j ? ", " : "", m(0, j), m(1, j), m(2, j), m(3, j));
  return "( " + rows + " )";
}

// Writes the properties of a prim below the root.
class Properties {
 public:
  Properties(std::ostream& out, const AnimatedScene& scene) : out_(out), scene_(scene) {}

  void line(const std::string& text) { out_ << "        " << text << '\n'; }
  void sample(double time, const std::string& value) {
    line(fmt::format("    {}: {},", time_code(scene_, time), value));
  }
  // Writes a sample for each instant, generated when it is written.
  template <class ValueText>
  void samples(const std::string& attribute, const ValueText& text) {
    line(attribute + ".timeSamples = {");
    for (const Instant& at : scene_.instants) sample(at.time, text(at));
    line("}");
  }
  // Writes a value for each instant, or a single one if all are equal.
  void samples_or_one(const std::string& attribute, const std::vector<std::string>& values) {
    if (std::count(values.begin(), values.end(), values.front()) == std::ssize(values))
      return line(attribute + " = " + values.front());
    std::size_t next = 0;
    samples(attribute, [&](const Instant&) { return values[next++]; });
  }

 private:
  std::ostream& out_;
  const AnimatedScene& scene_;
};

void write_place(Properties& mesh, const AnimatedScene& scene, const AnimatedPart& part) {
  std::vector<std::string> translations, orientations, scales;
  for (const Pose& pose : poses_at(part, scene.instants)) {
    const Eigen::Quaternionf& q = pose.rotation;
    translations.push_back(triple(pose.translation));
    orientations.push_back(fmt::format("({}, {}, {}, {})", q.w(), q.x(), q.y(), q.z()));
    scales.push_back(triple(Eigen::Vector3f::Constant(pose.scale)));
  }
  mesh.samples_or_one("double3 xformOp:translate", translations);
  mesh.samples_or_one("quatf xformOp:orient", orientations);
  mesh.samples_or_one("float3 xformOp:scale", scales);
  mesh.line("uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]");
}

void write_surface(Properties& mesh, const AnimatedScene& scene, const AnimatedPart& part) {
  const auto points = [&](const Instant& at) { return point_list(points_at(part, at)); };
  const auto normals = [&](const Instant& at) { return direction_list(surface_at(part, at).normals); };
  const auto box = [&](const Instant& at) { return extent(points_at(part, at)); };
  if (part.is_rigid()) {
    const Instant& any = scene.instants.front();
    mesh.line("float3[] extent = " + box(any));
    mesh.line("point3f[] points = " + points(any));
    mesh.line("normal3f[] normals = " + normals(any) + " (interpolation = \"vertex\")");
    return write_place(mesh, scene, part);
  }
  mesh.samples("float3[] extent", box);
  mesh.samples("point3f[] points", points);
  mesh.line("normal3f[] normals (interpolation = \"vertex\")");
  mesh.samples("normal3f[] normals", normals);
}

void write_visibility(Properties& mesh, const AnimatedScene& scene, const AnimatedPart& part) {
  const double first = scene.instants.front().time, last = scene.instants.back().time;
  if (part.from <= first && part.until > last) return;
  mesh.line("token visibility.timeSamples = {");
  const char *seen = "\"inherited\"", *hidden = "\"invisible\"";
  if (part.from > first) mesh.sample(first, hidden);
  if (part.from <= last && part.from < part.until)
    mesh.sample(std::max(part.from, first), part.until > first ? seen : hidden);
  if (part.until > first && part.until <= last) mesh.sample(part.until, hidden);
  mesh.line("}");
}

void write_texture(Properties& mesh, const TextureCoordinates& texture) {
  if (texture.at.empty()) return;
  mesh.line("texCoord2f[] primvars:st = " +
            list(texture.at,
                 [](std::string& to, const Eigen::Vector2f& at) {
                   fmt::format_to(std::back_inserter(to), "({}, {})", at.x(), at.y());
                 }) +
            " (interpolation = \"" + (texture.of_corners ? "faceVarying" : "vertex") + "\")");
}

void write_part(std::ostream& out, const AnimatedScene& scene, const AnimatedPart& part) {
  const std::vector<int> counts(part.shape.triangle_count(), 3);
  out << "    def Mesh \"" << part.name << "\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"]\n";
  if (part.inset > 0) out << fmt::format("        customData = {{ double inset = {} }}\n", part.inset);
  out << "    )\n    {\n";
  Properties mesh(out, scene);
  mesh.line("uniform token subdivisionScheme = \"none\"");
  mesh.line("uniform bool doubleSided = 1");
  mesh.line("color3f[] primvars:displayColor = [" + triple(part.color) + "]");
  mesh.line("rel material:binding = </run/materials/" + part.name + ">");
  mesh.line("int[] faceVertexCounts = " + number_list(counts));
  mesh.line("int[] faceVertexIndices = " + number_list(part.shape.triangles));
  write_texture(mesh, part.texture);
  write_visibility(mesh, scene, part);
  write_surface(mesh, scene, part);
  out << "    }\n\n";
}

void write_materials(std::ostream& out, const AnimatedScene& scene) {
  out << "    def Scope \"materials\"\n    {\n";
  for (const AnimatedPart& part : scene.parts) {
    const std::string path = "/run/materials/" + part.name;
    out << "        def Material \"" << part.name << "\"\n        {\n"
        << "            token outputs:surface.connect = <" << path << "/surface.outputs:surface>\n"
        << "            def Shader \"surface\"\n            {\n"
        << "                uniform token info:id = \"UsdPreviewSurface\"\n"
        << "                color3f inputs:diffuseColor = " << triple(part.color) << "\n"
        << "                float inputs:roughness = " << kDull << "\n"
        << "                token outputs:surface\n            }\n        }\n";
  }
  out << "    }\n\n";
}

void write_transform(Properties& prim, const Eigen::Matrix4d& matrix) {
  prim.line("matrix4d xformOp:transform = " + transform_rows(matrix));
  prim.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
}

// Writes the camera; its own z points away from what it looks at, here and in the format.
void write_camera(std::ostream& out, const AnimatedScene& scene) {
  const PictureView& view = scene.view;
  const Eigen::Matrix4d projection = view.camera.projection(view.aspect()).cast<double>();
  const double near = projection(2, 3) / (projection(2, 2) - 1),
               far = projection(2, 3) / (projection(2, 2) + 1);
  const double film = kTenths * kFilmHeight;
  out << "    def Camera \"camera\"\n    {\n";
  Properties camera(out, scene);
  camera.line("token projection = \"perspective\"");
  camera.line(fmt::format("float focalLength = {:.9g}", film / 2 * projection(1, 1)));
  camera.line(fmt::format("float horizontalAperture = {:.9g}", film * view.aspect()));
  camera.line(fmt::format("float verticalAperture = {:.9g}", film));
  camera.line(fmt::format("float2 clippingRange = ({:.6g}, {:.6g})", near, far));
  write_transform(camera, view.camera.view().cast<double>().inverse());
  out << "    }\n\n";
}

void write_light_color(Properties& light, const Eigen::Vector3f& color) {
  const float brightest = color.maxCoeff();
  light.line("float inputs:intensity = " + fmt::format("{}", brightest));
  light.line("color3f inputs:color = " + triple(color / brightest));
}

// Writes the lights so that a white surface under the key light, or under the sky, is as bright as the
// pictures' exposure makes it: a normalised distant light states its irradiance, a sky its radiance.
void write_lights(std::ostream& out, const AnimatedScene& scene) {
  const render::StudioLight studio = render::studio_light(scene.view.look.room);
  const Eigen::Vector3d to_light =
      render::key_direction(scene.view.look, scene.view.camera, {}).normalized().cast<double>();
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = rotation_between(Eigen::Vector3d::UnitZ(), to_light);
  out << "    def DistantLight \"key_light\"\n    {\n";
  Properties key(out, scene);
  key.line(fmt::format("float inputs:angle = {:.6g}",
                       360 / std::numbers::pi * std::atan(static_cast<double>(studio.key_radius))));
  key.line("bool inputs:normalize = 1");
  write_light_color(key, std::numbers::pi_v<float> * studio.exposure * studio.key);
  write_transform(key, turn);
  out << "    }\n\n    def DomeLight \"sky\"\n    {\n";
  Properties sky(out, scene);
  write_light_color(sky, studio.exposure * studio.sky);
  out << "    }\n";
}

void write_header(std::ostream& out, const AnimatedScene& scene) {
  const double rate = codes_a_second(scene);
  out << "#usda 1.0\n(\n    customLayerData = { string creator = \"hysteron\" }\n    defaultPrim = \"run\"\n"
      << fmt::format("    startTimeCode = {}\n    endTimeCode = {}\n",
                     time_code(scene, scene.instants.front().time),
                     time_code(scene, scene.instants.back().time))
      << fmt::format("    framesPerSecond = {0}\n    timeCodesPerSecond = {0}\n", rate)
      << "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\n";
}

}  // namespace

double time_code(const AnimatedScene& scene, double time) {
  return std::round(kCodes * time * codes_a_second(scene)) / kCodes;
}

void write_usd(const std::string& file, const AnimatedScene& scene) {
  AtomicFile target(file);
  std::ostream& out = target.stream();
  write_header(out, scene);
  out << "def Xform \"run\"\n{\n";
  for (const AnimatedPart& part : scene.parts) write_part(out, scene, part);
  write_materials(out, scene);
  write_camera(out, scene);
  write_lights(out, scene);
  out << "}\n";
  target.commit();
}

}  // namespace hysteron::experiments
