// The interface that every moment-curvature law has.
//
// A law is a small value with its parameters.  It maps a curvature (D components: 1 on the `hinge` element, 3
// on the `shape` element, where S = (S_xx, S_yy, sqrt2 S_xy)) and the history before the step to the moment
// and the history after it.  History goes in and comes out by value, so that a rejected step costs nothing.
// The concept MomentCurvatureLaw below states what every law must have, the concepts after it what a law may
// have; each function runs on host and device.
//
// Units: curvature 1/m, moment N (per unit width), energies J/m^2.
#pragma once

#include <concepts>

#include "sim/bending/laws/bending_parts.h"
#include "sim/device/host_device.h"

namespace hysteron {

// The memory of a law for one element: N Reals, all zero for virgin cloth.  N = 0 takes no memory in a scene.
template <class Real, int N>
struct History {
  Real slot[N] = {};
  HYST_HD Real& operator[](int i) { return slot[i]; }
  HYST_HD Real operator[](int i) const { return slot[i]; }
};
template <class Real>
struct History<Real, 0> {};

template <class Real, int D, int N>
struct LawStep {
  Vec<Real, D> moment;         // M at the new curvature [N]
  Real stored = 0;             // recoverable energy after the step [J/m^2]
  Real dissipated = 0;         // energy lost in this step [J/m^2]; never negative for a passive law
  Real relaxed = 0;            // the part of it that relaxing branches have lost
  History<Real, N> history{};  // memory after the step
};

template <class Real, int D>
using Tangent = Eigen::Matrix<Real, D, D>;

template <class Law>
using CurvatureOf = Vec<typename Law::Scalar, Law::kDimension>;
template <class Law>
using HistoryOf = History<typename Law::Scalar, Law::kHistory>;

// Load D numbers of a history, from `first` on, as a vector, and store them.
template <class Real, int D, int N>
HYST_HD Vec<Real, D> load_set(const History<Real, N>& history, int first = 0) {
  Vec<Real, D> set;
  for (int c = 0; c < D; ++c) set[c] = history[first + c];
  return set;
}
template <class Real, int D, int N>
HYST_HD void store_set(const Vec<Real, D>& set, History<Real, N>& history, int first = 0) {
  for (int c = 0; c < D; ++c) history[first + c] = set[c];
}

// Extract the history of a law within that of a law around it, from `first` on, and put it back.
template <class Law, class Real, int N>
HYST_HD History<Real, Law::kHistory> history_of(const History<Real, N>& whole, int first = 0) {
  History<Real, Law::kHistory> part;
  if constexpr (Law::kHistory > 0)
    for (int i = 0; i < Law::kHistory; ++i) part[i] = whole[first + i];
  return part;
}
template <class Real, int n, int N>
HYST_HD void put_history(const History<Real, n>& part, History<Real, N>& whole, int first = 0) {
  if constexpr (n > 0)
    for (int i = 0; i < n; ++i) whole[first + i] = part[i];
}

// A law has kDimension D, kHistory Reals of memory for each element (0 if none), and Scalar, the Real.
template <class Law>
concept MomentCurvatureLaw = (Law::kDimension == 1 || Law::kDimension == 3) && Law::kHistory >= 0 &&
                             requires(const Law& law, const CurvatureOf<Law>& curvature,
                                      const HistoryOf<Law>& history) {
  // Makes the step from the history before it to this curvature; tangent() is its dM/dK [N m].
  {
    law.step(curvature, history)
    } -> std::same_as<LawStep<typename Law::Scalar, Law::kDimension, Law::kHistory>>;
  { law.tangent(curvature, history) } -> std::convertible_to<Tangent<typename Law::Scalar, Law::kDimension>>;
  // Returns the curvature at which the moment is zero [1/m].
  { law.residual(history) } -> std::convertible_to<CurvatureOf<Law>>;
  // Returns a bound on the eigenvalues of dM/dK [N m].
  { law.largest_stiffness() } -> std::convertible_to<typename Law::Scalar>;
};

// Make the step and its tangent in loops that run rarely: they share one copy of a law, which may be long.
template <class Law>
HYST_HD HYST_CALLED LawStep<typename Law::Scalar, Law::kDimension, Law::kHistory> called_step(
    const Law& law, const CurvatureOf<Law>& curvature, const HistoryOf<Law>& history) {
  return law.step(curvature, history);
}
template <class Law>
HYST_HD HYST_CALLED Tangent<typename Law::Scalar, Law::kDimension> called_tangent(
    const Law& law, const CurvatureOf<Law>& curvature, const HistoryOf<Law>& history) {
  return law.tangent(curvature, history);
}

// A law that loses energy not only on the way to the curvature (creep, weakening) gives its incremental
// potential int M dK at a fixed history [J/m^2].  For other laws it is the energy stored plus that lost.
template <class Law>
concept LawWithPotential = requires(const Law& law, const CurvatureOf<Law>& k, const HistoryOf<Law>& h) {
  { law.potential(k, h) } -> std::convertible_to<typename Law::Scalar>;
};

// A law whose moment can fall with curvature gives dM/dK without its negative part [N m].
template <class Law>
concept LawWithConvexTangent = requires(const Law& law, const CurvatureOf<Law>& k, const HistoryOf<Law>& h) {
  { law.convex_tangent(k, h) } -> std::convertible_to<Tangent<typename Law::Scalar, Law::kDimension>>;
};

// A law whose history includes time has `dt`, the time of the coming step [s], which is set before it.
template <class Law>
concept TimedLaw = requires(Law& law) {
  law.dt = typename Law::Scalar(0);
};

// A law whose rest curvature a command can set: it returns the history with this curvature as the rest
// curvature.
template <class Law>
concept EditableLaw = requires(const Law& law, const CurvatureOf<Law>& k, const HistoryOf<Law>& h) {
  { law.edited(k, h) } -> std::convertible_to<HistoryOf<Law>>;
};

// A law that keeps part of its history when it is ironed returns that part.
template <class Law>
concept LawWithIroning = requires(const Law& law, const HistoryOf<Law>& h) {
  { law.ironed(h) } -> std::convertible_to<HistoryOf<Law>>;
};

// A law gives its utilisation, how far friction or plasticity is used from 0 (not) to 1 (slides, yields),
// where |M - b2 K|/M0 does not tell it.
template <class Law>
concept LawWithUse = requires(const Law& law, const CurvatureOf<Law>& k, const HistoryOf<Law>& h) {
  { law.utilisation(k, h) } -> std::convertible_to<typename Law::Scalar>;
};

// A law with a permanent set gives its rest curvature [1/m].
template <class Law>
concept SettingLaw = requires(const HistoryOf<Law>& h) {
  { Law::set_curvature(h) } -> std::convertible_to<CurvatureOf<Law>>;
};

// A law whose friction weakens gives the share that is left; the rest of it has set.
template <class Law>
concept WeakeningLaw = SettingLaw<Law> && requires(const Law& law, const HistoryOf<Law>& h) {
  { law.m0* law.strength(h) } -> std::convertible_to<typename Law::Scalar>;
};

// A law with relaxing branches fills LawStep::relaxed.
template <class Law>
concept RelaxingLaw = Law::kRelaxes;

// The three numbers that define a fabric's bending (M = b1 K + c1 K^2 up to K0, then M0 + b2 K), and the
// fabric's further parts, which laws that know them take in place of the three.
struct VirginCurve {
  double b1;  // initial bending rigidity [N m], b1 >= b2
  double b2;  // bending rigidity B of the straight branch [N m]
  double k0;  // elastic limit, the curvature at which friction saturates [1/m]
  BendingParts parts = {};

  double friction_moment() const { return (b1 - b2) * k0 / 2; }                // M0 = HB [N]
  double elastic_limit_moment() const { return friction_moment() + b2 * k0; }  // Ma [N]
  // Returns the width w of an excess of friction on one side along warp (faces.h) [1/m]: infinite without
  // elasticity.
  double face_width() const {
    constexpr double kTaken = 0.9;  // share of the elasticity that both sides have which the excess may take
    const Faces& faces = parts.faces;
    const double excess = friction_moment() * std::abs(faces.friction - 1);
    return excess > 0 ? faces.wider * excess / (2 * kTaken * b2 * std::min(1.0, faces.bending)) : 0;
  }
  double c1() const { return k0 > 0 ? (b2 - b1) / (2 * k0) : 0; }  // quadratic coefficient [N m^2]
};

}  // namespace hysteron
