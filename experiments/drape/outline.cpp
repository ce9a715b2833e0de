#include "experiments/drape/outline.h"

#include <algorithm>
#include <cmath>

namespace hysteron::experiments {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Lengthens every ray that the edge a-b crosses to the crossing.
void mark_edge(const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::vector<double>& radius) {
  const int n = static_cast<int>(radius.size());
  const double from = std::atan2(a.y(), a.x());
  double turn = std::atan2(b.y(), b.x()) - from;  // the edge spans less than 180 degrees around the axis
  if (turn > kPi) turn -= 2 * kPi;
  if (turn < -kPi) turn += 2 * kPi;
  const double low = std::min(from, from + turn), high = std::max(from, from + turn);
  for (int k = static_cast<int>(std::ceil(low / (2 * kPi) * n)); k <= std::floor(high / (2 * kPi) * n); ++k) {
    const double angle = 2 * kPi * k / n;
    const Eigen::Vector2d d(std::cos(angle), std::sin(angle)), e = b - a;
    const double across = d.x() * e.y() - d.y() * e.x();
    if (across == 0) continue;
    const double r = (a.x() * e.y() - a.y() * e.x()) / across;
    double& longest = radius[((k % n) + n) % n];
    longest = std::max(longest, r);
  }
}

}  // namespace

double Outline::area() const {
  double sum = 0;
  for (double r : radius) sum += r * r;
  return sum * kPi / static_cast<double>(radius.size());
}

// Walks once around from the lowest point: each climb of more than `prominence` followed by such a descent is
// a fold.
int Outline::nodes(double prominence) const {
  const int n = static_cast<int>(radius.size());
  const int start = static_cast<int>(std::min_element(radius.begin(), radius.end()) - radius.begin());
  int folds = 0;
  bool climbing = true;
  double low = radius[start], high = radius[start];
  for (int k = 1; k <= n; ++k) {
    const double r = radius[(start + k) % n];
    if (climbing) {
      high = std::max(high, r);
      low = std::min(low, r);
      if (high - low > prominence && high - r > prominence) {
        ++folds;
        climbing = false;
        low = r;
      }
    } else {
      low = std::min(low, r);
      if (r - low > prominence) {
        climbing = true;
        high = r;
      }
    }
  }
  return folds;
}

Outline outline_from_above(const ClothMesh& mesh, const std::vector<Eigen::Vector3d>& x, int directions) {
  Outline outline{std::vector<double>(directions, 0)};
  const auto mark = [&](const Edge& e) { mark_edge(x[e.p2].head<2>(), x[e.p3].head<2>(), outline.radius); };
  for (const Edge& e : mesh.edge)
    if (!e.interior()) mark(e);
  // The border excludes most interior edges, which are too near to reach any ray's end.
  constexpr double kRounding = 1e-9;
  const double shortest = (1 - kRounding) * *std::min_element(outline.radius.begin(), outline.radius.end());
  for (const Edge& e : mesh.edge)
    if (e.interior() && std::max(x[e.p2].head<2>().norm(), x[e.p3].head<2>().norm()) >= shortest) mark(e);
  return outline;
}

double overlap(const Outline& a, const Outline& b) {
  double both = 0, either = 0;
  for (std::size_t k = 0; k < a.radius.size(); ++k) {
    const auto [inner, outer] = std::minmax(a.radius[k], b.radius[k]);
    both += inner * inner;
    either += outer * outer;
  }
  return both / either;
}

double drape_coefficient(double projected_area, double disc_radius, double specimen_radius) {
  const double disc = kPi * disc_radius * disc_radius, specimen = kPi * specimen_radius * specimen_radius;
  return 100 * (projected_area - disc) / (specimen - disc);
}

}  // namespace hysteron::experiments
