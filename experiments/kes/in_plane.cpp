#include "experiments/kes/in_plane.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/kes/in_plane_output.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

struct InPlaneFlags {
  std::string test = "shear";
  Along along = Along::warp;
  std::string on = "law";
  InPlaneProtocol protocol;
  InPlaneSpecimen specimen;
  Options options;
};
using F = InPlaneFlags;
using S = InPlaneSpecimen;
using P = InPlaneProtocol;
// clang-format off
const KeyRow<InPlaneFlags> kOwnRows[] = {
    {"along", at<&F::along>, "", any(), "", "shear, tension: the direction from clamp to clamp"},
    {"load", at<&F::protocol, &P::largest>, "N/m", positive(), "", "tension: largest force per width; the tester's is 500 gf/cm"},
};
// As of the bending test's.
const KeyRow<InPlaneFlags> kSharedRows[] = {
    {"test", at<&F::test>, "", any(), "bending | shear | tension", "KES-FB2 bending, KES-FB1 shear or tension"},
    {"on", at<&F::on>, "", any(), "law | strip", "the law alone, or beside it a specimen of cloth"},
    {"mesh", at<&F::specimen, &S::mesh>, "", any(), "", "of the specimen"},
    {"triangles", at<&F::specimen, &S::triangles>, "", between(80, 1e6), "", "about how many it has"},
    {"strip-steps", at<&F::specimen, &S::steps>, "", between(4, 1e5), "", "its equilibria from zero to the largest"},
};
// clang-format on
constexpr int kQuickTriangles = 400;

Keys option_keys(InPlaneFlags& flags) {
  Keys keys = bind(kSharedRows, flags);
  for (const BoundKey& key : bind(kOwnRows, flags)) keys.push_back(key);
  return with_output_options(keys, flags.options);
}

template <class Test, class OnCloth>
void test_on_cloth(InPlaneResult& result, const Test& law, const InPlaneFlags& flags,
                   const OnCloth& on_cloth) {
  result.law = in_plane_loop(law);
  if (flags.on == "law") return;
  InPlaneSpecimen coarse = flags.specimen;
  coarse.triangles /= 4;
  const auto cloth = on_cloth(result.fabric, flags.along, flags.specimen, flags.protocol);
  result.cloth = in_plane_loop(cloth.test);
  result.coarse = in_plane_loop(on_cloth(result.fabric, flags.along, coarse, flags.protocol).test);
  result.tension = cloth.tension;
  result.triangles = cloth.triangles;
  result.seconds = cloth.seconds;
}

InPlaneResult tested(const Fabric& fabric, InPlaneTest test, const InPlaneFlags& flags) {
  InPlaneResult result;
  result.fabric = fabric;
  const InPlaneLaw law = in_plane_law(fabric, flags.along);
  if (test == InPlaneTest::shear)
    test_on_cloth(result, test_shear(law, flags.protocol), flags, shear_cloth);
  else
    test_on_cloth(result, test_tension(law, flags.protocol), flags, stretch_cloth);
  return result;
}

Json resolved(InPlaneFlags& flags, const Fabric& fabric) {
  Json keys = to_json(option_keys(flags));
  Scene scene;
  scene.fabric = fabric;
  keys["fabric"] = to_json(scene)["fabric"];
  return keys;
}

}  // namespace

void throw_if_other_tests(const CommandLine& line, const Keys& keys, const std::string& test) {
  for (const Flag& flag : line.flags) {
    if (flag.path.starts_with("fabric")) continue;
    const auto is_it = [&](const BoundKey& key) { return key.description.path == flag.path; };
    if (std::none_of(keys.begin(), keys.end(), is_it))
      throw Error::invalid_input("--" + flag.path + " is not of --test " + test)
          .with_key(flag.path, flag.text);
  }
}

int run_in_plane(const CommandLine& line) {
  InPlaneFlags flags;
  throw_if_other_tests(line, option_keys(flags), last_text(line.flags, "test", flags.test));
  set_keys(line, option_keys(flags),
           [&] { flags.specimen.triangles = std::min(flags.specimen.triangles, kQuickTriangles); });
  const auto test = value_named<InPlaneTest>(flags.test);
  const Fabric fabric = resolved_fabric(last_text(line.flags, "fabric", Fabric{}.name), line.flags);
  const InPlaneResult result = tested(fabric, test, flags);
  Run run(line, flags.options, resolved(flags, fabric));
  write_in_plane_metrics(run, result);
  write_in_plane_tables(run, result, test);
  if (!flags.options.no_images) write_in_plane_plot(run, result, test);
  finish_with_report(run);
  return 0;
}

std::vector<KeyDescription> in_plane_keys() {
  std::vector<KeyDescription> keys = key_descriptions(kOwnRows);
  for (const KeyDescription& key : scene_keys()) {
    const bool stiffness =
        key.path == "fabric.warp" || key.path == "fabric.weft" || key.path == "fabric.shear";
    if (stiffness || key.path.starts_with("fabric.membrane.")) keys.push_back(key);
  }
  return keys;
}

}  // namespace hysteron::experiments
