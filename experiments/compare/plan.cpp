#include "experiments/compare/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "experiments/workbench/app/case.h"
#include "experiments/workbench/app/scene_source.h"
#include "sim/base/error.h"
#include "sim/base/number_in.h"

namespace hysteron::experiments {
namespace {

constexpr const char* kLaws = "linear,pabst,obrien,narain,kim,dahl,prandtl";
constexpr const char* kReferenceLaw = "prandtl";

// True for flags that make the columns; all others are theirs.
bool is_own(const Flag& flag) {
  return flag.path.starts_with("compare.") || flag.path == "laws" || flag.path == "fabrics" ||
         flag.path == "integrators" || flag.path == "batch";
}

// Adds flags for the stiffnesses of the parts that a fabric has.
void add_parts(const BendingParts& parts, std::vector<Flag>& flags) {
  const auto add = [&](const char* table, const std::vector<double>& stiffnesses) {
    const std::string key = std::string("fabric.bending.") + table + ".stiffnesses";
    if (!stiffnesses.empty()) flags.push_back({key, stiffnesses});
  };
  add("stops", parts.stops.stiffnesses);
  add("stops.weft", parts.weft_stops.stiffnesses);
  add("branches", parts.branches.stiffnesses);
  if (parts.set.on()) flags.push_back({"fabric.bending.set.hardening", parts.set.hardening});
}

// Returns the keys of bending of a column's scene before any matching, by the experiment's defaults,
// the scene's file and the flags, as the column's run resolves it.
Scene bending_scene(const CommandLine& line) {
  Setup setup = setup_of_file(line);
  std::vector<Flag> bending;
  for (const Flag& flag : line.flags)
    if (flag.path.starts_with("fabric") || flag.path == "law" || flag.path == "param")
      bending.push_back(flag);
  apply_flags(setup.scene, bending);
  return setup.scene;
}

LawRequest requested_law(const Scene& scene) { return {scene.law, scene.fabric.virgin_curve(), scene.param}; }

// Returns the law whose stiffness all columns get.  It depends neither on their order nor on other laws
// beside them: prandtl, or the one law that all of them have.
std::string reference_law(const std::set<std::string>& laws) {
  return laws.size() == 1 ? *laws.begin() : kReferenceLaw;
}

// Returns the reference of a column on that fabric: the reference law as the column that has it runs it, on
// the same fabric if there is one, with the fewest own keys if there are several; if none has it, the
// law without parameters.
LawRequest reference_request(const std::vector<Scene>& scenes, const std::vector<Variant>& variants,
                             const std::string& law, const Scene& column) {
  std::optional<std::size_t> best;
  const auto rank = [&](std::size_t v) {
    std::string keys;
    for (const Flag& flag : variants[v].flags) keys += flag.path + "=" + flag.text() + "\n";
    return std::tuple(scenes[v].fabric.name != column.fabric.name, variants[v].flags.size(), keys);
  };
  for (std::size_t v = 0; v < scenes.size(); ++v)
    if (scenes[v].law == law && (!best || rank(v) < rank(*best))) best = v;
  LawRequest reference;
  reference.name = law;
  if (best) reference.parameters = scenes[*best].param;
  reference.curve = column.fabric.virgin_curve();
  return reference;
}

// Returns flags that make the column as stiff as the law of `reference` on the same fabric.  Its viscosity,
// fabric.damping times b1, is scaled with it.
std::vector<Flag> matched(const Scene& column, const LawRequest& reference, const CompareParams& choice,
                          double& scale) {
  scale = 1;
  if (choice.match == Match::fabric) return {};
  const Fabric& fabric = column.fabric;
  scale = matching_scale(requested_law(column), reference, choice.match, choice.match_curvature);
  const auto scaled = [&](const char* key, double value) { return Flag{key, scale * value}; };
  BendingParts parts = stiffened(fabric.bending, scale);
  std::vector<Flag> flags = {scaled("fabric.b2", fabric.b2)};  // b1 follows from stops, which replace it
  if (fabric.bending.stops.empty()) flags.insert(flags.begin(), scaled("fabric.b1", fabric.b1));
  if (fabric.kes.on()) {  // the others follow
    flags = {scaled("fabric.kes-b", fabric.kes.read.rigidity),
             scaled("fabric.kes-2hb", fabric.kes.read.loop_width)};
    parts.stops = {};
  }
  add_parts(parts, flags);
  return flags;
}

// Throws for a column that names its own stiffness, as it would run with another one.
void refuse_rescaled(const Variant& variant, double scale, const CompareParams& choice) {
  constexpr const char* kStiffnesses[] = {"fabric.b1", "fabric.b2", "fabric.k0", "fabric.kes-b",
                                          "fabric.kes-2hb"};
  if (scale == 1) return;
  for (const Flag& flag : variant.flags)
    if (std::ranges::find(kStiffnesses, flag.path) != std::end(kStiffnesses))
      throw Error::invalid_input("column " + variant.name + ": " + flag.path + " = " + flag.text() +
                                 " would be multiplied by " + number_text(scale, 4) +
                                 ", since compare.match = " + enum_name(choice.match) +
                                 " gives the column a stiffness: --compare.match fabric leaves it as it is")
          .with_key("compare.match", enum_name(choice.match));
}

// Returns one range, so that colours mean the same in all columns, whatever their transition curvatures.
Flag shared_range(const CommandLine& inner, const std::vector<Scene>& columns) {
  double most = 0;
  for (const Scene& column : columns) most = std::max(most, column.fabric.friction_curvature());
  Flag range = {"curvature-range", 2 * most};
  for (const Flag& flag : inner.flags)
    if (flag.path == range.path) range = flag;
  return range;
}

// Returns the flags that the page adds to those of the experiment alone.
std::vector<Flag> requested_for_page(const CommandLine& inner, const CompareParams& choice,
                                     const std::filesystem::path& out, bool is_reference) {
  std::vector<Flag> flags = for_sheets(inner);
  std::string look = last_text(inner.flags, "look", "cloth");
  if (!choice.no_outlines) look += ",silhouette";
  if (!choice.to.empty() && choice.difference == Difference::curvature) {
    if (is_reference)
      flags.push_back({"export", "ply"});
    else
      look += ",difference", flags.push_back({"reference", (out / choice.to).string()});
  }
  flags.push_back({"look", look});
  if (last_text(inner.flags, "size", "").empty()) flags.push_back({"size", "1120x840"});
  return flags;
}

}  // namespace

std::string compared_experiments() {
  std::string known;
  for (const Experiment& experiment : experiments())
    if (experiment.compared) known += std::string(experiment.name) + ", ";
  return known + "or a scene";
}

namespace {

// Throws for a single value beside a list of the same key, which leaves it no meaning.
void refuse_beside_list(const CommandLine& line, const std::string& key, const std::string& list) {
  const std::string one = last_text(line.flags, key, "");
  if (list.empty() || one.empty()) return;
  throw Error::invalid_input(key + " = " + one + " is not used beside " + key + "s = " + list +
                             ", of which each column has its own (--" + key + ")")
      .with_key(key, one);
}

}  // namespace

CommandLine line_of_columns(const CommandLine& line, const CompareParams& choice) {
  refuse_beside_list(line, "law", choice.laws);
  refuse_beside_list(line, "fabric", choice.fabrics);
  refuse_beside_list(line, "integrator", choice.integrators);
  CommandLine inner = line;
  inner.positionals.clear();
  const std::string what = line.positionals.front();
  const Experiment& experiment = experiment_named(what);
  if (experiment.name == what && !experiment.compared)
    throw Error::invalid_input(what + " cannot be compared: compare takes " + compared_experiments());
  inner.experiment = experiment.compared ? what : "run";
  std::erase_if(inner.flags, is_own);
  if (inner.experiment != what) {
    refuse_two_scenes(line);
    inner.flags.push_back({"scene", what});
  }
  if (!choice.fabrics.empty()) inner.flags.push_back({"fabric", choice.fabrics});
  if (!choice.integrators.empty()) inner.flags.push_back({"integrator", choice.integrators});
  const bool others = !choice.fabrics.empty() || !choice.integrators.empty();
  const std::string laws =
      !choice.laws.empty() || others ? choice.laws : last_text(inner.flags, "law", kLaws);
  if (!laws.empty()) inner.flags.push_back({"law", laws});
  return inner;
}

Plan comparison_plan(const CommandLine& inner, const std::vector<Variant>& variants,
                     const CompareParams& choice, const std::filesystem::path& out) {
  Plan plan;
  std::vector<Scene> scenes;
  for (const Variant& variant : variants) scenes.push_back(bending_scene(with_variant(inner, variant)));
  std::set<std::string> laws;
  for (const Scene& scene : scenes) laws.insert(scene.law);
  plan.laws = laws.size();
  plan.reference = reference_law(laws);
  plan.has_reference = laws.contains(plan.reference);
  plan.has_faces =
      std::ranges::any_of(scenes, [](const Scene& scene) { return scene.fabric.bending.faces.on(); });
  const Flag range = shared_range(inner, scenes);
  const std::vector<Flag> framing = shared_framing(inner, variants);
  plan.varied = varied_key(variants);
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const Variant& variant = variants[v];
    double scale = 1;
    std::vector<Flag> own = variant.flags;
    const LawRequest reference = reference_request(scenes, variants, plan.reference, scenes[v]);
    for (const Flag& flag : matched(scenes[v], reference, choice, scale)) own.push_back(flag);
    refuse_rescaled(variant, scale, choice);
    const std::string name = variant.name.empty() ? inner.experiment : variant.name;
    if (name == choice.to) plan.to = static_cast<int>(plan.columns.size());
    own.push_back(range);
    own.insert(own.end(), framing.begin(), framing.end());
    for (const Flag& flag : requested_for_page(inner, choice, out, name == choice.to)) own.push_back(flag);
    plan.columns.push_back(child_run(name, inner, own, out));
    plan.scales.push_back(scale);
  }
  if (!choice.to.empty() && plan.to < 0)
    throw Error::invalid_input("compare.to = " + choice.to + " is no column (--compare.to)")
        .with_key("compare.to", choice.to);
  return plan;
}

void check_times(const std::vector<double>& times, const std::vector<ChildRun>& columns) {
  if (times.empty()) return;
  const double last = *std::max_element(times.begin(), times.end());
  double end = 0;
  for (auto column = columns.begin(); column != columns.end() && end < last; ++column) {
    const std::unique_ptr<Case> own = experiment_named(column->line.experiment).case_of(column->line);
    if (!own)
      throw Error::invalid_input("compare.times: " + column->name +
                                 " simulates no cloth to picture (--compare.times)")
          .with_key("compare.times", "");
    end = std::max(end, own->setup.scene.seconds);
  }
  if (last <= end) return;
  throw Error::invalid_input(
      fmt::format("compare.times = {:g} s must be in [0, {:g}] s, the time of the run (--compare.times)",
                  last, end))
      .with_key("compare.times", number_text(last, 6));
}

}  // namespace hysteron::experiments
