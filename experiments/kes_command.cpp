// `hysteron kes`: the KES-FB2 pure bending test of laws alone, on fabrics of the assets.
#include <algorithm>
#include <sstream>

#include "experiments/experiments.h"
#include "experiments/kes.h"
#include "experiments/kes_output.h"
#include "experiments/report.h"
#include "experiments/run.h"
#include "sim/error.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

struct KesFlags {
  std::string law = "prandtl";
  Parameters param;
  KesProtocol protocol;
  Options options;
};

using K = KesFlags;
using P = KesProtocol;
// clang-format off
const KeyRow<KesFlags> kRows[] = {
    {"law", at<&K::law>, "", any(), "", "NAME, several apart by commas, or all; see `hysteron list laws`"},
    {"param", at<&K::param>, "", any(), "", "parameters, for those of the laws that have them"},
    {"amplitude", at<&K::protocol, &P::amplitude>, "1/m", positive(), "", "largest curvature; the tester's is 2.5 per cm"},
    {"rate", at<&K::protocol, &P::rate>, "1/(m s)", positive(), "", "of curvature; the tester's is 0.5 per cm and second"},
    {"slope-from", at<&K::protocol, &P::slope_from>, "1/m", at_least(0), "", "B is the slope from here"},
    {"slope-to", at<&K::protocol, &P::slope_to>, "1/m", positive(), "", "to here"},
    {"width-at", at<&K::protocol, &P::width_at>, "1/m", positive(), "", "curvature at which 2HB is read"},
    {"steps", at<&K::protocol, &P::steps>, "", between(10, 1e6), "", "accepted steps from zero to the amplitude"},
    {"cycles", at<&K::protocol, &P::cycles>, "", between(1, 1000), "", "the tester reads the first; the area is that of the last"},
};
// clang-format on
constexpr int kQuickSteps = 1000;

Keys keys_of(KesFlags& flags) {
  Keys keys = bind(kRows, flags);
  const Keys output = bind_output_options(flags.options);
  keys.insert(keys.end(), output.begin(), output.end());
  return keys;
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

std::vector<std::string> chosen_laws(const std::string& list) {
  if (list != "all") return split(list);
  std::vector<std::string> names;
  for (const LawEntry& law : law_catalogue()) names.push_back(law.name);
  return names;
}

std::vector<Fabric> chosen_fabrics(const std::vector<Flag>& flags) {
  std::string list = Fabric{}.name;
  for (const Flag& flag : flags) {
    if (flag.path == "fabric") list = flag.text;
  }
  std::vector<Fabric> fabrics;
  for (const std::string& name : list == "all" ? list_assets("fabrics") : split(list))
    fabrics.push_back(fabric_of(name, flags));
  if (fabrics.empty()) throw Error::request("--fabric names none");
  return fabrics;
}

// With several laws each takes the parameters that it has; one that no law has is refused.
LawParameters parameters_of(const std::string& law, const std::vector<std::string>& laws,
                            const Parameters& given) {
  if (laws.size() == 1) return given;
  const auto has = [](const std::string& name, const std::string& parameter) {
    const std::vector<std::string> names = law_parameter_names(name);
    return std::count(names.begin(), names.end(), parameter) > 0;
  };
  LawParameters own;
  for (const auto& [name, value] : given) {
    if (has(law, name)) own[name] = value;
    if (std::none_of(laws.begin(), laws.end(), [&](const std::string& other) { return has(other, name); }))
      throw Error::request("none of the laws has a parameter " + name + " (--param)");
  }
  return own;
}

KesFabric tested(const Fabric& fabric, const KesFlags& flags, const std::vector<std::string>& laws,
                 bool several_fabrics) {
  const VirginCurve curve = fabric.virgin_curve();
  KesFabric result{fabric, test_in_kes({"prandtl", curve, {}}, flags.protocol), {}};
  for (const std::string& law : laws) {
    const std::string name = several_fabrics ? fabric.name + "." + law : laws.size() > 1 ? law : "";
    result.results.push_back(
        {law, name, test_in_kes({law, curve, parameters_of(law, laws, flags.param)}, flags.protocol)});
  }
  return result;
}

// The manifest's `scene`: all keys resolved, and the fabrics with their sources.
Json resolved(KesFlags& flags, const std::vector<std::string>& laws, const std::vector<Fabric>& fabrics) {
  Json keys = to_json(bind(kRows, flags));
  keys["law"] = join(laws, ",");
  for (const Fabric& fabric : fabrics) {
    Scene scene;
    scene.fabric = fabric;
    const Json numbers = to_json(scene)["fabric"];
    if (fabrics.size() == 1)
      keys["fabric"] = numbers;
    else
      keys["fabrics"].push_back(numbers);
  }
  return keys;
}

}  // namespace

std::vector<KeyDescription> kes_keys() {
  KesFlags flags;
  std::vector<KeyDescription> keys = descriptions(keys_of(flags));
  for (const KeyDescription& key : fabric_keys()) keys.push_back(key);
  return keys;
}

int kes(const CommandLine& line) {
  KesFlags flags;
  set_keys(line, keys_of(flags));
  if (flags.options.quick) {
    flags.protocol.steps = std::min(flags.protocol.steps, kQuickSteps);
    flags.protocol.minor_loops = false;
  }
  check_protocol(flags.protocol);
  const std::vector<std::string> laws = chosen_laws(flags.law);
  if (laws.empty()) throw Error::request("--law names none");
  const std::vector<Fabric> fabrics = chosen_fabrics(line.flags);
  std::vector<KesFabric> results;
  for (const Fabric& fabric : fabrics) results.push_back(tested(fabric, flags, laws, fabrics.size() > 1));

  if (flags.options.out.empty()) flags.options.out = "out/kes";
  Run run(line, flags.options, resolved(flags, laws, fabrics));
  write_metrics(run, results);
  write_tables(run, results, flags.protocol);
  if (!flags.options.no_images) write_plots(run, results, flags.protocol);
  run.path("report.html");
  run.finish();
  write_report(run.folder());
  if (!flags.options.json) print_table(results);
  return 0;
}

}  // namespace hysteron::experiments
