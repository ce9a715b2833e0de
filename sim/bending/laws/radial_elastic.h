// Elastic laws without memory whose moment points along the curvature: M(|S|) S/|S|.
//
// A law derives from this and gives, for a curvature k >= 0: secant(k) = M/k [N m] (its limit at 0),
// slope(k) = dM/dk [N m], energy(k) = int M dk [J/m^2], largest_stiffness().  For a cylinder in any direction
// it is the scalar law.
#pragma once

#include "sim/bending/laws/law.h"

namespace hysteron {

template <class Law, class R, int D>
struct RadialElastic {
  static constexpr int kDimension = D;
  static constexpr int kHistory = 0;
  using Scalar = R;

  HYST_HD LawStep<R, D, 0> step(const Vec<R, D>& curvature, const History<R, 0>&) const {
    const R k = curvature.norm();
    LawStep<R, D, 0> result;
    result.moment = law().secant(k) * curvature;
    result.stored = law().energy(k);
    return result;
  }
  HYST_HD Tangent<R, D> tangent(const Vec<R, D>& curvature, const History<R, 0>&) const {
    const R k = curvature.norm();
    return along_and_across(curvature, k, law().slope(k), law().secant(k));
  }
  // Returns the tangent without negative stiffness.
  HYST_HD Tangent<R, D> convex_tangent(const Vec<R, D>& curvature, const History<R, 0>&) const {
    const R k = curvature.norm(), slope = law().slope(k), secant = law().secant(k);
    return along_and_across(curvature, k, slope > 0 ? slope : R(0), secant > 0 ? secant : R(0));
  }
  HYST_HD Vec<R, D> residual(const History<R, 0>&) const { return Vec<R, D>::Zero(); }

 private:
  HYST_HD static Tangent<R, D> along_and_across(const Vec<R, D>& curvature, R k, R along, R across) {
    Tangent<R, D> result = across * Tangent<R, D>::Identity();
    if (k > 0) result += (along - across) / (k * k) * curvature * curvature.transpose();
    return result;
  }
  HYST_HD const Law& law() const { return static_cast<const Law&>(*this); }
};

}  // namespace hysteron
