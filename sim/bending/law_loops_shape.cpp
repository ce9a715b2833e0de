// Laws on the shape element, D = 3; laws of scalar form along four material directions.
#include "sim/bending/four_directions.h"
#include "sim/bending/law_loop_of.h"
#include "sim/bending/linear.h"
#include "sim/bending/pabst.h"
#include "sim/bending/prandtl_stack.h"
#include "sim/bending/prandtl_stops.h"
#include "sim/bending/wong.h"

namespace hysteron {

template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_shape_law(Device& device, const std::string& name,
                                                      const HysteresisChoice& choice,
                                                      const VirginCurve& curve, int elements) {
  const auto loop = [&]<class Law>(const Law& law) -> std::unique_ptr<LawLoop<Real, Device>> {
    return std::make_unique<LawLoopOf<Real, Device, Law>>(device, law, curve, elements);
  };
  if (name == "linear") return loop(Linear<Real, 3>::make(curve));
  if (name == "pabst") return loop(Pabst<Real, 3>::make(curve));
  if (name == "wong")
    return loop(FourDirections<Wong<Real>>::make(
        curve, choice.reversible ? Recovery::kReversible : Recovery::kMasing));
  if (name != "prandtl") return nullptr;
  if (choice.stack) {
    if (choice.depth == 4) return loop(FourDirections<PrandtlStack<Real, 4>>::make(curve));
    if (choice.depth == 16) return loop(FourDirections<PrandtlStack<Real, 16>>::make(curve));
    return loop(FourDirections<PrandtlStack<Real, 8>>::make(curve));
  }
  if (choice.stops == 4) return loop(PrandtlStops<Real, 3, 4>::make(curve));
  if (choice.stops == 16) return loop(PrandtlStops<Real, 3, 16>::make(curve));
  if (choice.stops == 32) return loop(PrandtlStops<Real, 3, 32>::make(curve));
  return loop(PrandtlStops<Real, 3, 8>::make(curve));
}

#define HYSTERON_INSTANTIATE(Real)                                    \
  template std::unique_ptr<LawLoop<Real, ThisDevice>> make_shape_law( \
      ThisDevice&, const std::string&, const HysteresisChoice&, const VirginCurve&, int);
HYSTERON_INSTANTIATE(double)
HYSTERON_INSTANTIATE(float)

}  // namespace hysteron
