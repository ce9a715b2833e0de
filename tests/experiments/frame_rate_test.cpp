// No result depends on the rate of pictures: every experiment that simulates runs at several of them.
#include <map>
#include <optional>

#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

// The quickest forms, where others than kOthers; each has to cover what its experiment reads on the way.
const std::map<std::string, std::vector<Flag>> kQuickest = {
    {"drape",  // settles before its time is over
     {{"triangles", 60}, {"drape.lowering", 0.1}, {"seconds", 1.5}, {"drape.still", 0.4}}},
    {"swing", {{"triangles", 60}, {"seconds", 1.2}}},
    {"crease", {{"triangles", 60}, {"crease.fold", "pleat"}, {"crease.recovery", 0.1}}},
    {"fold", {{"triangles", 60}, {"fold.cycles", 2}}},
    {"crumple", {{"triangles", 100}, {"seconds", 0.1}}},
    {"buckle", {{"triangles", 60}}},
    {"cantilever", {{"triangles", 60}}},
    {"run", {{"scene", "hanging-square"}, {"triangles", 60}}}};
const std::vector<Flag> kOthers = {{"triangles", 60}, {"seconds", 0.1}};

std::vector<std::string> simulating_experiments() {
  std::vector<std::string> names;
  for (const Experiment& experiment : experiments())
    if (experiment.simulates && experiment.defaults && !experiment.timed) names.push_back(experiment.name);
  return names;
}

Json results_at(const std::string& experiment, std::optional<double> fps) {
  const Folder folder;
  const auto quickest = kQuickest.find(experiment);
  std::vector<Flag> flags = quickest == kQuickest.end() ? kOthers : quickest->second;
  flags.insert(flags.end(), {{"device", "cpu"}, {"threads", 1}});
  if (fps) flags.push_back({"fps", *fps});
  EXPECT_EQ(run_into(folder.path(), experiment, flags), 0);
  const Json manifest = manifest_in(folder.path());
  return {{"metrics", manifest["metrics"]},
          {"state_hash", manifest["state_hash"]},
          {"steps", manifest["steps"]},
          {"warnings", manifest.value("warnings", Json())}};
}

class FrameRate : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Experiments, FrameRate, testing::ValuesIn(simulating_experiments()),
                         [](const auto& name) { return name.param; });

TEST_P(FrameRate, DecidesNoResult) {
  const Json results = results_at(GetParam(), std::nullopt);
  EXPECT_FALSE(results["metrics"].empty());
  for (const double fps : {7, 0}) EXPECT_EQ(results_at(GetParam(), fps), results) << fps;
}

TEST(FrameRate, HasQuickestFormsOfExperimentsAlone) {
  for (const auto& [name, flags] : kQuickest) EXPECT_EQ(experiment_named(name).name, name) << flags.size();
}

}  // namespace
}  // namespace hysteron::experiments
