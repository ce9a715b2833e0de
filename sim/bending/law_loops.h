// Loops of each group of laws.  law_loops.cpp.in instantiates them, a file for each group and dimension: they
// are the slowest to compile.
#pragma once

#include "sim/bending/law_loop_of.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron {

// What a group's visit_*() makes a loop of: the law that it finds, none if the law is of another group.
template <class Real, class Device, class Visit>
std::unique_ptr<LawLoop<Real, Device>> loop_of(Device& device, const LawChoice& choice, int elements,
                                               const Visit& visit_group) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  visit_group([&](const auto& law) { loop = make_loop_of<Real>(device, law, choice.curve, elements); });
  return loop;
}

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_memoryless_loop(Device& device, const LawChoice& choice,
                                                            int elements) {
  return loop_of<Real>(device, choice, elements,
                       [&](const auto& visit) { visit_memoryless<Real, D>(choice, visit); });
}

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_plastic_loop(Device& device, const LawChoice& choice,
                                                         int elements) {
  return loop_of<Real>(device, choice, elements,
                       [&](const auto& visit) { visit_plastic<Real, D>(choice, visit); });
}

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_friction_loop(Device& device, const LawChoice& choice,
                                                          int elements) {
  return loop_of<Real>(device, choice, elements,
                       [&](const auto& visit) { visit_friction<Real, D, ClothMemory>(choice, visit); });
}

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_fatigue_loop(Device& device, const LawChoice& choice,
                                                         int elements) {
  return loop_of<Real>(device, choice, elements,
                       [&](const auto& visit) { visit_fatigue<Real, D, ClothFatigueMemory>(choice, visit); });
}

}  // namespace hysteron
