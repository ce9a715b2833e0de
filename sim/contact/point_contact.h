// The common part of the contact of vertices, or of triangles, with obstacles (contact_points.h).
#pragma once

#include "sim/contact/contact_points.h"
#include "sim/device/algorithms.h"

namespace hysteron {

template <class Real, class Device, class Points>
class PointContact {
 public:
  // `quasi_static`: obstacles' work is that of the mean of the forces before and after a step.
  PointContact(Device& device, int points, bool quasi_static)
      : device_(device),
        count_(points),
        stops_(device, points, quasi_static ? Points::kCorners * points : 0),
        inside_(device, 1),
        fraction_(device),
        scratch_(device) {}

  // These work as in Contact. x, before, start, end and direction have n vertices [m], held n flags, energy
  // one number per point [J] or is null. evaluate() passes its forces to `target` (give() of the points);
  // store_energies() adds the stops' energies.
  void update_lagged_friction(const Points& points, const Vec3<Real>* x);
  void evaluate(const Points& points, const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* target,
                double* energy);
  void store_energies(const Points& points, const Vec3<Real>* x, double* energy);
  int commit(const Points& points, const Vec3<Real>* x, const Vec3<Real>* before, const char* held);
  // Points with a held corner follow that corner.
  bool path_is_clear(const Points& points, const Vec3<Real>* start, const Vec3<Real>* end, const char* held);
  double feasible_step(const Points& points, const Vec3<Real>* x, const Vec3<Real>* direction,
                       const char* held, double max_step);

  int count() const { return count_; }
  FrictionStops<Real, Device>& stops() { return stops_; }
  const FrictionStops<Real, Device>& stops() const { return stops_; }
  const typename Points::Friction* lagged() const { return lagged_.data(); }
  Real* fractions() { return fraction_.reserve(count_); }  // of their paths, room for one per point
  Real least_fraction() { return smallest(device_, scratch_, fraction_.data(), count_, Real(1)); }
  std::size_t bytes() const { return total_bytes(stops_, lagged_, inside_, fraction_, scratch_); }

 private:
  Device& device_;
  int count_;
  FrictionStops<Real, Device> stops_;
  Buffer<typename Points::Friction, Device> lagged_;  // empty before the first update_lagged_friction()
  Buffer<double, Device> inside_;
  GrowingBuffer<Real, Device> fraction_;  // empty where no obstacle has another side
  Scratch<Device> scratch_;
};

}  // namespace hysteron
