// No result depends on the rate of pictures: every experiment that simulates runs at several of them.
#include <map>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

// The quickest forms; each has to cover what its experiment reads on the way.
const std::map<std::string, std::vector<Flag>> kQuickest = {
    {"drape",  // settles before its time is over
     {{"triangles", "60"}, {"drape.lowering", "0.1"}, {"seconds", "1.5"}, {"drape.still", "0.4"}}},
    {"swing", {{"triangles", "60"}, {"seconds", "1.2"}}},
    {"crease", {{"triangles", "60"}, {"crease.fold", "pleat"}, {"crease.recovery", "0.1"}}},
    {"fold", {{"triangles", "60"}, {"fold.cycles", "2"}}},
    {"crumple", {{"triangles", "100"}, {"seconds", "0.1"}}},
    {"buckle", {{"triangles", "60"}}},
    {"cantilever", {{"triangles", "60"}}},
    {"run", {{"scene", "hanging-square"}, {"triangles", "60"}}}};

Json results_at(const std::string& experiment, const std::string& fps) {
  const Folder folder;
  std::vector<Flag> flags = kQuickest.at(experiment);
  flags.insert(flags.end(), {{"device", "cpu"}, {"threads", "1"}});
  if (!fps.empty()) flags.push_back({"fps", fps});
  EXPECT_EQ(run_into(folder.path(), experiment, flags), 0);
  const Json manifest = manifest_in(folder.path());
  return {{"metrics", manifest["metrics"]},
          {"state_hash", manifest["state_hash"]},
          {"steps", manifest["steps"]},
          {"warnings", manifest.value("warnings", Json())}};
}

class FrameRate : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Experiments, FrameRate,
                         testing::Values("drape", "swing", "crease", "fold", "crumple", "buckle",
                                         "cantilever", "run"),
                         [](const auto& name) { return std::string(name.param); });

TEST_P(FrameRate, DecidesNoResult) {
  const Json results = results_at(GetParam(), "");
  EXPECT_FALSE(results["metrics"].empty());
  for (const char* fps : {"7", "0"}) EXPECT_EQ(results_at(GetParam(), fps), results) << fps;
}

TEST(FrameRate, IsTriedOnAllExperimentsThatSimulate) {
  for (const Experiment& experiment : experiments())
    EXPECT_EQ(kQuickest.contains(experiment.name),
              experiment.simulates && experiment.defaults && !experiment.timed)
        << experiment.name;
}

}  // namespace
}  // namespace hysteron::experiments
