// Friction in the plane.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

// Friction elements on the components of Green's strain E = (E11, E22, 2 E12) of a triangle or node: springs
// p that slip at strains r, as in bending (laws/spectrum_stops.h) but on each component by itself.
//
//   stress_c = sum_j p_j clip(E_c - S_j, r_j),   accepted: S_j = E_c - clip(E_c - S_j, r_j)
//
// From an accepted state on, the potential is sum_j p_j H_j(E_c - S_j), H(u) = u^2/2 where |u| <= r, else
// r |u| - r^2/2: convex in strain.  It is what is stored and what is lost on the way.  Chosen here: three
// mechanisms, not one radial set, since yarns that are pulled and yarns that turn at their crossings rub at
// different places.  Green's strain does not change with a rotation, and so neither does friction.
template <class Real>
struct StrainStop {
  Real limit;      // r (strain)
  Real stiffness;  // p [N/m]
};

// Of all stops of a triangle or node at a strain.
template <class Real>
struct StopsReply {
  Vec3<Real> stress{0, 0, 0}, tangent{0, 0, 0};  // by component: second Piola-Kirchhoff, its derivative [N/m]
  Real stored = 0, lost = 0;                     // now, and on the way from the accepted state [J/m^2]
};

// The stops of every triangle or node: of E11, then of E22, then of 2 E12; and what each remembers.
template <class Real>
struct StrainStops {
  const StrainStop<Real>* stop;
  int begin[4];  // of each component's
  Real* slip;    // S: begin[3] for each
  int faces;

  HYST_HD Real& slot_slip(int face, int j) const { return slip[slot_index(face, j, begin[3], faces)]; }
  // Without branches, which would be guessed wrongly where some stops hold and some slip.
  HYST_HD static Real clipped(Real offset, Real limit) {
    const Real below = offset < limit ? offset : limit;
    return below > -limit ? below : -limit;
  }

  HYST_HD StopsReply<Real> reply(int face, const Vec3<Real>& strain) const {
    StopsReply<Real> sum;
    for (int c = 0; c < 3; ++c) {
      Real stress = 0, tangent = 0;
      for (int j = begin[c]; j < begin[c + 1]; ++j) {
        const StrainStop<Real> of = stop[j];
        const Real offset = strain[c] - slot_slip(face, j), held = clipped(offset, of.limit);
        const Real force = of.stiffness * held;
        stress += force;
        tangent += held == offset ? of.stiffness : Real(0);
        sum.stored += force * held / 2;
        sum.lost += force * (offset - held);
      }
      sum.stress[c] = stress;
      sum.tangent[c] = tangent;
    }
    return sum;
  }

  // Stops that slip are dragged along.
  HYST_HD void accept(int face, const Vec3<Real>& strain) const {
    for (int c = 0; c < 3; ++c)
      for (int j = begin[c]; j < begin[c + 1]; ++j) {
        const Real offset = strain[c] - slot_slip(face, j), held = clipped(offset, stop[j].limit);
        if (held != offset) slot_slip(face, j) = strain[c] - held;
      }
  }
};

}  // namespace hysteron
