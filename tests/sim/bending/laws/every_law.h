// Every law of the catalogue with every parameter that changes what it does, as types: for tests that must
// hold for all of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/bending/laws/law_commands.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron::testing {

struct LawCase {
  std::string name;  // of the law, with its variant
  std::string law;
  LawParameters parameters;
  bool passive = true;  // gives no energy back
  bool timed = false;
};

// Fatigue here is strong: half of the friction moment is gone after a few full cycles of cotton broad.
inline std::vector<LawCase> law_cases() {
  std::vector<LawCase> cases;
  for (const LawEntry& law : law_catalogue()) cases.push_back({law.name, law.name, {}});
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
  const LawChoice choice = choose_law(c.law, curve, c.parameters);
  const auto timed = [&](auto law) {
    set_step_time(law, Real(seconds));
    visit(law);
  };
  visit_memoryless<Real, D>(choice, timed) || visit_plastic<Real, D>(choice, timed) ||
      visit_friction<Real, D, ClothMemory>(choice, timed) ||
      visit_fatigue<Real, D, ClothFatigueMemory>(choice, timed);
}

}  // namespace hysteron::testing
