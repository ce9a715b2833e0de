#include "experiments/workbench/pictures/bent_part.h"

#include <cmath>

#include "experiments/workbench/pictures/frame_source.h"

namespace hysteron::experiments {
namespace {

constexpr double kEnlargement = 2.5, kLeastShare = 0.5;
constexpr double kSeenRadius = 20;                             // of folds [pixels]
constexpr int kBins = 8;                                       // of a part, along either side of it
constexpr int kSide = static_cast<int>(kBins * kEnlargement);  // bins of a cell, along either side of it

// A square of kBins by kBins of them.
struct Part {
  int x = 0, y = 0;
  double bending = -1;

  bool holds(const Eigen::Vector2i& bin) const {
    const Eigen::Vector2i at = bin - Eigen::Vector2i(x, y);
    return at.minCoeff() >= 0 && at.maxCoeff() < kBins;
  }
};

// Returns the bin of each vertex in a cell's picture; some may lie outside of it.
std::vector<Eigen::Vector2i> bins_of(const std::vector<float>& xyz, const SheetView& view) {
  const auto bin = [](double coordinate) { return static_cast<int>(std::floor(coordinate * kSide)); };
  std::vector<Eigen::Vector2i> bins;
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    const render::Window at = view.camera.image_window({&xyz[i], 3}, view.aspect);
    bins.emplace_back(bin(at.left), bin(at.bottom));
  }
  return bins;
}

Part most_bent(const std::vector<Eigen::Vector2i>& bins, const Bending& bending) {
  Eigen::Matrix<double, kSide, kSide> sum = Eigen::Matrix<double, kSide, kSide>::Zero();
  for (std::size_t i = 0; i < bins.size(); ++i)
    if (bins[i].minCoeff() >= 0 && bins[i].maxCoeff() < kSide) sum(bins[i].x(), bins[i].y()) += bending.at(i);
  Part most;
  for (int x = 0; x + kBins <= kSide; ++x)
    for (int y = 0; y + kBins <= kSide; ++y)
      if (const double there = sum.block<kBins, kBins>(x, y).sum(); there > most.bending)
        most = {x, y, there};
  return most;
}

struct Place {
  Eigen::Vector3f middle;  // of the bending [m]
  double curvature;        // root mean square [1/m]
};

Place place_of(const Part& part, const std::vector<Eigen::Vector2i>& bins, const std::vector<float>& xyz,
               const Bending& bending) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t i = 0; i < bins.size(); ++i) {
    if (!part.holds(bins[i])) continue;
    sum += bending.at(i) * Eigen::Vector3d(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    area += bending.area[i];
  }
  return {(sum / part.bending).cast<float>(), std::sqrt(part.bending / area)};
}

}  // namespace

double Bending::total() const {
  double sum = 0;
  for (std::size_t i = 0; i < area.size(); ++i) sum += at(i);
  return sum;
}

Bending bending_of(const std::vector<float>& xyz, const std::vector<int>& triangles) {
  return {shape_curvature(xyz, triangles), vertex_areas(triangles, xyz)};
}

std::optional<NearerView> bent_part(const std::vector<float>& xyz, const Bending& bending,
                                    const SheetView& view) {
  const std::vector<Eigen::Vector2i> bins = bins_of(xyz, view);
  const Part part = most_bent(bins, bending);
  if (!(part.bending > kLeastShare * bending.total())) return std::nullopt;
  const Place place = place_of(part, bins, xyz, bending);
  if (place.curvature * view.metres_per_pixel * kSeenRadius < 1) return std::nullopt;
  const render::Camera there = render::Camera::perspective(
      place.middle + view.camera.eye() - view.camera.target(), place.middle, view.camera.fov_degree());
  return nearer(there, there.metres_per_pixel(place.middle, view.height), kEnlargement, view);
}

}  // namespace hysteron::experiments
