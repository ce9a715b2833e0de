// Reads a scene from a user's file, a shipped one, or the manifest of an earlier run.
#pragma once

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A place for a value of each type that is only checked, or read and dropped.
struct Scratch {
  bool flag = false;
  int integer = 0;
  double number = 0;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  std::string text;
  Parameters parameters;
  Numbers numbers;

  Field field(const std::string& type) {
    if (type == "flag") return &flag;
    if (type == "integer") return &integer;
    if (type == "number") return &number;
    if (type == "vector") return &vector;
    if (type == "name=value") return &parameters;
    if (type == "numbers") return &numbers;
    return &text;
  }
};

// Applies the scene that `--scene` names.  For a manifest of the same experiment this is the requested scene,
// since the experiment will change it once more, with the keys `extra`; for one of another experiment it is
// the scene as simulated.  Older manifests record which keys were given instead of the request: only these
// are applied to the same experiment.  `extra` is as in apply_scene_file.  Throws Error::invalid_input,
// Error::system.
void apply_scene(Setup& setup, const std::string& experiment, const std::string& name, const Keys& extra);

// Returns scene and options from an experiment's defaults and the scene's file of a line, without its flags;
// the experiment's own keys are not kept.  Throws as apply_scene() does.
Setup setup_of_file(const CommandLine& line);

// Returns the merge patch from the simulated scene to the requested one.
Json requested_patch(const Json& simulated, const Json& requested);

// Writes the scene of a set-up, with the keys of the run and its experiment, as the TOML file that
// `--dump-scene` names.  Throws Error::system.
void dump_scene(const Setup& setup);
// True if that file was written by dump_scene().
bool is_dumped_scene(const std::string& file);

// Throws Error::invalid_input for a line that names a scene and has --scene as well.
void refuse_two_scenes(const CommandLine& line);

}  // namespace hysteron::experiments
