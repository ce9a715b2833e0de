// The sagging strip against the elastica, on meshes with columns.
#include <nlohmann/json.hpp>

#include "experiments/experiments.h"
#include "sim/error.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {
namespace {

using Words = std::vector<Flag>;

nlohmann::json metrics_of(const Words& flags) {
  const Folder folder;
  CommandLine line{"cantilever", "hysteron cantilever", flags, {}};
  for (const char* on : {"no-images", "quiet"}) line.flags.push_back({on, "true"});
  line.flags.push_back({"out", (folder.path() / "run").string()});
  EXPECT_EQ(cantilever(line), 0);
  return nlohmann::json::parse(text_of(folder.path() / "run" / "manifest.json"))["metrics"];
}

class OnAMesh : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Meshes, OnAMesh, testing::Values("aligned", "flipped", "unionjack"));

// 32 cells along: B off by 5 % moves the drop by more than 2 %, the bending length by 1.7 %.
TEST_P(OnAMesh, DropsAsTheElastica) {
  const auto metrics = metrics_of({{"gamma", "10"}, {"mesh", GetParam()}, {"triangles", "512"}});
  EXPECT_NEAR(metrics["tip_drop_over_length"].get<double>() / 0.7001997, 1, 3e-3);
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 0.3);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / (0.1 / std::cbrt(10)), 1, 3e-3);
}

TEST(Cantilever, FollowsTheElasticaWithFriction) {
  const auto metrics = metrics_of({{"triangles", "512"}, {"law", "prandtl"}});
  EXPECT_LT(std::abs(metrics["error_percent"].get<double>()), 0.3);
  EXPECT_NEAR(metrics["bending_length_m"].get<double>() / metrics["elastica_bending_length_m"].get<double>(),
              1, 5e-3);
}

TEST(Cantilever, RefusesAMeshWithoutColumns) {
  try {
    metrics_of({{"mesh", "random"}, {"triangles", "512"}});
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_NE(std::string(error.what()).find("no columns"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hysteron::experiments
