// CIELAB coordinates of sRGB pixels, by which eyes tell colours apart.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "render/srgb.h"

namespace hysteron::render {

// Returns L*, a*, b* over the white D65 (CIE 15:2004) of red, green and blue light, 1 for white.
inline Eigen::Vector3d lab_of_linear(const Eigen::Vector3d& light) {
  const Eigen::Matrix3d xyz{
      {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};  // IEC 61966-2-1
  const Eigen::Vector3d white = xyz * Eigen::Vector3d::Ones();
  const auto root = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (t * 24389 / 27 + 16) / 116; };
  const Eigen::Vector3d f = (xyz * light).cwiseQuotient(white).unaryExpr(root);
  return {116 * f.y() - 16, 500 * (f.x() - f.y()), 200 * (f.y() - f.z())};
}

inline Eigen::Vector3d lab(const std::uint8_t* rgb) {
  const auto& linear = linear_of_srgb8();
  return lab_of_linear({linear[rgb[0]], linear[rgb[1]], linear[rgb[2]]});
}

inline double lightness(const std::uint8_t* rgb) { return lab(rgb).x(); }

// Returns the CIE 1976 difference, which is the strictest for saturated colours.
inline double delta_e(const std::uint8_t* a, const std::uint8_t* b) { return (lab(a) - lab(b)).norm(); }

}  // namespace hysteron::render
