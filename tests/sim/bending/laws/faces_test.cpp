// Cloth whose bending differs by the sign of its curvature (faces.h): nothing gives energy, each side has its
// own curve, and equal sides have that of a cloth without sides.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "sim/bending/laws/faces.h"
#include "sim/bending/laws/law_potential.h"
#include "tests/sim/bending/laws/law_fixtures.h"

namespace hysteron::testing {
namespace {

constexpr int kStopCount = 8;
constexpr double kAmplitude = 250;  // 1/m, that of KES-FB2
constexpr double kHb = 0.608e-3;    // N, of cotton broad

VirginCurve cotton_with(double bending, double friction) {
  VirginCurve curve = kCotton;
  curve.parts.faces = {bending, friction};
  return curve;
}
template <int D = 1, class Real = double>
WithFaces<Real, D, kStopCount> faced(double bending, double friction) {
  return WithFaces<Real, D, kStopCount>::make(cotton_with(bending, friction));
}
// Returns the ratios of random fabrics: elasticity and friction on the same side or on different ones.
double random_ratio(unsigned seed) { return std::exp2(0.013 * (seed * 37 % 151) - 1); }  // 1/2 to 2

// int M dK of one step from the history before it, by the trapezoidal rule.
template <class Law>
double work_of_step(const Law& law, const CurvatureOf<Law>& from, const CurvatureOf<Law>& to,
                    const HistoryOf<Law>& before, int parts) {
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const auto at = CurvatureOf<Law>(from + (to - from) * typename Law::Scalar(double(i) / parts));
    sum += (i == 0 || i == parts ? 0.5 : 1.) / parts *
           static_cast<double>(law.step(at, before).moment.dot(to - from));
  }
  return sum;
}

// Precision of the sum: kinks of stops are missed by the square of a part; and of the law's numbers.
template <int D, class Real>
void expect_energy_balance(unsigned seed, int parts, double precision) {
  const auto law = faced<D, Real>(random_ratio(seed), random_ratio(seed + 1000));
  Driven<WithFaces<Real, D, kStopCount>> cloth(law);
  Vec<Real, D> at = Vec<Real, D>::Zero();
  double work = 0, stored = 0, lost = 0;
  for (const Vec<double, 3>& turn : random_tensors(12, 80, seed)) {
    const Vec<Real, D> next = turn.head<D>().template cast<Real>();
    const double done = work_of_step(law, at, next, cloth.history, parts);
    const auto& step = cloth.to(next);
    EXPECT_GE(step.dissipated, 0);
    const double scale = kHb * static_cast<double>((next - at).norm()) + static_cast<double>(step.stored);
    EXPECT_NEAR(done, static_cast<double>(step.stored) - stored + static_cast<double>(step.dissipated),
                precision * scale);
    work += done, stored = static_cast<double>(step.stored), lost += static_cast<double>(step.dissipated);
    at = next;
  }
  const double back = work_of_step(law, at, Vec<Real, D>(Vec<Real, D>::Zero()), cloth.history, parts);
  EXPECT_GE(work + back, 0) << "a closed path from virgin cloth gives energy";
}

TEST(Faces, WorkIsStoredOrLostAndClosedPathsGiveNoEnergy) {
  constexpr int kParts = 200;
  constexpr double kOfTheSum = 5e-4, kOfFloats = 2e-3;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    expect_energy_balance<1, double>(seed, kParts, kOfTheSum);
    expect_energy_balance<3, double>(seed, kParts, kOfTheSum);
    expect_energy_balance<1, float>(seed, kParts, kOfFloats);
    expect_energy_balance<3, float>(seed, kParts, kOfFloats);
  }
}

// However a way is divided, it leads to the same state with the same loss: the balance is exact.
TEST(Faces, AWayInManyStepsStoresAndLosesWhatItDoesInOne) {
  constexpr double kRounding = 1e-11;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const auto law = faced(random_ratio(seed), random_ratio(seed + 1000));
    Driven one(law), many(law);
    double at = 0;
    for (const double turn : random_turns(10, kAmplitude, seed)) {
      one.moment(turn);
      for (int i = 1; i <= 7; ++i) many.moment(at + (turn - at) * i / 7);
      at = turn;
    }
    const double scale = one.dissipated + one.last.stored;
    EXPECT_NEAR(many.dissipated, one.dissipated, kRounding * scale);
    EXPECT_NEAR(many.last.stored, one.last.stored, kRounding * scale);
    EXPECT_NEAR(many.last.moment[0], one.last.moment[0], kRounding * kHb);
  }
}

// The slope of the potential is the moment, that of the moment the tangent.
TEST(Faces, MomentAndTangentAreDerivatives) {
  constexpr double kStep = 1e-4;        // 1/m
  constexpr double kDifference = 1e-5;  // of the largest stiffness: a kink within the step
  int kinks = 0, compared = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto law = faced<3>(random_ratio(seed), random_ratio(seed + 1000));
    Driven cloth(law);
    for (const Vec<double, 3>& turn : random_tensors(12, 80, seed)) {
      const Vec<double, 3> way = turn.normalized() * kStep;
      const auto potential = [&](const Vec<double, 3>& k) { return step_potential(law, k, cloth.history); };
      const auto moment = [&](const Vec<double, 3>& k) { return law.step(k, cloth.history).moment; };
      EXPECT_NEAR((potential(turn + way) - potential(turn - way)) / (2 * kStep),
                  moment(turn).dot(way) / kStep, kDifference * kHb);
      const Vec<double, 3> change = (moment(turn + way) - moment(turn - way)) / (2 * kStep),
                           slope = law.tangent(turn, cloth.history) * way / kStep;
      kinks += (change - slope).norm() > kDifference * law.largest_stiffness();
      ++compared;
      cloth.to(turn);
    }
  }
  EXPECT_LT(kinks, compared / 50);
}

// d2W/dK2 is at least a tenth of the common elasticity, wherever it is taken.
TEST(Faces, TheStepStaysConvex) {
  constexpr double kLeft = 0.1, kRounding = 1e-9;
  double least = INFINITY;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const double bending = random_ratio(seed), friction = random_ratio(seed + 1000);
    const auto law = faced<3>(bending, friction);
    const double common = kCotton.b2 * std::min(1.0, bending);
    Driven cloth(law);
    for (const Vec<double, 3>& turn : random_tensors(10, 200, seed)) {
      cloth.to(turn);
      for (const Vec<double, 3>& tried : random_tensors(10, 20, seed + 1)) {
        const Tangent<double, 3> t = law.tangent(tried, cloth.history);
        const double smallest = t.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff();
        least = std::min(least, smallest / common);
      }
    }
  }
  EXPECT_GE(least, kLeft - kRounding);
  EXPECT_LT(least, 0.5) << "no stops slipped back near flat: nothing was tested";
}

// Where friction has directions of its own, elasticity beside the law has the difference: a tenth of what a
// direction has is left along each, on tensors and on hinges across any edge.
TEST(Faces, TheStepStaysConvexWhereFrictionHasDirectionsOfItsOwn) {
  constexpr double kLeft = 0.1, kRounding = 1e-9;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const double q = random_ratio(seed + 2000), f = random_ratio(seed + 3000);  // of rigidity, of friction
    const double weft = q / (f * f),
                 twist = (1 + q) / (1 + f * f);  // of the bias of Fabric::friction_ratios()
    VirginCurve curve = cotton_with(random_ratio(seed), random_ratio(seed + 1000));
    curve.parts.faces.weft_elastic = weft;
    curve.parts.faces.wider = std::max(1.0, (1 + weft) / 2 / twist);
    const double common = kCotton.b2 * std::min(1.0, curve.parts.faces.bending);
    const double needed = kLeft * common * std::min({1.0, weft, twist}) - kRounding * common;
    Driven sheet(WithFaces<double, 3, kStopCount>::make(curve));
    auto hinge_law = WithFaces<double, 1, kStopCount>::make(curve);
    const double x = random_ratio(seed + 4000) / 4, y = random_ratio(seed + 5000) / 4;  // u_xx^2, u_yy^2
    hinge_law.turn(x, y);
    Driven hinge(hinge_law);
    const double beside = common * (x + weft * y + twist * (1 - x - y) - 1);
    for (const Vec<double, 3>& turn : random_tensors(10, 200, seed)) {
      sheet.to(turn);
      hinge.moment(turn[0]);
      for (const Vec<double, 3>& tried : random_tensors(10, 20, seed + 1)) {
        Tangent<double, 3> t = sheet.law.tangent(tried, sheet.history);
        t.diagonal() += common * Vec<double, 3>(0, weft - 1, twist - 1);
        ASSERT_GE(t.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), needed) << seed;
        ASSERT_GE(hinge.law.tangent(Vec<double, 1>(tried[0]), hinge.history)(0, 0) + beside, needed) << seed;
      }
    }
  }
}

// Along weft four directions have the excess of weft, as the scalar law turned there has it.
TEST(Faces, AcrossWarpTheTensorFollowsTheScalarLawOfThatDirection) {
  constexpr double kOfDirections = 4e-3;  // four_directions.h
  VirginCurve curve = cotton_with(1.6, 0.6);
  curve.parts.faces.weft_elastic = 0.5;
  auto strip_law = WithFaces<double, 1, kStopCount>::make(curve);
  strip_law.turn(0, 1);
  Driven strip(strip_law);
  Driven sheet(WithFaces<double, 3, kStopCount>::make(curve));
  for (const double k : random_turns(200, 200, 9)) {
    const double moment = strip.moment(k), largest = kHb + 1.6 * kCotton.b2 * 200;
    EXPECT_NEAR(sheet.to({0, k, 0}).moment[1], moment, kOfDirections * largest);
  }
}

TEST(Faces, TheMomentIsContinuousThroughFlat) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const auto law = faced(random_ratio(seed), random_ratio(seed + 1000));
    Driven cloth(law);
    for (const double turn : random_turns(6, kAmplitude, seed)) cloth.moment(turn);
    const auto jump = [&](double width) {
      const auto moment = [&](double k) { return law.step(Vec<double, 1>(k), cloth.history).moment[0]; };
      return std::abs(moment(width) - moment(-width));
    };
    for (const double width : {1e-1, 1e-3, 1e-6}) EXPECT_LE(jump(width), 2 * width * law.largest_stiffness());
  }
}

TEST(Faces, VirginClothLiesFlatWithoutMoment) {
  for (const double bending : {0.5, 1.0, 2.0})
    for (const double friction : {0.5, 1.0, 2.0}) {
      const auto law = faced(bending, friction);
      EXPECT_EQ(law.step(Vec<double, 1>(0.), {}).moment[0], 0);
      EXPECT_EQ(law.residual({})[0], 0);
      const auto tensor = faced<3>(bending, friction);
      EXPECT_EQ(tensor.step(Vec<double, 3>::Zero(), {}).moment.norm(), 0);
      EXPECT_LE(tensor.residual({}).norm(), 1e-12);
    }
}

// B and HB of one side are measured from beyond k0 on and after a reversal from far.
TEST(Faces, EachSideHasItsOwnRigidityAndFriction) {
  constexpr double kRounding = 1e-12, kOfDirections = 4e-3;  // four_directions.h
  const double bending = 1.4, friction = 0.7;
  const auto expect_side = [&](auto law, double side, double precision) {
    constexpr int D = decltype(law)::kDimension;
    const double b2 = kCotton.b2 * (side > 0 ? 1 : bending), hb = kHb * (side > 0 ? 1 : friction);
    Driven cloth(law);
    const auto moment = [&](double k) {
      Vec<double, D> curvature = Vec<double, D>::Zero();
      curvature[0] = side * k;
      return side * cloth.to(curvature).moment[0];
    };
    for (const double k : {50., 100., 250.}) EXPECT_NEAR(moment(k) / (hb + b2 * k), 1, precision);
    for (const double k : {149., 100., 50.}) EXPECT_NEAR(moment(k), b2 * k - hb, precision * (hb + b2 * k));
  };
  for (const double side : {1., -1.}) {
    expect_side(faced(bending, friction), side, kRounding);
    expect_side(faced<3>(bending, friction), side, kOfDirections);
  }
}

// Masing: where all of it happens beyond the width of one side, a branch after a reversal is the doubled
// virgin curve of that side's stops.
TEST(Faces, AReversalFollowsTheDoubledVirginCurveOfItsSide) {
  constexpr double kRounding = 1e-12;
  for (const double friction : {0.6, 1.5}) {
    const VirginCurve curve = cotton_with(1, friction);
    const auto law = WithFaces<double, 1, kStopCount>::make(curve);
    const double width = curve.face_width();
    for (const double side : {1., -1.}) {
      Driven turned(law);
      const double peak = turned.moment(side * kAmplitude) - curve.b2 * side * kAmplitude;
      const bool whole = (friction > 1) == (side < 0);  // with the excess
      const Spectrum common =
          parabola_stops(std::min(1., friction) * (curve.b1 - curve.b2), curve.k0, kStopCount);
      const auto virgin = [&](double k) {
        double sum = common.friction_at(k);
        for (int j = 0; whole && j < kStopCount; ++j)
          sum += law.excess.p[j] * std::min(k / law.excess.own.shorter, law.excess.limit[j]);
        return sum;
      };
      for (double k = kAmplitude; k > width; k -= 7) {
        const double friction_moment = turned.moment(side * k) - curve.b2 * side * k;
        EXPECT_NEAR(friction_moment, peak - side * 2 * virgin((kAmplitude - k) / 2), kRounding) << k;
      }
    }
  }
}

TEST(Faces, SidesThatAreAlmostEqualAreThoseOfAClothWithoutSides) {
  constexpr double kAlmost = 1e-9, kFollows = 1e-7;
  const auto law = faced(1 + kAlmost, 1 - kAlmost);
  const auto plain = PrandtlStops<double, 1, kStopCount>::make(kCotton);
  Driven with(law);
  Driven without(plain);
  for (const double turn : random_turns(200, kAmplitude, 5))
    EXPECT_NEAR(with.moment(turn), without.moment(turn), kFollows * kHb);
}

// The same cloth seen from its other side: ratios inverted, numbers those of the other side.
template <int D>
void expect_mirrored(double bending, double friction, unsigned seed) {
  constexpr double kRounding = 1e-11;
  const VirginCurve curve = cotton_with(bending, friction);
  VirginCurve turned = curve;
  turned.b2 *= bending;
  turned.b1 = turned.b2 + friction * (curve.b1 - curve.b2);
  turned.parts.faces = {1 / bending, 1 / friction};
  Driven cloth(WithFaces<double, D, kStopCount>::make(curve)),
      other(WithFaces<double, D, kStopCount>::make(turned));
  for (const Vec<double, 3>& turn : random_tensors(40, 200, seed)) {
    const Vec<double, D> k = turn.head<D>();
    const Vec<double, D> moment = cloth.to(k).moment;
    EXPECT_LE((moment + other.to(Vec<double, D>(-k)).moment).norm(), kRounding * kHb);
  }
}
TEST(Faces, TheMirroredClothHasMirroredMoments) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    expect_mirrored<1>(random_ratio(seed), random_ratio(seed + 1000), seed);
    expect_mirrored<3>(random_ratio(seed), random_ratio(seed + 1000), seed);
  }
}

}  // namespace
}  // namespace hysteron::testing
