// Reads point caches: the positions of one mesh's vertices at several instants, in one file.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/mesh/file_extension.h"

namespace hysteron {

inline bool names_a_point_cache(const std::filesystem::path& file) {
  return file_extension(file) == ".pc2" || file_extension(file) == ".mdd";
}

struct PointCache {
  std::vector<std::vector<Eigen::Vector3d>> frames;  // of all points each, in the file's unit
  double frames_per_sample = 1;                      // PC2: frames of the animation per sample
  // MDD: the time of each from the first one on [s]; empty for times that do not ascend, and for PC2.
  std::vector<double> time;
};

// Reads a cache by its ending: PC2 (3ds Max, Point Cache 2; Blender, Houdini) or MDD (LightWave; Blender,
// Maya).  Throws Error::system for a file that cannot be read; Error::invalid_input, naming it, for another
// ending, a header of another format, a file that is shorter than its header says, and numbers that are not
// finite.
PointCache read_point_cache(const std::string& file);

}  // namespace hysteron
