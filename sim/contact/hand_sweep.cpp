#include "sim/contact/hand_sweep.h"

#include "sim/contact/self_touch.h"

namespace hysteron {

namespace {
constexpr double kNearer = 0.9;  // of the distance of layers that begin pressed as far as pressure can press
}  // namespace

template <class Real, class Device>
bool HandSweep<Real, Device>::is_free(const Vec3<Real>* x, const Vec3<Real>* way, const char* held,
                                      const int* hand) {
  pairs_.find(x, way, 1, held, 0, hand);
  const SelfPair<Real>* pairs = pairs_.pairs();
  Real* share = share_.reserve(pairs_.count());
  for_each(
      device_, "hands: collisions", pairs_.count(), HYST_KERNEL(int p) {
        const SelfPair<Real> pair = pairs[p];
        Vec3<Real> from[4], along[4];
        pair.gather(x, from);
        pair.gather(way, along);
        const Approach<Real> start = approach(from, along, pair.is_edges());
        const Real hardest = static_cast<Real>(kHardest) * pair.shell,
                   nearer = static_cast<Real>(kNearer) * start.distance;
        share[p] = feasible_step(start, from, along, pair.is_edges(), nearer < hardest ? nearer : hardest);
      });
  return !(smallest(device_, pairs_.scratch(), share, pairs_.count(), Real(1)) < 1);
}

template class HandSweep<double, ThisDevice>;
template class HandSweep<float, ThisDevice>;

}  // namespace hysteron
