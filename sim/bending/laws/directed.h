// Runs laws of a fabric whose stops differ by direction on hinges: each hinge has the law of a bend across
// its edge.
//
// Stops, relaxing branches and set are as on any element.  The stops alone depend on the direction and are
// made anew for each hinge (SpectrumStops::turn), so that a hinge keeps two numbers of its direction beside
// the history of a scalar law.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

// Returns the innermost law of the wrappers of measured_law.h.
template <class Law>
HYST_HD auto& innermost(Law& law) {
  if constexpr (requires { law.law; })
    return innermost(law.law);
  else
    return law;
}

// A law whose stops can be turned to a direction.
template <class Law>
concept LawOfOneDirection = requires(Law& law, typename Law::Scalar part) {
  innermost(law).turn(part, part);
};

template <LawOfOneDirection Law>
struct Directed {
  using Scalar = typename Law::Scalar;
  static constexpr int kDimension = Law::kDimension, kHistory = Law::kHistory;
  static constexpr bool kRelaxes = RelaxingLaw<Law>;

  Law law;  // along warp

  // Returns the law of element i with the two numbers of `direction` (2 per element, CurvatureOperator);
  // along warp if it is null.
  HYST_HD Law of(const Scalar* direction, int i) const {
    Law own = law;
    if (direction) innermost(own).turn(direction[2 * i], direction[2 * i + 1]);
    return own;
  }
  HYST_HD Scalar largest_stiffness() const { return law.largest_stiffness(); }
};

template <class Law>
concept DirectedLaw = requires(const Law& law, const typename Law::Scalar* direction) {
  law.of(direction, 0);
};

// Returns the law of element i: that of all elements, or its own.
template <class Law>
HYST_HD decltype(auto) law_in_direction(const Law& law, const typename Law::Scalar* direction, int i) {
  if constexpr (DirectedLaw<Law>)
    return law.of(direction, i);
  else
    return (law);
}

}  // namespace hysteron
