#include "sim/bending/law_loops_friction.h"

namespace hysteron {

template std::unique_ptr<LawLoop<double, ThisDevice>> make_friction_loop<double, ThisDevice, 3>(
    ThisDevice&, const LawChoice&, int);
template std::unique_ptr<LawLoop<float, ThisDevice>> make_friction_loop<float, ThisDevice, 3>(
    ThisDevice&, const LawChoice&, int);

}  // namespace hysteron
