#include "render/flip.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/color_map.h"
#include "render/compare.h"
#include "render/srgb.h"
#include "sim/base/error.h"

namespace hysteron::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kColorExponent = 0.7;         // q_c
constexpr double kKnee = 0.4;                  // p_c, share of the largest colour difference
constexpr double kKneeError = 0.95;            // p_t, error that this share is mapped to
constexpr double kFeatureWidth = 0.082;        // w [degree], width of the edges and points
constexpr double kFeatureExponent = 0.5;       // q_f
constexpr double kMinPpd = 1, kMaxPpd = 1000;  // [pixels/degree]: filters of 3 to 273 pixels

constexpr int kSerialRows = 64;  // pictures of so few rows are done before threads have started

// ------------------------------------------------------------------------------------------- colour spaces

// Returns the XYZ of a colour of unit luminance.
Eigen::Vector3d xyz_of_chromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

// Returns the matrix from linear sRGB to X/Xn, Y/Yn, Z/Zn, by the primaries of IEC 61966-2-1 and the white
// D65 (CIE 15:2004): full red, green and blue together are that white.
Eigen::Matrix3d relative_xyz_of_rgb() {
  const Eigen::Vector3d white = xyz_of_chromaticity(0.31271, 0.32902);
  Eigen::Matrix3d primaries;
  primaries << xyz_of_chromaticity(0.64, 0.33), xyz_of_chromaticity(0.30, 0.60),
      xyz_of_chromaticity(0.15, 0.06);
  const Eigen::Vector3d primary_luminances = primaries.inverse() * white;
  return white.cwiseInverse().asDiagonal() * primaries * primary_luminances.asDiagonal();
}

// The matrix from relative XYZ to luminance, red-green and blue-yellow is YyCxCz (CIE 1976 without its roots,
// Flohr et al. 1993) with Y/Yn in place of Yy = 116 Y/Yn - 16, because filters that keep constants commute
// with both.
const Eigen::Matrix3d kOpponent{{0, 1, 0}, {500, -500, 0}, {0, 200, -200}};

// Returns the L*a*b* of relative XYZ (CIE 15:2004).
Eigen::Vector3d cie_lab(const Eigen::Vector3d& xyz) {
  constexpr double kDelta = 6.0 / 29;
  const auto root = [](double t) {
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double x = root(xyz.x()), y = root(xyz.y()), z = root(xyz.z());
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// Chroma counts less in the dark (Hunt 1952).
Eigen::Vector3d hunt_adjusted(const Eigen::Vector3d& lab) {
  return {lab.x(), 0.01 * lab.x() * lab.y(), 0.01 * lab.x() * lab.z()};
}

// HyAB is city-block in lightness, Euclidean in the plane of a* and b* (Abasi, Tehran, Fairchild 2020).
double hyab(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::abs(a.x() - b.x()) + std::hypot(a.y() - b.y(), a.z() - b.z());
}

// --------------------------------------------------------------------------------------------- perception

// A contrast sensitivity as a sum of Gaussians, weight a sqrt(pi / b) exp(-pi^2 d^2 / b) at the angle d
// [degree] (Andersson et al. 2020, spatial filtering).
struct Sensitivity {
  struct Term {
    double a, b;  // b [degree^2]
  };
  std::vector<Term> terms;
};
const std::array<Sensitivity, 3> kSensitivities = {
    Sensitivity{{{1, 0.0047}}},                 // luminance
    Sensitivity{{{1, 0.0053}}},                 // red-green
    Sensitivity{{{34.1, 0.04}, {13.5, 0.025}}}  // blue-yellow
};
constexpr double kWidest = 0.04;  // the largest b: one radius serves all filters

double kernel_sigma(double b, double ppd) { return ppd * std::sqrt(b / (2 * kPi * kPi)); }

Plane seen(const Plane& plane, const Sensitivity& sensitivity, double ppd) {
  const int radius = static_cast<int>(std::ceil(3 * kernel_sigma(kWidest, ppd)));
  Plane sum(plane.width, plane.height);
  double total = 0;
  for (const Sensitivity::Term& term : sensitivity.terms) {
    const Kernel kernel = gaussian_kernel(kernel_sigma(term.b, ppd), radius);
    const double height = 1 / kernel[static_cast<size_t>(radius)];  // its unscaled weights sum to this
    const double weight = term.a * std::sqrt(kPi / term.b) * height * height;
    const Plane part = filtered(plane, kernel, kernel);
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += weight * part.values[i];
    total += weight;
  }
  for (double& value : sum.values) value /= total;
  return sum;
}

// The planes of luminance, red-green and blue-yellow of a picture.
using Opponent = std::array<Plane, 3>;

Opponent opponent_colors(const Image& image) {
  const Eigen::Matrix3d m = kOpponent * relative_xyz_of_rgb();
  const auto& linear = linear_of_srgb8();
  Opponent planes;
  planes.fill(Plane(image.width(), image.height()));
#pragma omp parallel for schedule(static) if (image.height() > kSerialRows)
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const std::uint8_t* p = image.at(x, y);
      const Eigen::Vector3d color = m * Eigen::Vector3d(linear[p[0]], linear[p[1]], linear[p[2]]);
      for (int c = 0; c < 3; ++c) planes[c].row(y)[x] = color[c];
    }
  return planes;
}

// Returns the Hunt-adjusted L*a*b* that an eye perceives at each pixel.
Opponent perceived(const Opponent& picture, double ppd) {
  Opponent planes;
  for (int c = 0; c < 3; ++c) planes[c] = seen(picture[c], kSensitivities[c], ppd);
  const Eigen::Matrix3d xyz_from_rgb = relative_xyz_of_rgb(),
                        rgb_from_opponent = (kOpponent * xyz_from_rgb).inverse();
#pragma omp parallel for schedule(static) if (planes[0].height > kSerialRows)
  for (int y = 0; y < planes[0].height; ++y)
    for (int x = 0; x < planes[0].width; ++x) {
      const Eigen::Vector3d opponent(planes[0].row(y)[x], planes[1].row(y)[x], planes[2].row(y)[x]);
      const Eigen::Vector3d rgb = (rgb_from_opponent * opponent).cwiseMax(0.0).cwiseMin(1.0);
      const Eigen::Vector3d lab = hunt_adjusted(cie_lab(xyz_from_rgb * rgb));
      for (int c = 0; c < 3; ++c) planes[c].row(y)[x] = lab[c];
    }
  return planes;
}

// Returns the largest HyAB^q_c in the gamut, between green and blue.
double largest_color_difference() {
  const auto of = [](const Eigen::Vector3d& rgb) {
    return hunt_adjusted(cie_lab(relative_xyz_of_rgb() * rgb));
  };
  return std::pow(hyab(of({0, 1, 0}), of({0, 0, 1})), kColorExponent);
}

// Maps differences to errors by two straight pieces: the small differences get most of the range.
double redistributed(double difference, double largest) {
  const double knee = kKnee * largest;
  return difference < knee ? kKneeError / knee * difference
                           : kKneeError + (difference - knee) / (largest - knee) * (1 - kKneeError);
}

// ------------------------------------------------------------------------------------------ edges, points

// Scales weights so that the positive ones sum to 1 and the negative ones to -1.
Kernel balanced(Kernel kernel) {
  double positive = 0, negative = 0;
  for (double weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
  for (double& weight : kernel) weight /= weight > 0 ? positive : negative;
  return kernel;
}

struct FeatureKernels {
  Kernel smooth, edge, point;  // a Gaussian, its first and its second derivative
};

FeatureKernels feature_kernels(double ppd) {
  const double sigma = 0.5 * kFeatureWidth * ppd;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  FeatureKernels kernels{gaussian_kernel(sigma, radius), {}, {}};
  for (int d = -radius; d <= radius; ++d) {
    const double height = std::exp(-0.5 * d * d / (sigma * sigma));
    kernels.edge.push_back(-d * height);
    kernels.point.push_back((d * d / (sigma * sigma) - 1) * height);
  }
  kernels.edge = balanced(std::move(kernels.edge));
  kernels.point = balanced(std::move(kernels.point));
  return kernels;
}

Plane length(Plane x, const Plane& y) {
  for (size_t i = 0; i < x.values.size(); ++i)
    x.values[i] = std::sqrt(x.values[i] * x.values[i] + y.values[i] * y.values[i]);
  return x;
}

// The strength of edges and of points at each pixel.
struct Features {
  Plane edges, points;
};

Features luminance_features(const Plane& luminance, const FeatureKernels& kernels) {
  const auto [smooth, edge, point] = kernels;
  return {length(filtered(luminance, edge, smooth), filtered(luminance, smooth, edge)),
          length(filtered(luminance, point, smooth), filtered(luminance, smooth, point))};
}

void require_ppd(double ppd) {
  if (!(ppd >= kMinPpd && ppd <= kMaxPpd))
    throw Error::invalid_input("FLIP: " + std::to_string(ppd) + " pixels per degree must be in [1, 1000]");
}

}  // namespace

SeenPicture seen_picture(const Image& image, double pixels_per_degree) {
  require_ppd(pixels_per_degree);
  const Opponent opponent = opponent_colors(image);
  auto [edges, points] = luminance_features(opponent[0], feature_kernels(pixels_per_degree));
  return {perceived(opponent, pixels_per_degree), std::move(edges), std::move(points)};
}

Plane flip_map(const Image& a, const Image& b, double pixels_per_degree) {
  require_same_size(a, b);
  return flip_map(seen_picture(a, pixels_per_degree), seen_picture(b, pixels_per_degree));
}

Plane flip_map(const SeenPicture& a, const SeenPicture& b) {
  if (a.edges.width != b.edges.width || a.edges.height != b.edges.height)
    throw Error::invalid_input("FLIP: the two pictures differ in size");
  const double largest = largest_color_difference();
  Plane result(a.edges.width, a.edges.height);
#pragma omp parallel for schedule(static) if (result.height > kSerialRows)
  for (size_t i = 0; i < result.values.size(); ++i) {
    const auto color = [i](const Opponent& planes) {
      return Eigen::Vector3d(planes[0].values[i], planes[1].values[i], planes[2].values[i]);
    };
    const double color_error =
        redistributed(std::pow(hyab(color(a.color), color(b.color)), kColorExponent), largest);
    const double feature = std::max(std::abs(a.edges.values[i] - b.edges.values[i]),
                                    std::abs(a.points.values[i] - b.points.values[i]));
    const double feature_error = std::pow(feature / std::numbers::sqrt2, kFeatureExponent);
    result.values[i] = std::pow(color_error, 1 - feature_error);
  }
  return result;
}

Image heat_map(const Plane& errors) {
  std::array<Rgb8, 256> colors;
  for (int i = 0; i < 256; ++i) colors[i] = map_color8(ColorMap::sequential, static_cast<float>(i) / 255);
  Image result(errors.width, errors.height);
  for (int y = 0; y < errors.height; ++y)
    for (int x = 0; x < errors.width; ++x) {
      const double error = std::clamp(errors.row(y)[x], 0.0, 1.0);
      std::copy_n(colors[static_cast<size_t>(std::lround(255 * error))].data(), 3, result.at(x, y));
    }
  return result;
}

}  // namespace hysteron::render
