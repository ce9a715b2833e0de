// Measures the error of every headline number (--errors) by running again at half the step, with four times
// the triangles, on other meshes and, if release matters, along the other path.
//
//   run -> repeats (a process each, in OUT/errors/NAME/) -> <metric>_step_error ... , OUT/errors.csv
#pragma once

#include <string>
#include <vector>

#include "experiments/workbench/app/run.h"

namespace hysteron::experiments {

// The key of the finer mesh of a cloth whose triangles come from a file.
inline constexpr const char* kSubdivisions = "cloth.subdivisions";

// An additional run, with its changes from the first.  Its name is "step", "mesh", "path" or "draw-1",
// "draw-2" ...
struct ErrorRun {
  std::string name;
  std::vector<Flag> changes;
};
// Returns the repeats of a resolved scene.  `release` is how its cloth is let go, "" if there is one path
// only.  The triangles of a file are subdivided, and there are no other draws of them.
std::vector<ErrorRun> planned_error_runs(const std::string& experiment, const Scene& scene,
                                         const std::string& release, int mesh_samples);

// The result of a repeat.
struct ErrorRunResult {
  ErrorRun error_run;
  Metrics metrics{};
  std::string stopped{};   // why it is not complete; empty if it is
  bool unchanged = false;  // it ended in the run's own state, bit for bit
};

// Returns for each headline and each of `requested` among the metrics of the run:
//   _step_error, _mesh_error   |its value there - the run's|
//   _draw_error                standard deviation over the run and the draws
//   _mean, _mean_stderr        of the same, from three draws on
//   _path_difference           its value there - the run's
// An unknown error is null, and a sentence gives the reason.
struct Errors {
  Metrics metrics{};
  std::vector<std::string> missing;
};
Errors estimated_errors(const std::string& experiment, const Metrics& metrics,
                        const std::vector<ErrorRunResult>& error_runs,
                        const std::vector<std::string>& requested = {});

// Runs the repeats of a run whose metrics are known, adds its errors to them, the sentences as
// `errors_missing`, and writes errors.csv.  Throws Error::system.
void measure_errors(Run& run, const CommandLine& line, const Setup& setup);

}  // namespace hysteron::experiments
