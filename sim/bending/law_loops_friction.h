// Loops of the laws with friction, one instantiation per element and group; they are the slowest to compile.
#pragma once

#include "sim/bending/law_loop_of.h"
#include "sim/bending/law_visit.h"

namespace hysteron {

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_friction_loop(Device& device, const LawChoice& choice,
                                                          int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  visit_friction<Real, D, ClothMemory>(
      choice, [&](const auto& law) { loop = make_loop_of<Real>(device, law, choice.curve, elements); });
  return loop;
}

template <class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_fatigue_loop(Device& device, const LawChoice& choice,
                                                         int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  visit_fatigue<Real, D, ClothFatigueMemory>(
      choice, [&](const auto& law) { loop = make_loop_of<Real>(device, law, choice.curve, elements); });
  return loop;
}

}  // namespace hysteron
