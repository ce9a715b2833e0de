#include "experiments/workbench/pictures/ridge_metrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hysteron::experiments {
namespace {

// Nodes of a regular grid over the sheet, with the value there; NaN outside.
struct Raster {
  Eigen::Vector2d low;
  double spacing;
  int nx, ny;
  std::vector<float> value;

  Raster(const std::vector<Eigen::Vector2d>& at, double step) : spacing(step) {
    Eigen::Vector2d high = low = at[0];
    for (const Eigen::Vector2d& p : at) low = low.cwiseMin(p), high = high.cwiseMax(p);
    nx = static_cast<int>((high.x() - low.x()) / step) + 1;
    ny = static_cast<int>((high.y() - low.y()) / step) + 1;
    value.assign(static_cast<std::size_t>(nx) * ny, NAN);
  }
  float& at(int i, int j) { return value[static_cast<std::size_t>(j) * nx + i]; }

  void fill(const Eigen::Vector2d (&p)[3], const float (&v)[3]) {
    const Eigen::Vector2d e1 = p[1] - p[0], e2 = p[2] - p[0];
    const double area = e1.x() * e2.y() - e1.y() * e2.x();
    if (area == 0) return;
    const Eigen::Vector2d from = (p[0].cwiseMin(p[1]).cwiseMin(p[2]) - low) / spacing,
                          to = (p[0].cwiseMax(p[1]).cwiseMax(p[2]) - low) / spacing;
    for (int j = static_cast<int>(std::ceil(from.y())); j <= to.y() && j < ny; ++j)
      for (int i = static_cast<int>(std::ceil(from.x())); i <= to.x() && i < nx; ++i) {
        const Eigen::Vector2d d = low + spacing * Eigen::Vector2d(i, j) - p[0];
        const double s = (d.x() * e2.y() - d.y() * e2.x()) / area,
                     t = (e1.x() * d.y() - e1.y() * d.x()) / area;
        if (s < 0 || t < 0 || s + t > 1) continue;
        at(i, j) = static_cast<float>((1 - s - t) * v[0] + s * v[1] + t * v[2]);
      }
  }
};

// Runs of nodes above the threshold along lines, and the lines' length on the sheet in nodes.
struct Lines {
  long ridges = 0, nodes = 0;
  bool inside = false;
  void begin() { inside = false; }
  void visit(float value, double threshold) {
    const bool above = value > threshold;
    ridges += above && !inside;
    nodes += !std::isnan(value);
    inside = above;
  }
};

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

std::vector<Eigen::Vector2d> unrolled(const ClothMesh& mesh, const ClothShape& shape) {
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector3d& x : mesh.rest) {
    const double around = std::atan2(-x.y(), -x.z());
    result.push_back({x.x(), shape.shape == "tube" ? shape.radius * around : x.y()});
  }
  if (shape.copies > 1) place_apart(result, shape.copies);
  return result;
}

double ridge_length(const ClothMesh& mesh, const std::vector<Eigen::Vector2d>& at,
                    const std::vector<float>& value, double threshold, double spacing) {
  Raster raster(at, spacing);
  const double longest = spacing * std::max(raster.nx, raster.ny) / 4;
  double area = 0;
  for (int f = 0; f < mesh.faces(); ++f) {
    const Eigen::Vector3i& t = mesh.face[f];
    const Eigen::Vector2d p[3] = {at[t[0]], at[t[1]], at[t[2]]};
    if ((p[1] - p[0]).norm() > longest || (p[2] - p[0]).norm() > longest) continue;
    raster.fill(p, {value[t[0]], value[t[1]], value[t[2]]});
    area += mesh.face_area[f];
  }
  Lines lines;
  for (int j = 0; j < raster.ny; ++j) {
    lines.begin();
    for (int i = 0; i < raster.nx; ++i) lines.visit(raster.at(i, j), threshold);
  }
  for (int i = 0; i < raster.nx; ++i) {
    lines.begin();
    for (int j = 0; j < raster.ny; ++j) lines.visit(raster.at(i, j), threshold);
  }
  return lines.nodes > 0 ? std::numbers::pi / 2 * area * lines.ridges / (lines.nodes * spacing) : 0;
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
