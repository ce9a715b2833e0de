#include "experiments/bench/law_cost.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/bending/laws/law_run.h"
#include "sim/time/back_end.h"

namespace hysteron::experiments {
namespace {

struct Variant {
  const char* law;
  LawParameters parameters;
  const char* parts = "";  // that the fabric has beyond three numbers
};

// The even stops of these three numbers as a fabric's own, a second set along weft, two branches, a set.
BendingParts parts_of(const std::string& words, const VirginCurve& curve) {
  BendingParts parts;
  const auto has = [&](const char* word) { return words.find(word) != std::string::npos; };
  if (has("stops")) parts.stops = even_stops(curve.b1 - curve.b2, curve.k0, has("32") ? 32 : 8);
  if (has("weft")) parts.weft_stops = parts.stops;
  if (has("branches")) parts.branches = {{1, 100}, {curve.b2 / 2, curve.b2 / 2}};
  if (has("set")) parts.set = {3 * curve.k0, curve.b2 / 2};
  return parts;
}

std::vector<Variant> variants() {
  std::vector<Variant> all = {{"linear", {}}, {"bilinear", {}}, {"wong", {}}, {"dahl", {}}};
  for (const char* n : {"4", "8", "16", "32"})
    all.push_back({"prandtl", {{"memory", "stops"}, {"stops", n}}});
  for (const char* n : {"4", "6", "8", "16"}) all.push_back({"prandtl", {{"memory", "stack"}, {"stack", n}}});
  for (const char* parts : {"own stops 8", "own stops 32", "own stops 8, weft", "own stops 8, set"})
    all.push_back({"prandtl", {}, parts});
  for (const char* parts : {"own stops 8, branches", "own stops 8, branches, set"})
    all.push_back({"chapman", {}, parts});
  return all;
}

// Turns of widely different sizes within +-2 k0, with steps on the way.
std::vector<LawRow> random_history(double k0, unsigned seed) {
  constexpr int kTurns = 200, kSteps = 5;
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<LawRow> rows;
  double at = 0;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double to = 2 * k0 * uniform(generator) * std::abs(uniform(generator));
    for (int i = 1; i <= kSteps; ++i) rows.push_back({at + (to - at) * i / kSteps});
    at = to;
  }
  return rows;
}

struct MomentError {
  double largest = 0, rms = 0;  // [N]
};

MomentError moment_error(const Variant& variant, const VirginCurve& curve) {
  constexpr unsigned kHistories = 100;
  MomentError error;
  if (*variant.parts) return {NAN, NAN};  // another law than the exact one
  double squares = 0, count = 0;
  for (unsigned seed = 1; seed <= kHistories; ++seed) {
    const std::vector<LawRow> rows = random_history(curve.k0, seed);
    const auto exact = run_law({"prandtl", curve, {}}, rows).moment;
    const auto rough = run_law({variant.law, curve, variant.parameters}, rows).moment;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double e = std::abs(rough[i] - exact[i]);
      error.largest = std::max(error.largest, e);
      squares += e * e;
      ++count;
    }
  }
  error.rms = std::sqrt(squares / count);
  return error;
}

bool on_gpu(const Scene& scene) {
  std::string reason;
  return scene.device == DeviceChoice::cuda ||
         (scene.device == DeviceChoice::automatic && gpu_count(reason) > 0);
}

}  // namespace

std::vector<Metrics> law_cost_table(const Scene& scene, int elements) {
  const VirginCurve curve = scene.fabric.virgin_curve();
  const bool gpu = on_gpu(scene);
  std::vector<Metrics> rows;
  for (const Variant& variant : variants()) {
    const MomentError error = moment_error(variant, curve);
    for (const int dimension : {1, 3}) {
      VirginCurve own = curve;
      if (*variant.parts) own.parts = parts_of(variant.parts, curve);
      const LawChoice choice = choose_law(variant.law, own, variant.parameters);
      const LawCost cost = gpu ? gpu_law_cost(choice, dimension, elements, scene.precision)
                               : cpu_law_cost(choice, dimension, elements, scene.precision, scene.threads);
      const auto size = [&](const char* key) {
        const auto found = variant.parameters.find(key);
        return found == variant.parameters.end() ? std::string() : " " + found->second;
      };
      const std::string memory = choice.name != "prandtl" ? "" : choice.stack ? " stack" : " stops";
      rows.push_back(Metrics{{"law", variant.law + (*variant.parts ? " " + std::string(variant.parts)
                                                                   : memory + size("stops") + size("stack"))},
                             {"element", dimension == 1 ? "hinge" : "shape"},
                             {"largest_error_percent_of_M0", 100 * error.largest / curve.friction_moment()},
                             {"rms_error_percent_of_M0", 100 * error.rms / curve.friction_moment()},
                             {"ns_per_element", cost.ns_per_element},
                             {"history_bytes_per_element", cost.bytes_per_element},
                             {"elements", elements},
                             {"precision", name_of(scene.precision)},
                             {"device", gpu ? gpu_description(0) : cpu_description()}});
    }
  }
  return rows;
}

}  // namespace hysteron::experiments
