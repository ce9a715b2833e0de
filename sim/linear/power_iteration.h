// Finds the largest eigenvalue of M^-1 K, the square of the highest frequency [1/s^2].
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "sim/device/host_device.h"

namespace hysteron {

// Iterates with Rayleigh quotients to a relative change of 1e-4, at most 400 products.  The quotient
// approaches from below, so that callers keep a margin. apply(v, w) sets w = K v; mass: n masses [kg];
// vertices with held flags do not move.
inline double largest_eigenvalue(
    const std::vector<double>& mass, const std::vector<char>& held,
    const std::function<void(const std::vector<Eigen::Vector3d>&, std::vector<Eigen::Vector3d>&)>& apply) {
  constexpr int kProducts = 400;
  constexpr double kConverged = 1e-4;
  const int n = static_cast<int>(mass.size());
  std::vector<Eigen::Vector3d> v(n), w(n);
  for (int i = 0; i < n; ++i)  // any vector with a share of every mode will do
    v[i] = Eigen::Vector3d(std::sin(1.0 + 7 * i), std::cos(2.0 + 3 * i), std::sin(5.0 * i + 0.5));
  double lambda = 0;
  for (int product = 0; product < kProducts; ++product) {
    double norm = 0;
    for (int i = 0; i < n; ++i) {
      if (held[i]) v[i].setZero();
      norm += mass[i] * v[i].squaredNorm();
    }
    if (norm == 0) return 0;
    for (auto& vi : v) vi /= std::sqrt(norm);
    apply(v, w);
    double quotient = 0;
    for (int i = 0; i < n; ++i) {
      quotient += v[i].dot(w[i]);
      v[i] = w[i] / mass[i];
    }
    const bool converged = std::abs(quotient - lambda) < kConverged * quotient;
    lambda = quotient;
    if (converged) break;
  }
  return lambda;
}

}  // namespace hysteron
