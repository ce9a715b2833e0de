// What a run does besides simulating: pictures, folder, verbosity.  The same key table style as scenes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/look.h"
#include "render/offscreen.h"
#include "sim/scene/key_table.h"

namespace hysteron::experiments {

struct Options {
  std::string scene;              // scene      NAME|FILE.toml, "" = the experiment's own
  std::string out;                // out        folder of the results, "" = out/<experiment>
  std::string size = "1280x720";  // size       of pictures, WIDTHxHEIGHT pixels
  double fps = 30;                // fps        pictures per simulated second
  std::string quality = "final";  // quality    draft | final | figure
  render::Renderer renderer = render::Renderer::automatic;  // renderer   auto | egl | osmesa
  bool no_images = false;                                   // no-images
  std::string look = "cloth";    // look       what the pictures show; several separated by commas
  double curvature_range = 0;    // curvature-range  [1/m] at the ends of its colours; 0: 2 k0
  std::string reference;         // reference  folder of the run that look `difference` subtracts
  bool plain = false;            // plain      pictures of the sequence without letters
  std::string light = "studio";  // light      studio | raking
  render::Background background = render::Background::studio;  // background studio | white | transparent
  std::string camera;  // camera     a run's camera.json, before the keys camera.*
  Eigen::Vector3d camera_direction{0.8, -1.6, 0.9};  // camera.direction  from the cloth to the eye
  double camera_fov = 28;                            // camera.fov        full vertical angle [degree]
  Numbers camera_target;       // camera.target     [m] in the picture's middle; empty: found
  double camera_distance = 0;  // camera.distance   [m] from there to the eye; 0: found
  Numbers camera_box;          // camera.box        [m] framed, low then high; empty: found
  std::string export_format =
      "none";         // export     none | ply | obj | vtk | pc2 | usd | glb | mitsuba: meshes in out/mesh
  std::string probe;  // probe      "x,y[;x,y...]" [m] on the flat cloth: out/probes.csv
  bool check_intersections = false;  // check-intersections  at every instant that is recorded
  bool errors = false;               // errors       of headlines, by repeating the run
  int errors_draws = 2;              // errors.draws other meshes
  int errors_jobs = 0;               // errors.jobs  repeats at a time, 0: as many as fit
  int errors_batch = 1;              // errors.batch repeats in a process, at most
  double checkpoint = 0;             // checkpoint   [s] of wall clock between two; 0: none
  bool resume = false;               // resume       go on from OUT/checkpoint
  double max_memory = 0;             // max-memory   [MB] that the process may take; 0: no limit
  bool quick = false;                // quick      a small version of the same question
  std::string dump_scene;            // dump-scene write the resolved scene as TOML, and stop
  bool explain = false;              // explain    print what the scene includes, and stop
  bool quiet = false;                // quiet      no progress on stderr
  bool json = false;                 // json       the manifest on stdout

  int width() const;   // [pixels], of `size`
  int height() const;  // [pixels]
  std::vector<std::string> looks() const;
  bool has_view() const;  // of pictures, or of an export with their camera
};

Keys bind_options(Options& options);
// Those of experiments that simulate nothing: out, no-images, quick, quiet, json.
Keys bind_output_options(Options& options);
Keys with_output_options(Keys own, Options& options);

// A size that is no WIDTHxHEIGHT within 16 to 16384 pixels, a camera without direction, or with a target or a
// box of too few numbers: Error::invalid_input.
void check_options(const Options& options);

}  // namespace hysteron::experiments
