// Loops of a group of laws.  law_loops.cpp.in instantiates them, a file for each group, dimension and
// precision: they are the slowest to compile.
#pragma once

#include "sim/bending/law_loop_of.h"
#include "sim/bending/laws/law_visit.h"

namespace hysteron {

template <class Group, class Real, class Device, int D>
std::unique_ptr<LawLoop<Real, Device>> make_group_loop(Device& device, const LawChoice& choice,
                                                       int elements) {
  std::unique_ptr<LawLoop<Real, Device>> loop;
  visit_group<Group, Real, D, ClothMemory>(choice, [&]<class Law>(const Law& law) {
    if constexpr (LawOfOneDirection<Law> && Device::kGpu) {  // one law to compile: nvcc takes long
      loop = make_loop_of<Real>(device, Directed<Law>{law}, choice.curve, elements);
    } else {
      if constexpr (LawOfOneDirection<Law>)
        if (innermost(law).two_spectra) {
          loop = make_loop_of<Real>(device, Directed<Law>{law}, choice.curve, elements);
          return;
        }
      loop = make_loop_of<Real>(device, law, choice.curve, elements);
    }
  });
  return loop;
}

}  // namespace hysteron
