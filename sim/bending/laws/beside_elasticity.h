// Puts elasticity that differs by direction beside a law: cloth whose friction has other ratios along weft
// than its rigidity needs it (CurvatureOperator::elastic, which may be negative; the sum is convex).  It
// serves measurements alone: they call the law's own copies, which compilers, nvcc above all, need not
// compile again.
#pragma once

#include "sim/bending/laws/law.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

template <class Law>
struct BesideElasticity {
  using Scalar = typename Law::Scalar;
  static constexpr int kDimension = Law::kDimension, kHistory = Law::kHistory;

  Law law;
  Vec<Scalar, kDimension> elastic;  // [N m]

  HYST_HD LawStep<Scalar, kDimension, kHistory> step(const Vec<Scalar, kDimension>& curvature,
                                                     const History<Scalar, kHistory>& before) const {
    LawStep<Scalar, kDimension, kHistory> result = called_step(law, curvature, before);
    const Vec<Scalar, kDimension> moment = elastic.cwiseProduct(curvature);
    result.moment += moment;
    result.stored += moment.dot(curvature) / 2;
    return result;
  }
  HYST_HD Tangent<Scalar, kDimension> tangent(const Vec<Scalar, kDimension>& curvature,
                                              const History<Scalar, kHistory>& before) const {
    Tangent<Scalar, kDimension> result = called_tangent(law, curvature, before);
    result.diagonal() += elastic;
    return result;
  }
  HYST_HD Scalar largest_stiffness() const { return law.largest_stiffness() + elastic.cwiseAbs().maxCoeff(); }
};

// Returns the curvature of zero moment [1/m], sought from that of the law alone.
template <class Law>
HYST_HD CurvatureOf<Law> beside_elasticity(const Law& law, const CurvatureOf<Law>& elastic,
                                           const HistoryOf<Law>& history) {
  return zero_moment(BesideElasticity<Law>{law, elastic}, history, CurvatureOf<Law>(law.residual(history)));
}

}  // namespace hysteron
