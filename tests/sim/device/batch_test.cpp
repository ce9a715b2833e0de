// Many small cloths together: every one as if it were alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "sim/base/error.h"
#include "sim/time/together.h"
#include "tests/sim/device/on_each_device.h"
#include "tests/sim/device/primitives.h"
#include "tests/sim/time/scenes.h"

namespace hysteron {
namespace {

using test::Trial;

TEST(Together, OnACpuEveryJobIsTakenOnce) {
  for (const int count : {0, 1, 7}) {
    std::vector<int> taken(count);
    run_batched_scenes(false, count, [&](int i) { ++taken[i]; });
    EXPECT_EQ(taken, std::vector<int>(count, 1));
  }
}

TEST(Together, OnACpuAJobSharesNoLaunches) {
  EXPECT_EQ(jobs_together(), 1);
  run_batched_scenes(false, 4, [](int) { EXPECT_EQ(jobs_together(), 1); });
}

class BatchTogether : public test::OnGpu {};

TEST_F(BatchTogether, LetsAJobKnowHowManyShareItsLaunches) {
  run_batched_scenes(true, 5, [](int) { EXPECT_EQ(jobs_together(), 5); });
  EXPECT_EQ(jobs_together(), 1);
}

TEST(Together, AskForAGpuWhereThereIsNone) {
  std::string reason;
  if (gpu_count(reason) > 0) GTEST_SKIP() << "there is a GPU";
  EXPECT_THROW(run_batched_scenes(true, 2, [](int) {}), Error);
}

// Members whose loops differ in length and in how often they are repeated.
TEST_F(BatchTogether, HasLoopsThatGiveWhatTheyGiveAlone) {
  constexpr int kMembers = 9, kTimes = 3;
  const auto alone = test::gpu_primitives();
  run_batched_scenes(true, kMembers, [&](int i) {
    const auto member = test::gpu_primitives();
    const int n = i < 2 ? 1 + i : 1 << (2 * i), goal = 1 + 5 * i;
    std::vector<int> count(n + 1);
    for (int k = 0; k <= n; ++k) count[k] = (k * (i + 1)) % 7;
    const std::vector<double> values(count.begin(), count.end());
    test::Rows rows{{0}, count};
    rows.start.push_back(n);
    EXPECT_EQ(member->repeated(n, goal, kTimes), std::vector<int>(n, kTimes * goal)) << i;
    EXPECT_EQ(member->scan(count).start.back(), std::accumulate(count.begin(), count.end(), 0)) << i;
    EXPECT_EQ(member->group(count, 7).item.size(), count.size()) << i;
    EXPECT_EQ(member->totals(values).finished, 1) << i;
    EXPECT_EQ(member->totals(values).sum, std::accumulate(values.begin(), values.end(), 0.0)) << i;
    EXPECT_EQ(member->row_sums(rows, values).size(), 1u) << i;
    EXPECT_EQ(member->written_to_host(0.5 + i), 0.5 + i);
    EXPECT_EQ(member->through_a_buffer(values), values) << i;
    EXPECT_EQ(member->smallest(values, -1.0 - i), -1.0 - i);
  });
  EXPECT_EQ(alone->bytes(), test::gpu_primitives()->bytes());
}

std::vector<test::Method> methods() {
  std::vector<test::Method> all;
  for (const char* integrator : {"semi-implicit", "explicit", "implicit", "bdf2", "tr-bdf2"})
    all.push_back({"prandtl", "shape", integrator});
  all.push_back({"wong", "hinge", "implicit"});
  return all;
}

// Cloths of one topology, each with a rigidity of its own, so that they need other numbers of iterations.
Scene member_scene(const test::Method& method, int i) {
  Scene scene = test::hanging_square(300);
  scene.law = method.law;
  scene.element = value_named<BendingElement>(method.element);
  scene.integrator = value_named<Integrator>(method.integrator);
  scene.fabric.b1 *= 1 + 0.3 * i;
  scene.air_drag = 0.02;
  if (scene.is_implicit()) scene.step = 5e-3;
  scene.pin[0].motion.keys = {{0, {0, 0, 0}, 0}, {0.05, {0.01, 0, 0.02}, 10}};
  return scene;
}

std::uint64_t hash_after(Scene scene, int steps) {
  scene.device = DeviceChoice::cuda;
  return Trial(scene).after(steps)->state_hash();
}

class BatchOnGpu : public test::OnGpuWith<test::Method> {};
INSTANTIATE_TEST_SUITE_P(Cases, BatchOnGpu, testing::ValuesIn(methods()), test::CaseName());

TEST_P(BatchOnGpu, EveryClothHasTheBitsThatItHasAlone) {
  constexpr int kMembers = 5, kSteps = 20;
  std::vector<std::uint64_t> together(kMembers), alone;
  run_batched_scenes(true, kMembers,
                     [&](int i) { together[i] = hash_after(member_scene(GetParam(), i), kSteps); });
  for (int i = 0; i < kMembers; ++i) alone.push_back(hash_after(member_scene(GetParam(), i), kSteps));
  EXPECT_EQ(together, alone);
  EXPECT_NE(alone[0], alone[1]);
}

// Lists of pairs grow, are scanned and sorted, and obstacles ask for the smallest step.
class BatchOfContact : public test::OnGpu {};

TEST_F(BatchOfContact, EveryClothHasTheBitsThatItHasAlone) {
  constexpr int kMembers = 3, kSteps = 30;
  for (const Preconditioning solver : {Preconditioning::multigrid, Preconditioning::cholesky}) {
    const auto batch_scene = [&](int i) {
      Scene scene = member_scene({"prandtl", "shape", "implicit"}, i);
      scene.self_contact = true;
      scene.obstacle = {test::sphere_at({0.1, 0.05, -0.042}, 0.04)};
      scene.linear_solver = solver;
      return scene;
    };
    std::vector<std::uint64_t> together(kMembers), alone;
    run_batched_scenes(true, kMembers, [&](int i) { together[i] = hash_after(batch_scene(i), kSteps); });
    for (int i = 0; i < kMembers; ++i) alone.push_back(hash_after(batch_scene(i), kSteps));
    EXPECT_EQ(together, alone) << enum_name(solver);
  }
}

// Members renew their factorisations in different steps.
TEST_F(BatchTogether, FactorisesEveryClothWithTheBitsThatItHasAlone) {
  constexpr int kMembers = 4, kSteps = 20;
  const auto batch_scene = [](int i) {
    Scene scene = member_scene({"prandtl", "shape", "tr-bdf2"}, i);
    scene.linear_solver = Preconditioning::cholesky;
    return scene;
  };
  std::vector<std::uint64_t> together(kMembers), alone;
  run_batched_scenes(true, kMembers, [&](int i) { together[i] = hash_after(batch_scene(i), kSteps); });
  for (int i = 0; i < kMembers; ++i) alone.push_back(hash_after(batch_scene(i), kSteps));
  EXPECT_EQ(together, alone);
}

TEST_F(BatchTogether, LeavesTheOthersTheirStatesWhereOneFails) {
  constexpr int kMembers = 4, kFails = 2, kSteps = 10;
  const test::Method method{"prandtl", "shape", "implicit"};
  std::vector<std::uint64_t> together(kMembers);
  const auto job = [&](int i) {
    if (i == kFails) {
      hash_after(member_scene(method, i), 1);
      throw Error::simulation("this one fails");
    }
    together[i] = hash_after(member_scene(method, i), kSteps);
  };
  EXPECT_THROW(run_batched_scenes(true, kMembers, job), Error);
  for (int i = 0; i < kMembers; ++i)
    if (i != kFails) {
      EXPECT_EQ(together[i], hash_after(member_scene(method, i), kSteps)) << i;
    }
}

}  // namespace
}  // namespace hysteron
