// The loops of an iteration of conjugate gradients, row by row.
#pragma once

#include "sim/linear/preconditioner.h"
#include "sim/linear/row_products.h"

namespace hysteron {

// q = A p, and p' q.
template <class Real>
struct ProductTerms {
  SystemProduct<Real> product;
  const char* held;
  const Vec3<Real>* p;
  Vec3<Real>* q;
  const PcgScalars* scalars;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes, Sums<1>& sums) const {
    if (scalars->done || held[i]) return;
    const Vec3<Real> row = product.at(lanes, i, p);
    if (!lanes.leads()) return;
    q[i] = row;
    sums.term[0] += static_cast<double>(p[i].dot(row));
  }
};

// A step along p: x, and the residual r.
template <class Real>
struct Advance {
  const char* held;
  const Vec3<Real>*p, *q;
  Vec3<Real>*x, *r;
  const PcgScalars* scalars;

  HYST_HD void operator()(int i) const {
    if (!scalars->done && !held[i]) move(i);
  }
  HYST_HD void move(int i) const {
    const Real alpha = static_cast<Real>(scalars->alpha);
    x[i] += alpha * p[i];
    r[i] -= alpha * q[i];
  }
};

// The same with z = D^-1 r, and r' z.
template <class Real>
struct AdvanceTerms {
  Advance<Real> advance;
  const Mat3<Real>* inverse;  // of the diagonal blocks
  Vec3<Real>* z;

  HYST_HD void operator()(int i, Sums<1>& sums) const {
    if (advance.scalars->done || advance.held[i]) return;
    advance.move(i);
    const Vec3<Real> residual = advance.r[i], preconditioned = inverse[i] * residual;
    z[i] = preconditioned;
    sums.term[0] += static_cast<double>(residual.dot(preconditioned));
  }
};

// The next direction.
template <class Real>
struct Direction {
  const char* held;
  const Vec3<Real>* z;
  Vec3<Real>* p;
  const PcgScalars* scalars;

  HYST_HD void operator()(int i) const {
    if (scalars->done || held[i]) return;
    p[i] = z[i] + static_cast<Real>(scalars->beta) * p[i];
  }
};

}  // namespace hysteron
