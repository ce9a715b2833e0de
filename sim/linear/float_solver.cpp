#include "sim/linear/float_solver.h"

#include <cmath>

namespace hysteron {

template <class Device>
FloatSolver<Device>::FloatSolver(Device& device, const BlockRows<double, Device>& pattern,
                                 std::unique_ptr<LinearSolver<float, Device>> solver,
                                 std::unique_ptr<FloatStiffness<Device>> bending)
    : device_(device),
      solver_(std::move(solver)),
      bending_(std::move(bending)),
      pair_(device),
      off_diagonal_(device, pattern.col().size()),
      diagonal_(device, pattern.row_ptr().size() - 1),
      rest_diagonal_(device, diagonal_.size()),
      softening_off_diagonal_(device, off_diagonal_.size()),
      softening_diagonal_(device, diagonal_.size()),
      rhs_(device, diagonal_.size()),
      x_(device, diagonal_.size()),
      norm_(device, 1) {}

template <class Device>
LinearSystem<float, Device> FloatSolver<Device>::rounded(const LinearSystem<double, Device>& system) {
  const auto round_blocks = [&](const char* name, const Mat3<double>* from, auto& to) {
    round_all(device_, name, 9 * to.size(), from->data(), to.data()->data());
  };
  const BlockRowsView<double>& matrix = system.matrix;
  round_blocks("in float: matrix", matrix.off_diagonal, off_diagonal_);
  round_blocks("in float: diagonal", matrix.diagonal, diagonal_);
  LinearSystem<float, Device> result;
  result.matrix = {matrix.rows, matrix.row_ptr, matrix.col, off_diagonal_.data(), diagonal_.data()};
  result.bytes =
      (matrix.rows + 1 + off_diagonal_.size()) * sizeof(int) + total_bytes(off_diagonal_, diagonal_);
  if (system.rest_diagonal) {
    round_blocks("in float: diagonal", system.rest_diagonal, rest_diagonal_);
    result.rest_diagonal = rest_diagonal_.data();
  }
  const auto product = [&](FloatStiffness<Device>& stiffness) {
    stiffness.round();
    result.bytes += stiffness.force_bytes();
    return [&stiffness](const Vec3<float>* p) { return stiffness.apply(p); };
  };
  if (system.whole.rows > 0) {
    take_whole(system, result);
  } else {
    if (system.softening.off_diagonal) {
      round_all(device_, "in float: softening", softening_off_diagonal_.size(), system.softening.off_diagonal,
                softening_off_diagonal_.data());
      round_all(device_, "in float: softening", softening_diagonal_.size(), system.softening.diagonal,
                softening_diagonal_.data());
      result.softening = {softening_off_diagonal_.data(), softening_diagonal_.data()};
      result.bytes += total_bytes(softening_off_diagonal_, softening_diagonal_);
    }
    if (system.bending) result.bending = product(*bending_);
  }
  if (system.pairs.start) result.pairs = rounded(system.pairs);
  return result;
}

template <class Device>
PairProduct<float> FloatSolver<Device>::rounded(const PairProduct<double>& pairs) {
  const PairStiffness<double>* from = pairs.pair;
  PairStiffness<float>* to = pair_.reserve(pairs.count);
  for_each(
      device_, "in float: pairs", pairs.count, HYST_KERNEL(int p) {
        for (int k = 0; k < 4; ++k) to[p].v[k] = from[p].v[k];
        to[p].block = from[p].block.template cast<float>();
        to[p].weight = from[p].weight.template cast<float>();
      });
  return {pairs.start, pairs.item, to, pairs.count};
}

template <class Device>
void FloatSolver<Device>::take_whole(const LinearSystem<double, Device>& system,
                                     LinearSystem<float, Device>& result) {
  const BlockRowsView<double>& whole = system.whole;
  if (whole_off_diagonal_.size() == 0) {
    whole_off_diagonal_ = Buffer<Mat3<float>, Device>(device_, system.whole_blocks);
    whole_diagonal_ = Buffer<Mat3<float>, Device>(device_, whole.rows);
  }
  round_all(device_, "in float: whole matrix", 9 * whole_off_diagonal_.size(), whole.off_diagonal->data(),
            whole_off_diagonal_.data()->data());
  round_all(device_, "in float: whole matrix", 9 * whole_diagonal_.size(), whole.diagonal->data(),
            whole_diagonal_.data()->data());
  result.whole = {whole.rows, whole.row_ptr, whole.col, whole_off_diagonal_.data(), whole_diagonal_.data()};
  result.whole_blocks = system.whole_blocks;
  result.bytes = (whole.rows + 1 + whole_off_diagonal_.size()) * sizeof(int) +
                 total_bytes(whole_off_diagonal_, whole_diagonal_);
}

template <class Device>
void FloatSolver<Device>::scale_down(const char* held, const Vec3<double>* rhs) {
  double* norm = norm_.data();
  for_each_sum<1>(
      device_, {"in float: norm", 2 * rhs_.bytes()}, static_cast<int>(rhs_.size()),
      HYST_KERNEL(int i, Sums<1>& sums) {
        if (!held[i]) sums.term[0] += rhs[i].squaredNorm();
      },
      HYST_KERNEL(const Sums<1>& total) {
        using std::sqrt;
        *norm = total.term[0] > 0 ? sqrt(total.term[0]) : 1.0;
      });
  Vec3<float>* scaled = rhs_.data();
  for_each(
      device_, {"in float: right-hand side", 3 * rhs_.bytes()}, static_cast<int>(rhs_.size()),
      HYST_KERNEL(int i) {
        scaled[i] =
            held[i] ? Vec3<float>(Vec3<float>::Zero()) : Vec3<float>((rhs[i] / *norm).template cast<float>());
      });
}

template <class Device>
void FloatSolver<Device>::scale_up(Vec3<double>* x) {
  const Vec3<float>* scaled = x_.data();
  const double* norm = norm_.data();
  for_each(
      device_, {"in float: solution", 3 * x_.bytes()}, static_cast<int>(x_.size()),
      HYST_KERNEL(int i) { x[i] = *norm * scaled[i].template cast<double>(); });
}

template <class Device>
PcgOutcome FloatSolver<Device>::solve(const LinearSystem<double, Device>& system, const char* held,
                                      const Vec3<double>* rhs, Vec3<double>* x, double tolerance) {
  const LinearSystem<float, Device> in_float = rounded(system);
  scale_down(held, rhs);
  const PcgOutcome outcome =
      solver_->solve(in_float, held, rhs_.data(), x_.data(), std::max(tolerance, kTightest));
  scale_up(x);
  return outcome;
}

template <class Device>
std::size_t FloatSolver<Device>::bytes() const {
  return solver_->bytes() + (bending_ ? bending_->bytes() : 0) + pair_.bytes() +
         total_bytes(off_diagonal_, diagonal_, rest_diagonal_, softening_off_diagonal_, softening_diagonal_,
                     whole_off_diagonal_, whole_diagonal_, rhs_, x_, norm_);
}

template class FloatSolver<ThisDevice>;

}  // namespace hysteron
