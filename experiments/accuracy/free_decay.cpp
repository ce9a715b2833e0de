#include "experiments/accuracy/free_decay.h"

#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/identification/decay_shape.h"

namespace hysteron::experiments {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLength = 0.075, kWidth = 0.015;  // [m]; the period is about a second
// Deflection of the free end over the length: at rotations of 1.6 degrees the beam's equation is linear to
// 1e-3.
constexpr double kDeflection = 0.02;
constexpr double kRigidity = 1.157e-5;  // rigidity at small curvatures [N m]

// The first zero of 1 + cos(x) cosh(x), and the weight of the mode's odd part (Blevins 1979, table 8-1).
constexpr double kBeta = 1.8751040687119611;
const double kOdd = (std::sinh(kBeta) - std::sin(kBeta)) / (std::cosh(kBeta) + std::cos(kBeta));

// Returns the distance from the clamp's middle to its inner column [m].
double clamp_offset(const CantileverStrip& flat) { return flat.scene.cloth.length - flat.length; }

// Downward deflection [m] of a strip whose free end is deflected by `end`, at a distance from the clamp's
// middle [m].
struct BentStrip {
  double end, length;
  double slack;  // distance of the clamp's middle from its inner column, where the cloth is still level [m]

  double deflection(double s) const {
    return end * (mode_deflection(s / length) - mode_deflection(slack / length));
  }
  // Returns how far [m] the deflection draws a point towards the clamp if lengths stay: half the integral of
  // the squared slope, by chords.
  double drawn(double s) const {
    constexpr int kChords = 64;
    const double step = (s - slack) / kChords;
    double sum = 0;
    for (int i = 0; i < kChords && step > 0; ++i) {
      const double rise = deflection(slack + (i + 1) * step) - deflection(slack + i * step);
      sum += rise * rise / (2 * step);
    }
    return sum;
  }
};

// Returns the weights of the vertices' deflections that extract the first mode: masses times mode, to which
// the higher modes are orthogonal.
std::vector<double> first_mode_weights(const CantileverStrip& flat) {
  std::vector<double> weight;
  double norm = 0;
  for (int i = 0; i < flat.cloth.mesh.vertices(); ++i) {
    const double s = flat.cloth.mesh.rest[i].x() - clamp_offset(flat), area = flat.cloth.mesh.vertex_area[i];
    const double mode = flat.cloth.pin[i] >= 0 ? 0 : mode_deflection(s / flat.length);
    weight.push_back(area * mode);
    norm += area * mode * mode;
  }
  for (double& w : weight) w /= norm;
  return weight;
}

}  // namespace

double mode_deflection(double xi) {
  const double a = kBeta * xi;
  return (std::cosh(a) - std::cos(a) - kOdd * (std::sinh(a) - std::sin(a))) / 2;
}

double mode_curvature(double xi) {
  const double a = kBeta * xi;
  return (std::cosh(a) + std::cos(a) - kOdd * (std::sinh(a) + std::sin(a))) / 2;
}

double mode_clamp_curvature(double length) { return kBeta * kBeta / length; }

double mode_frequency(double b, double density, double length) {
  return kBeta * kBeta * std::sqrt(b / density) / (length * length);
}

std::vector<double> mode_curvatures(int parts) {
  std::vector<double> result(parts);
  for (int i = 0; i < parts; ++i) result[i] = mode_curvature((i + 0.5) / parts);
  return result;
}

// Friction loses the loop's area, in closed form for both ranges of the amplitude (Prandtl-Ishlinskii:
// Whiteman 1959, Iwan 1966).  Viscosity loses pi c w A^2.
double DecayingBend::loss(double amplitude) const {
  const double k0 = curve.k0, a = amplitude;
  const double friction =
      a <= k0 ? 4.0 / 3 * std::abs(curve.c1()) * a * a * a : 4 * curve.friction_moment() * (a - 2 * k0 / 3);
  return friction + kPi * viscosity * frequency * a * a;
}

// With g = b1 - b2 the virgin curve's work up to A <= K0 is b1 A^2/2 - g A^3/(6 K0), of which g A^3/(6 K0) is
// dissipated; beyond K0 friction stores no more.
double DecayingBend::stored_slope(double amplitude) const {
  const double softer = amplitude < curve.k0 ? amplitude / curve.k0 : 1;
  return (curve.b1 - (curve.b1 - curve.b2) * softer) * amplitude;
}

std::vector<double> amplitudes_by_energy(const DecayingBend& bend, const std::vector<double>& shape,
                                         double first, int cycles) {
  const auto rate = [&](double amplitude) {
    double loss = 0, slope = 0;
    for (double fraction : shape) {
      loss += bend.loss(amplitude * fraction);
      slope += bend.stored_slope(amplitude * fraction) * fraction;
    }
    return slope > 0 ? -loss / slope : 0;
  };
  constexpr int kParts = 8;  // steps per cycle of the fourth-order method
  const double h = 1.0 / kParts;
  std::vector<double> result = {first};
  double a = first;
  for (int i = 1; i <= cycles * kParts; ++i) {
    const double k1 = rate(a), k2 = rate(std::max(0.0, a + h / 2 * k1));
    const double k3 = rate(std::max(0.0, a + h / 2 * k2)), k4 = rate(std::max(0.0, a + h * k3));
    a = std::max(0.0, a + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4));
    if (i % kParts == 0) result.push_back(a);
  }
  return result;
}

double decay_length() { return kLength; }
double decay_first_amplitude() { return kDeflection * mode_clamp_curvature(kLength); }

// The parameters make each kind lose about a third of its amplitude in 20 cycles.
Scene decay_scene(DecayKind kind) {
  Scene scene;
  scene.cloth.width = kWidth;
  scene.gravity.setZero();
  scene.law = kind == DecayKind::exponential ? "linear" : "prandtl";
  if (scene.law == "prandtl") scene.param["stops"] = "32";
  Fabric& fabric = scene.fabric;
  fabric.b1 = fabric.b2 = kRigidity;
  fabric.damping = 0;
  const double first = decay_first_amplitude();
  if (kind == DecayKind::hyperbolic) {
    fabric.k0 = 1.25 * first;
    fabric.b2 = 0.94 * kRigidity;
  } else if (kind == DecayKind::linear) {
    fabric.k0 = first / 50;
    fabric.b1 += 2 * (first * kRigidity / 400) / fabric.k0;  // gives M0 = b2 A_0/400
  } else {
    fabric.damping = 0.006 / mode_frequency(kRigidity, fabric.density, kLength);
  }
  return scene;
}

DecayingBend decaying_bend(const Scene& scene) {
  const Fabric& fabric = scene.fabric;
  return {fabric.virgin_curve(), fabric.damping * fabric.b1,
          mode_frequency(fabric.b2, fabric.density, kLength)};
}

double decay_period(const Scene& scene) {
  const VirginCurve curve = scene.fabric.virgin_curve();
  const double a = decay_first_amplitude();
  const double moment =
      a < curve.k0 ? (curve.b1 + curve.c1() * a) * a : curve.friction_moment() + curve.b2 * a;
  return 2 * kPi / mode_frequency(moment / a, scene.fabric.density, kLength);
}

// The mode's curvature begins at the clamp's middle, but the cloth is held level up to the clamp's inner
// column.
Cloth bent_in_first_mode(const CantileverStrip& flat) {
  Cloth cloth = flat.cloth;
  const double slack = clamp_offset(flat);
  const BentStrip strip{kDeflection * flat.length, flat.length, slack};
  for (std::size_t i = 0; i < cloth.start.size(); ++i) {
    if (cloth.pin[i] >= 0) continue;
    const double s = cloth.mesh.rest[i].x() - slack;
    cloth.start[i] -= Eigen::Vector3d(strip.drawn(s), 0, strip.deflection(s));
  }
  return cloth;
}

MeasuredDecay measure_decay(Simulation& simulation, const CantileverStrip& flat, int cycles) {
  const Scene& scene = flat.scene;
  const auto deflection = [&, weight = first_mode_weights(flat)] {
    const std::vector<Eigen::Vector3d> x = simulation.positions();
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += weight[i] * (flat.cloth.start[i].z() - x[i].z());
    return sum;
  };
  const double latest = 1.5 * decay_period(scene) * cycles;
  double before = deflection(), at = before, last_time = 0;
  MeasuredDecay decay{{at}, 0};
  for (long step = 0; static_cast<int>(decay.peaks.size()) <= cycles; ++step) {
    if (simulation.time() > latest)
      throw Error::simulation("decay: after " + std::to_string(latest) + " s the strip has come back " +
                              std::to_string(decay.peaks.size() - 1) + " times, not " +
                              std::to_string(cycles));
    simulation.advance(1);
    const double after = deflection();
    if (step > 0 && at > 0 && at >= before && at > after) {
      const Eigen::Vector2d peak = vertex_of_parabola(before, at, after);
      decay.peaks.push_back(peak.y());
      last_time = simulation.time() + (peak.x() - 1) * scene.step;
    }
    before = at, at = after;
  }
  decay.period = last_time / cycles;
  return decay;
}

}  // namespace hysteron::experiments
