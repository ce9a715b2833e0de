#include "experiments/workbench/pictures/ridge_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hysteron::experiments {
namespace {

// Where `value` crosses the threshold between two points, of which one alone lies above it.
Eigen::Vector3d crossing(const Eigen::Vector3d& a, double value_a, const Eigen::Vector3d& b, double value_b,
                         double threshold) {
  return a + (threshold - value_a) / (value_b - value_a) * (b - a);
}

// Length of the line within a triangle on which a value, linear between its corners, is the threshold: it
// cuts off the one corner that lies on its own side.
double contour_length(const std::array<Eigen::Vector3d, 3>& corner, const double (&value)[3],
                      double threshold) {
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    const bool above = value[k] > threshold;
    if ((value[l] > threshold) == above || (value[m] > threshold) == above) continue;
    return (crossing(corner[k], value[k], corner[l], value[l], threshold) -
            crossing(corner[k], value[k], corner[m], value[m], threshold))
        .norm();
  }
  return 0;
}

// The part of an edge on which a value, linear between its ends, exceeds the threshold.
double fraction_above(double from, double to, double threshold) {
  const bool first = from > threshold, last = to > threshold;
  if (first == last) return first ? 1 : 0;
  const double crossed = (threshold - from) / (to - from);
  return first ? crossed : 1 - crossed;
}

// Copies side by side along the first coordinate.
void place_apart(std::vector<Eigen::Vector2d>& at, int copies) {
  const std::size_t each = at.size() / copies;
  const auto first = at.begin(), end = first + static_cast<std::ptrdiff_t>(each);
  const auto by_x = [](const auto& a, const auto& b) { return a.x() < b.x(); };
  const auto [low, high] = std::minmax_element(first, end, by_x);
  const double from = low->x(), stride = 1.1 * (high->x() - from);
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = {at[i % each].x() + static_cast<double>(i / each) * stride, at[i % each].y()};
}

}  // namespace

std::vector<double> curvature_size(const std::vector<double>& curvature, int dimension) {
  std::vector<double> size;
  for (std::size_t e = 0; e < curvature.size(); e += dimension) {
    double square = 0;
    for (int k = 0; k < dimension; ++k) square += curvature[e + k] * curvature[e + k];
    size.push_back(std::sqrt(square));
  }
  return size;
}

std::vector<Eigen::Vector2d> unrolled_tube(const ClothMesh& mesh, const ClothShape& shape) {
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector3d& x : mesh.rest)
    result.push_back({x.x(), shape.radius * std::atan2(-x.y(), -x.z())});
  if (shape.copies > 1) place_apart(result, shape.copies);
  return result;
}

double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold) {
  double outline = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    const Eigen::Vector3i& t = mesh.face[f];
    outline += contour_length(mesh.corners(f), {value[t[0]], value[t[1]], value[t[2]]}, threshold);
  }
  for (int e = mesh.interior_edges; e < static_cast<int>(mesh.edge.size()); ++e) {
    const Edge& edge = mesh.edge[e];
    outline += mesh.edge_length(e) * fraction_above(value[edge.p2], value[edge.p3], threshold);
  }
  return outline / 2;
}

std::vector<double> area_fractions(const std::vector<double>& value, const std::vector<double>& area,
                                   double bin, int bins) {
  std::vector<double> fraction(bins, 0);
  double sum = 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    fraction[std::min(bins - 1, static_cast<int>(value[i] / bin))] += area[i];
    sum += area[i];
  }
  for (double& s : fraction) s /= sum;
  return fraction;
}

}  // namespace hysteron::experiments
