// The surface of a body of triangles, and its vertices' positions over time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/base/cycles.h"

namespace hysteron {

// Positions are in the body's own frame [m]; a body that is at rest there has one frame.
struct BodyMesh {
  std::vector<Eigen::Vector3i> face;                 // counter-clockwise seen from outside
  std::vector<std::vector<Eigen::Vector3d>> frames;  // at least one; each of all vertices [m]
  double fps = 0;            // frames per second, from t = 0 on; 0: rigid, or as `time` says
  std::vector<double> time;  // of the frames [s], ascending; empty: as fps says
  Cycles cycles = {};        // in which the frames are repeated
  bool closed = false;       // every edge has two triangles, wound alike

  int vertices() const { return static_cast<int>(frames.front().size()); }
  int faces() const { return static_cast<int>(face.size()); }
  bool moves() const { return frames.size() > 1 && (fps > 0 || !time.empty()); }
  double time_of(std::size_t frame) const {  // [s]
    return time.empty() ? (fps > 0 ? static_cast<double>(frame) / fps : 0) : time[frame];
  }
  // Returns the vertices at time t [s], interpolated linearly between frames [m]; the body rests before the
  // first and after the last frame.  Each further cycle repeats the first.
  std::vector<Eigen::Vector3d> positions(double t) const;
};

}  // namespace hysteron
