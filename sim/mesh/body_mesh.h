// The surface of a body of triangles, and where its vertices are over time.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/base/cycles.h"

namespace hysteron {

// Positions are in the body's own frame [m]; a body that is at rest there has one frame.
struct BodyMesh {
  std::vector<Eigen::Vector3i> face;                 // counter-clockwise seen from outside
  std::vector<std::vector<Eigen::Vector3d>> frames;  // at least one; each of all vertices [m]
  double fps = 0;            // frames a second, the first of them at t = 0; 0: rigid, or as `time` says
  std::vector<double> time;  // of the frames [s], ascending; empty: as fps says
  Cycles cycles = {};        // in which the frames are gone through again
  bool closed = false;       // every edge has two triangles, wound alike

  int vertices() const { return static_cast<int>(frames.front().size()); }
  int faces() const { return static_cast<int>(face.size()); }
  bool moves() const { return frames.size() > 1 && (fps > 0 || !time.empty()); }
  double time_of(std::size_t frame) const {  // [s]
    return time.empty() ? (fps > 0 ? static_cast<double>(frame) / fps : 0) : time[frame];
  }
  // Straight from one frame to the next; before the first one and after the last one it stays.  In each
  // further cycle it is where it is in the first.
  std::vector<Eigen::Vector3d> positions(double t) const;
};

}  // namespace hysteron
