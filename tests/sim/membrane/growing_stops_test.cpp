// Stops of shear whose limits grow with the shear: energies, memory, derivatives.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "sim/membrane/in_plane_friction.h"

namespace hysteron {
namespace {

constexpr double kGrowingRounding = 1e-12;  // of some hundred operations, relative
constexpr int kHistories = 200, kTurns = 40;
constexpr double kWidest = 0.3;  // of the shears of a history

// This struct has up to three stops of shear of one place; a_j < 1.
template <class Real>
struct GrowingStops {
  std::vector<StrainStop<Real>> stop;
  std::vector<Real> slip;
  Real growth;

  GrowingStops(unsigned seed, bool grows = true) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int j = 0; j <= static_cast<int>(seed % 3); ++j)
      stop.push_back({static_cast<Real>(0.002 + 0.05 * unit(random)), static_cast<Real>(300 * unit(random))});
    slip.assign(stop.size(), 0);
    Real largest = 0;
    for (const auto& of : stop) largest = std::max(largest, of.limit);
    growth = grows ? static_cast<Real>(0.95 * unit(random)) / largest : 0;
  }
  Real stiffness() const {
    Real sum = 0;
    for (const auto& of : stop) sum += of.stiffness;
    return sum;
  }
  StrainStops<Real> at() {
    const int n = static_cast<int>(stop.size());
    return {stop.data(), {0, 0, 0, n}, slip.data(), 1, growth};
  }
  StopsReply<Real> reply(Real shear) { return at().reply(0, {0, 0, shear}); }
  Real potential(Real shear) {
    const StopsReply<Real> now = reply(shear);
    return now.stored + now.lost;
  }
  void accept(Real shear) { at().accept(0, {0, 0, shear}); }

  // Where the stress may have a corner: no shear, and wherever |x - S| = r + a |x|.
  std::vector<double> corners() const {
    std::vector<double> all = {0};
    for (std::size_t j = 0; j < stop.size(); ++j)
      for (const int side : {-1, 1})
        for (const int slope : {-1, 1})
          all.push_back((slip[j] + side * stop[j].limit) / (1 + slope * stop[j].limit * growth));
    return all;
  }
  // int stress dx: the stress is straight between its corners.
  double work(double from, double to) {
    std::vector<double> cuts = {from, to};
    for (const double corner : corners())
      if ((corner - from) * (corner - to) < 0) cuts.push_back(corner);
    std::sort(cuts.begin(), cuts.end());
    double sum = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i)
      sum += (reply(cuts[i - 1]).stress[2] + reply(cuts[i]).stress[2]) / 2 * (cuts[i] - cuts[i - 1]);
    return to < from ? -sum : sum;
  }
};

template <class Visit>
void for_each_history(const Visit& visit) {
  for (unsigned seed = 1; seed <= kHistories; ++seed) {
    std::mt19937 random(1000 + seed);
    std::uniform_real_distribution<double> shear(-kWidest, kWidest);
    std::vector<double> turns;
    for (int i = 0; i < kTurns; ++i) turns.push_back(shear(random) * (i % 4 ? 1 : 0.05));
    visit(seed, turns);
  }
}

TEST(GrowingStops, LoseInEveryStepWhatTheyDoNotStoreOfTheWorkAndGiveNothingBack) {
  double all = 0, across = 0;
  for_each_history([&](unsigned seed, const std::vector<double>& turns) {
    GrowingStops<double> stops(seed);
    double from = 0;
    for (const double to : turns) {
      const double before = stops.reply(from).stored, work = stops.work(from, to);
      const StopsReply<double> now = stops.reply(to);
      EXPECT_GE(now.lost, 0) << seed;
      EXPECT_NEAR(now.stored + now.lost - before, work, kGrowingRounding * (now.stored + now.lost + before))
          << seed << ": " << from << " to " << to;
      if (from * to < 0) across += now.lost;
      all += now.lost;
      stops.accept(to);
      from = to;
    }
  });
  EXPECT_GT(across, 0.1 * all) << "many steps lead through no shear, where limits are least";
}

TEST(GrowingStops, NeverGiveBackInSinglePrecisionEither) {
  for_each_history([&](unsigned seed, const std::vector<double>& turns) {
    GrowingStops<float> stops(seed);
    for (const double to : turns) {
      EXPECT_GE(stops.reply(static_cast<float>(to)).lost, 0) << seed;
      stops.accept(static_cast<float>(to));
      EXPECT_GE(stops.reply(static_cast<float>(to)).lost, 0) << seed;
    }
  });
}

TEST(GrowingStops, TakeOneLongStepAsManyShortOnes) {
  constexpr int kParts = 37;
  for_each_history([&](unsigned seed, const std::vector<double>& turns) {
    GrowingStops<double> once(seed), parts(seed);
    double from = 0, in_parts = 0, at_once = 0;
    for (const double to : turns) {
      at_once += once.reply(to).lost;
      once.accept(to);
      for (int i = 1; i <= kParts; ++i) {
        const double x = i == kParts ? to : from + (to - from) * i / kParts;
        in_parts += parts.reply(x).lost;
        parts.accept(x);
      }
      const StopsReply<double> a = once.reply(to), b = parts.reply(to);
      EXPECT_NEAR(b.stress[2], a.stress[2], kGrowingRounding * once.stiffness()) << seed;
      EXPECT_NEAR(b.stored, a.stored, kGrowingRounding * (a.stored + at_once)) << seed;
      EXPECT_NEAR(in_parts, at_once, kGrowingRounding * (a.stored + at_once)) << seed;
      from = to;
    }
  });
}

// Growing stops without growth compute what stops of a constant limit computed before, bit by bit.
TEST(GrowingStops, WithoutGrowthAreTheStopsOfConstantLimits) {
  for_each_history([&](unsigned seed, const std::vector<double>& turns) {
    GrowingStops<double> stops(seed, false);
    std::vector<double> anchors(stops.stop.size(), 0.0);
    for (const double to : turns) {
      double stress = 0, tangent = 0, stored = 0, lost = 0;
      for (std::size_t j = 0; j < anchors.size(); ++j) {
        const auto [limit, stiffness] = stops.stop[j];
        const double offset = to - anchors[j], held = std::clamp(offset, -limit, limit);
        const double force = stiffness * held;
        stress += force;
        tangent += held == offset ? stiffness : 0;
        stored += force * held / 2;
        lost += force * (offset - held);
        if (held != offset) anchors[j] = to - held;
      }
      const StopsReply<double> now = stops.reply(to);
      EXPECT_EQ(now.stress[2], stress);
      EXPECT_EQ(now.tangent[2], tangent);
      EXPECT_EQ(now.stored, stored);
      EXPECT_EQ(now.lost, lost);
      stops.accept(to);
      EXPECT_EQ(stops.slip, anchors);
    }
  });
}

// Between corners the potential is a parabola, of which central differences are exact.
TEST(GrowingStops, HaveTheStressAsSlopeOfTheirPotentialAndTheTangentAsThatOfTheStress) {
  constexpr double h = 1e-4, kDifferences = 1e-9;  // of the stiffness of all
  double steepest = 0, softest = 0;
  int compared = 0;
  for_each_history([&](unsigned seed, const std::vector<double>& turns) {
    GrowingStops<double> stops(seed);
    const double stiffness = stops.stiffness();
    for (const double x : turns) {
      const std::vector<double> corners = stops.corners();
      const bool near_corner = std::any_of(corners.begin(), corners.end(),
                                           [&](double corner) { return std::abs(x - corner) <= 2 * h; });
      if (!near_corner) {
        const StopsReply<double> now = stops.reply(x), high = stops.reply(x + h), low = stops.reply(x - h);
        EXPECT_NEAR((stops.potential(x + h) - stops.potential(x - h)) / (2 * h), now.stress[2],
                    kDifferences * stiffness);
        EXPECT_NEAR((high.stress[2] - low.stress[2]) / (2 * h), now.tangent[2], kDifferences * stiffness);
        steepest = std::max(steepest, now.tangent[2] / stiffness);
        softest = std::min(softest, now.tangent[2] / stiffness);
        ++compared;
      }
      stops.accept(x);
    }
  });
  EXPECT_GT(compared, kHistories * kTurns / 2);
  EXPECT_GT(steepest, 0.5);
  EXPECT_LT(softest, -0.1) << "on the way back to no shear stops that slip push";
}

}  // namespace
}  // namespace hysteron
