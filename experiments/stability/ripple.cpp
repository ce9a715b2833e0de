#include "experiments/stability/ripple.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "sim/base/error.h"
#include "sim/bending/angle.h"
#include "sim/bending/curvature_operator.h"
#include "sim/identification/decay_shape.h"
#include "sim/scene/scene_reader.h"
#include "sim/time/simulation.h"

namespace hysteron::experiments {
namespace {

constexpr double kRipplePi = 3.14159265358979323846;
constexpr double kRippleSide =
    0.04;  // side of the square [m]; its ripples of k0 = 8/m stretch it by less than 1e-5
constexpr int kRippleTriangles = 128;  // few enough for a dense matrix of all modes
constexpr double kNoTurn = 1e-3;       // smaller relative amplitudes are not followed

Scene ripple_scene(const RippleCase& of) {
  Scene scene = default_scene();
  scene.cloth.length = kRippleSide;
  scene.triangles = kRippleTriangles;
  scene.mesh = "equilateral";
  scene.element = BendingElement::hinge;
  scene.law = of.law;
  scene.integrator = of.integrator;
  scene.fabric.damping = 0;
  scene.air_drag = 0;
  scene.gravity.setZero();
  scene.device = DeviceChoice::cpu;
  scene.threads = 1;
  scene.newton_residual = 1e-9;
  scene.newton_velocity = 1e-12;
  return scene;
}

struct Mode {
  double frequency = 0;                 // at rigidity b1 [rad/s]
  std::vector<double> height;           // by vertex, for a largest curvature of 1/m [m^2]
  std::vector<double> weight;           // by vertex: amplitude = sum of weight times height
  std::vector<double> area, curvature;  // by hinge: area [m^2], curvature relative to the largest
};

// Returns the rate of each hinge's curvature with the height of each vertex of the flat cloth [1/m^2].
Eigen::MatrixXd curvature_rates(const ClothMesh& mesh, const CurvatureOperator& op) {
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(op.elements(), mesh.vertices());
  for (int i = 0; i < op.elements(); ++i)
    for (int j = op.hinge.start[i]; j < op.hinge.start[i + 1]; ++j) {
      const int h = op.hinge.item[j];
      const auto [p0, p1, p2, p3] = rest_hinge(mesh, h);
      const Angle<double> a = dihedral_angle<double>(p0, p1, p2, p3);
      const double packed[] = {a.g0.x(), a.g0.y(), a.g0.z(), a.g1.x(), a.g1.y(), a.g1.z(), a.t0, a.t1};
      const Edge& e = mesh.edge[h];
      const int vertices[] = {e.p0, e.p1, e.p2, e.p3};
      for (int corner = 0; corner < 4; ++corner)
        rates(i, vertices[corner]) += op.coefficient[j] * angle_gradient<double>(packed, corner).z();
    }
  return rates;
}

Mode highest_mode(const Scene& scene, const ClothMesh& mesh) {
  const CurvatureOperator op =
      make_curvature_operator(scene.element, mesh, std::vector<char>(mesh.vertices()));
  const Eigen::MatrixXd rates = curvature_rates(mesh, op);
  const Eigen::VectorXd areas = Eigen::Map<const Eigen::VectorXd>(op.area.data(), op.elements());
  Eigen::VectorXd mass(mesh.vertices());
  for (int i = 0; i < mesh.vertices(); ++i) mass[i] = scene.fabric.density * mesh.vertex_area[i];
  const Eigen::MatrixXd stiffness = scene.fabric.b1 * rates.transpose() * areas.asDiagonal() * rates;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness,
                                                                        mass.asDiagonal().toDenseMatrix());
  Eigen::VectorXd height = modes.eigenvectors().rightCols(1);
  height /= (rates * height).cwiseAbs().maxCoeff();
  const Eigen::VectorXd curvature = rates * height,
                        weight = mass.cwiseProduct(height) / (mass.dot(height.cwiseAbs2()));
  const auto list = [](const Eigen::VectorXd& v) {
    return std::vector<double>(v.data(), v.data() + v.size());
  };
  return {std::sqrt(modes.eigenvalues()[mesh.vertices() - 1]), list(height), list(weight), op.area,
          list(curvature)};
}

// Returns the energy lost in a loop of this amplitude [1/m], at most k0 [J/m^2].
double loop_area(const std::string& law, const VirginCurve& curve, double amplitude) {
  const double cubic = std::abs(curve.c1()) * amplitude * amplitude * amplitude;
  if (law == "prandtl") return 4.0 / 3 * cubic;
  if (law == "linear") return 0;
  const double a = amplitude / curve.k0;  // closed form for `wong`: docs/model.md
  return 8.0 / 3 * cubic / (1 + (2 * a - 1 + std::sqrt(1 + 4 * a - 4 * a * a)) / 2);
}

// Returns the decay by the energy balance of one mode, dA/dn = -losses over d(stored)/dA, as in free_decay.h
// of `accuracy`.  Friction is assumed to leave the mode's shape as it is.
double closed_form_decay(const RippleCase& of, const Scene& scene, const Mode& mode) {
  if (of.law != "linear" && of.law != "prandtl" && of.law != "wong") return NAN;
  const VirginCurve curve = scene.fabric.virgin_curve();
  const auto rate = [&](double amplitude) {
    double loss = 0, slope = 0;
    for (std::size_t i = 0; i < mode.area.size(); ++i) {
      const double shape = std::abs(mode.curvature[i]), k = amplitude * curve.k0 * shape;
      loss += mode.area[i] * loop_area(of.law, curve, k);
      slope += mode.area[i] * (curve.b1 - (curve.b1 - curve.b2) * k / curve.k0) * k * curve.k0 * shape;
    }
    return loss / slope;
  };
  constexpr int kParts = 16;  // steps per period of the second-order method
  double amplitude = of.amplitude;
  for (int i = 0; i < kRipplePeriods * kParts; ++i) {
    const double middle = amplitude - rate(amplitude) / (2 * kParts);
    amplitude -= rate(middle) / kParts;
  }
  return 1 - std::pow(amplitude / of.amplitude, 1.0 / kRipplePeriods);
}

struct Decay {
  std::vector<double> times, amplitudes;  // [s], relative to the first
  double per_period = 0;
};

// Follows a motion through 2 kRipplePeriods + 1 reversals, or until there are no more.
Decay decay_of(const RippleCase& of, const Scene& scene, const Cloth& flat, const Mode& mode) {
  Cloth cloth = flat;
  const double first = of.amplitude * scene.fabric.k0;
  for (std::size_t i = 0; i < mode.height.size(); ++i) cloth.start[i].z() += first * mode.height[i];
  const auto simulation = make_simulation(scene, cloth);
  const auto amplitude = [&] {
    const std::vector<Eigen::Vector3d> x = simulation->positions();
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += mode.weight[i] * x[i].z();
    return sum / first;
  };
  const double slowest = 2 * kRipplePi / mode.frequency * std::sqrt(scene.fabric.b1 / scene.fabric.b2);
  std::vector<double> time = {0}, series = {1};
  while (time.back() < (kRipplePeriods + 1) * slowest) {
    simulation->advance(1);
    time.push_back(simulation->time());
    series.push_back(amplitude());
  }
  Decay decay{{0}, {1}};
  for (const Amplitude& a : turning_amplitudes(turning_points(time, series, kNoTurn))) {
    if (a.turn >= 2 * kRipplePeriods) break;
    decay.times.push_back(a.time);
    decay.amplitudes.push_back(a.value);
    decay.per_period = 1 - std::pow(a.value, 2.0 / (a.turn + 1));  // reversal 0 is half a period
  }
  if (decay.times.size() == 1) decay.per_period = 1;
  return decay;
}

}  // namespace

Ripple measure_ripple(const RippleCase& of) {
  Ripple ripple{of};
  Scene scene = ripple_scene(of);
  const Cloth flat = make_cloth(scene);
  const Mode mode = highest_mode(scene, flat.mesh);
  // Numerical damping depends on steps per period, and friction makes cloth stiffer, so each law uses its own
  // period.
  const Fabric& fabric = scene.fabric;
  const double softer = of.law == "linear" ? std::sqrt(fabric.b1 / fabric.b2) : 1;
  ripple.step = 2 * kRipplePi / mode.frequency * softer / of.steps_per_period;
  ripple.closed_form = closed_form_decay(of, scene, mode);
  try {
    scene.step = ripple.step;
    Decay decay = decay_of(of, scene, flat, mode);
    ripple.times = std::move(decay.times);
    ripple.amplitudes = std::move(decay.amplitudes);
    ripple.decay = decay.per_period;
    scene.step /= 2;
    ripple.control = decay_of(of, scene, flat, mode).per_period;
  } catch (const Error& error) {
    if (error.exit_code() == 1) throw;
    ripple.failed = error.what();
  }
  return ripple;
}

RippleVerdict ripple_verdict(const std::vector<Ripple>& ripples) {
  double shortest = INFINITY;
  for (const Ripple& r : ripples) shortest = std::min(shortest, 1 / r.of.steps_per_period);
  const auto counts = [&](const Ripple& r) {
    return r.failed.empty() && 1 / r.of.steps_per_period == shortest;
  };
  RippleVerdict least{INFINITY, 0};
  for (const Ripple& without : ripples) {
    if (!counts(without) || without.of.law != "linear") continue;
    for (const Ripple& with : ripples) {
      const bool same =
          with.of.integrator == without.of.integrator && with.of.amplitude == without.of.amplitude;
      if (!counts(with) || !same || with.of.law == "linear") continue;
      const RippleVerdict one{with.decay - without.decay, std::abs(with.change() - without.change())};
      if (one.margin() < least.margin()) least = one;
    }
  }
  return least;
}

std::vector<RippleCase> ripple_cases(const std::vector<std::string>& integrators,
                                     const std::vector<std::string>& laws, bool quick) {
  std::vector<RippleCase> cases;
  std::vector<std::string> all = {"linear"};
  for (const std::string& law : laws)
    if (law != "linear") all.push_back(law);
  for (const std::string& integrator : integrators)
    for (const double amplitude : quick ? std::vector<double>{1} : std::vector<double>{1, 0.1})
      for (const std::string& law : all)
        for (const double steps : {20.0, 80.0})
          cases.push_back({value_named<Integrator>(integrator), law, amplitude, steps});
  return cases;
}

}  // namespace hysteron::experiments
