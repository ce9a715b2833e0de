#include "sim/contact/float_pairs.h"

namespace hysteron {

template <class Device>
void FloatPairs<Device>::round() {
  const std::span<const PairStiffness<double>> pressing = contact_.pressing();
  const PairStiffness<double>* from = pressing.data();
  PairStiffness<float>* to = stiffness_.reserve(pressing.size());
  force_.reserve(4 * pressing.size());
  for_each(
      device_, "in float: pairs", static_cast<int>(pressing.size()), HYST_KERNEL(int p) {
        for (int k = 0; k < 4; ++k) to[p].v[k] = from[p].v[k];
        to[p].block = from[p].block.template cast<float>();
        to[p].weight = from[p].weight.template cast<float>();
      });
}

template <class Device>
GatheredForces<float> FloatPairs<Device>::apply(const Vec3<float>* p) {
  const PairStiffness<float>* stiffness = stiffness_.data();
  Vec3<float>* force = force_.data();
  for_each(
      device_, "in float: product of pairs", static_cast<int>(contact_.pressing().size()),
      HYST_KERNEL(int i) { stiffness[i].times(p, force + 4 * i); });
  return contact_.pressing_forces(static_cast<const Vec3<float>*>(force));
}

template class FloatPairs<ThisDevice>;

}  // namespace hysteron
