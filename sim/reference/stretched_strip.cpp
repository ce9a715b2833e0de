#include "sim/reference/stretched_strip.h"

#include <algorithm>
#include <cmath>

namespace hysteron {
namespace {

constexpr int kHalvings = 60;

// Between strains of push and of pull.
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

}  // namespace hysteron
