// `hysteron kes`: the KES-FB2 pure bending test of laws, alone or on strips of cloth, on fabrics of the
// assets; with --test the tests of KES-FB1 (in_plane.h).
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/kes/in_plane.h"
#include "experiments/kes/output.h"
#include "experiments/kes/strip_pictures.h"
#include "experiments/workbench/app/experiment.h"
#include "experiments/workbench/app/run.h"
#include "experiments/workbench/pages/report.h"
#include "sim/base/error.h"
#include "sim/reference/kes.h"
#include "sim/scene/assets.h"
#include "sim/scene/keys.h"

namespace hysteron::experiments {
namespace {

struct KesFlags {
  std::string test = "bending";
  std::string law = "prandtl";
  Parameters param;
  KesProtocol protocol;
  std::string on = "law";
  std::string mesh = "aligned";
  StripShape strip;
  Options options;
};

using K = KesFlags;
using P = KesProtocol;
using S = StripShape;
// clang-format off
const KeyRow<KesFlags> kRows[] = {
    {"test", at<&K::test>, "", any(), "bending | shear | tension", "KES-FB2 bending, or shear or tension of KES-FB1, which take along, load, on, mesh, triangles and strip-steps"},
    {"law", at<&K::law>, "", any(), "", "NAME, several separated by commas, or all; see `hysteron list laws`"},
    {"param", at<&K::param>, "", any(), "", "parameters, for those of the laws that have them"},
    {"amplitude", at<&K::protocol, &P::amplitude>, "1/m", positive(), "", "largest curvature; the tester's is 2.5 per cm"},
    {"rate", at<&K::protocol, &P::rate>, "1/(m s)", positive(), "", "rate of the curvature; the tester's is 0.5 per cm and second"},
    {"slope-from", at<&K::protocol, &P::slope_from>, "1/m", at_least(0), "", "curvature from which the slope B is taken"},
    {"slope-to", at<&K::protocol, &P::slope_to>, "1/m", positive(), "", "curvature up to which the slope B is taken"},
    {"width-at", at<&K::protocol, &P::width_at>, "1/m", positive(), "", "curvature at which 2HB is read"},
    {"steps", at<&K::protocol, &P::steps>, "", between(10, 1e6), "", "accepted steps from zero to the amplitude"},
    {"cycles", at<&K::protocol, &P::cycles>, "", between(1, 1000), "", "number of cycles; the tester reads the first, the area is that of the last"},
    {"on", at<&K::on>, "", any(), "law | strip", "the law alone, or beside it a strip of cloth between rotating clamps"},
    {"renderer", at<&K::options, &Options::renderer>, "", any(), "auto | egl | osmesa", "how pictures of strips are drawn"},
};
const KeyRow<KesFlags> kStripRows[] = {
    {"mesh", at<&K::mesh>, "", any(), "", "of strips, several separated by commas: aligned, aligned-45, flipped, unionjack, equilateral, random; or all"},
    {"element", at<&K::strip, &S::element>, "", any(), "", "bending element of strips"},
    {"triangles", at<&K::strip, &S::triangles>, "", between(20, 1e6), "", "about how many a strip has; their size times the amplitude must stay small"},
    {"cloth.width", at<&K::strip, &S::width>, "m", positive(), "", "of strips; 1 cm is between the clamps"},
    {"strip-steps", at<&K::strip, &S::steps>, "", between(4, 1e5), "", "equilibria of a strip from zero to the amplitude"},
};
// clang-format on
constexpr int kQuickSteps = 1000, kQuickStripSteps = 18;

Keys option_keys(KesFlags& flags) {
  Keys keys = bind(kRows, flags);
  for (const BoundKey& key : bind(kStripRows, flags)) keys.push_back(key);
  return with_output_options(keys, flags.options);
}

// All that can be tested: a strip gets no orders on its way.
std::vector<std::string> chosen_laws(const std::string& list, bool on_strip) {
  std::vector<std::string> every = law_names();
  if (on_strip) std::erase(every, "grinspun-edit");
  return listed(list, every);
}

std::vector<Fabric> chosen_fabrics(const std::vector<Flag>& flags) {
  const std::string list = last_text(flags, "fabric", Fabric{}.name);
  std::vector<Fabric> fabrics;
  for (const std::string& name : listed(list, list_assets("fabrics")))
    fabrics.push_back(resolved_fabric(name, flags));
  if (fabrics.empty()) throw Error::invalid_input("--fabric names none").with_key("fabric", list);
  return fabrics;
}

// With several laws each takes the parameters that it has; one that no law has is refused.
LawParameters accepted_parameters(const std::string& law, const std::vector<std::string>& laws,
                                  const Parameters& given) {
  if (laws.size() == 1) return given;
  const auto has = [](const std::string& name, const std::string& parameter) {
    const std::vector<std::string> names = law_parameter_names(name);
    return std::count(names.begin(), names.end(), parameter) > 0;
  };
  LawParameters own;
  for (const auto& [name, value] : given) {
    if (has(law, name)) own[name] = value;
    if (std::none_of(laws.begin(), laws.end(),
                     [&, &name = name](const std::string& other) { return has(other, name); }))
      throw Error::invalid_input("none of the laws has a parameter " + name + " (--param)")
          .with_key("param", name + "=" + value);
  }
  return own;
}

void throw_if_strip_keys(const CommandLine& line) {
  for (const Flag& flag : line.flags)
    for (const KeyRow<KesFlags>& row : kStripRows)
      if (flag.path == row.path)
        throw Error::invalid_input("--" + flag.path + " is of strips: it needs --on strip")
            .with_key(flag.path, flag.text);
}

// Where no equilibrium is found, the test of other strips goes on.
StripResult strip_tested(const Fabric& fabric, const KesFlags& flags, const LawRequest& law,
                         const std::string& mesh, bool several_meshes) {
  StripShape shape = flags.strip;
  shape.mesh = mesh;
  const ClampedStrip strip = clamped_strip(shape, law, fabric, flags.protocol);
  StripResult result;
  result.mesh = mesh;
  result.element = enum_name(shape.element);
  result.prefix = several_meshes ? mesh + "." : "";
  result.triangles = strip.cloth.mesh.faces();
  result.spacing = strip.spacing;
  result.walk = strip.walk;
  StripPictures pictures(flags.options, strip);
  const StripWatch watch = [&](std::size_t row, Simulation& simulation) { pictures.watch(row, simulation); };
  try {
    result.test = test_strip(strip, law, flags.protocol, flags.options.no_images ? StripWatch{} : watch);
    result.pictures = pictures.taken(result.test);
    result.renderer = pictures.renderer();
  } catch (const Error& error) {
    if (error.exit_code() != 3) throw;
    result.failure = error.what();
  }
  if (!flags.options.quiet && result.failure.empty())
    std::cerr << fabric.name << ", " << law.name << ", strip " << mesh << ": tested" << std::endl;
  return result;
}

// The others of them are missing in the tables.
void warn_of_failures(const std::vector<KesFabric>& fabrics, Run& run) {
  for (const KesFabric& fabric : fabrics)
    for (const KesResult& result : fabric.results)
      for (const StripResult& strip : result.strips)
        if (!strip.failure.empty())
          run.warn(fabric.fabric.name + ", " + result.law + ", strip " + strip.mesh + ": " + strip.failure);
}

// Not a single strip could be tested.
void throw_if_failures(const std::vector<KesFabric>& fabrics) {
  std::string failure;
  for (const KesFabric& fabric : fabrics)
    for (const KesResult& result : fabric.results)
      for (const StripResult& strip : result.strips) {
        if (strip.failure.empty()) return;
        failure = strip.failure;
      }
  if (!failure.empty()) throw Error::simulation(failure);
}

KesFabric tested(const Fabric& fabric, const KesFlags& flags, const std::vector<std::string>& laws,
                 bool several_fabrics) {
  const VirginCurve curve = fabric.virgin_curve();
  KesFabric result{fabric, test_in_kes({"prandtl", curve, {}}, flags.protocol), {}};
  for (const std::string& law : laws) {
    const std::string name = several_fabrics ? fabric.name + "." + law : laws.size() > 1 ? law : "";
    const LawRequest request{law, curve, accepted_parameters(law, laws, flags.param)};
    result.results.push_back({law, name, test_in_kes(request, flags.protocol)});
    if (flags.on == "law") continue;
    const std::vector<std::string> meshes = listed(flags.mesh, strip_meshes());
    for (const std::string& mesh : meshes)
      result.results.back().strips.push_back(strip_tested(fabric, flags, request, mesh, meshes.size() > 1));
  }
  return result;
}

// The manifest's `scene`: all keys resolved, and the fabrics with their sources.
Json resolved(KesFlags& flags, const std::vector<std::string>& laws, const std::vector<Fabric>& fabrics) {
  Json keys = to_json(bind(kRows, flags));
  if (flags.on == "strip") keys.update(to_json(bind(kStripRows, flags)), true);
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

int run_kes(const CommandLine& line) {
  KesFlags flags;
  if (last_text(line.flags, "test", flags.test) != flags.test) return run_in_plane(line);
  throw_if_other_tests(line, option_keys(flags), flags.test);
  set_keys(line, option_keys(flags), [&] {
    flags.protocol.steps = std::min(flags.protocol.steps, kQuickSteps);
    flags.protocol.minor_loops = false;
    flags.strip.steps = std::min(flags.strip.steps, kQuickStripSteps);
  });
  if (flags.on == "law") throw_if_strip_keys(line);
  check_protocol(flags.protocol);
  const std::vector<std::string> laws = chosen_laws(flags.law, flags.on == "strip");
  if (laws.empty()) throw Error::invalid_input("--law names none").with_key("law", flags.law);
  const std::vector<Fabric> fabrics = chosen_fabrics(line.flags);
  std::vector<KesFabric> results;
  for (const Fabric& fabric : fabrics) results.push_back(tested(fabric, flags, laws, fabrics.size() > 1));
  throw_if_failures(results);

  Run run(line, flags.options, resolved(flags, laws, fabrics));
  warn_of_failures(results, run);
  write_metrics(run, results);
  write_tables(run, results, flags.protocol);
  if (!flags.options.no_images) write_plots(run, results, flags.protocol);
  finish_with_report(run);
  if (!flags.options.json) print_table(results);
  return 0;
}

}  // namespace

Experiment kes() {
  return {
      .name = "kes",
      .question = "virtual KES tests: bending (B, 2HB, residual curvature), shear (G, 2HG), tension (WT, RT)",
      .run = run_kes,
      .own_keys = own_key_descriptions<option_keys, fabric_keys, in_plane_keys>};
}

}  // namespace hysteron::experiments
