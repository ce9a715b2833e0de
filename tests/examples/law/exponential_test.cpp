#include "tests/examples/law/exponential.h"

#include <gtest/gtest.h>

#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kRounding = 1e-12;

TEST(ExponentialLaw, StartsWithB1AndEndsOnTheStraightLineThroughM0) {
  Driven cloth(Exponential<double, 1>::make(kCotton, 0.5));
  EXPECT_NEAR(cloth.law.slope(0), kCotton.b1, kRounding * kCotton.b1);
  const double far = 40 * kCotton.k0;  // exp(-80) is below rounding
  EXPECT_NEAR(cloth.moment(far), kCotton.friction_moment() + kCotton.b2 * far, kRounding * kCotton.b2 * far);
  EXPECT_NEAR(cloth.moment(-far), -cloth.moment(far), kRounding * kCotton.b2 * far);
}

TEST(ExponentialLaw, BendsToKWithTheMomentOfItsFormula) {
  const double k = 0.7 * kCotton.k0, softness = 0.3;
  Driven cloth(Exponential<double, 1>::make(kCotton, softness));
  EXPECT_NEAR(cloth.moment(k), kCotton.b2 * k + kCotton.friction_moment() * (1 - std::exp(-0.7 / softness)),
              kRounding * kCotton.b1 * k);
}

}  // namespace
}  // namespace hysteron::testing
