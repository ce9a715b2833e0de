#include "sim/mesh/weld.h"

#include "sim/mesh/point_grid.h"

namespace hysteron {

std::vector<int> nearby_representatives(const std::vector<Eigen::Vector3d>& points, double distance) {
  PointGrid kept(points, distance);
  std::vector<int> representative;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    int lowest = i;
    kept.around(points[i], [&](int j) {
      if (j < lowest && (points[j] - points[i]).norm() < distance) lowest = j;
    });
    representative.push_back(lowest);
    if (lowest == i) kept.add(i, points[i]);
  }
  return representative;
}

}  // namespace hysteron
