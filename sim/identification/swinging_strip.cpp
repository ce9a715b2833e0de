#include "sim/identification/swinging_strip.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sim/reference/fab_test.h"

namespace hysteron {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr int kElements = 10;        // cubic, shorter near the clamp: the first mode to 1e-4
constexpr double kGrading = 1.5;     // node i is at L (i/n)^kGrading
constexpr int kMostIterations = 16;  // of rigidities and mode in turn
constexpr double kSameMode = 1e-3;   // change of phi'' over its largest value at which they agree
constexpr double kRelaxed = 0.7;     // share of each new mode in the mean

// The abscissae and weights of Gauss on [0, 1].
constexpr std::array<double, 3> kGauss = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> kGaussWeight = {5.0 / 18, 8.0 / 18, 5.0 / 18};

// A cubic element of length h at x in [0, 1]: values, slopes, second derivatives.
struct Hermite {
  Vector4d value, slope, second;

  Hermite(double x, double h) {
    value << 1 - 3 * x * x + 2 * x * x * x, h * x * (1 - x) * (1 - x), x * x * (3 - 2 * x),
        h * x * x * (x - 1);
    slope << (-6 * x + 6 * x * x) / h, 1 - 4 * x + 3 * x * x, (6 * x - 6 * x * x) / h, x * (3 * x - 2);
    second << (-6 + 12 * x) / (h * h), (-4 + 6 * x) / h, (6 - 12 * x) / (h * h), (6 * x - 2) / h;
  }
};

// Returns the share of a stop's stiffness in a cycle that is 1/u times as large as the threshold.
double felt_part(double u) {
  if (u >= 1) return 1;
  const double cosine = 1 - 2 * u, sine = 2 * std::sqrt(u * (1 - u));
  return (std::acos(cosine) - sine * cosine) / std::numbers::pi;
}

double cycle_rigidity(double curvature, double spring, const Spectrum& stops) {
  double sum = spring;
  for (std::size_t j = 0; j < stops.size(); ++j)
    sum += stops.stiffnesses[j] *
           (curvature > stops.thresholds[j] ? felt_part(stops.thresholds[j] / curvature) : 1);
  return sum;
}

double stored_density(double curvature, double spring, const Spectrum& stops) {
  double sum = spring * curvature * curvature / 2;
  for (std::size_t j = 0; j < stops.size(); ++j) {
    const double held = std::min(curvature, stops.thresholds[j]);
    sum += stops.stiffnesses[j] * held * held / 2;
  }
  return sum;
}

}  // namespace

SwingingStrip::SwingingStrip(double length, double density) : density_(density) {
  const int n = 2 * (kElements + 1), per_element = static_cast<int>(kGauss.size());
  const auto node = [&](int i) { return length * std::pow(static_cast<double>(i) / kElements, kGrading); };
  MatrixXd mass = MatrixXd::Zero(n, n), tension = mass, second = MatrixXd::Zero(per_element * kElements, n);
  weight_.resize(second.rows());
  for (int e = 0; e < kElements; ++e)
    for (int g = 0; g < per_element; ++g) {
      const int row = per_element * e + g;
      const double h = node(e + 1) - node(e), below = length - node(e) - kGauss[g] * h;
      const Hermite f(kGauss[g], h);
      weight_[row] = kGaussWeight[g] * h;
      mass.block<4, 4>(2 * e, 2 * e) += weight_[row] * f.value * f.value.transpose();
      tension.block<4, 4>(2 * e, 2 * e) +=
          weight_[row] * density * kStandardGravity * below * f.slope * f.slope.transpose();
      second.block<1, 4>(row, 2 * e) = f.second.transpose();
    }
  mass_ = mass.bottomRightCorner(n - 2, n - 2);
  tension_ = tension.bottomRightCorner(n - 2, n - 2);
  second_ = second.rightCols(n - 2);
}

double SwingingStrip::iterate_mode(const VectorXd& rigidity, VectorXd& phi) const {
  constexpr int kInverse =
      3;  // steps of inverse iteration: the second mode's omega^2 is some ten times as high
  const MatrixXd stiffness =
      tension_ + second_.transpose() * weight_.cwiseProduct(rigidity).asDiagonal() * second_;
  const Eigen::LLT<MatrixXd> factor(stiffness);
  for (int i = 0; i < kInverse; ++i) {
    phi = factor.solve(mass_ * phi);
    phi /= phi[phi.size() - 2];
  }
  return std::sqrt(phi.dot(stiffness * phi) / (density_ * phi.dot(mass_ * phi)));
}

SwingState SwingingStrip::state(double amplitude, double spring, const Spectrum& stops, VectorXd& phi) const {
  SwingState state{amplitude};
  VectorXd bend = second_ * phi;
  for (int i = 0; i < kMostIterations; ++i) {
    VectorXd rigidity(bend.size()), next = phi;
    for (Eigen::Index q = 0; q < bend.size(); ++q)
      rigidity[q] = cycle_rigidity(amplitude * std::abs(bend[q]), spring, stops);
    state.omega = iterate_mode(rigidity, next);
    const double change = (second_ * next - bend).lpNorm<Eigen::Infinity>();
    phi += kRelaxed * (next - phi);
    bend = second_ * phi;
    if (change < kSameMode * bend.lpNorm<Eigen::Infinity>()) break;
  }
  for (Eigen::Index q = 0; q < bend.size(); ++q) {
    const double curvature = amplitude * std::abs(bend[q]);
    state.stored += weight_[q] * stored_density(curvature, spring, stops);
    state.lost += weight_[q] * stops.loop_area(curvature);
    state.curvature = std::max(state.curvature, curvature);
  }
  state.stored += amplitude * amplitude / 2 * phi.dot(tension_ * phi);
  state.square = phi.dot(mass_ * phi);
  state.bend = weight_.dot(bend.cwiseAbs());
  return state;
}

std::vector<SwingState> SwingingStrip::at(const std::vector<double>& amplitudes, double spring,
                                          const Spectrum& stops) const {
  VectorXd phi = VectorXd::Zero(mass_.rows());
  phi[phi.size() - 2] = 1;
  VectorXd stiff = VectorXd::Constant(weight_.size(), cycle_rigidity(0, spring, stops));
  iterate_mode(stiff, phi);
  std::vector<SwingState> states;
  for (const double amplitude : amplitudes) states.push_back(state(amplitude, spring, stops, phi));
  return states;
}

}  // namespace hysteron
