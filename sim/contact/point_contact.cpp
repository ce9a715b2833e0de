#include "sim/contact/point_contact.h"

#include "sim/contact/sweep.h"

namespace hysteron {

template <class Real, class Device, class Points>
void PointContact<Real, Device, Points>::update_lagged_friction(const Points& points, const Vec3<Real>* x) {
  if (lagged_.size() == 0) lagged_ = Buffer<typename Points::Friction, Device>(device_, count_);
  const StopView<Real> stops = stops_.view();
  typename Points::Friction* lagged = lagged_.data();
  for_each(
      device_, "contact: lagged friction", count_,
      HYST_KERNEL(int p) { lagged[p] = points.friction(p, active_contacts<Real>(points, p, x), stops); });
}

// Friction follows the normal force and therefore has no potential; with the force of the last iterate it has
// that of a stop: k_t |e|^2/2 up to the limit, then limit |e|.
template <class Real, class Device, class Points>
void PointContact<Real, Device, Points>::evaluate(const Points& points, const Vec3<Real>* x,
                                                  const Vec3<Real>* before, Vec3<Real>* target,
                                                  double* energy) {
  const typename Points::Friction* lagged = lagged_.data();
  for_each(
      device_, "contact: forces", count_, HYST_KERNEL(int p) {
        const auto b = active_contacts<Real>(points, p, x);
        const typename Points::Friction friction = lagged[p];
        double sum = b.energy;
        Vec3<Real> back = Vec3<Real>::Zero();
        if (friction.limit > 0) {
          const Real k = points.model.stop_stiffness(friction.limit, points.area[p]);
          sum += friction.energy_at(lagged_slip<Real>(points, p, friction, x, before), k, back);
        }
        if (energy) energy[p] = sum;
        points.give(p, b.force, friction, back, target);
      });
}

template <class Real, class Device, class Points>
void PointContact<Real, Device, Points>::store_energies(const Points& points, const Vec3<Real>* x,
                                                        double* energy) {
  const double* stored = stops_.stored.data();
  for_each(
      device_, "contact: energy", count_,
      HYST_KERNEL(int p) { energy[p] = active_contacts<Real>(points, p, x).energy + stored[p]; });
}

template <class Real, class Device, class Points>
int PointContact<Real, Device, Points>::commit(const Points& points, const Vec3<Real>* x,
                                               const Vec3<Real>* before, const char* held) {
  const StopView<Real> stops = stops_.view();
  double* inside = inside_.data();
  for_each_sum<1>(
      device_, "contact: history", count_,
      HYST_KERNEL(int p, Sums<1>& sums) {
        constexpr int kCorners = Points::kCorners;
        const auto b = active_contacts<Real>(points, p, x);
        for (int k = 0; stops.force && k < kCorners; ++k)
          stops.work_before(p, kCorners * p + k,
                            surface_motion(points.set, stops.touching[p] - 1, x[points.vertex(p, k)]));
        stops.touch(p, b.index);
        if (b.index < 0) return;
        if (b.inside && !points.may_be_inside(p, held)) sums.term[0] += 1;
        const Slip<Real> slip = points.slip(p, b, x, before, stops);
        const Vec3<Real> stretched = stops.accept(p, slip);
        for (int k = 0; k < kCorners; ++k)
          stops.work_after(p, kCorners * p + k, b.force[k] - slip.stiffness * b.weight[k] * stretched,
                           surface_motion(points.set, b.index, x[points.vertex(p, k)]));
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]);
}

template <class Real, class Device, class Points>
bool PointContact<Real, Device, Points>::path_is_clear(const Points& points, const Vec3<Real>* start,
                                                       const Vec3<Real>* end, const char* held) {
  Real* fraction = fractions();
  for_each(
      device_, "contact: reached", count_, HYST_KERNEL(int p) {
        fraction[p] =
            is_held(points, p, held) || hysteron::path_is_clear(points, p, start, end) ? Real(1) : Real(0);
      });
  return least_fraction() > 0;
}

// Returns the step length where all points go the same fraction of their displacements, as along a direction
// of Newton's method.
template <class Real, class Device, class Points>
double PointContact<Real, Device, Points>::feasible_step(const Points& points, const Vec3<Real>* x,
                                                         const Vec3<Real>* direction, const char* held,
                                                         double max_step) {
  const Real requested = static_cast<Real>(max_step);
  Real* fraction = fractions();
  for_each(
      device_, "contact: collisions", count_, HYST_KERNEL(int p) {
        fraction[p] = 1;
        if (is_held(points, p, held)) return;
        Path<Real, Points::kCorners> path;
        for (int k = 0; k < Points::kCorners; ++k) {
          path.from[k] = x[points.vertex(p, k)];
          path.displacement[k] = requested * direction[points.vertex(p, k)];
        }
        for (int o = 0; o < points.set.count; ++o) {
          if (!points.may_be_blocked_by(o)) continue;
          const Real free = free_fraction(path, points.set.item[o]);
          fraction[p] = free < fraction[p] ? free : fraction[p];
        }
      });
  return max_step * static_cast<double>(least_fraction());
}

template class PointContact<double, ThisDevice, VertexPoints<double>>;
template class PointContact<float, ThisDevice, VertexPoints<float>>;
template class PointContact<double, ThisDevice, FacePoints<double>>;
template class PointContact<float, ThisDevice, FacePoints<float>>;

}  // namespace hysteron
