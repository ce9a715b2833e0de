// The root mean square of a field over a cloth, each value weighted by the area that it stands for.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace hysteron {

// `area` has one number for each element or vertex [m^2], `values` equally many components for each of them.
// The mean is over the area, so that it does not depend on the mesh; it is 0 without area.
template <class Number>
double root_mean_square(const std::vector<Number>& values, const std::vector<double>& area) {
  const std::size_t components = area.empty() ? 1 : values.size() / area.size();
  double square = 0, sum = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    double own = 0;
    for (std::size_t c = 0; c < components; ++c) {
      const double value = values[i * components + c];
      own += value * value;
    }
    square += area[i] * own;
    sum += area[i];
  }
  return sum > 0 ? std::sqrt(square / sum) : 0;
}

}  // namespace hysteron
