// Computes friction in the plane.
#pragma once

#include "sim/device/device.h"

namespace hysteron {

// Friction elements act on the components of Green's strain E = (E11, E22, 2 E12) of a triangle or node:
// springs p slip at strains r, as in bending (laws/spectrum_stops.h) but on each component by itself.
//
//   stress_c = sum_j p_j clip(E_c - S_j, r_j),   accepted: S_j = E_c - clip(E_c - S_j, r_j)
//
// From an accepted state on, the potential is sum_j p_j H_j(E_c - S_j), H(u) = u^2/2 where |u| <= r, else r
// |u| - r^2/2: convex in strain.  It is the energy stored plus that lost on the way.  Chosen here: three
// mechanisms, not one radial set, since yarns that are pulled and yarns that turn at their crossings rub at
// different places.  Green's strain does not change with a rotation, and so neither does friction.
//
// Yarns that turn press harder on each other the further they have turned: the limits of stops of shear grow
// with the shear x = 2 E12 that the cloth has, by g per unit of it,
//
//   r(x) = r (1 + g |x|),   a = r g < 1,   held = clip(x - S, r(x)),   accepted: S = x - held
//
// Where a stop slips its tangent is p a sign(x) sign(held), negative on the way back to no shear, so that
// elasticity beside the stops has to have at least sum_j p_j a_j (scene/fabric.cpp): then the potential, the
// energy stored plus that lost, p held^2/2 + p int held dS, is convex.  Nothing is given back: r(x) changes
// less than x does since a < 1, so that S moves only with the sign of held, and held dS >= 0.
template <class Real>
struct StrainStop {
  Real limit;      // r (strain), at zero shear
  Real stiffness;  // p [N/m]
};

// The response of all stops of a triangle or node at a strain.
template <class Real>
struct StopsReply {
  Vec3<Real> stress{0, 0, 0}, tangent{0, 0, 0};  // second Piola-Kirchhoff, its derivative [N/m]
  Real stored = 0, lost = 0;                     // at present, and on the way from the accepted state [J/m^2]
};

// Returns the loss of a stop that has slipped at x since S was accepted, over its stiffness p: int held dS
// from where it began to slip, mirrored so that it slips forward, is the integral of r(y) (1 - a sign y) dy.
// On either side of y = 0 that is the distance slipped times the mean of the limits at its ends.
template <class Real>
HYST_HD Real growing_slip_loss(Real x, Real slip, Real r, Real a) {
  const Real forward = x < slip ? Real(-1) : Real(1), y = forward * x;
  const Real reach = forward * slip + r;  // where it would begin to slip if the limit were r
  const Real onset = reach < 0 ? reach / (1 + a) : reach / (1 - a);
  const Real first = r + a * (onset < 0 ? -onset : onset), last = r + a * (y < 0 ? -y : y);
  if (onset < 0 && y > 0) return (-reach * (first + r) + (1 - a) * y * (r + last)) / 2;
  return (y - forward * slip - last) * (first + last) / 2;
}

// The stops of every triangle or node, on E11, then on E22, then on 2 E12, with their memory.
template <class Real>
struct StrainStops {
  const StrainStop<Real>* stop;
  int begin[4];  // of each component's stops
  Real* slip;    // S, begin[3] numbers for each triangle or node
  int faces;
  Real growth = 0;  // g, for the limits of 2 E12

  HYST_HD Real& slot_slip(int face, int j) const { return slip[slot_index(face, j, begin[3], faces)]; }
  // Clips without branches, which would be predicted wrongly where some stops hold and some slip.
  HYST_HD static Real clipped(Real offset, Real limit) {
    const Real below = offset < limit ? offset : limit;
    return below > -limit ? below : -limit;
  }

  HYST_HD Real grown_limit(Real limit, Real strain) const {
    return limit + limit * growth * (strain < 0 ? -strain : strain);
  }

  HYST_HD StopsReply<Real> reply(int face, const Vec3<Real>& strain) const {
    StopsReply<Real> sum;
    for (int c = 0; c < 3; ++c) {
      if (c == 2 && growth != 0) {
        add_growing(face, strain[2], sum);
        continue;
      }
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

  // Adds the stops of 2 E12 whose limits grow.
  HYST_HD void add_growing(int face, Real x, StopsReply<Real>& sum) const {
    for (int j = begin[2]; j < begin[3]; ++j) {
      const Real p = stop[j].stiffness, r = stop[j].limit, slip = slot_slip(face, j);
      const Real offset = x - slip, held = clipped(offset, grown_limit(r, x));
      sum.stress[2] += p * held;
      sum.stored += p * held * held / 2;
      if (held == offset) {
        sum.tangent[2] += p;
      } else {
        const Real softens = (x < 0) != (held < 0) ? Real(-1) : Real(1);
        sum.tangent[2] += softens * p * r * growth;
        sum.lost += p * growing_slip_loss(x, slip, r, r * growth);
      }
    }
  }

  // Accepts the strain: stops that slip are dragged along.
  HYST_HD void accept(int face, const Vec3<Real>& strain) const {
    for (int c = 0; c < 3; ++c)
      for (int j = begin[c]; j < begin[c + 1]; ++j) {
        const Real limit = c == 2 && growth != 0 ? grown_limit(stop[j].limit, strain[2]) : stop[j].limit;
        const Real offset = strain[c] - slot_slip(face, j), held = clipped(offset, limit);
        if (held != offset) slot_slip(face, j) = strain[c] - held;
      }
  }
};

}  // namespace hysteron
