// Solves with swept fronts (front_sweeps.h): rows of dense matrices times vectors, one level of the tree
// after the other, in which no row waits for another.
//
//   up    b_R <- b_R - (C P^-1) b_P     at each level the rows of fronts above, each from all fronts below
//   down  z_P = P^-1 b_P - (C P^-1)^T z_R
#pragma once

#include "sim/device/grid_team.h"
#include "sim/linear/dissection.h"
#include "sim/linear/preconditioner.h"

namespace hysteron {

// Vectors have n x 3 numbers in the order of the vertices; an "unknown" is the index of one of them.

// A part of a front's row, to be multiplied by the unknowns of its columns.
struct FrontTerm {
  std::size_t number;  // start of its numbers
  int source;          // its first column in the list of all fronts' columns
  int count;
};

// An unknown that a level updates, and its terms.
struct RowAbove {
  int unknown;
  int first, end;
};

// An unknown that a level solves.  An unknown without columns of its own is known already.
struct SolvedRow {
  int unknown;
  FrontTerm own, above;
};

template <class Lanes, class Real>
HYST_HD double lane_part(const Lanes& lanes, const double* row, const int* source, int count, const Real* v) {
  constexpr int kAtOnce = 8;  // loads that are in flight together
  double part[kAtOnce] = {};
  for (int first = lanes.index(); first < count; first += kAtOnce * Lanes::kCount)
    for (int k = 0; k < kAtOnce; ++k) {
      const int j = first + k * Lanes::kCount;
      if (j < count) part[k] += row[j] * static_cast<double>(v[source[j]]);
    }
  double sum = 0;
  for (const double each : part) sum += each;
  return sum;
}

// Returns the total in the leading lane.
template <class Lanes>
HYST_HD double lane_total(const Lanes& lanes, double part) {
  Vec<double, 1> sum;
  sum[0] = part;
  return lanes.lane_sum(sum)[0];
}

template <class Real>
struct RowUp {
  const RowAbove* row;
  const FrontTerm* term;
  const double* number;
  const int* source;
  const Real* from;
  Real* to;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    const RowAbove at = row[i];
    double part = 0;
    for (int t = at.first; t < at.end; ++t)
      part += lane_part(lanes, number + term[t].number, source + term[t].source, term[t].count, from);
    const double sum = lane_total(lanes, part);
    if (lanes.leads()) to[at.unknown] = static_cast<Real>(static_cast<double>(from[at.unknown]) - sum);
  }
};

template <class Real>
struct RowDown {
  const SolvedRow* row;
  const double* number;
  const int* source;
  const Real* b;  // right-hand side after the levels below
  Real* z;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    solve(row[i], lanes);
  }
  // Returns z in the leading lane.
  template <class Lanes>
  HYST_HD Real solve(const SolvedRow& at, const Lanes& lanes) const {
    if (at.own.count == 0) return z[at.unknown];
    const FrontTerm &own = at.own, &above = at.above;
    const double part = lane_part(lanes, number + own.number, source + own.source, own.count, b) +
                        lane_part(lanes, number + above.number, source + above.source, above.count,
                                  static_cast<const Real*>(z));
    const Real sum = static_cast<Real>(lane_total(lanes, part));
    if (lanes.leads()) z[at.unknown] = sum;
    return sum;
  }
};

// Computes the last level down, in which every unknown is a row, and r' z.
template <class Real>
struct LastRowDown {
  RowDown<Real> down;
  const PcgScalars* scalars;  // null: this is no iteration

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes, Sums<1>& sums) const {
    if (scalars && scalars->done) return;
    const SolvedRow at = down.row[i];
    const Real z = down.solve(at, lanes);
    if (lanes.leads()) sums.term[0] += static_cast<double>(down.b[at.unknown] * z);
  }
};

// The rows and terms of all levels, with the fronts' numbers.
template <class Real>
struct FrontsView {
  int levels = 0;  // 0: there are no fronts
  const double* number = nullptr;
  const int* source = nullptr;
  const FrontTerm* term = nullptr;
  const RowAbove* above[kMaxFrontLevels] = {};
  const SolvedRow* solved[kMaxFrontLevels] = {};
  int above_rows[kMaxFrontLevels] = {}, solved_rows[kMaxFrontLevels] = {};
  Real* b = nullptr;  // right-hand side of the fronts above the first level

  HYST_HD RowUp<Real> up(int level, const Real* r) const {
    return {above[level], term, number, source, level == 0 ? r : b, b};
  }
  HYST_HD RowDown<Real> down(int level, const Real* r, Real* z) const {
    return {solved[level], number, source, level == 0 ? r : b, z};
  }
};

#ifdef __CUDACC__
// Sets z from r (n vertices each), and returns r' z in every thread.
template <class Real>
__device__ double run_fronts(GridTeam& team, const FrontsView<Real>& fronts, const Vec3<Real>* r,
                             Vec3<Real>* z, const PcgScalars* scalars) {
  const Real* from = r->data();
  Real* to = z->data();
  for (int l = 0; l + 1 < fronts.levels; ++l) team.for_each_row(fronts.above_rows[l], fronts.up(l, from));
  for (int l = fronts.levels - 1; l > 0; --l)
    team.for_each_row(fronts.solved_rows[l], fronts.down(l, from, to));
  return team.template row_sum<Warp>(fronts.solved_rows[0],
                                     LastRowDown<Real>{fronts.down(0, from, to), scalars});
}
#endif

}  // namespace hysteron
