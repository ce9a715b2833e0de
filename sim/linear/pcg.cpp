#include "sim/linear/pcg.h"

#include <Eigen/LU>

namespace hysteron {

template <class Real, class Device>
Pcg<Real, Device>::Pcg(Device& device, int rows)
    : device_(device),
      rows_(rows),
      inverse_(device, rows),
      r_(device, rows),
      z_(device, rows),
      p_(device, rows),
      q_(device, rows),
      scalars_(device, 1) {}

template <class Real, class Device>
std::size_t Pcg<Real, Device>::bytes() const {
  return inverse_.bytes() + 4 * r_.bytes() + scalars_.bytes();
}

namespace {

template <class Real>
GatheredForces<Real> product(const StiffnessProduct<Real>& stiffness, const Vec3<Real>* p) {
  return stiffness ? stiffness(p) : GatheredForces<Real>{};
}

}  // namespace

// q = matrix * guess, and the factor alpha for which alpha * guess is nearest to the solution.
template <class Real, class Device>
void Pcg<Real, Device>::project(const System& system, const char* held, const Vec3<Real>* rhs,
                                const Vec3<Real>* guess) {
  const BlockRowsView<Real> matrix = system.matrix;
  const GatheredForces<Real> bending = product(system.bending, guess);
  const GatheredForces<Real> pressing = product(system.self_contact, guess);
  Vec3<Real>* q = q_.data();
  Scalars* s = scalars_.data();
  for_each_sum<2>(
      device_, "solve: guess", rows_,
      HYST_KERNEL(int i, Sums<2>& sums) {
        if (held[i]) return;
        q[i] = matrix.times(i, guess);
        if (bending.start) q[i] -= bending.at(i);
        if (pressing.start) q[i] += pressing.at(i);
        sums.term[0] += static_cast<double>(guess[i].dot(rhs[i]));
        sums.term[1] += static_cast<double>(guess[i].dot(q[i]));
      },
      HYST_KERNEL(const Sums<2>& total) {
        s->alpha = total.term[1] > 0 ? total.term[0] / total.term[1] : 0;
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::start(const System& system, const char* held, const Vec3<Real>* rhs,
                              const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                              double tolerance) {
  if (guess) project(system, held, rhs, guess);
  const BlockRowsView<Real> matrix = system.matrix;
  const Mat3<Real>* rest = system.rest_diagonal;
  const Vec3<Real>* q = q_.data();
  Mat3<Real>* inverse = inverse_.data();
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data();
  Scalars* s = scalars_.data();
  for_each_sum<2>(
      device_, "solve: start", rows_,
      HYST_KERNEL(int i, Sums<2>& sums) {
        if (held[i]) {
          x[i] = r[i] = z[i] = p[i] = Vec3<Real>::Zero();
          return;
        }
        Mat3<Real> block = matrix.diagonal[i];
        if (rest) block += rest[i];
        inverse[i] = block.inverse();
        x[i] = guess ? Vec3<Real>(static_cast<Real>(s->alpha) * guess[i]) : Vec3<Real>(Vec3<Real>::Zero());
        r[i] = guess ? Vec3<Real>(rhs[i] - static_cast<Real>(s->alpha) * q[i]) : rhs[i];
        z[i] = inverse[i] * r[i];
        p[i] = z[i];
        sums.term[0] += static_cast<double>(r[i].dot(z[i]));
        const Vec3<Real> scale = known ? Vec3<Real>(rhs[i] - known[i]) : rhs[i];
        sums.term[1] += static_cast<double>(scale.dot(inverse[i] * scale));
      },
      HYST_KERNEL(const Sums<2>& total) {
        s->residual = total.term[0];
        s->target = tolerance * tolerance * total.term[1];
        s->iterations = 0;
        s->done = !(s->residual > s->target);
      });
  if (system.preconditioner) start_preconditioned(system, held, rhs, known, tolerance);
}

// The same with the caller's preconditioner: z, p and the two norms again.
template <class Real, class Device>
void Pcg<Real, Device>::start_preconditioned(const System& system, const char* held, const Vec3<Real>* rhs,
                                             const Vec3<Real>* known, double tolerance) {
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data(), *scale = q_.data();
  Scalars* s = scalars_.data();
  for_each(
      device_, "solve: scale", rows_, HYST_KERNEL(int i) {
        scale[i] = held[i] ? Vec3<Real>(Vec3<Real>::Zero())
                   : known ? Vec3<Real>(rhs[i] - known[i])
                           : Vec3<Real>(rhs[i]);
      });
  system.preconditioner->apply(scale, z);
  for_each_sum<1>(
      device_, "solve: target", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) { sums.term[0] += static_cast<double>(scale[i].dot(z[i])); },
      HYST_KERNEL(const Sums<1>& total) { s->target = tolerance * tolerance * total.term[0]; });
  system.preconditioner->apply(r, z);
  for_each_sum<1>(
      device_, "solve: first direction", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        p[i] = z[i];
        sums.term[0] += static_cast<double>(r[i].dot(z[i]));
      },
      HYST_KERNEL(const Sums<1>& total) {
        s->residual = total.term[0];
        s->done = !(s->residual > s->target);
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::iterate(const System& system, const char* held, Vec3<Real>* x) {
  const BlockRowsView<Real> matrix = system.matrix;
  Vec3<Real>*z = z_.data(), *p = p_.data(), *q = q_.data();
  Scalars* s = scalars_.data();
  const GatheredForces<Real> bending = product(system.bending, p);
  const GatheredForces<Real> pressing = product(system.self_contact, p);
  const ScalarRowsView<Real> softening = system.softening;
  for_each_sum<1>(
      device_, "solve: product", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (s->done || held[i]) return;
        q[i] = softening.off_diagonal ? matrix.times(i, p, softening) : matrix.times(i, p);
        if (bending.start) q[i] -= bending.at(i);
        if (pressing.start) q[i] += pressing.at(i);
        sums.term[0] += static_cast<double>(p[i].dot(q[i]));
      },
      HYST_KERNEL(const Sums<1>& total) {
        if (s->done) return;
        s->indefinite = !(total.term[0] > 0);
        s->alpha = s->residual / (s->indefinite ? -total.term[0] : total.term[0]);
      });
  if (system.preconditioner)
    advance_preconditioned(system, held, x);
  else
    advance(held, x);
  for_each(
      device_, "solve: direction", rows_, HYST_KERNEL(int i) {
        if (s->done || held[i]) return;
        p[i] = z[i] + static_cast<Real>(s->beta) * p[i];
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::advance(const char* held, Vec3<Real>* x) {
  const Mat3<Real>* inverse = inverse_.data();
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data(), *q = q_.data();
  Scalars* s = scalars_.data();
  for_each_sum<1>(
      device_, "solve: advance", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (s->done || held[i]) return;
        const Real alpha = static_cast<Real>(s->alpha);
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
        z[i] = inverse[i] * r[i];
        sums.term[0] += static_cast<double>(r[i].dot(z[i]));
      },
      HYST_KERNEL(const Sums<1>& total) { s->advance(total.term[0]); });
}

template <class Real, class Device>
void Pcg<Real, Device>::advance_preconditioned(const System& system, const char* held, Vec3<Real>* x) {
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data(), *q = q_.data();
  Scalars* s = scalars_.data();
  for_each(
      device_, "solve: advance", rows_, HYST_KERNEL(int i) {
        if (s->done || held[i]) return;
        const Real alpha = static_cast<Real>(s->alpha);
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
      });
  system.preconditioner->apply(r, z);
  for_each_sum<1>(
      device_, "solve: weigh", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) { sums.term[0] += static_cast<double>(r[i].dot(z[i])); },
      HYST_KERNEL(const Sums<1>& total) { s->advance(total.term[0]); });
}

// The device decides when it is done; the host only asks, at first after as many iterations as the last solve
// took.
template <class Real, class Device>
PcgOutcome Pcg<Real, Device>::solve(const System& system, const char* held, const Vec3<Real>* rhs,
                                    const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                                    double tolerance, int most_iterations) {
  start(system, held, rhs, known, guess, x, tolerance);
  constexpr int kAskAgain = 4;
  Scalars scalars{};
  for (int sent = 0;;) {
    const int batch = Device::kGpu ? (sent == 0 ? last_iterations_ + 1 : kAskAgain) : 1;
    if (sent > 0 || !Device::kGpu) {
      device_download(device_, &scalars, scalars_.data(), sizeof(Scalars));
      if (scalars.done || sent >= most_iterations) break;
    }
    for (int i = 0; i < batch; ++i) iterate(system, held, x);
    sent += batch;
  }
  last_iterations_ = scalars.iterations;
  return {scalars.iterations, scalars.done == kConverged};
}

template class Pcg<double, ThisDevice>;
template class Pcg<float, ThisDevice>;

}  // namespace hysteron
