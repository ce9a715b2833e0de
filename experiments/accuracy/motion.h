// Errors of motions: positions at sampled times against a run of the same mesh with very small steps.
#pragma once

#include <functional>
#include <vector>

#include "experiments/accuracy/accuracy.h"
#include "sim/scene/cloth.h"

namespace hysteron::experiments {

using Trajectory = std::vector<std::vector<Eigen::Vector3d>>;  // positions at each sampled time [m]

// Runs the scene and keeps the positions every `sampling` [s], of which its step is a part.
Trajectory simulated(const Scene& scene, const Cloth& cloth, double sampling, Found& found);

// Root mean square over vertices and times, over `length` [m].
double distance(const Trajectory& a, const Trajectory& b, double length);

// A motion that settings differ in: its scene for a mesh, its size, and what to read off it.
struct MotionQuestion {
  std::function<Scene(const Setting&)> scene;
  double length = 0, sampling = 0;  // [m], [s]
  Setting reference;                // integrator and step of the references, one per mesh and size
  std::function<double(const Cloth&, const std::vector<Eigen::Vector3d>&)> value;
};

// Gives the problem its solve(): error is the distance from the reference.
void ask_for_motion(const MotionQuestion& question, Problem& problem);

}  // namespace hysteron::experiments
