// Where a scene is read from: a file of one's own, a shipped one, or the manifest of an earlier run.
#pragma once

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/manifest.h"

namespace hysteron::experiments {

// A place for a value of each type, which is only checked, or read and dropped.
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

// Applies what `--scene` names.  Of a manifest that is the scene that its run resolved: if it is of this
// experiment, as it was asked of it, since it will change it once more, with the keys `extra`; else as it was
// simulated.  Programs that did not note what was asked have noted which keys were given: of their manifests
// only these are applied to the same experiment.  `extra` as in apply_scene_file.  Throws
// Error::invalid_input, Error::system.
void apply_scene(Setup& setup, const std::string& experiment, const std::string& name, const Keys& extra);

// What an experiment's defaults and the scene's file of a line say, without its flags: scene and options;
// keys of the experiment's own are not kept.  Throws as apply_scene() does.
Setup setup_of_file(const CommandLine& line);

// Throws what the experiment of that line refuses before it builds a cloth or takes its folder, and does
// neither.
void check_request(const CommandLine& line);

// The merge patch that turns the scene as it was simulated into the one that was asked for.
Json requested_patch(const Json& simulated, const Json& requested);

// Writes the scene of a set-up, with the keys of the run and its experiment, as the TOML file that
// `--dump-scene` names.  Throws Error::system.
void dump_scene(const Setup& setup);
// Whether that file was written so.
bool is_dumped_scene(const std::string& file);

// Throws Error::invalid_input for a line that names a scene and has --scene as well.
void refuse_two_scenes(const CommandLine& line);

}  // namespace hysteron::experiments
