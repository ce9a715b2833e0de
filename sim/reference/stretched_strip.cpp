#include "sim/reference/stretched_strip.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

// Newton's method on a curve of straight pieces ends after as many as there are, on the way down two a stop.
double strain_without_force(const StopsLaw& law, const double* anchors, double from) {
  double strain = from;
  for (int i = 0; i <= 2 * law.stops() + 1; ++i) {
    const StopsPoint at = respond(law, anchors, strain);
    strain -= at.response / at.tangent;
  }
  return strain;
}

}  // namespace

StretchedStripTest::StretchedStripTest(StopsLaw law, double length)
    : law_(std::move(law)), length_(length), anchors_(law_.stops(), 0.0) {}

void StretchedStripTest::go_to(double distance) {
  double strain = distance / length_ - 1;
  if (respond(law_, anchors_.data(), strain).response < 0)
    strain = strain_without_force(law_, anchors_.data(), strain_);
  const StopsPoint at = respond(law_, anchors_.data(), strain);
  strain_ = strain;
  force_ = distance / length_ - 1 < strain ? 0 : at.response;
  dissipated_ += length_ * at.dissipated;
  accept(law_, anchors_.data(), strain);
}

double StretchedStripTest::energy() const { return length_ * respond(law_, anchors_.data(), strain_).stored; }

}  // namespace hysteron
