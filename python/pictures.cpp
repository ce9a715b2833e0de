// Draws pictures of a simulation as arrays, and compares two pictures.
#include <pybind11/stl.h>

#include <algorithm>

#include "experiments/diff/diff.h"
#include "experiments/workbench/pictures/drawing.h"
#include "python/module.h"
#include "python/simulation.h"
#include "sim/base/error.h"
#include "sim/bending/vertex_curvature.h"

namespace hysteron::python {
namespace {

py::array_t<std::uint8_t> image_array(const render::Image& image) {
  return py::array_t<std::uint8_t>(
      {static_cast<py::ssize_t>(image.height()), static_cast<py::ssize_t>(image.width()),
       static_cast<py::ssize_t>(image.channels())},
      image.pixels().data());
}

// Converts an array (H, W, 3 or 4) of bytes, or a PNG file.
render::Image image_from_python(py::handle picture, const std::string& what) {
  if (!py::isinstance<py::array>(picture)) return render::read_png(std::string(py::str(picture)));
  using Bytes = py::array_t<std::uint8_t, py::array::c_style>;
  const auto array = py::reinterpret_borrow<py::array>(picture);
  if (!py::isinstance<py::array_t<std::uint8_t>>(array) || array.ndim() != 3 ||
      (array.shape(2) != 3 && array.shape(2) != 4))
    throw Error::invalid_input(
        what + " must be an array of bytes (uint8) of shape (H, W, 3) or (H, W, 4), or a PNG file")
        .with_key(what, py::str(array.attr("shape")));
  const Bytes bytes(array);
  render::Image image(static_cast<int>(bytes.shape(1)), static_cast<int>(bytes.shape(0)),
                      static_cast<int>(bytes.shape(2)));
  std::copy(bytes.data(), bytes.data() + bytes.size(), image.pixels().begin());
  return image;
}

py::dict diff(py::object a, py::object b, double pixels_per_degree, const std::string& map) {
  experiments::DiffFlags flags;
  flags.pixels_per_degree = pixels_per_degree;
  const auto quantity = value_if_named<experiments::HeatMap>(map);
  if (!quantity) throw Error::invalid_input("map = " + map + " must be steps | flip").with_key("map", map);
  flags.map = *quantity;
  experiments::Comparison found;
  render::Image of_a = image_from_python(a, "a"), of_b = image_from_python(b, "b");
  unlocked([&] { found = compare_pictures(std::move(of_a), std::move(of_b), flags); });
  py::dict result;
  for (const experiments::Measure& measure : experiments::all_measures())
    result[measure.name] = found.measures.*measure.value;
  result["heat"] = image_array(found.heat);
  return result;
}

// Formats the size for the table of options.
std::string size_text(const std::pair<int, int>& size) {
  return std::to_string(size.first) + "x" + std::to_string(size.second);
}

void set_options(experiments::Options& options, const py::kwargs& given) {
  static const std::vector<std::string> kNames = {
      "look", "light", "background", "renderer", "curvature-range", "camera.direction", "camera.fov"};
  const Keys keys = bind_options(options);
  for (const auto& [name, value] : given) {
    const std::string path = key_named(py::str(name), kNames);
    if (std::find(kNames.begin(), kNames.end(), path) == kNames.end())
      throw Error::invalid_input("render has no argument \"" + path +
                                 "\"; there are: size, bounds, caption, " + join(kNames, ", "))
          .with_key(path, "");
    assign(find_key(keys, path, "render"), to_value(value, path), "render");
  }
}

std::optional<render::Box> bounding_box(const std::optional<std::pair<Numbers, Numbers>>& bounds) {
  if (!bounds) return {};
  const auto corner = [](const Numbers& at) -> Eigen::Vector3f {
    if (at.size() != 3)
      throw Error::invalid_input("bounds must be two corners of three numbers [m]").with_key("bounds", "");
    return Eigen::Map<const Eigen::Vector3d>(at.data()).cast<float>();
  };
  return render::Box{corner(bounds->first), corner(bounds->second)};
}

py::array_t<std::uint8_t> render_simulation(SimulationValue& sim, std::pair<int, int> size,
                                            const std::optional<std::pair<Numbers, Numbers>>& bounds,
                                            const std::string& caption, const py::kwargs& options) {
  PictureChoice choice;
  choice.options.size = size_text(size);
  choice.bounds = bounding_box(bounds);
  choice.caption = caption;
  set_options(choice.options, options);
  check_options(choice.options);
  return image_array(sim.picture(choice));
}

// Returns one number a vertex, in looks that show a value.
std::vector<float> shown_values(const std::string& look, const Cloth& cloth, Simulation& simulation) {
  const int d = simulation.dimension();
  if (look == "curvature") return vertex_curvature(cloth.mesh, simulation.curvature(), d);
  if (look == "residual") return vertex_curvature(cloth.mesh, simulation.residual_curvature(), d);
  if (look == "friction") return vertex_average(cloth.mesh, simulation.friction_share(), d);
  return {};
}

}  // namespace

SimulationValue::Studio& SimulationValue::studio(const PictureChoice& choice, const render::Box& bounds,
                                                 int cuda_device) {
  const experiments::Options& wanted = choice.options;
  if (studio_ && made_for_.size == wanted.size && made_for_.renderer == wanted.renderer) return *studio_;
  studio_.reset();
  mesh_ = experiments::drawn_mesh(cloth_.mesh, scene_.cloth);
  studio_ = std::make_unique<Studio>([&] {
    return std::make_unique<experiments::SceneRenderer>(scene_, wanted, mesh_, bounds, std::nullopt,
                                                        cuda_device);
  });
  made_for_ = wanted;
  return *studio_;
}

render::Image SimulationValue::drawn(const PictureChoice& choice, Simulation& simulation) {
  const std::string& look = choice.options.look;
  const std::vector<float> xyz = experiments::flat_points(simulation.positions());
  const render::Box bounds = choice.bounds.value_or(render::bounding_box(xyz));
  const render::Camera camera = experiments::framed_camera(choice.options, bounds);
  const experiments::SceneRenderer::Shown shown{simulation.time(), shown_values(look, cloth_, simulation)};
  return studio(choice, bounds, simulation.cuda_device()).run([&](experiments::SceneRenderer& renderer) {
    renderer.view().set_bounds(bounds);
    renderer.view().set_positions(xyz);
    render::Image image = renderer.draw(experiments::scene_look(scene_, choice.options, look), camera, shown);
    if (!renderer.view().shows_cloth())
      throw Error::simulation("the picture shows no cloth: bounds must frame where it is");
    if (!choice.caption.empty())
      experiments::annotate(image, camera, bounds.center(), choice.caption,
                            experiments::value_color_bar(scene_, choice.options, look));
    return image;
  });
}

render::Image SimulationValue::picture(const PictureChoice& choice) {
  render::Image image;
  alone([&](Simulation& simulation) { image = drawn(choice, simulation); });
  return image;
}

void bind_pictures(py::module_& module) {
  module.def("render", &render_simulation, py::arg("simulation"), py::arg("size") = std::make_pair(640, 480),
             py::arg("bounds") = py::none(), py::arg("caption") = "",
             R"(A picture of a simulation as it is now: uint8, shape (height, width, 3), rows from the top.

size: (width, height) in pixels.  bounds: (low, high), two corners [m] that the picture frames; none: the
cloth as it is now, so that sequences need their own.  caption: letters, with a scale and the colour bar.
Further arguments are the program's: look ("cloth", "curvature", "residual", "friction", "wireframe",
"silhouette"), light, background ("transparent" makes (height, width, 4)), curvature_range [1/m],
camera_direction, camera_fov [degree], renderer.  MachineError where no OpenGL is to be had.)");
  module.def(
      "png",
      [](py::object picture) {
        const std::vector<std::uint8_t> file = render::encode_png(image_from_python(picture, "picture"));
        return py::bytes(reinterpret_cast<const char*>(file.data()), file.size());
      },
      py::arg("picture"), "A picture, uint8 of shape (H, W, 3) or (H, W, 4), as the bytes of a PNG file.");
  module.def("diff", &diff, py::arg("a"), py::arg("b"),
             py::arg("pixels_per_degree") = render::kPixelsPerDegree, py::arg("map") = "steps",
             R"(How far two pictures of one size differ, as the program's `diff` measures it.

a, b: uint8 arrays of shape (H, W, 3) or (H, W, 4), or PNG files.  Returns a dict of mean_abs, rmse [8-bit
steps], psnr_db, ssim, flip, pixels_over_8_percent, and heat, a picture of where they differ (map: "steps" or
"flip"), uint8 of shape (H, W, 3).)");
}

}  // namespace hysteron::python
