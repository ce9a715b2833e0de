// Computes friction between obstacles and points of the cloth, vertices or nearest points of triangles: each
// has a Prandtl stop in the tangent plane.
#pragma once

#include <numeric>

#include "sim/contact/compression.h"
#include "sim/contact/sliding_stop.h"
#include "sim/device/archive_buffer.h"

namespace hysteron {

// The friction of one point in an implicit step: the quantities that depend on the normal force, held fixed.
template <class Real>
struct LaggedFriction {
  Vec3<Real> normal;
  Vec3<Real> start;  // slip at the step's start, less the obstacle's motion over the step [m]
  Real limit;        // mu f_n [N]; 0: no contact

  HYST_HD Real weight_of(int) const { return 1; }  // a vertex has one corner
  // Returns the energy of the stop at a stretch e in the tangent plane [J], and sets its gradient [N].
  HYST_HD double energy_at(const Vec3<Real>& e, Real k, Vec3<Real>& gradient) const {
    const Real length = e.norm(), most = limit / k;
    const bool slides = length > most;
    gradient = (slides ? k * most / length : k) * e;
    return static_cast<double>(k * (slides ? most * (length - most / 2) : length * length / 2));
  }
  HYST_HD Mat3<Real> stiffness_at(const Vec3<Real>& e, Real k, Real sliding_fraction) const {
    return sliding_stiffness<Real>(e, normal, k, limit / k, sliding_fraction);
  }
};

// The trial slip [m], the fraction of it that friction can hold, and the stiffness of the stop [N/m].
template <class Real>
struct Slip {
  Vec3<Real> trial;
  Real fraction, stiffness;
};

template <class Real>
HYST_HD Slip<Real> slip_within(const Vec3<Real>& trial, Real limit, Real stiffness) {
  const Real length = trial.norm();
  return {trial, stiffness * length > limit ? limit / (stiffness * length) : Real(1), stiffness};
}

// The stops of all points; travels with a kernel launch by value.
template <class Real>
struct StopView {
  Vec3<Real>* slip;              // elastic slip E [m]
  int* touching;                 // obstacle index + 1; 0: free
  double *stored, *loss, *work;  // stored in a stop, lost in it, and done by its moving obstacle [J]
  // The contact forces at the positions accepted last [N]; null unless the scene is quasi-static.
  Vec3<Real>* force;

  // Is the stop that presses against an obstacle (-1: none) that of the step before?
  HYST_HD bool goes_on(int i, int obstacle) const { return touching[i] == obstacle + 1; }
  // Sets the obstacle that presses most (-1: none).  The energy that the stop had stored against another one
  // is lost.
  HYST_HD void touch(int i, int obstacle) const {
    if (touching[i] != 0 && !goes_on(i, obstacle)) {
      loss[i] += stored[i];
      stored[i] = 0;
      slip[i].setZero();
    }
    touching[i] = obstacle + 1;
  }
  // Returns the stretch of the stop [m].  Its stiffness follows the pressure: the work done on it that it
  // does not store is lost.
  HYST_HD Vec3<Real> accept(int i, const Slip<Real>& s) const {
    const Vec3<Real> stretched = s.fraction * s.trial;
    const double kept = static_cast<double>(s.stiffness * stretched.squaredNorm() / 2);
    loss[i] += stored[i] - kept + static_cast<double>(s.stiffness * stretched.dot(s.trial - slip[i]));
    stored[i] = kept;
    slip[i] = stretched;
    return stretched;
  }
  // Adds the work on vertex `c` of a point over a step in which the obstacle moves by `motion` [m]: that of
  // the mean of the forces before and after, or of the force after.
  HYST_HD void work_before(int i, int c, const Vec3<Real>& motion) const {
    work[i] += static_cast<double>(force[c].dot(motion) / 2);
    force[c].setZero();
  }
  HYST_HD void work_after(int i, int c, const Vec3<Real>& pressed, const Vec3<Real>& motion) const {
    work[i] += (force ? 0.5 : 1.0) * static_cast<double>(pressed.dot(motion));
    if (force) force[c] = pressed;
  }
};

template <class Real, class Device>
struct FrictionStops {
  // `forces` is the number of the points' vertices in quasi-static scenes, else 0.
  FrictionStops(Device& device, int points, int forces)
      : slip(device, points),
        touching(device, points),
        stored(device, points),
        loss(device, points),
        work(device, points),
        force(device, forces) {}

  StopView<Real> view() {
    return {slip.data(), touching.data(), stored.data(),
            loss.data(), work.data(),     force.size() > 0 ? force.data() : nullptr};
  }
  // `between` are buffers that are saved among its own.
  template <class... Between>
  void serialise(Archive& archive, Device& device, Between&... between) {
    hysteron::serialise(archive, device, slip);
    hysteron::serialise(archive, device, touching);
    (hysteron::serialise(archive, device, between), ...);
    hysteron::serialise(archive, device, stored);
    hysteron::serialise(archive, device, loss);
    hysteron::serialise(archive, device, work);
    hysteron::serialise(archive, device, force);
  }
  ContactLoss losses() const {
    const std::vector<double> lost = loss.download(), done = work.download();
    return {std::accumulate(lost.begin(), lost.end(), 0.0), std::accumulate(done.begin(), done.end(), 0.0)};
  }
  std::size_t bytes() const { return total_bytes(slip, touching, stored, loss, work, force); }

  Buffer<Vec3<Real>, Device> slip;
  Buffer<int, Device> touching;
  Buffer<double, Device> stored, loss, work;
  Buffer<Vec3<Real>, Device> force;
};

}  // namespace hysteron
