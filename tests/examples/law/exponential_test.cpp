#include "tests/examples/law/exponential.h"

#include <gtest/gtest.h>

#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kRounding = 1e-12;

TEST(ExponentialLaw, StartsWithB1AndEndsOnTheStraightLineThroughM0) {
  const VirginCurve c = cotton_broad();
  Driven<Exponential<double, 1>> cloth(Exponential<double, 1>::make(c, 0.5));
  EXPECT_NEAR(cloth.law.slope(0), c.b1, kRounding * c.b1);
  const double far = 40 * c.k0;  // exp(-80) is below rounding
  EXPECT_NEAR(cloth.moment(far), c.friction_moment() + c.b2 * far, kRounding * c.b2 * far);
  EXPECT_NEAR(cloth.moment(-far), -cloth.moment(far), kRounding * c.b2 * far);
}

TEST(ExponentialLaw, BendsToKWithTheMomentOfItsFormula) {
  const VirginCurve c = cotton_broad();
  const double k = 0.7 * c.k0, softness = 0.3;
  Driven<Exponential<double, 1>> cloth(Exponential<double, 1>::make(c, softness));
  EXPECT_NEAR(cloth.moment(k), c.b2 * k + c.friction_moment() * (1 - std::exp(-0.7 / softness)),
              kRounding * c.b1 * k);
}

}  // namespace
}  // namespace hysteron::testing
