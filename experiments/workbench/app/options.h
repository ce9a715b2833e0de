// The options of a run besides its simulation: pictures, folder, verbosity.  They have the same style of key
// table as scenes; each comment begins with the key.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "render/look.h"
#include "render/offscreen.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {

enum class PictureQuality { draft, final, figure };
constexpr std::array<const char*, 3> names(PictureQuality) { return {"draft", "final", "figure"}; }

enum class Lighting { studio, raking };
constexpr std::array<const char*, 2> names(Lighting) { return {"studio", "raking"}; }

// The format of exported meshes (experiments/workbench/session/mesh_export.h, animation_export.h).
enum class MeshFormat { none, ply, obj, vtk, pc2, usd, glb, mitsuba };
constexpr std::array<const char*, 8> names(MeshFormat) {
  return {"none", "ply", "obj", "vtk", "pc2", "usd", "glb", "mitsuba"};
}

struct Options {
  std::string scene;              // scene      NAME|FILE.toml, "" = the experiment's own
  std::string out;                // out        folder of the results, "" = out/<experiment>
  std::string size = "1280x720";  // size       width and height of pictures, WIDTHxHEIGHT pixels
  double fps = 30;                // fps        pictures per simulated second
  PictureQuality quality = PictureQuality::final;           // quality    draft | final | figure
  render::Renderer renderer = render::Renderer::automatic;  // renderer   auto | egl | osmesa
  bool no_images = false;                                   // no-images  no pictures are drawn
  std::string look = "cloth";         // look       what the pictures show; several separated by commas
  double curvature_range = 0;         // curvature-range  curvature at the ends of its colours [1/m]; 0: 2 k0
  std::string reference;              // reference  folder of the run that look `difference` subtracts
  bool plain = false;                 // plain      pictures of the sequence have no text
  Lighting light = Lighting::studio;  // light      studio | raking
  render::Background background = render::Background::studio;  // background studio | white | transparent
  std::string camera;  // camera     a run's camera.json, before the keys camera.*
  Eigen::Vector3d camera_direction{0.8, -1.6, 0.9};  // camera.direction  from the cloth to the eye
  double camera_fov = 28;                            // camera.fov        full vertical angle of view [degree]
  Numbers camera_target;       // camera.target     point in the picture's middle [m]; empty: found
  double camera_distance = 0;  // camera.distance   from the target to the eye [m]; 0: found
  Numbers camera_box;          // camera.box        framed box [m], low then high; empty: found
  MeshFormat export_format = MeshFormat::none;  // export     meshes in out/mesh
  std::string probe;                 // probe      points "x,y[;x,y...]" [m] on the flat cloth: out/probes.csv
  bool check_intersections = false;  // check-intersections  counts them at every recorded instant
  bool errors = false;               // errors     measures errors of headlines by repeating the run
  int errors_draws = 2;              // errors.draws number of other meshes
  int errors_jobs = 0;               // errors.jobs  repeats at the same time, 0: as many as fit
  int errors_batch = 1;              // errors.batch most repeats in a process
  double checkpoint = 0;             // checkpoint wall clock between two checkpoints [s]; 0: none
  bool resume = false;               // resume       go on from OUT/checkpoint
  double max_memory = 0;             // max-memory limit of the process [MB]; 0: no limit
  bool quick = false;                // quick      runs a small version of the same question
  std::string dump_scene;            // dump-scene write the resolved scene as TOML, and stop
  bool explain = false;              // explain    print what the scene includes, and stop
  bool quiet = false;                // quiet      no progress on stderr
  bool json = false;                 // json       the manifest on stdout

  int width() const;   // width of pictures [pixels]
  int height() const;  // height of pictures [pixels]
  std::vector<std::string> looks() const;
  bool has_view() const;  // true with pictures, or an export with their camera
};

Keys bind_options(Options& options);
// Binds the options that `takers`, which are tools or files, take beside their own.
Keys bind_options_of(Takers takers, Options& options);
// Binds those of tools: out, no-images, quick, quiet, json.
Keys bind_output_options(Options& options);
Keys with_output_options(Keys own, Options& options);

// Throws Error::invalid_input for a size that is no WIDTHxHEIGHT within 16 to 16384 pixels, a camera without
// direction, or a target or a box with too few numbers.
void check_options(const Options& options);

}  // namespace hysteron::experiments
