#include "experiments/workbench/pictures/bent_part.h"

#include <array>
#include <cmath>

#include "experiments/workbench/pictures/frame_source.h"

namespace hysteron::experiments {
namespace {

constexpr double kEnlargement = 2.5, kLeastShare = 0.5;
constexpr double kSeenRadius = 20;                             // of folds [pixels]
constexpr int kBins = 8;                                       // of a part, along either side of it
constexpr int kSide = static_cast<int>(kBins * kEnlargement);  // bins of a cell, along either side of it

// Bending of what a cell's picture shows, by squares of it.
using Bins = std::array<std::array<double, kSide>, kSide>;

// A square of kBins by kBins of them.
struct Part {
  int x = 0, y = 0;
  double bending = -1;
};

// Returns the bin of one coordinate in a picture [0, 1], or -1 outside of it.
int bin_of(double coordinate) {
  const int bin = static_cast<int>(std::floor(coordinate * kSide));
  return bin < 0 || bin >= kSide ? -1 : bin;
}

Eigen::Vector2i bin_of(const float* vertex, const SheetView& view) {
  const render::Window at = view.camera.image_window({vertex, 3}, view.aspect);
  return {bin_of(at.left), bin_of(at.bottom)};
}

double& bin_at(Bins& bins, int x, int y) {
  return bins[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)];
}

Bins binned(const std::vector<float>& xyz, const Bending& bending, const SheetView& view) {
  Bins bins{};
  for (std::size_t i = 0; i < bending.area.size(); ++i)
    if (const Eigen::Vector2i at = bin_of(&xyz[3 * i], view); at.minCoeff() >= 0)
      bin_at(bins, at.x(), at.y()) += bending.at(i);
  return bins;
}

Part part_at(int x, int y, Bins& bins) {
  Part part{x, y, 0};
  for (int i = x; i < x + kBins; ++i)
    for (int j = y; j < y + kBins; ++j) part.bending += bin_at(bins, i, j);
  return part;
}

Part most_bent(Bins bins) {
  Part most;
  for (int x = 0; x + kBins <= kSide; ++x)
    for (int y = 0; y + kBins <= kSide; ++y)
      if (const Part part = part_at(x, y, bins); part.bending > most.bending) most = part;
  return most;
}

struct Place {
  Eigen::Vector3f middle;  // of the bending [m]
  double curvature;        // root mean square [1/m]
};

Place place_of(const Part& part, const std::vector<float>& xyz, const Bending& bending,
               const SheetView& view) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (std::size_t i = 0; i < bending.area.size(); ++i) {
    const Eigen::Vector2i bin = bin_of(&xyz[3 * i], view), at = bin - Eigen::Vector2i(part.x, part.y);
    if (bin.minCoeff() < 0 || at.minCoeff() < 0 || at.maxCoeff() >= kBins) continue;
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
  const Part part = most_bent(binned(xyz, bending, view));
  if (!(part.bending > kLeastShare * bending.total())) return std::nullopt;
  const Place place = place_of(part, xyz, bending, view);
  if (place.curvature * view.metres_per_pixel * kSeenRadius < 1) return std::nullopt;
  const Eigen::Vector3f direction = view.camera.eye() - view.camera.target();
  const auto from = [&](float distances) {
    return render::Camera::perspective(place.middle + distances * direction, place.middle,
                                       view.camera.fov_degree());
  };
  const double scale = from(1).metres_per_pixel(place.middle, view.height);
  return NearerView{from(static_cast<float>(view.metres_per_pixel / kEnlargement / scale)),
                    static_cast<float>(kEnlargement)};
}

}  // namespace hysteron::experiments
