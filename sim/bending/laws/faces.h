// Models cloth that bends otherwise to its back (K < 0) than to its face (K > 0): B and 2HB depend on the
// sign of curvature.
//
//   M = M_common(K) + dB s max(s K, 0) + s' m(phi(s' K)) phi'(s' K)
//
// The common law is the stops of prandtl with the smaller of the two B and the smaller of the two 2HB.  The
// excess dB of elasticity acts on the side s = +-1 that has the larger B.  The excess of friction, m, is
// stops of the same kind with the difference of the two 2HB, driven by a curvature phi of the side s' that
// has the larger 2HB,
//   phi(x) = -w/4 for x <= -w,   (x + w)^2/(4 w) - w/4 between,   x - w/4 for x >= w,
// so that its moment grows over +-w from none to all (phi' from 0 to 1) and is zero on virgin cloth that is
// flat. Each term is the derivative of one potential of a step, P(phi(K)) with that of the stops: what is
// stored and lost is what stops store and lose, for any history, and nothing is given back.  P(phi) alone is
// not convex: d2/dK2 >= -dHB/(2 w) where all stops slip back.  The width w is the least at which a tenth of
// the common elasticity is left of the sum (VirginCurve::face_width).  The excess's thresholds are those of
// the common law times phi(k0)/k0, so that first bending is through all of them at k0 as well; beyond w a
// branch after a reversal is its own virgin curve doubled.  Of a tensor the excess runs along four directions
// (four_directions.h), each by the sign of its own curvature.  Chosen here, not in a source: all of it.
#pragma once

#include <type_traits>

#include "sim/bending/laws/four_directions.h"
#include "sim/bending/laws/prandtl_stops.h"

namespace hysteron {

// The excess of one side's friction and elasticity over the other's, along one direction.
template <class Real, int N>
struct FaceExcess : StopMemory<Real, 1, N> {
  using Memory = StopMemory<Real, 1, N>;
  using Memory::kHistory;
  using Memory::limit;
  using Past = History<Real, kHistory>;

  // The numbers that depend on the direction where friction has directions of its own
  // (CurvatureOperator::elastic).
  struct Direction {
    Real elastic;  // dB [N m]
    Real width;    // w [1/m]
    Real shorter;  // phi(k0)/k0: stops see phi divided by it
  };
  Direction own = {0, 0, 1}, weft = {0, 0, 1};
  Real elastic_side = 1;   // 1 if bends with K > 0 have the excess, -1 if those with K < 0
  Real friction_side = 1;  // likewise
  Real knee = 0;           // k0 [1/m]
  Real p[N] = {};          // stiffness of each stop [N m]

  HYST_HD LawStep<Real, 1, kHistory> step(const Vec<Real, 1>& curvature, const Past& before) const {
    LawStep<Real, 1, kHistory> result;
    const Seen seen = seen_at(curvature[0], own);
    const Stretch now = stretch(Vec<Real, 1>(seen.phi / own.shorter), before);
    const PerStop held = now.scale * now.length, spring = now.offset[0] * now.scale;
    slip(result.history, 0) = seen.phi / own.shorter - spring;
    const Real bent = elastic_side * curvature[0] > 0 ? curvature[0] : Real(0);
    result.moment[0] = own.elastic * bent + friction_side * seen.slope * sum(PerStop(stiffnesses() * spring));
    result.stored = (own.elastic * bent * bent + own.shorter * sum(PerStop(stiffnesses() * held * held))) / 2;
    result.dissipated = own.shorter * sum(PerStop(stiffnesses() * limits() * (now.length - held)));
    return result;
  }
  // The tangent is negative where all stops slip back while their moment comes or goes.
  HYST_HD Tangent<Real, 1> tangent(const Vec<Real, 1>& curvature, const Past& before) const {
    const Seen seen = seen_at(curvature[0], own);
    const Stretch now = stretch(Vec<Real, 1>(seen.phi / own.shorter), before);
    const PerStop spring = now.offset[0] * now.scale;
    const PerStop holding = (now.length > limits()).select(PerStop::Zero(), stiffnesses());
    const Real beside = elastic_side * curvature[0] > 0 ? own.elastic : Real(0);
    return Tangent<Real, 1>(beside + seen.slope * seen.slope / own.shorter * sum(holding) +
                            seen.bend * sum(PerStop(stiffnesses() * spring)));
  }
  // It stands beside a common law.
  HYST_HD Vec<Real, 1> residual(const Past&) const { return Vec<Real, 1>(Real(0)); }
  HYST_HD Real largest_stiffness() const {
    return most_of(own) > most_of(weft) ? most_of(own) : most_of(weft);
  }

  // Returns the excess along weft, for four directions.
  HYST_HD FaceExcess along_weft() const {
    FaceExcess other = *this;
    other.own = weft;
    return other;
  }
  // Turns from warp to a direction between (directed.h): the share of twist counts half for either, as it
  // does for four directions along the bias.
  HYST_HD void turn(Real warp, Real weftwards) {
    const Real twist = (1 - warp - weftwards) / 2, first = warp + twist, second = weftwards + twist;
    own.elastic = first * own.elastic + second * weft.elastic;
    if (!(own.width > 0)) return;
    own.width = 1 / (first / own.width + second / weft.width);
    own.shorter = shorter_by(own.width);
  }
  // Returns phi(k0)/k0 for a change of this width [1/m].
  HYST_HD Real shorter_by(Real width) const {
    if (!(width > 0 && knee > 0)) return 1;
    return knee > width ? 1 - width / (4 * knee) : Real(0.5) + knee / (4 * width);
  }

  struct Seen {
    Real phi, slope, bend;  // phi, phi', phi''
  };
  HYST_HD Seen seen_at(Real curvature, const Direction& along) const {
    const Real x = friction_side * curvature, width = along.width;
    if (x >= width) return {x - width / 4, 1, 0};
    if (!(x > -width)) return {-width / 4, 0, 0};
    const Real share = (x + width) / (2 * width);
    return {width * (share * share - Real(0.25)), share, 1 / (2 * width)};
  }

 private:
  using Memory::limits;
  using Memory::slip;
  using Memory::stretch;
  using Memory::sum;
  using typename Memory::PerStop;
  using typename Memory::Stretch;

  HYST_HD Eigen::Map<const PerStop> stiffnesses() const { return Eigen::Map<const PerStop>(p); }
  HYST_HD Real most_of(const Direction& along) const {
    const Real pull = sum(PerStop(stiffnesses() * limits()));
    return along.elastic + sum(PerStop(stiffnesses())) / along.shorter +
           (along.width > 0 ? pull / (2 * along.width) : Real(0));
  }
};

// Prandtl's N stops with the excess of one side beside them.
template <class Real, int D, int N>
struct WithFaces {
  using Common = PrandtlStops<Real, D, N>;
  using Excess = std::conditional_t<D == 1, FaceExcess<Real, N>, FourDirections<FaceExcess<Real, N>>>;
  using Scalar = Real;
  static constexpr int kDimension = D;
  static constexpr int kHistory = Common::kHistory + Excess::kHistory;
  using Past = History<Real, kHistory>;

  Common common;
  Excess excess;
  Real hb = 0;               // friction moment of the common stops [N]
  bool two_spectra = false;  // the excess differs by direction: turn()

  // Makes N stops from b1, b2 and k0, or the fabric's own, N at most.
  static WithFaces make(const VirginCurve& curve) {
    const Faces& faces = curve.parts.faces;
    const Spectrum stops =
        curve.parts.stops.empty() ? parabola_stops(curve.b1 - curve.b2, curve.k0, N) : curve.parts.stops;
    const double elasticity = curve.b2 * std::min(1.0, faces.bending);
    WithFaces law;
    law.common = Common::make({elasticity, elasticity, 0});
    put(stops, std::min(1.0, faces.friction), law.common);
    law.hb = Real(stops.friction_moment() * std::min(1.0, faces.friction));

    FaceExcess<Real, N> excess;
    excess.elastic_side = Real(faces.bending > 1 ? -1 : 1);
    excess.friction_side = Real(faces.friction > 1 ? -1 : 1);
    excess.knee = Real(curve.k0);
    put(stops, std::abs(faces.friction - 1), excess);
    const double beyond = curve.b2 * std::abs(faces.bending - 1), width = curve.face_width();
    excess.own = {Real(beyond), Real(width), excess.shorter_by(Real(width))};
    const Real weft = Real(width / faces.weft_elastic);
    excess.weft = {Real(beyond * faces.weft_elastic), weft, excess.shorter_by(weft)};
    law.two_spectra = faces.weft_elastic != 1;
    if constexpr (D == 1)
      law.excess = excess;
    else
      law.excess = Excess{excess};
    return law;
  }

  // Turns from a bend along warp to one across an edge (directed.h).
  HYST_HD void turn(Real warp, Real weft) requires(D == 1) { excess.turn(warp, weft); }

  HYST_HD LawStep<Real, D, kHistory> step(const Vec<Real, D>& curvature, const Past& before) const {
    const auto one = common.step(curvature, history_of<Common>(before));
    const auto other = excess.step(curvature, history_of<Excess>(before, Common::kHistory));
    LawStep<Real, D, kHistory> result;
    result.moment = one.moment + other.moment;
    result.stored = one.stored + other.stored;
    result.dissipated = one.dissipated + other.dissipated;
    put_history(one.history, result.history);
    put_history(other.history, result.history, Common::kHistory);
    return result;
  }
  HYST_HD Tangent<Real, D> tangent(const Vec<Real, D>& curvature, const Past& before) const {
    const Tangent<Real, D> one = common.tangent(curvature, history_of<Common>(before));
    return one + excess.tangent(curvature, history_of<Excess>(before, Common::kHistory));
  }
  HYST_HD Vec<Real, D> residual(const Past& history) const {
    return zero_moment(*this, history, Vec<Real, D>(Vec<Real, D>::Zero()));
  }
  // Returns |F|/HB of the common stops, which slide on both sides.
  HYST_HD Real utilisation(const Vec<Real, D>& curvature, const Past& history) const {
    const auto now = called_step(common, curvature, history_of<Common>(history));
    return hb > 0 ? (now.moment - common.b2 * curvature).norm() / hb : Real(0);
  }
  HYST_HD Real largest_stiffness() const { return common.largest_stiffness() + excess.largest_stiffness(); }

 private:
  // Gives the law stops with `share` of these moments.
  template <class Stops>
  static void put(const Spectrum& stops, double share, Stops& law) {
    constexpr double kSomeLimit = 1;  // any positive number: without stiffness a stop carries nothing
    for (std::size_t j = 0; j < N; ++j) {
      const bool real = j < stops.size();
      law.limit[j] = Real(real ? stops.thresholds[j] : kSomeLimit);
      law.p[j] = Real(real ? share * stops.stiffnesses[j] : 0);
    }
  }
};

}  // namespace hysteron
