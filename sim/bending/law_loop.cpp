#include "sim/bending/law_loop.h"

#include "sim/error.h"

namespace hysteron {

template <class Real, class Device>
std::unique_ptr<LawLoop<Real, Device>> make_law_loop(Device& device, const std::string& name,
                                                     const LawParameters& parameters,
                                                     const VirginCurve& curve, int dimension, int elements) {
  const HysteresisChoice choice = hysteresis_choice(name, parameters);
  auto loop = dimension == 1 ? make_hinge_law<Real>(device, name, choice, curve, elements)
                             : make_shape_law<Real>(device, name, choice, curve, elements);
  if (!loop)
    throw Error::request("law " + name + " cannot be simulated yet: use linear, pabst, prandtl or wong");
  return loop;
}

#define HYSTERON_INSTANTIATE(Real)                                   \
  template std::unique_ptr<LawLoop<Real, ThisDevice>> make_law_loop( \
      ThisDevice&, const std::string&, const LawParameters&, const VirginCurve&, int, int);
HYSTERON_INSTANTIATE(double)
HYSTERON_INSTANTIATE(float)

}  // namespace hysteron
