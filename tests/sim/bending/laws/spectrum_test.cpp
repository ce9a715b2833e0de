// Friction as a spectrum of stops: loops by closed form, on the tensor, with a spectrum for each direction.
#include <gtest/gtest.h>

#include "sim/bending/laws/directed.h"
#include "sim/bending/laws/prandtl_stops.h"
#include "sim/bending/laws/spectrum_stops.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr double kSpectrumB2 = 1e-5;         // [N m]
constexpr double kSpectrumRounding = 1e-13;  // relative

// The thresholds reach beyond the tester's amplitude of 250/m as well.
Spectrum warp() { return {{3, 12, 40, 95, 300}, {9e-6, 7e-6, 3e-6, 1e-6, 4e-7}}; }
Spectrum weft() { return {{5, 10, 55, 60, 200}, {4e-6, 9e-6, 1e-6, 2e-6, 1e-7}}; }

using Strip = SpectrumStops<double, 1, 8>;
using Sheet = SpectrumStops<double, 3, 8>;

TEST(Spectrum, BeginsWithTheSumOfItsStiffnessesAndEndsWithItsFrictionMoment) {
  Driven cloth(Strip::make(kSpectrumB2, warp(), {}));
  const double k = 2;  // below all thresholds
  EXPECT_NEAR(cloth.moment(k), (kSpectrumB2 + 9e-6 + 7e-6 + 3e-6 + 1e-6 + 4e-7) * k,
              kSpectrumRounding * kSpectrumB2 * k);
  const double hb = 3 * 9e-6 + 12 * 7e-6 + 40 * 3e-6 + 95 * 1e-6 + 300 * 4e-7;
  EXPECT_NEAR(cloth.moment(1000), kSpectrumB2 * 1000 + hb, kSpectrumRounding * kSpectrumB2 * 1000);
  EXPECT_NEAR(cloth.law.utilisation(Vec<double, 1>(1000), cloth.history), 1, kSpectrumRounding);
}

TEST(Spectrum, HasTheWidthOfItsClosedFormAtEveryCurvature) {
  const double amplitude = 250;
  Driven down(Strip::make(kSpectrumB2, warp(), {}));
  for (double turn : {amplitude, -amplitude, amplitude}) down.moment(turn);
  Driven<Strip> up = down;
  up.moment(-amplitude);
  for (double k : {200.0, 100.0, 0.0, -60.0}) {
    Driven<Strip> rising = up;
    const double width = rising.moment(k) - down.moment(k);
    EXPECT_NEAR(width, warp().loop_width(amplitude, k), kSpectrumRounding * kSpectrumB2 * amplitude);
  }
}

TEST(Spectrum, OfTheParabolasStopsIsTheDefaultLaw) {
  Spectrum parabola;
  for (int j = 1; j <= 8; ++j) {
    parabola.thresholds.push_back((j * j - j + 0.5) * kCotton.k0 / 64);
    parabola.stiffnesses.push_back((2 * j - 1) * (kCotton.b1 - kCotton.b2) / 64);
  }
  Driven usual(PrandtlStops<double, 3, 8>::make(kCotton));
  Driven cloth(Sheet::make(kCotton.b2, parabola, {}));
  for (const auto& k : random_tensors(200, 2 * kCotton.k0, 11)) {
    usual.to(k), cloth.to(k);
    ASSERT_LE((usual.last.moment - cloth.last.moment).norm(), kSpectrumRounding * kCotton.b1 * kCotton.k0);
    ASSERT_NEAR(usual.last.dissipated, cloth.last.dissipated,
                kSpectrumRounding * kCotton.b1 * kCotton.k0 * kCotton.k0);
  }
}

// Along warp and along weft each spectrum is exact.
TEST(TwoSpectra, FollowTheirOwnLoopsAlongWarpAndAlongWeft) {
  const Sheet law = Sheet::make(kSpectrumB2, warp(), weft());
  for (int axis : {0, 1}) {
    Driven<Sheet> sheet(law);
    Driven strip(Strip::make(kSpectrumB2, axis == 0 ? warp() : weft(), {}));
    for (double k : random_turns(200, 400, 5)) {
      const Vec<double, 3> bend = k * Vec<double, 3>::Unit(axis);
      const double m = strip.moment(k);
      ASSERT_LE((sheet.to(bend).moment - m * Vec<double, 3>::Unit(axis)).norm(),
                kSpectrumRounding * kSpectrumB2 * 400);
      ASSERT_NEAR(sheet.last.stored, strip.last.stored, kSpectrumRounding * kSpectrumB2 * 400 * 400);
      ASSERT_NEAR(sheet.last.dissipated, strip.last.dissipated, kSpectrumRounding * kSpectrumB2 * 400 * 400);
    }
  }
}

TEST(TwoSpectra, ThatAreEqualAreOne) {
  Driven two(Sheet::make(kSpectrumB2, warp(), warp())), one(Sheet::make(kSpectrumB2, warp(), {}));
  for (const auto& k : random_tensors(300, 200, 6)) {
    two.to(k), one.to(k);
    ASSERT_LE((two.last.moment - one.last.moment).norm(), kSpectrumRounding * kSpectrumB2 * 200);
    ASSERT_NEAR(two.last.dissipated, one.last.dissipated, kSpectrumRounding * kSpectrumB2 * 200 * 200);
  }
}

// A bend at 45 degrees slips at a moment between those of warp and weft.
TEST(TwoSpectra, RubBetweenWarpAndWeftOnTheBias) {
  Driven sheet(Sheet::make(kSpectrumB2, warp(), weft()));
  const Vec<double, 3> bias(0.5, 0.5, std::sqrt(0.5));
  const double friction =
      (sheet.to(Vec<double, 3>(5000 * bias)).moment - kSpectrumB2 * 5000 * bias).dot(bias);
  const double of_warp = warp().friction_moment(), of_weft = weft().friction_moment();
  EXPECT_GT(friction, std::min(of_warp, of_weft));
  EXPECT_LT(friction, std::max(of_warp, of_weft));
}

// At 45 degrees: stiffnesses are the squares of the mean roots, friction moments the means.
Spectrum bias() {
  Spectrum mean;
  for (std::size_t j = 0; j < warp().size(); ++j) {
    const double p = warp().stiffnesses[j], other_p = weft().stiffnesses[j];
    const double stiff = std::pow((std::sqrt(p) + std::sqrt(other_p)) / 2, 2);
    const double moment = (p * warp().thresholds[j] + other_p * weft().thresholds[j]) / 2;
    mean.stiffnesses.push_back(stiff);
    mean.thresholds.push_back(moment / stiff);
  }
  return mean;
}

// Returns a hinge in this direction (CurvatureOperator).
Strip in_direction(const Spectrum& along_warp, const Spectrum& along_weft, double warp_part,
                   double weft_part) {
  const double direction[2] = {warp_part, weft_part};
  return Directed<Strip>{Strip::make(kSpectrumB2, along_warp, along_weft)}.of(direction, 0);
}

struct Bend {
  Strip law;
  Spectrum own;  // that it must follow
};
const Bend kBends[] = {{Strip::make(kSpectrumB2, warp(), {}), warp()},
                       {in_direction(warp(), weft(), 1, 0), warp()},
                       {in_direction(warp(), weft(), 0, 1), weft()},
                       {in_direction(warp(), weft(), 0.25, 0.25), bias()}};

// A branch is M = Mr + 2 f((K - Kr)/2), whatever the spectrum and the reversal (Masing 1926).
TEST(Spectra, ReturnOnTheVirginCurveOfTheirDirectionDoubled) {
  for (const Bend& of : kBends) {
    const auto own = [&](double k) { return kSpectrumB2 * k + of.own.friction_at(k); };
    for (double turn : {7.0, 30.0, 80.0, 250.0, 900.0}) {
      Driven<Strip> cloth(of.law);
      EXPECT_NEAR(cloth.moment(turn), own(turn), kSpectrumRounding * own(turn));
      for (int i = 1; i <= 40; ++i) {
        const double k = turn - 2 * turn * i / 40;
        EXPECT_NEAR(cloth.moment(k), own(turn) - 2 * own((turn - k) / 2), kSpectrumRounding * own(turn));
      }
    }
  }
}

TEST(Spectra, LoseTheAreaOfTheClosedLoopOfTheirDirection) {
  for (const Bend& of : kBends)
    for (double amplitude : {8.0, 50.0, 250.0, 1000.0}) {
      Driven<Strip> cloth(of.law);
      double area = 0;
      for (std::size_t j = 0; j < of.own.size(); ++j) {
        const double r = of.own.thresholds[j];
        if (r < amplitude) area += 4 * of.own.stiffnesses[j] * r * (amplitude - r);
      }
      EXPECT_NEAR(of.own.loop_area(amplitude), area, kSpectrumRounding * area);
      EXPECT_NEAR(cloth.cycle_loss(amplitude), area, kSpectrumRounding * area);
      EXPECT_NEAR(cloth.law.utilisation(Vec<double, 1>(2000), cloth.history), 1, kSpectrumRounding);
    }
}

// The tensor held to one direction begins with the same stiffness and slides with the same moment.
TEST(TurnedSpectra, BeginAndSlideAsTheTensorBentInTheirDirection) {
  constexpr double kSmall = 1e-3, kFar = 1e9, kSlides = 1e-6;  // below and far beyond all thresholds [1/m]
  for (double angle : {0.2, 0.6, 1.1, 1.4}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec<double, 3> u = Vec<double, 3>(c * c, 0.8 * s * s, 0.9 * std::sqrt(2.0) * c * s).normalized();
    const double direction[2] = {u[0] * u[0], u[1] * u[1]};
    Driven<Strip> strip(Directed<Strip>{Strip::make(0, warp(), weft())}.of(direction, 0));
    Driven sheet(Sheet::make(0, warp(), weft()));
    EXPECT_NEAR(strip.moment(kSmall), sheet.to(Vec<double, 3>(kSmall * u)).moment.dot(u),
                kSpectrumRounding * warp().stiffness() * kSmall);
    EXPECT_NEAR(strip.moment(kFar), sheet.to(Vec<double, 3>(kFar * u)).moment.dot(u),
                kSlides * warp().friction_moment());
  }
}

// Behind the metric of the curvature these are the same spectrum, whatever the direction.
TEST(TurnedSpectra, ThatAreEqualAreOne) {
  Driven<Strip> between(in_direction(warp(), warp(), 0.3, 0.5)),
      plain(Strip::make(kSpectrumB2, warp(), warp()));
  for (double k : random_turns(200, 400, 5))
    ASSERT_NEAR(between.moment(k), plain.moment(k), kSpectrumRounding * kSpectrumB2 * 400);
}

}  // namespace
}  // namespace hysteron::testing
