#include "sim/solve/pcg.h"

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

// q = matrix * guess, and the factor alpha for which alpha * guess is nearest to the solution.
template <class Real, class Device>
void Pcg<Real, Device>::project(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs,
                                const Vec3<Real>* guess) {
  Vec3<Real>* q = q_.data();
  Scalars* s = scalars_.data();
  for_each_sum<2>(
      device_, "solve: guess", rows_,
      HYST_KERNEL(int i, Sums<2>& sums) {
        if (held[i]) return;
        q[i] = matrix.times(i, guess);
        sums.term[0] += static_cast<double>(guess[i].dot(rhs[i]));
        sums.term[1] += static_cast<double>(guess[i].dot(q[i]));
      },
      HYST_KERNEL(const Sums<2>& total) {
        s->alpha = total.term[1] > 0 ? total.term[0] / total.term[1] : 0;
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::start(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs,
                              const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                              double tolerance) {
  if (guess) project(matrix, held, rhs, guess);
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
        inverse[i] = matrix.diagonal[i].inverse();
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
}

template <class Real, class Device>
void Pcg<Real, Device>::iterate(BlockRowsView<Real> matrix, const char* held, Vec3<Real>* x) {
  const Mat3<Real>* inverse = inverse_.data();
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data(), *q = q_.data();
  Scalars* s = scalars_.data();
  for_each_sum<1>(
      device_, "solve: product", rows_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (s->done || held[i]) return;
        q[i] = matrix.times(i, p);
        sums.term[0] += static_cast<double>(p[i].dot(q[i]));
      },
      HYST_KERNEL(const Sums<1>& total) {
        if (!s->done) s->alpha = s->residual / total.term[0];
      });
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
      HYST_KERNEL(const Sums<1>& total) {
        if (s->done) return;
        s->beta = total.term[0] / s->residual;
        s->residual = total.term[0];
        s->iterations += 1;
        s->done = !(s->residual > s->target);
      });
  for_each(
      device_, "solve: direction", rows_, HYST_KERNEL(int i) {
        if (s->done || held[i]) return;
        p[i] = z[i] + static_cast<Real>(s->beta) * p[i];
      });
}

// The device decides when it is done; the host only asks, at first after as many iterations as the last solve
// took.
template <class Real, class Device>
PcgOutcome Pcg<Real, Device>::solve(BlockRowsView<Real> matrix, const char* held, const Vec3<Real>* rhs,
                                    const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                                    double tolerance, int most_iterations) {
  start(matrix, held, rhs, known, guess, x, tolerance);
  constexpr int kAskAgain = 4;
  Scalars scalars{};
  for (int sent = 0;;) {
    const int batch = Device::kGpu ? (sent == 0 ? last_iterations_ + 1 : kAskAgain) : 1;
    if (sent > 0 || !Device::kGpu) {
      device_download(device_, &scalars, scalars_.data(), sizeof(Scalars));
      if (scalars.done || sent >= most_iterations) break;
    }
    for (int i = 0; i < batch; ++i) iterate(matrix, held, x);
    sent += batch;
  }
  last_iterations_ = scalars.iterations;
  return {scalars.iterations, scalars.done != 0};
}

template class Pcg<double, ThisDevice>;
template class Pcg<float, ThisDevice>;

}  // namespace hysteron
