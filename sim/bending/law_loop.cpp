#include "sim/bending/law_loop.h"

#include "sim/bending/laws/every_law.h"

namespace hysteron {
namespace {

template <int D, class Real, class Device, class... Groups>
std::unique_ptr<LawLoop<Real, Device>> of_any_group(LawList<Groups...>, Device& device,
                                                    const LawParams& choice, int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  (void)((loop = make_group_loop<Groups, Real, Device, D>(device, choice, elements)) || ...);
  return loop;
}

}  // namespace

template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_law_loop(Device& device, const LawParams& choice, int dimension,
                                                     int elements) {
  return dimension == 1 ? of_any_group<1, Real>(LawGroups{}, device, choice, elements)
                        : of_any_group<3, Real>(LawGroups{}, device, choice, elements);
}

template std::unique_ptr<LawLoop<double, ThisDevice>> make_law_loop(ThisDevice&, const LawParams&, int, int);
template std::unique_ptr<LawLoop<float, ThisDevice>> make_law_loop(ThisDevice&, const LawParams&, int, int);

}  // namespace hysteron
