// Every law, where nothing is linked; two of them by their contract.
#include "sim/bending/laws/every_law.h"

static_assert(hysteron::MomentCurvatureLaw<hysteron::Linear<double, 1>>);
static_assert(hysteron::MomentCurvatureLaw<hysteron::PrandtlStops<double, 3, 8>>);
