#include <nlohmann/json.hpp>

#include "experiments/workbench/app/experiment.h"
#include "sim/bending/laws/recovery.h"
#include "sim/scene/fabric_reader.h"
#include "tests/experiments/folder.h"

namespace hysteron::experiments {

Experiment spring_back();

namespace {

TEST(SpringBackExample, FindsTheResidualCurvatureOfTheClosedForm) {
  constexpr double kRounding = 1e-9;
  const Folder folder;
  const auto out = folder.path() / "s";
  const CommandLine line{"spring-back",
                         "hysteron spring-back",
                         {{"law", "bilinear"}, {"curvature", 150}, {"out", out.string()}, {"quiet", true}},
                         {}};
  ASSERT_EQ(spring_back().run(line), 0);
  const VirginCurve curve = read_fabric(Fabric{}.name, "test").fabric.virgin_curve();
  const double moment = curve.friction_moment() + curve.b2 * 150;  // beyond K0, on the straight line
  const double residual = residual_by_formula(choose_law("bilinear", curve, {}), 150, moment);
  const auto metrics = metrics_of(out);
  EXPECT_GT(residual, 0);
  EXPECT_NEAR(metrics["residual_curvature_per_m"], residual, kRounding * 150);
  EXPECT_NEAR(metrics["recovered_percent"], 100 * (1 - residual / 150), kRounding * 100);
}

}  // namespace
}  // namespace hysteron::experiments
