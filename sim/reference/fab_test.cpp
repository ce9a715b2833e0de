#include "sim/reference/fab_test.h"

#include <algorithm>
#include <cmath>

#include "sim/reference/buckled_strip.h"

namespace hysteron {

namespace {

constexpr int kHalvings = 60;

// Returns the strain without force, between strains of push and of pull.
double strain_without_force(const StopsLaw& law, const double* anchors, double push, double pull) {
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (push + pull) / 2;
    (respond(law, anchors, middle).response < 0 ? push : pull) = middle;
  }
  return pull;
}

}  // namespace

StretchedStripTest::StretchedStripTest(StopsLaw law, double length)
    : law_(std::move(law)), length_(length), anchors_(law_.stops(), 0.0) {}

void StretchedStripTest::go_to(double distance) {
  double strain = distance / length_ - 1;
  if (respond(law_, anchors_.data(), strain).response < 0)
    strain = strain_without_force(law_, anchors_.data(), strain, strain_);
  const StopsPoint at = respond(law_, anchors_.data(), strain);
  strain_ = strain;
  force_ = distance / length_ - 1 < strain ? 0 : at.response;
  dissipated_ += length_ * at.dissipated;
  accept(law_, anchors_.data(), strain);
}

double StretchedStripTest::energy() const { return length_ * respond(law_, anchors_.data(), strain_).stored; }

namespace {

constexpr double kElement = 0.33e-3;  // length of an element [m]: forces to 0.1 % at a gauge of 2 cm
constexpr int kFewestElements = 32, kMaxElements = 256;  // number of elements of half a strip
constexpr double kStep = 0.02;  // step of the clamps over the gauge: history in between is monotone

// Sums the work of the clamps by the trapezoidal rule from one distance to the next.
class Work {
 public:
  double add(double distance, double force) {
    if (begun_) done_ += (force + force_) / 2 * (distance - distance_);
    begun_ = true;
    distance_ = distance;
    force_ = force;
    return done_;
  }

 private:
  bool begun_ = false;
  double done_ = 0, distance_ = 0, force_ = 0;
};

FabRun bent(const FabLoops& loops, const FabStrip& strip, int branches) {
  const double weight = kStandardGravity * strip.density;
  const int elements =
      std::clamp(static_cast<int>(std::lround(loops.gauge / 2 / kElement)), kFewestElements, kMaxElements);
  BuckledStripTest test(
      {strip.bending, loops.gauge, loops.bends_up() ? weight : -weight, elements, strip.most_halvings},
      loops.branches[0].distance[0], BuckledStripTest::Start::relaxed);
  FabRun run;
  const double before = test.energy();
  run.shapes.push_back(test.line());
  Work work;
  for (int b = 0; b < branches; ++b) {
    run.force.emplace_back();
    for (const double distance : loops.branches[b].distance) {
      test.go_to(distance, kStep);
      run.force.back().push_back(test.force());
      run.work = work.add(distance, test.force());
      run.largest_work = std::max(run.largest_work, std::abs(run.work));
    }
    run.shapes.push_back(test.line());
  }
  run.stored = test.energy() - before;
  run.dissipated = test.dissipated();
  return run;
}

FabRun stretched(const FabLoops& loops, const FabStrip& strip, int branches) {
  StretchedStripTest test(strip.stretch, loops.gauge);
  FabRun run;
  Work work;
  for (int b = 0; b < branches; ++b) {
    run.force.emplace_back();
    for (const double distance : loops.branches[b].distance) {
      test.go_to(distance);
      run.force.back().push_back(test.force());
      run.work = work.add(distance, test.force());
      run.largest_work = std::max(run.largest_work, std::abs(run.work));
    }
  }
  run.stored = test.energy();
  run.dissipated = test.dissipated();
  return run;
}

}  // namespace

FabRun run_fab(const FabLoops& loops, const FabStrip& strip, int branches) {
  const int all = static_cast<int>(loops.branches.size());
  const int count = branches < 0 ? all : std::min(branches, all);
  return loops.bends() ? bent(loops, strip, count) : stretched(loops, strip, count);
}

FabLoops made_up_loops(const std::string& test, double gauge, double slack,
                       const std::vector<double>& amplitudes, int steps) {
  FabLoops loops{"", test, gauge, 0, {}};
  const double first = loops.bends() ? gauge - slack : gauge;
  for (const double amplitude : amplitudes) {
    FabBranch out, back;
    const double end = loops.bends() ? gauge - amplitude : gauge + amplitude;
    for (int i = 0; i <= steps; ++i) {
      out.distance.push_back(first + (end - first) * i / steps);
      back.distance.push_back(end + (first - end) * i / steps);
    }
    out.force.assign(out.distance.size(), 0);
    back.force = out.force;
    loops.branches.push_back(out);
    loops.branches.push_back(back);
  }
  return loops;
}

}  // namespace hysteron
