// Every law of the catalogue, and those of tests/examples, with every parameter that changes what they do, as
// types: for tests that must hold for all of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_visit.h"
#include "tests/examples/law/exponential.h"

namespace hysteron::testing {

using ExampleLaws = LawList<ExponentialLaw>;  // a law that no program ships

// What a fabric has beyond three numbers, on the scale of these, so that extreme fabrics have it as well.
enum Part { kStops = 1, kManyStops = 2, kWeft = 4, kBranches = 8, kSet = 16 };

inline Spectrum spectrum_of(const VirginCurve& curve, int count) {
  const double scale = curve.k0 > 0 ? curve.k0 : 1;
  Spectrum stops;
  for (int j = 0; j < count; ++j) {
    stops.thresholds.push_back(scale * 1.7 * (j + 0.3) * (j + 1) / (count * count));  // beyond k0 as well
    stops.stiffnesses.push_back((curve.b1 - curve.b2) * (1.5 - 1.0 * j / count) / count);
  }
  return stops;
}

// Yields at 1.2 k0, branches of a third and a half of the friction's stiffness.
inline BendingParts parts_of(int which, const VirginCurve& curve) {
  BendingParts parts;
  const double g = curve.b1 - curve.b2;
  if (which & (kStops | kManyStops)) parts.stops = spectrum_of(curve, which & kManyStops ? 12 : 5);
  if (which & kWeft) {
    parts.weft_stops = parts.stops;
    for (double& r : parts.weft_stops.thresholds) r *= 0.6;
    for (double& p : parts.weft_stops.stiffnesses) p *= 1.3;
  }
  if ((which & kBranches) && g > 0) parts.branches = {{0.2, 5}, {g / 3, g / 2}};
  if (which & kSet) parts.set = {1.2 * curve.k0, curve.b2 / 2};
  return parts;
}

struct LawCase {
  std::string name;  // of the law, with its variant
  std::string law;
  LawParameters parameters;
  bool passive = true;  // gives no energy back
  bool timed = false;
  int parts = 0;  // of enum Part
  bool radial() const { return !(parts & kWeft); }
};

inline std::vector<LawEntry> laws_and_examples() {
  std::vector<LawEntry> laws = law_catalogue();
  for (const LawEntry& law : law_entries(ExampleLaws{})) laws.push_back(law);
  return laws;
}

inline const LawEntry& law_or_example(const std::string& name) {
  static const std::vector<LawEntry> laws = laws_and_examples();
  for (const LawEntry& law : laws)
    if (law.name == name) return law;
  throw Error::invalid_input("no law or example of a law is called " + name);
}

// Fatigue here is strong: half of the friction moment is gone after a few full cycles of cotton broad.
inline std::vector<LawCase> law_cases() {
  std::vector<LawCase> cases;
  for (const LawEntry& law : laws_and_examples()) cases.push_back({law.name, law.name, {}});
  cases.push_back({"exponential-soft", "exponential", {{"softness", "0.2"}}});
  cases.push_back({"wong-reversible", "wong", {{"recovery", "reversible"}}});
  cases.push_back({"prandtl-stack", "prandtl", {{"memory", "stack"}, {"stack", "16"}}});
  cases.push_back({"obrien-bounded", "obrien", {{"max-set", "20"}}});
  cases.push_back({"narain-bounded", "narain", {{"max-set", "20"}, {"weakening", "2"}}});
  cases.push_back({"kim-bounded", "kim", {{"max-set", "20"}, {"tau", "0.1"}}});
  for (const char* law : {"bilinear", "wong", "prandtl"})
    cases.push_back({std::string(law) + "-fatigue", law, {{"fatigue.dc", "0.5"}, {"fatigue.m-inf", "1e-4"}}});
  const auto measured = [&](const char* name, const char* law, int parts) {
    cases.push_back({name, law, {}});
    cases.back().parts = parts;
  };
  measured("prandtl-spectrum", "prandtl", kStops);
  measured("prandtl-spectrum-of-many", "prandtl", kManyStops);
  measured("prandtl-two-spectra", "prandtl", kStops | kWeft);
  measured("prandtl-set", "prandtl", kSet);
  measured("chapman-branches", "chapman", kBranches);
  measured("chapman-spectrum-branches-set", "chapman", kStops | kBranches | kSet);
  measured("chapman-two-spectra-branches-set", "chapman", kStops | kWeft | kBranches | kSet);
  for (LawCase& c : cases) {
    c.passive = c.law != "wong";
    c.timed = c.law == "terzopoulos" || c.law == "kim" || c.law == "gong" || c.parts & kBranches;
  }
  return cases;
}

inline std::string case_name(const ::testing::TestParamInfo<LawCase>& c) {
  std::string name = c.param.name;
  for (char& letter : name) letter = letter == '-' ? '_' : letter;
  return name;
}

// visit(law) with the case's law for this fabric; steps take `seconds`.
template <class Real, int D, class Visit>
void with_law(const LawCase& c, VirginCurve curve, double seconds, const Visit& visit) {
  curve.parts = parts_of(c.parts, curve);
  const LawChoice choice = choose_law(law_or_example(c.law), curve, c.parameters);
  const auto timed = [&](auto law) {
    set_step_time(law, Real(seconds));
    visit(law);
  };
  const bool found = visit_groups<Real, D, ClothMemory>(LawGroups{}, choice, timed) ||
                     visit_laws<Real, D, ClothMemory>(ExampleLaws{}, choice, timed);
  ASSERT_TRUE(found) << c.name;
}

}  // namespace hysteron::testing
