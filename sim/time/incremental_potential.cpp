#include "sim/time/incremental_potential.h"

#include <cmath>

namespace hysteron {

template <class Real, class Device>
IncrementalPotential<Real, Device>::IncrementalPotential(
    Device& device, BlockRows<Real, Device>& matrix, Membrane<Real, Device>& membrane,
    Bending<Real, Device>& bending, Contact<Real, Device>* contact, SelfContact<Real, Device>* self_contact,
    const Buffer<Real, Device>& mass, bool bending_lags, const SolverTuning& tuning)
    : device_(device),
      matrix_(matrix),
      membrane_(membrane),
      bending_(bending),
      contact_(contact),
      self_contact_(self_contact),
      mass_(mass),
      bending_lags_(bending_lags),
      tuning_(tuning),
      vertices_(static_cast<int>(mass.size())),
      gradient_(device, vertices_),
      rest_diagonal_(device, vertices_),
      softening_off_diagonal_(device, matrix.col().size()),
      softening_diagonal_(device, vertices_),
      sums_(device, 1) {}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::begin(const StepStart<Real>& start) {
  start_ = start;
  membrane_.begin_step(start.rates, start.now, start.before);
  if (!bending_lags_) bending_.begin_step(start.rates);
}

template <class Real, class Device>
double IncrementalPotential<Real, Device>::unfolded_step(const Vec3<Real>* x, const Vec3<Real>* direction,
                                                         double max_step) {
  return self_contact_ ? self_contact_->prepare(x, direction, start_.held, max_step) : max_step;
}

template <class Real, class Device>
double IncrementalPotential<Real, Device>::feasible_step(const Vec3<Real>* x, const Vec3<Real>* direction,
                                                         double max_step) {
  const double outside = contact_ ? contact_->feasible_step(x, direction, start_.held, max_step) : max_step;
  return unfolded_step(x, direction, outside);
}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::keep_out(Vec3<Real>* end) {
  if (contact_) contact_->keep_out(start_.now, end, start_.held);
}

template <class Real, class Device>
bool IncrementalPotential<Real, Device>::reaches(const Vec3<Real>* end) {
  return !contact_ || contact_->reaches(start_.now, end, start_.held);
}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::took(const Vec3<Real>* x) {
  if (self_contact_) self_contact_->moved(x);
}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::lag_friction(const Vec3<Real>* x) {
  if (contact_) contact_->lag(x);
  if (self_contact_) self_contact_->lag(x);
}

template <class Real, class Device>
PotentialValue IncrementalPotential<Real, Device>::evaluate(const Vec3<Real>* x,
                                                            const Vec3<Real>* direction) {
  membrane_.evaluate(x);
  if (!bending_lags_) bending_.evaluate(x);
  compute_gradient(x);
  if (contact_) {
    contact_->evaluate(x, start_.now, gradient_.data());
    add_energies(contact_->energies(), contact_->energies_count());
  }
  if (self_contact_) {
    self_contact_->evaluate(x, start_.now, gradient_.data());
    add_energies(self_contact_->energies(), self_contact_->pairs());
  }
  add_energies(membrane_.energies(), membrane_.faces());
  if (!bending_lags_) add_energies(bending_.energies(), bending_.elements());
  measure_gradient(x, direction);
  const Totals t = sums_.download()[0];
  return {t.energy,
          t.size,
          std::sqrt(t.residual2),
          std::sqrt(t.reaction2),
          std::sqrt(t.inertia2),
          std::sqrt(t.internal2),
          t.slope};
}

// Inertia, drag and weight with their energies; the gradients of membrane and bending.
template <class Real, class Device>
void IncrementalPotential<Real, Device>::compute_gradient(const Vec3<Real>* x) {
  const StepStart<Real> s = start_;
  const Real beta_dt = static_cast<Real>(s.formula.beta_dt);
  const Real inertia = 1 / (beta_dt * beta_dt), drag = s.drag / beta_dt;  // 0 in statics
  const Vec3<Real> g = s.share * s.gravity;
  const MembraneForceView<Real> membrane = membrane_.forces();
  const GatheredForces<Real> bending = bending_.forces();
  const Real* mass = mass_.data();
  const bool lags = bending_lags_;
  Vec3<Real>* gradient = gradient_.data();
  Totals* totals = sums_.data();
  for_each_sum<4>(
      device_, "potential: vertices", vertices_,
      HYST_KERNEL(int i, Sums<4>& sums) {
        const Vec3<Real> moved = x[i] - s.predicted[i], drift = x[i] - s.reference[i];
        const Vec3<Real> stretch = membrane.at(i), bend = bending.at(i);
        gradient[i] = mass[i] * (inertia * moved + drag * drift - g) - stretch - bend;
        if (s.grips.any_at(i)) gradient[i] -= s.grips.force(i, x[i]);
        sums.term[2] += static_cast<double>(stretch.squaredNorm() + bend.squaredNorm());
        if (s.held[i]) return;
        sums.term[3] += static_cast<double>((mass[i] * inertia * moved).squaredNorm());
        double kinetic =
            static_cast<double>(mass[i] / 2 * (inertia * moved.squaredNorm() + drag * drift.squaredNorm()));
        if (s.grips.any_at(i)) kinetic += static_cast<double>(s.grips.energy(i, x[i]));
        Vec3<Real> given = mass[i] * g;
        if (lags) given += bend;
        const double weight = static_cast<double>(given.dot(x[i] - s.now[i]));
        sums.term[0] += kinetic - weight;
        sums.term[1] += kinetic + (weight < 0 ? -weight : weight);
      },
      HYST_KERNEL(const Sums<4>& total) {
        totals->energy = total.term[0];
        totals->size = total.term[1];
        totals->internal2 = total.term[2];
        totals->inertia2 = total.term[3];
      });
}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::add_energies(const double* energies, int count) {
  Totals* totals = sums_.data();
  for_each_sum<2>(
      device_, "potential: sum", count,
      HYST_KERNEL(int i, Sums<2>& sums) {
        sums.term[0] += energies[i];
        sums.term[1] += energies[i] < 0 ? -energies[i] : energies[i];
      },
      HYST_KERNEL(const Sums<2>& total) {
        totals->energy += total.term[0];
        totals->size += total.term[1];
      });
}

template <class Real, class Device>
void IncrementalPotential<Real, Device>::measure_gradient(const Vec3<Real>* x, const Vec3<Real>* direction) {
  const Vec3<Real>* gradient = gradient_.data();
  const char* held = start_.held;
  const Grips<Real> grips = start_.grips;
  Totals* totals = sums_.data();
  for_each_sum<3>(
      device_, "potential: gradient", vertices_,
      HYST_KERNEL(int i, Sums<3>& sums) {
        sums.term[held[i] ? 1 : 0] += static_cast<double>(gradient[i].squaredNorm());
        if (grips.any_at(i)) sums.term[1] += static_cast<double>(grips.force(i, x[i]).squaredNorm());
        if (direction && !held[i]) sums.term[2] += static_cast<double>(gradient[i].dot(direction[i]));
      },
      HYST_KERNEL(const Sums<3>& total) {
        totals->residual2 = total.term[0];
        totals->reaction2 = total.term[1];
        totals->slope = total.term[2];
      });
}

template <class Real, class Device>
LinearSystem<Real, Device> IncrementalPotential<Real, Device>::linearise(const Vec3<Real>* x, Real shift,
                                                                         bool full) {
  const BlockRowsView<Real> matrix = matrix_.view();
  ScalarRowsView<Real> softening;
  if (full) softening = {softening_off_diagonal_.data(), softening_diagonal_.data()};
  membrane_.assemble(1 + membrane_.viscous_factor(), 1, matrix, softening);
  if (!bending_lags_) bending_.linearise();
  const Real beta_dt = static_cast<Real>(start_.formula.beta_dt);
  const Real inertia = 1 / (beta_dt * beta_dt) + start_.drag / beta_dt + shift;
  const Real* mass = mass_.data();
  const Real sliding_share = static_cast<Real>(full ? tuning_.sliding_near : tuning_.sliding_far);
  const Grips<Real> grips = start_.grips;
  Mat3<Real>* rest = rest_diagonal_.data();
  for_each(
      device_, "potential: masses", vertices_, HYST_KERNEL(int i) {
        for (int k = 0; k < 3; ++k) matrix.diagonal[i](k, k) += inertia * mass[i];
        if (grips.any_at(i)) matrix.diagonal[i] += grips.stiffness(i, x[i], sliding_share);
        rest[i].setZero();
      });
  if (contact_) contact_->add_stiffness(x, start_.now, matrix, sliding_share);
  if (!bending_lags_) bending_.add_stiffness_diagonal(rest);
  if (self_contact_) {
    self_contact_->linearise(x, start_.now, sliding_share);
    self_contact_->add_stiffness_diagonal(rest);
  }
  LinearSystem<Real, Device> system{matrix, {}, rest, nullptr, softening, {}};
  if (!bending_lags_)
    system.bending = [this](const Vec3<Real>* p) {
      bending_.apply_stiffness(p);
      return bending_.forces();
    };
  if (self_contact_)
    system.self_contact = [this](const Vec3<Real>* p) { return self_contact_->apply_stiffness(p); };
  return system;
}

template <class Real, class Device>
double IncrementalPotential<Real, Device>::load() {
  const StepStart<Real> s = start_;
  const Real* mass = mass_.data();
  Totals* totals = sums_.data();
  for_each_sum<1>(
      device_, "potential: load", vertices_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (!s.held[i]) sums.term[0] += static_cast<double>((mass[i] * s.gravity).squaredNorm());
      },
      HYST_KERNEL(const Sums<1>& total) { totals->slope = total.term[0]; });
  return std::sqrt(sums_.download()[0].slope);
}

template class IncrementalPotential<double, ThisDevice>;
template class IncrementalPotential<float, ThisDevice>;

}  // namespace hysteron
