// The contract of a law: what keeps it, what breaks it, and what a law has beyond it.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron {
namespace {

struct WithoutResidual {
  static constexpr int kDimension = 1, kHistory = 0;
  using Scalar = double;
  LawStep<double, 1, 0> step(const Vec<double, 1>&, const History<double, 0>&) const { return {}; }
  Tangent<double, 1> tangent(const Vec<double, 1>&, const History<double, 0>&) const { return {}; }
  double largest_stiffness() const { return 0; }
};
struct Complete : WithoutResidual {
  Vec<double, 1> residual(const History<double, 0>&) const { return {}; }
};
// History by reference: a rejected step would not cost nothing.
struct ChangesItsHistory : Complete {
  LawStep<double, 1, 0> step(const Vec<double, 1>&, History<double, 0>&) const { return {}; }
};
struct OfTwoDimensions : Linear<double, 3> {
  static constexpr int kDimension = 2;
};

static_assert(MomentCurvatureLaw<Complete>);
static_assert(!MomentCurvatureLaw<WithoutResidual>);
static_assert(!MomentCurvatureLaw<ChangesItsHistory>);
static_assert(!MomentCurvatureLaw<OfTwoDimensions>);

// A law may have more than the contract, and the laws made of others pass this on.
static_assert(LawWithConvexTangent<Bridson<double, 3>> && !LawWithPotential<Bridson<double, 3>>);
static_assert(LawWithPotential<Kim<float, 3>> && TimedLaw<Kim<float, 3>> && LawWithUse<Kim<float, 3>>);
static_assert(LawWithTriedStep<Fatigue<PrandtlStops<double, 1, 8>>>);
static_assert(WeakeningLaw<Fatigue<PrandtlStops<double, 1, 8>>> && !WeakeningLaw<Narain<double, 3>>);
static_assert(EditableLaw<GrinspunEdit<double, 3>> && !EditableLaw<Linear<double, 3>>);
static_assert(LawWithUse<FourDirections<Gong<double>>> && !LawWithUse<FourDirections<Wong<double>>>);
static_assert(LawWithIroning<FourDirections<Fatigue<Wong<double>>>>);
static_assert(!LawWithIroning<FourDirections<Gong<double>>>);

template <class Real, int D, class Memory>
void expect_contract(const LawEntry& entry, const LawParameters& parameters) {
  const LawParams choice = choose_law(entry, {2e-5, 1e-5, 100}, parameters);
  int visited = 0;
  visit_groups<Real, D, Memory>(LawGroups{}, choice, [&]<class Law>(const Law& law) {
    static_assert(MomentCurvatureLaw<Law> && Law::kDimension == D);
    EXPECT_GT(law.largest_stiffness(), 0) << entry.name;
    ++visited;
  });
  EXPECT_EQ(visited, 1) << entry.name;
}

TEST(EveryLaw, KeepsTheContractAndIsInOneGroup) {
  for (const LawEntry& entry : law_catalogue()) {
    expect_contract<double, 1, ClothMemory>(entry, {});
    expect_contract<float, 3, ClothMemory>(entry, {});
  }
}

// A law that takes the parameters of fatigue but is not in that group would run without it.
TEST(EveryLaw, ThatTakesFatigueIsInTheGroupOfFatigue) {
  int tired = 0;
  for (const LawEntry& entry : law_catalogue()) {
    const auto names = law_parameter_names(entry.name);
    if (std::find(names.begin(), names.end(), "fatigue.dc") == names.end()) continue;
    expect_contract<double, 1, ClothMemory>(entry, {{"fatigue.dc", "1"}});
    ++tired;
  }
  EXPECT_EQ(tired, 3) << "bilinear, wong, prandtl";
}

}  // namespace
}  // namespace hysteron
