#include "sim/contact/contact.h"

#include <numeric>

#include "sim/contact/obstacle_set.h"
#include "sim/contact/sweep.h"

namespace hysteron {

namespace {

// Most of the stiffness of friction's stop, over that of the shell at its stiffest.
constexpr double kTangential = 0.5;

template <class Real>
ContactModel<Real> contact_model(const Scene& scene) {
  const ObstacleShell<double> shell = obstacle_shell(scene);
  return {{static_cast<Real>(shell.thickness), static_cast<Real>(shell.k), static_cast<Real>(shell.last)},
          static_cast<Real>(kElasticSlip * shell.thickness),
          static_cast<Real>(kTangential * shell.stiffest())};
}

}  // namespace

template <class Real, class Device>
Contact<Real, Device>::Contact(Device& device, const ClothMesh& mesh, const Scene& scene)
    : device_(device),
      obstacle_(scene.obstacle),
      fabric_friction_(scene.fabric.friction),
      model_(contact_model<Real>(scene)),
      vertices_(mesh.vertices()),
      area_(device, std::vector<Real>(mesh.vertex_area.begin(), mesh.vertex_area.end())),
      stops_(device, vertices_, scene.integrator == Integrator::quasi_static ? vertices_ : 0),
      exempt_(device, vertices_),
      energy_(device, 0),
      inside_(device, 1),
      fraction_(device),
      scratch_(device) {
  if (is_sharper_than_mesh(scene, mesh)) faces_.emplace(device, mesh, scene, model_);
  energy_ = Buffer<double, Device>(device, vertices_ + (faces_ ? faces_->faces() : 0));
}

template <class Real, class Device>
void Contact<Real, Device>::move(double start, double end) {
  set_ = obstacles_during<Real>(obstacle_, fabric_friction_, start, end);
  moved_from_ = start;
  moved_to_ = end;
}

template <class Real, class Device>
void Contact<Real, Device>::serialise(Archive& archive) {
  archive(moved_from_);
  archive(moved_to_);
  if (archive.loads()) move(moved_from_, moved_to_);
  stops_.serialise(archive, device_, exempt_);
  if (faces_) faces_->serialise(archive);
}

template <class Real, class Device>
void Contact<Real, Device>::add(const Vec3<Real>* x, const Vec3<Real>* before, Real step, Vec3<Real>* rhs,
                                const BlockRowsView<Real>* matrix) {
  Mat3<Real>* diagonal = matrix ? matrix->diagonal : nullptr;
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  for_each(
      device_, "contact", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.vertex_touch(i, x);
        if (t.index < 0) return;
        const Slip<Real> s = contact.vertex_slip(i, t, x[i] - before[i], stops);
        const Real kt = s.stiffness * s.fraction;
        rhs[i] += step * (t.normal_force - kt * s.trial);
        if (!diagonal) return;
        diagonal[i] += step * step *
                       (t.normal_stiffness + kt * (Mat3<Real>::Identity() - t.normal * t.normal.transpose()));
      });
  if (faces_) faces_->add(set_, x, before, step, rhs, matrix);
}

template <class Real, class Device>
int Contact<Real, Device>::commit(const Vec3<Real>* x, const Vec3<Real>* before, const char* held) {
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  double* inside = inside_.data();
  const char* exempted = exempt_.data();
  for_each_sum<1>(
      device_, "contact history", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        const Touch<Real> t = contact.vertex_touch(i, x);
        if (stops.force) stops.work_before(i, i, surface_motion(contact.set, stops.touching[i] - 1, x[i]));
        stops.touch(i, t.index);
        if (t.index < 0) return;
        if (t.inside && !(held[i] && exempted[i])) sums.term[0] += 1;
        const Slip<Real> s = contact.vertex_slip(i, t, x[i] - before[i], stops);
        stops.work_after(i, i, t.normal_force - s.stiffness * stops.accept(i, s), t.obstacle_motion);
      },
      HYST_KERNEL(const Sums<1>& total) { *inside = total.term[0]; });
  return static_cast<int>(inside_.download()[0]) + (faces_ ? faces_->commit(set_, x, before, held) : 0);
}

template <class Real, class Device>
double Contact<Real, Device>::stored_energy(const Vec3<Real>* x) {
  const VertexContact<Real> contact = view();
  const double* stored = stops_.stored.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact energy", vertices_,
      HYST_KERNEL(int i) { energy[i] = contact.vertex_touch(i, x).energy + stored[i]; });
  if (faces_) faces_->store_energies(set_, x, energy + vertices_);
  const std::vector<double> values = energy_.download();
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Real, class Device>
ContactLoss Contact<Real, Device>::losses() const {
  ContactLoss lost = stops_.losses();
  if (faces_) {
    const ContactLoss between = faces_->losses();
    lost.friction += between.friction;
    lost.obstacle_work += between.obstacle_work;
  }
  return lost;
}

template <class Real, class Device>
std::size_t Contact<Real, Device>::bytes() const {
  return total_bytes(area_, stops_, exempt_, energy_, lagged_, inside_, fraction_, scratch_) +
         (faces_ ? faces_->bytes() : 0);
}

// Contact in an implicit step.  Friction follows the normal force and therefore has no potential; with the
// force of the last iterate it has one, a stop's: k_t |e|^2/2 up to the limit, then limit |e|.

namespace {

// Stretch of the tangential stop at `moved` = x - before.
template <class Real>
HYST_HD Vec3<Real> lagged_slip(const LaggedFriction<Real>& lagged, const Vec3<Real>& moved) {
  const Vec3<Real> e = moved + lagged.start;
  return e - lagged.normal * lagged.normal.dot(e);
}

}  // namespace

template <class Real, class Device>
void Contact<Real, Device>::lag(const Vec3<Real>* x) {
  if (lagged_.size() == 0) lagged_ = Buffer<LaggedFriction<Real>, Device>(device_, vertices_);
  const VertexContact<Real> contact = view();
  const StopView<Real> stops = stops_.view();
  LaggedFriction<Real>* lagged = lagged_.data();
  for_each(
      device_, "contact friction, lagged", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.vertex_touch(i, x);
        lagged[i] = {t.normal, -t.obstacle_motion, t.friction * t.strongest};
        if (stops.touching[i] == t.index + 1) lagged[i].start += stops.slip[i];
      });
  if (faces_) faces_->lag(set_, x);
}

template <class Real, class Device>
void Contact<Real, Device>::evaluate(const Vec3<Real>* x, const Vec3<Real>* before, Vec3<Real>* gradient) {
  const VertexContact<Real> contact = view();
  const LaggedFriction<Real>* lagged = lagged_.data();
  double* energy = energy_.data();
  for_each(
      device_, "contact, tried", vertices_, HYST_KERNEL(int i) {
        const Touch<Real> t = contact.vertex_touch(i, x);
        energy[i] = t.energy;
        gradient[i] -= t.normal_force;
        if (!(lagged[i].limit > 0)) return;
        const Real k = contact.model.stop_stiffness(lagged[i].limit, contact.area[i]);
        Vec3<Real> back;
        energy[i] += lagged[i].energy_at(lagged_slip<Real>(lagged[i], x[i] - before[i]), k, back);
        gradient[i] += back;
      });
  if (faces_) faces_->evaluate(set_, x, before, Real(-1), gradient, energy + vertices_);
}

template <class Real, class Device>
void Contact<Real, Device>::add_stiffness(const Vec3<Real>* x, const Vec3<Real>* before,
                                          BlockRowsView<Real> matrix, Real sliding_fraction) {
  const VertexContact<Real> contact = view();
  const LaggedFriction<Real>* lagged = lagged_.data();
  Mat3<Real>* diagonal = matrix.diagonal;
  for_each(
      device_, "contact stiffness", vertices_, HYST_KERNEL(int i) {
        diagonal[i] += contact.vertex_touch(i, x).normal_stiffness;
        if (!(lagged[i].limit > 0)) return;
        const Real k = contact.model.stop_stiffness(lagged[i].limit, contact.area[i]);
        diagonal[i] +=
            lagged[i].stiffness_at(lagged_slip<Real>(lagged[i], x[i] - before[i]), k, sliding_fraction);
      });
  if (faces_) faces_->add_stiffness(set_, x, before, Real(1), matrix, sliding_fraction);
}

// Obstacles that vertices, or they themselves, would pass through in one step.

// The guess of a step: each vertex by itself, so that one does not hold up the others.
template <class Real, class Device>
void Contact<Real, Device>::clip_to_obstacles(const Vec3<Real>* start, Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return;
  const ObstacleSet<Real> set = set_;
  const Real rest_distance =
      static_cast<Real>(1 - kCompressed) * model_.shell.thickness;  // where it is pressed back
  for_each(
      device_, "contact: guess", vertices_, HYST_KERNEL(int i) {
        if (!held[i]) end[i] = kept_out(set, start[i], end[i], rest_distance);
      });
  if (faces_) faces_->clip_to_obstacles(set, start, end, held, rest_distance);
}

template <class Real, class Device>
bool Contact<Real, Device>::path_is_clear(const Vec3<Real>* start, const Vec3<Real>* end, const char* held) {
  if (!set_.has_thin()) return true;
  const ObstacleSet<Real> set = set_;
  Real* fraction = fraction_.reserve(vertices_);
  for_each(
      device_, "contact: reached", vertices_, HYST_KERNEL(int i) {
        fraction[i] = held[i] || hysteron::path_is_clear(set, start[i], end[i]) ? Real(1) : Real(0);
      });
  if (!(smallest(device_, scratch_, fraction, vertices_, Real(1)) > 0)) return false;
  return !faces_ || faces_->path_is_clear(set, start, end, held);
}

// Where all go the same share of their way, as along a direction of Newton's method.
template <class Real, class Device>
double Contact<Real, Device>::feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction,
                                            const char* held, double max_step) {
  if (!set_.has_thin()) return max_step;
  const ObstacleSet<Real> set = set_;
  const Real requested = static_cast<Real>(max_step);
  Real* fraction = fraction_.reserve(vertices_);
  for_each(
      device_, "contact: collisions", vertices_, HYST_KERNEL(int i) {
        fraction[i] = 1;
        if (held[i]) return;
        const Vec3<Real> displacement = requested * direction[i];
        for (int o = 0; o < set.count; ++o) {
          if (!set.item[o].is_thin()) continue;
          const Real free = free_fraction(set.item[o], x[i], displacement);
          fraction[i] = free < fraction[i] ? free : fraction[i];
        }
      });
  const double free =
      max_step * static_cast<double>(smallest(device_, scratch_, fraction, vertices_, Real(1)));
  return faces_ ? faces_->feasible_step(set, x, direction, held, free) : free;
}

template class Contact<double, ThisDevice>;
template class Contact<float, ThisDevice>;

}  // namespace hysteron
