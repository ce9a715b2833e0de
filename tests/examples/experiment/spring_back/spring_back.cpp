// This experiment computes how far a fabric springs back from one bend: its residual curvature under a law,
// without cloth.
#include <nlohmann/json.hpp>

#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run.h"
#include "sim/bending/laws/recovery.h"

namespace hysteron::experiments {
namespace {

struct SpringBackChoice {
  std::string law = "prandtl";
  double curvature = 200;
};
using S = SpringBackChoice;
// clang-format off
const KeyRow<S> kRows[] = {
    {"law", at<&S::law>, "", any(), "see `hysteron list laws`"},
    {"curvature", at<&S::curvature>, "1/m", positive(), "to which the fabric is bent before it is let go"},
};
// clang-format on

Keys option_keys(SpringBackChoice& choice, Options& options) {
  Keys keys = bind(kRows, choice);
  for (const BoundKey& key : bind_output_options(options)) keys.push_back(key);
  return keys;
}

std::vector<KeyDescription> own_keys() {
  SpringBackChoice choice;
  Options options;
  std::vector<KeyDescription> keys = descriptions(option_keys(choice, options));
  for (const KeyDescription& key : fabric_keys()) keys.push_back(key);
  return keys;
}

int run_spring_back(const CommandLine& line) {
  SpringBackChoice choice;
  Options options;
  options.out = "out/spring-back";
  set_keys(line, option_keys(choice, options));
  Scene scene;
  scene.law = choice.law;
  scene.fabric = resolved_fabric(last_text(line.flags, "fabric", Fabric{}.name), line.flags);
  const double residual = residual_after({choice.law, scene.fabric.virgin_curve(), {}}, {{choice.curvature}});
  const Json keys = {{"law", choice.law}, {"fabric", to_json(scene)["fabric"]}};
  Run run(line, options, keys);
  run.metric("residual_curvature_per_m", residual);
  run.metric("recovered_percent", 100 * (1 - residual / choice.curvature));
  run.finish();
  return 0;
}

}  // namespace

Experiment spring_back() {
  return {.name = "spring-back",
          .question = "residual curvature after one bend of a fabric",
          .run = run_spring_back,
          .own_keys = own_keys};
}

}  // namespace hysteron::experiments
