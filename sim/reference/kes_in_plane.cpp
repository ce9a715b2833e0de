#include "sim/reference/kes_in_plane.h"

#include <fmt/core.h>

#include <cmath>

#include "sim/base/error.h"

namespace hysteron {
namespace {

constexpr int kBisections = 60;
constexpr double kMaxExtension = 2;
// The way back ends at this share of the largest tension: cloth without tension is in equilibrium anywhere.
constexpr double kLeftOver = 1e-4;

StopsLaw beside(double spring, const Spectrum& stops) {
  return {spring, stops.thresholds, stops.stiffnesses};
}

// Makes the law's limits grow by `growth` times themselves per unit of strain.
StopsLaw growing(StopsLaw law, double growth) {
  if (growth > 0)
    for (const double r : law.thresholds) law.growths.push_back(growth * r);
  return law;
}

// Returns the root of an increasing function between low and high.
template <class Function>
double root(const Function& of, double low, double high) {
  for (int i = 0; i < kBisections; ++i) {
    const double middle = (low + high) / 2;
    (of(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

// One component with its memory.
struct Component {
  explicit Component(StopsLaw of) : law(std::move(of)), anchors(law.stops(), 0.0) {}
  double stress(double strain) const { return respond(law, anchors.data(), strain).response; }
  void accept(double strain) { hysteron::accept(law, anchors.data(), strain); }

  StopsLaw law;
  std::vector<double> anchors;
};

double green_lagrange_strain(double stretch, double shear) {
  return (stretch * stretch + shear * shear - 1) / 2;
}

KesProtocol as_bending(const InPlaneProtocol& p, double width_at) {
  KesProtocol protocol;
  const auto shear = [](double degrees) { return std::tan(degrees * kDegree); };
  protocol.amplitude = shear(p.angle);
  protocol.slope_from = shear(p.slope_from);
  protocol.slope_to = shear(p.slope_to);
  protocol.width_at = shear(width_at);
  protocol.cycles = 1;
  return protocol;
}

// Walks one cycle from rest through equal angles.
KesWalk shear_walk(const InPlaneProtocol& p) {
  KesWalk walk{{LawRow{0, 0, false}}, {0}};
  for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, -1), std::pair(-1, 1)}) {
    const int count = p.steps * std::abs(to - from);
    for (int i = 1; i <= count; ++i)
      walk.rows.push_back({std::tan(p.angle * kDegree * (from + double(to - from) * i / count)), 1, false});
    walk.start.push_back(walk.rows.size() - 1);
  }
  return walk;
}

double extension_work(const std::vector<double>& extension, const std::vector<double>& force,
                      std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = from + 1; i <= to; ++i)
    sum += (force[i - 1] + force[i]) / 2 * (extension[i] - extension[i - 1]);
  return sum;
}

}  // namespace

InPlaneLaw in_plane_law(const Fabric& fabric, Along along) {
  const InPlaneStops& stops = fabric.in_plane;
  return {along == Along::warp ? beside(fabric.warp, stops.warp) : beside(fabric.weft, stops.weft),
          growing(beside(fabric.shear, stops.shear), stops.shear_growth)};
}

ShearReading read_shear(const InPlaneProtocol& p, const KesWalk& walk, const std::vector<double>& force) {
  const KesProtocol first = as_bending(p, p.width_at);
  const KesReading reading = read_loop(first, walk, force);
  const double radians = (p.slope_to - p.slope_from) * kDegree;
  return {reading.rigidity * (first.slope_to - first.slope_from) / radians, reading.loop_width,
          read_loop(as_bending(p, p.second_width_at), walk, force).loop_width, reading.loop_area};
}

TensionReading read_tension(const std::vector<double>& extension, const std::vector<double>& force,
                            std::size_t turn) {
  TensionReading reading;
  reading.work = extension_work(extension, force, 0, turn);
  reading.linearity = reading.work / (force[turn] * extension[turn] / 2);
  reading.resilience = -100 * extension_work(extension, force, turn, force.size() - 1) / reading.work;
  reading.extension = 100 * extension[turn];
  return reading;
}

ShearTest test_shear(const InPlaneLaw& law, const InPlaneProtocol& p) {
  ShearTest test;
  test.walk.shear = shear_walk(p);
  Component tension(law.tension), shear(law.shear);
  for (const LawRow& row : test.walk.shear.rows) {
    const double g = row.curvature;
    const double stretch =
        root([&](double l) { return tension.stress(green_lagrange_strain(l, g)) * l - p.weight; }, 0.5,
             kMaxExtension);
    test.walk.stretch.push_back(stretch);
    test.force.push_back(shear.stress(g));
    tension.accept(green_lagrange_strain(stretch, g));
    shear.accept(g);
  }
  test.reading = read_shear(p, test.walk.shear, test.force);
  return test;
}

TensionTest test_tension(const InPlaneLaw& law, const InPlaneProtocol& p) {
  Component tension(law.tension);
  const auto force = [&](double extension) {
    return tension.stress(green_lagrange_strain(1 + extension, 0)) * (1 + extension);
  };
  if (force(kMaxExtension - 1) < p.largest)
    throw Error::invalid_input(
        fmt::format("load = {0:g} N/m stretches a fabric of {1:g} N/m to more than twice its length: it must "
                    "be < {2:g} N/m",
                    p.largest, law.tension.spring, force(kMaxExtension - 1)));
  TensionTest test;
  const auto go = [&](double extension) {
    test.extension.push_back(extension);
    test.force.push_back(force(extension));
    tension.accept(green_lagrange_strain(1 + extension, 0));
  };
  const double largest = root([&](double e) { return force(e) - p.largest; }, 0, kMaxExtension - 1);
  for (int i = 0; i <= p.steps; ++i) go(largest * i / p.steps);
  test.turn = test.force.size() - 1;
  const double slack = root([&](double e) { return force(e) - kLeftOver * p.largest; }, -0.5, largest);
  for (int i = 1; i <= p.steps; ++i) go(largest + (slack - largest) * i / p.steps);
  test.reading = read_tension(test.extension, test.force, test.turn);
  return test;
}

}  // namespace hysteron
