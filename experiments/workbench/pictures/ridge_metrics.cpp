#include "experiments/workbench/pictures/ridge_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace hysteron::experiments {
namespace {

// Returns the point where `value` crosses the threshold between two points, exactly one of which is above it.
Eigen::Vector3d crossing(const Eigen::Vector3d& a, double value_a, const Eigen::Vector3d& b, double value_b,
                         double threshold) {
  return a + (threshold - value_a) / (value_b - value_a) * (b - a);
}

// Returns the length of the line within a triangle on which a value, linear between its corners, equals the
// threshold: it cuts off the one corner on its own side.
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

// Returns the share of an edge on which a value, linear between its ends, exceeds the threshold.
double fraction_above(double from, double to, double threshold) {
  const bool first = from > threshold, last = to > threshold;
  if (first == last) return first ? 1 : 0;
  const double crossed = (threshold - from) / (to - from);
  return first ? crossed : 1 - crossed;
}

// Places copies side by side along the first coordinate.
void place_apart(std::vector<Eigen::Vector2d>& at, int copies) {
  const std::size_t each = at.size() / copies;
  const auto first = at.begin(), end = first + static_cast<std::ptrdiff_t>(each);
  const auto by_x = [](const auto& a, const auto& b) { return a.x() < b.x(); };
  const auto [low, high] = std::minmax_element(first, end, by_x);
  const double from = low->x(), stride = 1.1 * (high->x() - from);
  for (std::size_t i = 0; i < at.size(); ++i)
    at[i] = {at[i % each].x() + static_cast<double>(i / each) * stride, at[i % each].y()};
}

// The weight exp(-pi (r/(alpha cutoff))^2) with alpha^2 = ln 2/pi is exp(-kDecay (r/cutoff)^2).
constexpr double kDecay = std::numbers::pi * std::numbers::pi / std::numbers::ln2;
constexpr double kReach = 0.6;  // over the cutoff; weights beyond are below 0.6 %
constexpr double kTail = 0.05;

// Returns normals at the vertices, of length twice the areas of the triangles around them [m^2].
std::vector<Eigen::Vector3d> vertex_normals(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x) {
  std::vector<Eigen::Vector3d> normal(x.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& t : mesh.face) {
    const Eigen::Vector3d n = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (int k = 0; k < 3; ++k) normal[t[k]] += n;
  }
  return normal;
}

// Finds the vertices that a path along edges reaches without leaving the ball of this radius around one [m].
class Neighbourhood {
 public:
  Neighbourhood(const ClothMesh& mesh, double radius)
      : mesh_(mesh), radius_(radius), seen_(mesh.vertices(), -1) {}

  const std::vector<int>& around(int vertex) {
    found_ = {vertex};
    seen_[vertex] = vertex;
    for (std::size_t i = 0; i < found_.size(); ++i)
      for (int k = mesh_.vertex_faces.start[found_[i]]; k < mesh_.vertex_faces.start[found_[i] + 1]; ++k)
        for (const int n : mesh_.face[mesh_.vertex_faces.item[k] / 3]) visit(n, vertex);
    return found_;
  }

 private:
  void visit(int n, int vertex) {
    if (seen_[n] == vertex || (mesh_.rest[n] - mesh_.rest[vertex]).norm() > radius_) return;
    seen_[n] = vertex;
    found_.push_back(n);
  }

  const ClothMesh& mesh_;
  const double radius_;
  std::vector<int> seen_;  // by vertex: the last search that reached it
  std::vector<int> found_;
};

// Returns the weighted percentile of ascending values, interpolated between the middles of two neighbours.
double percentile(const std::vector<std::pair<double, double>>& values, double share) {
  double sum = 0, below = 0;
  for (const auto& [value, weight] : values) sum += weight;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double middle = below + values[i].second / 2;
    if (middle >= share * sum) {
      if (i == 0) return values[i].first;
      const double gap = (values[i - 1].second + values[i].second) / 2;
      return values[i].first - (middle - share * sum) / gap * (values[i].first - values[i - 1].first);
    }
    below += values[i].second;
  }
  return values.back().first;
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

double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold,
                    const std::vector<int>& faces) {
  double outline = 0;
  std::vector<char> chosen(mesh.faces(), 0);
  for (const int f : faces) {
    const Eigen::Vector3i& t = mesh.face[f];
    outline += contour_length(mesh.corners(f), {value[t[0]], value[t[1]], value[t[2]]}, threshold);
    chosen[f] = 1;
  }
  for (int e = mesh.interior_edges; e < static_cast<int>(mesh.edge.size()); ++e) {
    const Edge& edge = mesh.edge[e];
    if (chosen[edge.face0])
      outline += mesh.edge_length(e) * fraction_above(value[edge.p2], value[edge.p3], threshold);
  }
  return outline / 2;
}

double ridge_length(const ClothMesh& mesh, const std::vector<float>& value, double threshold) {
  std::vector<int> all(mesh.faces());
  std::iota(all.begin(), all.end(), 0);
  return ridge_length(mesh, value, threshold, all);
}

double ridge_height(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x,
                    const std::vector<int>& vertices, double cutoff) {
  const std::vector<Eigen::Vector3d> normal = vertex_normals(mesh, x);
  Neighbourhood near(mesh, kReach * cutoff);
  std::vector<std::pair<double, double>> heights;  // pairs of height and the area that it represents
  for (const int v : vertices) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero(), up = middle;
    double sum = 0;
    for (const int n : near.around(v)) {
      const double away = (mesh.rest[n] - mesh.rest[v]).norm() / cutoff;
      const double weight = std::exp(-kDecay * away * away);
      sum += weight * mesh.vertex_area[n];
      middle += weight * mesh.vertex_area[n] * x[n];
      up += weight * normal[n];
    }
    heights.emplace_back((x[v] - middle / sum).dot(up.normalized()), mesh.vertex_area[v]);
  }
  std::sort(heights.begin(), heights.end());
  return percentile(heights, 1 - kTail) - percentile(heights, kTail);
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
