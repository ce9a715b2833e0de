// Every law of the catalogue, and those of tests/examples, with every parameter that changes what they do, as
// types: for tests that must hold for all of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/base/error.h"
#include "sim/bending/laws/every_group.h"
#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_visit.h"
#include "tests/examples/law/example_laws.h"

namespace hysteron::testing {

struct LawCase {
  std::string name;  // of the law, with its variant
  std::string law;
  LawParameters parameters;
  bool passive = true;  // gives no energy back
  bool timed = false;
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
  throw Error::request("no law or example of a law is called " + name);
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
  for (LawCase& c : cases) {
    c.passive = c.law != "wong";
    c.timed = c.law == "terzopoulos" || c.law == "kim" || c.law == "gong";
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
void with_law(const LawCase& c, const VirginCurve& curve, double seconds, const Visit& visit) {
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
