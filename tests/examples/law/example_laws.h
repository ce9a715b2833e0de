// A law that no program ships: it is in the tests of every law.
#pragma once

#include "tests/examples/law/exponential.h"

namespace hysteron {

using ExampleLaws = LawList<ExponentialLaw>;

}  // namespace hysteron
