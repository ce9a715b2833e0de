#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace hysteron {

// Of no values: 0.
template <class Number>
double root_mean_square(const std::vector<Number>& values) {
  double square = 0;
  for (const Number value : values) square += static_cast<double>(value) * value;
  return std::sqrt(square / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

}  // namespace hysteron
