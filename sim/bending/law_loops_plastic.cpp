// Loops of the laws with a plastic rest curvature.
#include "sim/bending/law_loop_of.h"
#include "sim/bending/law_visit.h"

namespace hysteron {

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_plastic_loop(Device& device, const LawChoice& choice,
                                                         int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  visit_plastic<Real, D>(
      choice, [&](const auto& law) { loop = make_loop_of<Real>(device, law, choice.curve, elements); });
  return loop;
}

template std::unique_ptr<LawLoop<double, ThisDevice>> make_plastic_loop<double, ThisDevice, 1>(
    ThisDevice&, const LawChoice&, int);
template std::unique_ptr<LawLoop<double, ThisDevice>> make_plastic_loop<double, ThisDevice, 3>(
    ThisDevice&, const LawChoice&, int);
template std::unique_ptr<LawLoop<float, ThisDevice>> make_plastic_loop<float, ThisDevice, 1>(ThisDevice&,
                                                                                             const LawChoice&,
                                                                                             int);
template std::unique_ptr<LawLoop<float, ThisDevice>> make_plastic_loop<float, ThisDevice, 3>(ThisDevice&,
                                                                                             const LawChoice&,
                                                                                             int);

}  // namespace hysteron
