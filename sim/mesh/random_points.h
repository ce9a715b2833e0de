// Makes random points for irregular meshes, the same on every machine.
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

namespace hysteron {

// The largest jitter of a point from its even place, over the spacing: neighbours keep a distance.
inline constexpr double kPointJitter = 0.42;

// Uniform doubles come from a fixed generator with a fixed mapping; the distributions of <random> may differ
// between standard libraries.
class Uniform {
 public:
  explicit Uniform(unsigned seed) : engine_(seed) {}
  // Returns a number in [lo, hi).
  double operator()(double lo, double hi) { return lo + (hi - lo) * (engine_() * 0x1p-32); }

 private:
  std::mt19937 engine_;
};

// Triangulates the points (Delaunay) and moves free ones to the centroid of their triangles, first once
// everywhere and then only at triangles with an angle below 20 degrees, until there are none or 60 rounds
// have passed.  This is a relaxation by centroidal stars after Lloyd (1982) that leaves the points irregular.
std::vector<Eigen::Vector3i> triangulate_relaxed(std::vector<Eigen::Vector2d>& points,
                                                 const std::vector<char>& free);

// Returns the point of the unit circle at the fraction i/n of a turn.  It uses a series of its own instead of
// the C library's cosine, whose last bit depends on library and processor.
Eigen::Vector2d circle_point(int i, int n);

}  // namespace hysteron
