#include "experiments/workbench/session/animation.h"

#include <gtest/gtest.h>

namespace hysteron::experiments {
namespace {

// One vertex that has gone as many metres as instants have passed, 0.1 s apart.
Animation of_instants(int count) {
  Animation animation;
  for (int k = 0; k < count; ++k) animation.add(0.1 * k, {Eigen::Vector3d(k, 0, 0)});
  return animation;
}

TEST(Animation, KeepsAllThatViewersBear) {
  EXPECT_EQ(of_instants(kMostMorphTargets + 1).frames().size(), kMostMorphTargets + 1);
}

TEST(Animation, OfALongRunIsEvenAndEndsWithItsLastInstant) {
  for (const int count : {202, 203, 777, 1000}) {
    const Animation animation = of_instants(count);
    const std::vector<ClothFrame>& frames = animation.frames();
    EXPECT_EQ(animation.instants(), static_cast<std::size_t>(count));
    EXPECT_LE(frames.size(), kMostMorphTargets + 1);
    EXPECT_GT(frames.size(), kMostMorphTargets / 2);
    EXPECT_EQ(frames.front().xyz[0], 0);
    EXPECT_EQ(frames.back().xyz[0], count - 1);
    const float stride = frames[1].xyz[0];
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) EXPECT_EQ(frames[k].xyz[0], stride * k) << count;
    EXPECT_LE(frames.back().xyz[0], stride * (frames.size() - 1)) << count;
  }
}

TEST(Animation, TakesTheLaterOfTwoInstantsAtOneTime) {
  Animation animation = of_instants(3);
  animation.add(0.2, {Eigen::Vector3d(7, 0, 0)});
  ASSERT_EQ(animation.frames().size(), 3u);
  EXPECT_EQ(animation.frames().back().xyz[0], 7);
}

TEST(Animation, OfALargeClothHasFewerInstants) {
  constexpr std::size_t kVertices = 1'000'000;
  EXPECT_EQ(most_morph_targets(kVertices), kMostMorphBytes / kMorphBytes / kVertices);
  EXPECT_EQ(most_morph_targets(1), kMostMorphTargets);
  EXPECT_EQ(most_morph_targets(100 * kVertices), 1u);
}

TEST(Animation, GoesOnFromACheckpointAsIfThereWereNone) {
  Animation before = of_instants(250), after;
  Archive saved;
  before.visit(saved);
  const std::string bytes = saved.take();
  Archive loaded{bytes};
  after.visit(loaded);
  for (int k = 250; k < 500; ++k) {
    before.add(0.1 * k, {Eigen::Vector3d(k, 0, 0)});
    after.add(0.1 * k, {Eigen::Vector3d(k, 0, 0)});
  }
  ASSERT_EQ(after.frames().size(), before.frames().size());
  for (std::size_t k = 0; k < after.frames().size(); ++k)
    EXPECT_EQ(after.frames()[k].xyz, before.frames()[k].xyz);
}

}  // namespace
}  // namespace hysteron::experiments
