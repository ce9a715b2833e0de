#include "experiments/workbench/app/options.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "sim/base/comma_list.h"
#include "sim/base/error.h"

namespace hysteron::experiments {
namespace {

using O = Options;

// clang-format off
// How pictures look, of runs and of mesh files; what else is drawn and written of a run; how it is executed,
// and where to.
constexpr KeyTraits kLook{.scope = Scope::output, .group = KeyGroup::pictures, .takers = Takers::files};
constexpr KeyTraits kPicture{.scope = Scope::output, .group = KeyGroup::pictures};
constexpr KeyTraits kRun{.scope = Scope::run, .group = KeyGroup::running};
constexpr KeyTraits kPlace{.scope = Scope::run, .group = KeyGroup::running, .takers = Takers::all, .in_columns = InColumns::leave};

// Returns the traits of a key that the run itself has, and its repeats for errors have not.
constexpr KeyTraits once(KeyTraits traits) {
  traits.repeats = false;
  return traits;
}

const KeyRow<Options> kRows[] = {
    {"scene", at<&O::scene>, "", any(), "a scene of assets/scenes or a TOML file", {.scope = Scope::preset, .group = KeyGroup::scene}},
    {"out", at<&O::out>, "", any(), "folder of the results; default out/<experiment>", kPlace},
    {"size", at<&O::size>, "", any(), "size of the pictures, WIDTHxHEIGHT pixels", kLook},
    {"fps", at<&O::fps>, "1/s", between(0, 10000), "pictures and rows of series per simulated second, at the ends of steps; 0: of the start and the end alone; no result depends on it", kPicture},
    {"quality", at<&O::quality>, "", any(), "of the pictures: a draft is drawn with 4 samples a pixel in place of 8; a figure, for pictures that are published, is lit from 192 directions and takes seconds", kLook},
    {"renderer", at<&O::renderer>, "", any(), "how pictures are drawn", kLook.needing("not no-images")},
    {"no-images", at<&O::no_images>, "", any(), "draw no pictures; options that say how they look may stand beside it, a renderer may not", {.scope = Scope::output, .group = KeyGroup::pictures, .takers = Takers::tools}},
    {"look", at<&O::look>, "", any(), "what pictures show: cloth | grid (printed, 1 cm) | clay | curvature | residual | difference | friction | height (from the lowest to the highest point) | wireframe | silhouette; of several, separated by commas, each but the first has a sequence of its own, frames-LOOK/", once(kLook)},
    {"curvature-range", at<&O::curvature_range>, "1/m", at_least(0), "curvature at the ends of the colours, half of it for residual and difference; 0: 2 k0", kPicture},
    {"reference", at<&O::reference>, "", any(), "folder of a run on the same mesh with --export ply: look difference subtracts its curvature", once(kPicture).needing("look = difference")},
    {"plain", at<&O::plain>, "", any(), "pictures of the sequence without captions and bars", kPicture},
    {"light", at<&O::light>, "", any(), "raking: light from the side, almost in the plane of the picture, as wrinkles are photographed", kLook},
    {"background", at<&O::background>, "", any(), "behind the cloth; transparent: for figures, with the shadow on the ground and bars but without captions", kLook},
    {"camera", at<&O::camera>, "", any(), "a camera as a run writes it, OUT/camera.json; keys camera.* that are given win", {.scope = Scope::preset, .group = KeyGroup::pictures}},
    {"camera.direction", at<&O::camera_direction>, "", any(), "from the cloth to the eye, any length", kLook},
    {"camera.fov", at<&O::camera_fov>, "degree", between(1, 120), "full vertical angle of view", kLook},
    {"camera.target", at<&O::camera_target>, "m", any(), "three numbers: what is in the middle of the picture; none: the middle of what moves", kLook},
    {"camera.distance", at<&O::camera_distance>, "m", at_least(0), "from the target to the eye; 0: as near as all that moves stays in the picture", kLook},
    {"camera.box", at<&O::camera_box>, "m", any(), "six numbers, lowest corner, then highest: what the picture frames in place of what moves", kLook},
    {"export", at<&O::export_format>, "", any(), "meshes, OUT/mesh/0000.obj ...; vtk: 0000.vtp ... with fields, and cloth.pvd for ParaView; mitsuba: 0000.xml ... beside 0000.ply, scenes that the path tracer Mitsuba 3 draws; pc2: cloth.obj and cloth.pc2, one animated mesh for Blender and Houdini; usd: cloth.usda, and glb: cloth.glb (glTF), one animated scene with obstacles and camera", once(kPicture)},
    {"probe", at<&O::probe>, "", any(), "material points as they lie on the flat cloth [m], 'x,y' or 'x,y;x,y...': a time series of their positions, curvatures, moments and friction, OUT/probes.csv; pictures show the moment of the first against its curvature so far; none: not that of the experiment either", kPicture},
    {"check-intersections", at<&O::check_intersections>, "", any(), "count the triangles that pass through each other at every recorded instant, by exact predicates; always on with self-contact", {.scope = Scope::output, .group = KeyGroup::running}},
    {"errors", at<&O::errors>, "", any(), "repeat the run at half the step, with four times the triangles and on other meshes: the error of each headline number", once(kRun)},
    {"errors.draws", at<&O::errors_draws>, "", between(1, 64), "how many other meshes the run is repeated on; from 3 on with mean and standard error", kRun.needing("errors")},
    {"errors.jobs", at<&O::errors_jobs>, "", between(0, 64), "how many repeats run at a time; 0: one for each GPU, or for each core", kRun.needing("errors")},
    {"errors.batch", at<&O::errors_batch>, "", between(1, 64), "up to so many repeats share a process and, on a GPU, its launches", kRun.needing("errors")},
    {"checkpoint", at<&O::checkpoint>, "s", at_least(0), "wall clock between two checkpoints: OUT/checkpoint, at a recorded instant, also on SIGINT and SIGTERM, which then end the run (exit code 3); 0: none", once(kRun)},
    {"resume", at<&O::resume>, "", any(), "go on from OUT/checkpoint with the same command, to the same bits on the same device; begins anew where there is none; a complete run is repeated only where request, program or a file that it has read have changed; of several laws, fabrics or integrators, and of compare: so is each column", once({.scope = Scope::run, .group = KeyGroup::running, .in_columns = InColumns::leave})},
    {"max-memory", at<&O::max_memory>, "MB", at_least(0), "of the host, that the process may take; a run that asks for more ends (exit code 1); 0: no limit", kRun},
    {"quick", at<&O::quick>, "", any(), "a small version of the same question; flags that are given take precedence", {.scope = Scope::preset, .group = KeyGroup::running, .takers = Takers::tools}},
    {"dump-scene", at<&O::dump_scene>, "", any(), "write the resolved scene to this TOML file, with where each value comes from, and stop", {.scope = Scope::run, .group = KeyGroup::scene}},
    {"explain", at<&O::explain>, "", any(), "print what this scene includes and leaves out, and stop", {.scope = Scope::run, .group = KeyGroup::running, .in_columns = InColumns::share}},
    {"quiet", at<&O::quiet>, "", any(), "no progress on stderr; warnings are said", kPlace},
    {"json", at<&O::json>, "", any(), "print the manifest on stdout", once(kPlace)},
};
// clang-format on

constexpr int kSmallestSide = 16;    // [pixels]; captions need some room
constexpr int kLargestSide = 16384;  // [pixels]; limit of textures in OpenGL drivers

// Parses WIDTHxHEIGHT; {0, 0} for any other text.
std::pair<int, int> sides(const std::string& size) {
  int width = 0, height = 0;
  const char* end = size.data() + size.size();
  const auto first = std::from_chars(size.data(), end, width);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != 'x') return {0, 0};
  const auto second = std::from_chars(first.ptr + 1, end, height);
  if (second.ec != std::errc() || second.ptr != end) return {0, 0};
  return {width, height};
}

void check_look(const std::string& look) {
  const std::vector<std::string>& known = render::look_names();
  if (std::count(known.begin(), known.end(), look)) return;
  throw Error::invalid_input("look = " + look + " must be " + join(known, " | ") + suggestion(look, known) +
                             " (--look)")
      .with_key("look", look);
}

// Throws unless the key has the wanted number of numbers, or none.
void check_place(const Numbers& given, std::size_t wanted, const char* key) {
  if (given.empty() || given.size() == wanted) return;
  throw Error::invalid_input(
      fmt::format("{} has {} numbers and must have {} [m] (--{})", key, given.size(), wanted, key))
      .with_key(key, "");
}

void check_camera(const Options& options) {
  if (options.camera_direction.isZero(0))
    throw Error::invalid_input("camera.direction = [0, 0, 0] must not be zero (--camera.direction)")
        .with_key("camera.direction", "0, 0, 0");
  check_place(options.camera_target, 3, "camera.target");
  check_place(options.camera_box, 6, "camera.box");
  const Numbers& box = options.camera_box;
  for (std::size_t k = 0; k + 3 < box.size(); ++k)
    if (!(box[k + 3] > box[k]))
      throw Error::invalid_input(
          fmt::format("camera.box reaches from {} to {} m along {} and must be ascending (--camera.box)",
                      box[k], box[k + 3], "xyz"[k]))
          .with_key("camera.box", "");
}

bool drawable(int side) { return side >= kSmallestSide && side <= kLargestSide; }

}  // namespace

int Options::width() const { return sides(size).first; }
int Options::height() const { return sides(size).second; }
std::vector<std::string> Options::looks() const { return split(look); }
bool Options::has_view() const {
  return !no_images || export_format == MeshFormat::mitsuba || export_format == MeshFormat::usd ||
         export_format == MeshFormat::glb;
}

Keys bind_options(Options& options) { return bind(kRows, options); }

Keys bind_options_of(Takers takers, Options& options) {
  Keys keys = bind_options(options);
  std::erase_if(keys, [&](const BoundKey& key) {
    const Takers of = key.description.traits.takers;
    return of != takers && of != Takers::all;
  });
  return keys;
}

Keys bind_output_options(Options& options) { return bind_options_of(Takers::tools, options); }

Keys with_output_options(Keys own, Options& options) {
  const Keys output = bind_output_options(options);
  own.insert(own.end(), output.begin(), output.end());
  return own;
}

void check_options(const Options& options) {
  if (!drawable(options.width()) || !drawable(options.height())) {
    throw Error::invalid_input("size = " + options.size + " must be WIDTHxHEIGHT with sides in [" +
                               std::to_string(kSmallestSide) + ", " + std::to_string(kLargestSide) +
                               "] pixels (--size)")
        .with_key("size", options.size);
  }
  check_camera(options);
  if (options.looks().empty()) check_look("");
  for (const std::string& look : options.looks()) {
    check_look(look);
    if (look == "difference" && options.reference.empty())
      throw Error::invalid_input("look = difference needs the run that it is taken from (--reference DIR)")
          .with_key("look", look);
  }
}

}  // namespace hysteron::experiments
