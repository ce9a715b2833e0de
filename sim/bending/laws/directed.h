// A law of a fabric whose stops differ by direction, on hinges: each has the one of a bend across its edge.
//
// Stops, relaxing branches and set are as on any element; what depends on the direction, the stops, is made
// for each hinge anew (SpectrumStops::turn), so that a hinge keeps two numbers of its direction beside the
// history of a scalar law.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

// What the wrappers of measured_law.h hold innermost.
template <class Law>
HYST_HD auto& innermost(Law& law) {
  if constexpr (requires { law.law; })
    return innermost(law.law);
  else
    return law;
}

// Whose stops can be turned to a direction.
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

  // That of element i, whose numbers `direction` has (CurvatureOperator); along warp where it is null.
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

// The law of element i: that of all elements, or its own.
template <class Law>
HYST_HD decltype(auto) law_in_direction(const Law& law, const typename Law::Scalar* direction, int i) {
  if constexpr (DirectedLaw<Law>)
    return law.of(direction, i);
  else
    return (law);
}

}  // namespace hysteron
