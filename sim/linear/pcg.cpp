#include "sim/linear/pcg.h"

#include <Eigen/LU>

#include "sim/linear/row_products.h"

namespace hysteron {

template <class Real, class Device>
Pcg<Real, Device>::Pcg(Device& device, int rows, bool preconditioned)
    : device_(device),
      rows_(rows),
      inverse_(device, preconditioned ? 0 : rows),
      r_(device, rows),
      z_(device, rows),
      p_(device, rows),
      q_(device, rows),
      other_p_(device, Device::kGpu && rows <= kMaxRowsInOneLaunch ? rows : 0),
      scalars_(device, 1) {}

template <class Real, class Device>
std::size_t Pcg<Real, Device>::bytes() const {
  return total_bytes(inverse_, r_, z_, p_, q_, other_p_, scalars_);
}

namespace {

template <class Real>
GatheredForces<Real> product(const StiffnessProduct<Real>& stiffness, const Vec3<Real>* p) {
  return stiffness ? stiffness(p) : GatheredForces<Real>{};
}

template <class Real, class Device>
SystemProduct<Real> system_product(const LinearSystem<Real, Device>& system, const Vec3<Real>* p) {
  if (system.whole.rows > 0) return {system.whole, {}, {}, system.pairs};
  return {system.matrix, system.softening, product(system.bending, p), system.pairs};
}

// Returns the number of a product's blocks for each block of a sum over elements: as many as an H100 runs at
// once.  A thread takes 32 registers in single precision, 40 in double.  Fewer rows are summed as in one
// launch.
template <class Real>
int blocks_each(int rows) {
  return sizeof(Real) == 4 && rows > kMaxRowsInOneLaunch ? kMaxSumBlocksEach : kRowSumBlocksEach;
}

// A GPU gets so many iterations before the host asks whether they were enough.
constexpr int kIterationsAtOnce = 4;

}  // namespace

// Sets q = matrix * guess, and finds the factor alpha for which alpha * guess is nearest to the solution.
template <class Real, class Device>
void Pcg<Real, Device>::project(const System& system, const char* held, const Vec3<Real>* rhs,
                                const Vec3<Real>* guess) {
  const SystemProduct<Real> system_product{system.matrix, {}, product(system.bending, guess), system.pairs};
  Vec3<Real>* q = q_.data();
  PcgScalars* s = scalars_.data();
  for_each_row_sum<2>(
      device_, {"solve: guess", system.bytes + vectors(3)}, rows_,
      HYST_KERNEL(int i, const LanesOn<Device>& lanes, Sums<2>& sums) {
        if (held[i]) return;
        const Vec3<Real> product = system_product.at(lanes, i, guess);
        if (!lanes.leads()) return;
        q[i] = product;
        sums.term[0] += static_cast<double>(guess[i].dot(rhs[i]));
        sums.term[1] += static_cast<double>(guess[i].dot(product));
      },
      HYST_KERNEL(const Sums<2>& total) {
        s->alpha = total.term[1] > 0 ? total.term[0] / total.term[1] : 0;
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::start(const System& system, const char* held, const Vec3<Real>* rhs,
                              const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x, PcgEnd end) {
  if (guess) project(system, held, rhs, guess);
  if (system.preconditioner) return start_preconditioned(system, held, rhs, known, guess, x, end);
  const BlockRowsView<Real> matrix = system.matrix;
  const Mat3<Real>* rest = system.rest_diagonal;
  const Real* mass = system.mass;
  const std::size_t mass_bytes = mass ? rows_ * sizeof(Real) : 0;
  const Vec3<Real>* q = q_.data();
  Mat3<Real>* inverse = inverse_.data();
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data();
  PcgScalars* s = scalars_.data();
  for_each_sum<3>(
      device_, {"solve: start", (rest ? 3 : 2) * inverse_.bytes() + vectors(guess ? 7 : 5) + mass_bytes},
      rows_,
      HYST_KERNEL(int i, Sums<3>& sums) {
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
        if (!mass) return;
        for (int k = 0; k < 3; ++k) {
          const Real stiffness = block(k, k) - mass[i];
          sums.term[2] += static_cast<double>(stiffness * stiffness / block(k, k));
        }
      },
      HYST_KERNEL(const Sums<3>& total) {
        const double wanted = end.tolerance * end.tolerance * total.term[1],
                     least = end.rounding * end.rounding * total.term[2];
        s->target = least > wanted ? least : wanted;
        s->begin(total.term[0], end.most_iterations);
      });
}

// Starts with the caller's preconditioner.  Without known impulses and guess the first residual is the scale.
template <class Real, class Device>
void Pcg<Real, Device>::start_preconditioned(const System& system, const char* held, const Vec3<Real>* rhs,
                                             const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                                             PcgEnd end) {
  const Vec3<Real>* q = q_.data();
  Vec3<Real>*r = r_.data(), *z = z_.data(), *p = p_.data();
  PcgScalars* s = scalars_.data();
  for_each(
      device_, {"solve: start", vectors(guess ? 6 : 4)}, rows_, HYST_KERNEL(int i) {
        if (held[i]) {
          x[i] = r[i] = p[i] = Vec3<Real>::Zero();
          return;
        }
        x[i] = guess ? Vec3<Real>(static_cast<Real>(s->alpha) * guess[i]) : Vec3<Real>(Vec3<Real>::Zero());
        r[i] = guess ? Vec3<Real>(rhs[i] - static_cast<Real>(s->alpha) * q[i]) : rhs[i];
      });
  const bool other_scale = known || guess;
  if (other_scale) find_target(system, held, rhs, known, end);
  system.preconditioner->apply(r, z, nullptr);
  for_each_sum<1>(
      device_, {"solve: first direction", vectors(3)}, rows_,
      HYST_KERNEL(int i, Sums<1>& sums) {
        p[i] = z[i];
        sums.term[0] += static_cast<double>(r[i].dot(z[i]));
      },
      HYST_KERNEL(const Sums<1>& total) {
        if (!other_scale) s->target = end.tolerance * end.tolerance * total.term[0];
        s->begin(total.term[0], end.most_iterations);
      });
}

template <class Real, class Device>
void Pcg<Real, Device>::find_target(const System& system, const char* held, const Vec3<Real>* rhs,
                                    const Vec3<Real>* known, PcgEnd end) {
  Vec3<Real>*z = z_.data(), *scale = q_.data();
  PcgScalars* s = scalars_.data();
  for_each(
      device_, {"solve: scale", vectors(known ? 3 : 2)}, rows_, HYST_KERNEL(int i) {
        scale[i] = held[i] ? Vec3<Real>(Vec3<Real>::Zero())
                   : known ? Vec3<Real>(rhs[i] - known[i])
                           : Vec3<Real>(rhs[i]);
      });
  system.preconditioner->apply(scale, z, nullptr);
  for_each_sum<1>(
      device_, {"solve: target", vectors(2)}, rows_,
      HYST_KERNEL(int i, Sums<1>& sums) { sums.term[0] += static_cast<double>(scale[i].dot(z[i])); },
      HYST_KERNEL(const Sums<1>& total) { s->target = end.tolerance * end.tolerance * total.term[0]; });
}

template <class Real, class Device>
PcgIterations<Real> Pcg<Real, Device>::iterations(const System& system, const char* held, Vec3<Real>* x) {
  const PcgScalars* s = scalars_.data();
  Vec3<Real>* p = p_.data();
  return {rows_,
          {system_product(system, static_cast<const Vec3<Real>*>(p)), held, p, q_.data(), s},
          {{held, p, q_.data(), x, r_.data(), s}, inverse_.data(), z_.data()},
          {held, z_.data(), p, s},
          other_p_.data(),
          scalars_.data()};
}

template <class Real, class Device>
template <bool kHasPairs>
void Pcg<Real, Device>::multiply(const ProductTerms<Real, kHasPairs>& product, std::size_t bytes) {
  PcgScalars* s = scalars_.data();
  for_each_block_row_sum<1>(
      device_, {"solve: product", bytes + vectors(2)}, rows_, product,
      HYST_KERNEL(const Sums<1>& total) { s->find_length(total.term[0]); }, blocks_each<Real>(rows_));
}

template <class Real, class Device>
void Pcg<Real, Device>::iterate(const System& system, const char* held, Vec3<Real>* x) {
  const PcgIterations<Real> loops = iterations(system, held, x);
  PcgScalars* s = scalars_.data();
  const ProductTerms<Real>& terms = loops.product;
  if (system.pairs.start) {
    multiply(terms, system.bytes);
  } else {
    const SystemProduct<Real, false> alone{
        terms.product.matrix, terms.product.softening, terms.product.bending, {}};
    multiply(ProductTerms<Real, false>{alone, terms.held, terms.p, terms.q, terms.scalars}, system.bytes);
  }
  if (system.preconditioner) {
    const Advance<Real>& step = loops.advance.advance;
    if (!system.preconditioner->step_and_apply(step, z_.data(), s)) {
      for_each(device_, {"solve: advance", vectors(6)}, rows_, step);
      system.preconditioner->apply(r_.data(), z_.data(), s);
    }
  } else {
    for_each_sum<1>(
        device_, {"solve: advance", inverse_.bytes() + vectors(7)}, rows_, loops.advance,
        HYST_KERNEL(const Sums<1>& total) { s->advance(total.term[0]); });
  }
  for_each(device_, {"solve: direction", vectors(3)}, rows_, loops.direction);
}

// Iterates in a graph on the device if it can.  Pairs of layers, and a factorisation's arrays, move from
// system to system: capturing their loops would cost more than it saves.
template <class Real, class Device>
bool Pcg<Real, Device>::iterate_on_device(const System& system, const char* held, Vec3<Real>* x) {
  if (!system.bending || system.whole.rows > 0) {  // no loops of bending's product are needed
    OneLaunchView<Real> view;
    const bool has_view = !system.preconditioner || system.preconditioner->in_one_launch(view);
    if (has_view && iterate_in_one_launch(device_, iterations(system, held, x), view)) return true;
  }
  if (system.pairs.start) return false;
  const BlockRowsView<Real>& matrix = system.matrix;
  const std::vector<const void*> key = {matrix.row_ptr,
                                        matrix.col,
                                        matrix.off_diagonal,
                                        matrix.diagonal,
                                        system.softening.off_diagonal,
                                        system.softening.diagonal,
                                        system.preconditioner,
                                        system.bending ? this : nullptr,
                                        system.whole.off_diagonal,
                                        held,
                                        x};
  const int rounds = system.preconditioner ? 1 : kIterationsAtOnce;
  return loop_.run(device_, key, &scalars_.data()->done, [&] {
    for (int k = 0; k < rounds; ++k) iterate(system, held, x);
  });
}

// Iterates in batches: the device decides when it is done; the host only asks, at first after as many
// iterations as the last solve took for each decade of its tolerance.  While kernels are profiled it asks
// after each, so that the profile shows needed iterations alone.
template <class Real, class Device>
PcgScalars Pcg<Real, Device>::iterate_in_batches(const System& system, const char* held, Vec3<Real>* x,
                                                 PcgEnd end) {
  int batch = 1;
  const bool in_batches = Device::kGpu && !device_.profile;
  if (in_batches)
    batch += static_cast<int>(
        std::min<double>(end.most_iterations, iterations_per_decade_ * decades(end.tolerance)));
  else if (const PcgScalars first = scalars(); first.done)
    return first;
  for (;;) {
    for (int k = 0; k < batch; ++k) iterate(system, held, x);
    if (const PcgScalars now = scalars(); now.done) return now;
    batch = in_batches ? kIterationsAtOnce : 1;
  }
}

template <class Real, class Device>
PcgScalars Pcg<Real, Device>::scalars() const {
  return scalars_.download()[0];
}

template <class Real, class Device>
PcgOutcome Pcg<Real, Device>::solve(const System& system, const char* held, const Vec3<Real>* rhs,
                                    const Vec3<Real>* known, const Vec3<Real>* guess, Vec3<Real>* x,
                                    PcgEnd end) {
  start(system, held, rhs, known, guess, x, end);
  const PcgScalars outcome =
      iterate_on_device(system, held, x) ? scalars() : iterate_in_batches(system, held, x, end);
  iterations_per_decade_ = outcome.iterations / decades(end.tolerance);
  return {outcome.iterations, outcome.done == PcgScalars::kConverged};
}

template class Pcg<double, ThisDevice>;
template class Pcg<float, ThisDevice>;

}  // namespace hysteron
