// Friction elements with their own thresholds and stiffnesses stand beside an elastic plate: this is how
// `prandtl` and `chapman` use a fabric's stops.
//
//   M = b2 S + sum_j p_j E_j,   E_j as stop_memory.h returns it,   accepted: S_j = S - E_j
//
// The virgin curve is b2 K + sum_j p_j min(K, r_j); a branch after a reversal is that curve doubled (Masing
// 1926, for any spectrum).  N is the capacity; elements that the fabric does not have carry nothing.
//
// Two spectra, along warp and along weft, have no radial return.  Stop j then has stiffnesses
// A_j = diag(p_j, p'_j, sqrt(p_j p'_j)) and slips on an ellipsoid (StopEllipsoid) of half axes r_j, r'_j
// and sqrt(r_j r'_j), so that bends along warp and along weft follow their own spectrum exactly.  Chosen
// here: the geometric means for twist, which are those of the metric (curvature_operator.h) where the weft
// spectrum is what the metric makes of the other.  A law of one component bends along warp, or across the
// edge that it is turned to: turn().
#pragma once

#include <cmath>

#include "sim/bending/laws/law.h"
#include "sim/bending/laws/law_parameters.h"
#include "sim/bending/laws/stop_memory.h"
#include "sim/bending/laws/zero_moment.h"

namespace hysteron {

// One friction element whose stiffness and threshold differ by direction.
//
//   least  (E - U)^T A (E - U)/2  with  E^T B E <= 1,   A, B diagonal and positive
//   E = (A + l B)^-1 A U,   l >= 0 the multiplier: 0 inside, else of E^T B E = 1
//
// The slip U - E follows the normal of the surface in moments (maximal dissipation): what is lost is
// (A E).(U - E) = l, never negative, and the potential, the Moreau envelope of the bound, is convex in U.
// With A and B multiples of one matrix it is the radial return.  The stiffnesses may be 0 together.
template <class Real>
struct StopReturn {
  Vec<Real, 3> elastic;  // E [1/m]
  Real multiplier;       // l [J/m^2]
};

template <class Real>
struct StopEllipsoid {
  Vec<Real, 3> stiffness;  // A [N m]
  Vec<Real, 3> bound;      // B [m^2]

  // Finds the multiplier by Newton's method on 1/|B^1/2 E| - 1, which is nearly linear in it and concave, so
  // that from l = 0 every step stays on one side (as for trust regions: More & Sorensen 1983).
  [[gnu::noinline]] HYST_HD StopReturn<Real> returned(const Vec<Real, 3>& offset) const {
    using std::sqrt;
    constexpr int kMaxSteps = 40;
    constexpr Real kPrecision = Real(sizeof(Real) == 8 ? 1e-15 : 4e-7);
    if (!(offset.dot(bound.cwiseProduct(offset)) > 1)) return {offset, 0};
    if (!(stiffness[0] > 0)) return {offset / sqrt(offset.dot(bound.cwiseProduct(offset))), 0};
    Real multiplier = 0;
    Vec<Real, 3> elastic = offset;
    for (int i = 0; i < kMaxSteps; ++i) {
      const Vec<Real, 3> softer = stiffness + multiplier * bound;
      elastic = stiffness.cwiseProduct(offset).cwiseQuotient(softer);
      const Real squared = elastic.dot(bound.cwiseProduct(elastic)), size = sqrt(squared);
      if (!(size - 1 > kPrecision)) break;
      const Vec<Real, 3> normal = bound.cwiseProduct(elastic);
      multiplier += (size - 1) * squared / normal.dot(normal.cwiseQuotient(softer));
    }
    return {elastic, multiplier};
  }

  // Returns d(A E)/dU [N m].
  HYST_HD Tangent<Real, 3> tangent(const StopReturn<Real>& now) const {
    const Vec<Real, 3> softer = stiffness + now.multiplier * bound;
    Tangent<Real, 3> result = Tangent<Real, 3>::Zero();
    if (!(stiffness[0] > 0)) return result;
    for (int c = 0; c < 3; ++c) result(c, c) = stiffness[c] * stiffness[c] / softer[c];
    if (!(now.multiplier > 0)) return result;
    const Vec<Real, 3> normal = bound.cwiseProduct(now.elastic),
                       turned = stiffness.cwiseProduct(normal).cwiseQuotient(softer);
    return result - turned * turned.transpose() / normal.dot(normal.cwiseQuotient(softer));
  }
};

template <class Real, int D, int N>
struct SpectrumStops : StopMemory<Real, D, N> {
  using Memory = StopMemory<Real, D, N>;
  using Memory::kHistory;
  using Memory::limit;
  using Step = LawStep<Real, D, kHistory>;
  using Past = History<Real, kHistory>;

  Real b2 = 0;               // rigidity of the straight branch [N m]
  Real hb = 0;               // friction moment sum p_j r_j [N]
  Real p[N] = {};            // stiffness of stop j [N m]
  bool two_spectra = false;  // the weft spectrum differs and follows below
  Real weft_limit[N] = {}, weft_p[N] = {};

  // Takes at most N stops, as many along weft as along warp, or none.
  static SpectrumStops make(double b2, const Spectrum& warp, const Spectrum& weft) {
    constexpr double kSomeLimit = 1;  // any positive number: without stiffness a stop carries nothing
    SpectrumStops law;
    law.b2 = Real(b2);
    law.hb = Real(warp.friction_moment());
    law.two_spectra = !weft.empty();
    for (std::size_t j = 0; j < N; ++j) {
      const bool real = j < warp.size(), across = j < weft.size();
      law.limit[j] = Real(real ? warp.thresholds[j] : kSomeLimit);
      law.p[j] = Real(real ? warp.stiffnesses[j] : 0);
      law.weft_limit[j] = Real(across ? weft.thresholds[j] : kSomeLimit);
      law.weft_p[j] = Real(across ? weft.stiffnesses[j] : 0);
    }
    return law;
  }

  // Turns from a bend along warp to one whose unit tensor u behind the metric has u_xx^2 = warp, u_yy^2 =
  // weft and twist for the rest.  On the tensor a stop that is bent along u starts with the stiffness u.A u
  // and, held in that direction, ends with the largest moment along u on its ellipsoid, (u.A B^-1 A u)^1/2
  // with B of the half axes; so does the scalar stop made here, whose corner lies between.  Chosen here.
  HYST_HD void turn(Real warp, Real weft) requires(D == 1) {
    Eigen::Map<PerStop> own(p), own_limit(limit);
    const Eigen::Map<const PerStop> other(weft_p), other_limit(weft_limit);
    const PerStop slides = own * own_limit, other_slides = other * other_limit;
    const Real twist = 1 - warp - weft;
    const PerStop stiff = warp * own + weft * other + twist * (own * other).sqrt();
    const PerStop moment =
        (warp * slides * slides + weft * other_slides * other_slides + twist * slides * other_slides).sqrt();
    own_limit = (stiff > Real(0)).select(moment / stiff, own_limit);
    own = stiff;
    hb = sum(moment);
  }

  HYST_HD Step step(const Vec<Real, D>& curvature, const Past& before) const {
    if constexpr (D == 3)
      if (two_spectra) return step_on_ellipsoids(curvature, before);
    Step result;
    const Stretch now = stretch(curvature, before);
    const PerStop held = now.scale * now.length;
    for (int c = 0; c < D; ++c) {
      const PerStop elastic = now.offset[c] * now.scale;
      slip(result.history, c) = curvature[c] - elastic;
      result.moment[c] = b2 * curvature[c] + sum(PerStop(stiffness() * elastic));
    }
    result.stored = (b2 * curvature.squaredNorm() + sum(PerStop(stiffness() * held * held))) / 2;
    result.dissipated = sum(PerStop(stiffness() * limits() * (now.length - held)));
    return result;
  }

  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Past& before) const {
    if constexpr (D == 3)
      if (two_spectra) return tangent_on_ellipsoids(curvature, before);
    const Stretch now = stretch(curvature, before);
    const PerStop slipping = stiffness() * turning(now);
    Tangent<Real, D> result = (b2 + sum(PerStop(stiffness() * now.scale))) * Tangent<Real, D>::Identity();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) result(a, b) -= sum(PerStop(slipping * now.offset[a] * now.offset[b]));
    return result;
  }

  HYST_HD Vec<Real, D> residual(const Past& history) const {
    Vec<Real, D> mean_slip;
    for (int c = 0; c < D; ++c) mean_slip[c] = sum(PerStop(slip(history, c))) / N;
    return zero_moment(*this, history, mean_slip);
  }
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Past& history) const {  // |F|/HB along warp
    return hb > 0 ? (called_step(*this, curvature, history).moment - b2 * curvature).norm() / hb : Real(0);
  }
  HYST_HD Real largest_stiffness() const {
    Real warp = 0, weft = 0;
    for (int j = 0; j < N; ++j) warp += p[j], weft += weft_p[j];
    return b2 + (warp > weft ? warp : weft);
  }

 private:
  using Memory::limits;
  using Memory::slip;
  using Memory::stretch;
  using Memory::sum;
  using Memory::turning;
  using typename Memory::PerStop;
  using typename Memory::Stretch;

  HYST_HD Eigen::Map<const PerStop> stiffness() const { return Eigen::Map<const PerStop>(p); }

  HYST_HD StopEllipsoid<Real> ellipsoid(int j) const {
    using std::sqrt;
    const Real twist = sqrt(limit[j] * weft_limit[j]);
    return {{p[j], weft_p[j], sqrt(p[j] * weft_p[j])},
            {1 / (limit[j] * limit[j]), 1 / (weft_limit[j] * weft_limit[j]), 1 / (twist * twist)}};
  }
  HYST_HD static Vec<Real, 3> offset(const Vec<Real, 3>& curvature, const Past& before, int j) {
    return {curvature[0] - before[j], curvature[1] - before[N + j], curvature[2] - before[2 * N + j]};
  }

  // This is not inlined, so that the usual loop over one spectrum stays short.
  [[gnu::noinline]] HYST_HD Step step_on_ellipsoids(const Vec<Real, 3>& curvature, const Past& before) const {
    Step result;
    result.moment = b2 * curvature;
    result.stored = b2 * curvature.squaredNorm() / 2;
    for (int j = 0; j < N; ++j) {
      const StopEllipsoid<Real> stop = ellipsoid(j);
      const StopReturn<Real> now = stop.returned(offset(curvature, before, j));
      const Vec<Real, 3> moment = stop.stiffness.cwiseProduct(now.elastic);
      result.moment += moment;
      result.stored += moment.dot(now.elastic) / 2;
      result.dissipated += now.multiplier;
      for (int c = 0; c < 3; ++c) result.history[c * N + j] = curvature[c] - now.elastic[c];
    }
    return result;
  }
  [[gnu::noinline]] HYST_HD Tangent<Real, 3> tangent_on_ellipsoids(const Vec<Real, 3>& curvature,
                                                                   const Past& before) const {
    Tangent<Real, 3> result = b2 * Tangent<Real, 3>::Identity();
    for (int j = 0; j < N; ++j) {
      const StopEllipsoid<Real> stop = ellipsoid(j);
      result += stop.tangent(stop.returned(offset(curvature, before, j)));
    }
    return result;
  }
};

}  // namespace hysteron
