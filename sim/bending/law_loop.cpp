#include "sim/bending/law_loop.h"

#include "sim/base/error.h"

namespace hysteron {
namespace {

template <int D, class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> of_any_group(Device& device, const LawChoice& choice, int elements) {
  if (auto loop = make_memoryless_loop<Real, Device, D>(device, choice, elements)) return loop;
  if (auto loop = make_plastic_loop<Real, Device, D>(device, choice, elements)) return loop;
  if (auto loop = make_friction_loop<Real, Device, D>(device, choice, elements)) return loop;
  return make_fatigue_loop<Real, Device, D>(device, choice, elements);
}

}  // namespace

template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_law_loop(Device& device, const LawChoice& choice, int dimension,
                                                     int elements) {
  return dimension == 1 ? of_any_group<1, Real>(device, choice, elements)
                        : of_any_group<3, Real>(device, choice, elements);
}

template std::unique_ptr<LawLoop<double, ThisDevice>> make_law_loop(ThisDevice&, const LawChoice&, int, int);
template std::unique_ptr<LawLoop<float, ThisDevice>> make_law_loop(ThisDevice&, const LawChoice&, int, int);

}  // namespace hysteron
