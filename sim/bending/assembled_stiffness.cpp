#include "sim/bending/assembled_stiffness.h"

#include <algorithm>

#include "sim/bending/bending_elements.h"
#include "sim/linear/compressed_rows.h"

namespace hysteron {

namespace {

template <class Real, class Device>
Adjacency vertices_of_elements(Device& device, const BendingFactors<Real>& factors) {
  const auto start = downloaded(device, factors.start, factors.elements + 1);
  const auto hinge = downloaded(device, factors.hinge, factors.items);
  const auto corner = downloaded(device, factors.corner, factors.hinges);
  return hysteron::vertices_of_elements(factors.elements, start.data(), hinge.data(), corner.data());
}

// Returns the off-diagonal blocks: pairs of vertices that share an element, or a block of the narrower
// matrix.
template <class Real, class Device>
Adjacency stiffness_pattern(const Adjacency& elements, const BlockRows<Real, Device>& narrow) {
  const int n = static_cast<int>(narrow.row_ptr().size()) - 1;
  std::vector<std::vector<int>> neighbours(n);
  for (int i = 0; i < n; ++i)
    neighbours[i].assign(narrow.col().begin() + narrow.row_ptr()[i],
                         narrow.col().begin() + narrow.row_ptr()[i + 1]);
  for (std::size_t e = 0; e + 1 < elements.start.size(); ++e)
    for (int a = elements.start[e]; a < elements.start[e + 1]; ++a)
      for (int b = elements.start[e]; b < elements.start[e + 1]; ++b)
        if (a != b) neighbours[elements.item[a]].push_back(elements.item[b]);
  return compressed(neighbours);
}

int slot_in(const int* row_ptr, const std::vector<int>& col, int row, int column) {
  const auto last = col.begin() + row_ptr[row + 1],
             at = std::lower_bound(col.begin() + row_ptr[row], last, column);
  return at != last && *at == column ? static_cast<int>(at - col.begin()) : -1;
}

// Lists for each upper block the pairs of items that add to it, in the order of their elements.
template <class Pair>
void pairs_of_blocks(const Adjacency& elements, const Adjacency& pattern,
                     const std::vector<UpperBlock>& upper, std::vector<int>& start, std::vector<Pair>& pair) {
  std::vector<int> diagonal, of_slot(pattern.item.size(), -1);
  for (std::size_t u = 0; u < upper.size(); ++u)
    if (upper[u].slot < 0)
      diagonal.push_back(static_cast<int>(u));
    else
      of_slot[upper[u].slot] = static_cast<int>(u);
  const auto each = [&](auto&& visit) {
    for (std::size_t e = 0; e + 1 < elements.start.size(); ++e)
      for (int a = elements.start[e]; a < elements.start[e + 1]; ++a)
        for (int b = elements.start[e]; b < elements.start[e + 1]; ++b) {
          const int row = elements.item[a], column = elements.item[b];
          if (row > column) continue;
          visit(row == column ? diagonal[row]
                              : of_slot[slot_in(pattern.start.data(), pattern.item, row, column)],
                Pair{a, b});
        }
  };
  start.assign(upper.size() + 1, 0);
  each([&](int u, const Pair&) { ++start[u + 1]; });
  for (std::size_t u = 0; u < upper.size(); ++u) start[u + 1] += start[u];
  pair.resize(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  each([&](int u, const Pair& items) { pair[next[u]++] = items; });
}

}  // namespace

template <class Real, class Device>
AssembledStiffness<Real, Device>::AssembledStiffness(Device& device, const BlockRows<Real, Device>& rows,
                                                     const Bending<Real, Device>& bending)
    : device_(device), bending_(bending) {
  const BendingFactors<Real> factors = bending.factors();
  const Adjacency elements = vertices_of_elements(device, factors),
                  pattern = stiffness_pattern(elements, rows);
  const std::vector<UpperBlock> upper = upper_blocks(pattern);
  std::vector<int> element, pair_start, narrow;
  for (int e = 0; e < factors.elements; ++e) element.resize(elements.start[e + 1], e);
  std::vector<Pair> pair;
  pairs_of_blocks(elements, pattern, upper, pair_start, pair);
  for (const UpperBlock& block : upper)
    narrow.push_back(block.slot < 0 ? block.row
                                    : slot_in(rows.row_ptr().data(), rows.col(), block.row, block.column));
  element_ = Buffer<int, Device>(device, element);
  vertex_ = Buffer<int, Device>(device, elements.item);
  rate_ = Buffer<Real, Device>(device, elements.item.size() * 3 * factors.dimension);
  upper_ = Buffer<UpperBlock, Device>(device, upper);
  pair_start_ = Buffer<int, Device>(device, pair_start);
  narrow_ = Buffer<int, Device>(device, narrow);
  pair_ = Buffer<Pair, Device>(device, pair);
  row_ptr_ = Buffer<int, Device>(device, pattern.start);
  col_ = Buffer<int, Device>(device, pattern.item);
  off_diagonal_ = Buffer<Mat3<Real>, Device>(device, pattern.item.size());
  diagonal_ = Buffer<Mat3<Real>, Device>(device, pattern.start.size() - 1);
}

template <class Real, class Device>
BlockRowsView<Real> AssembledStiffness<Real, Device>::assemble(const BlockRowsView<Real>& matrix,
                                                               const ScalarRowsView<Real>& softening) {
  const BendingFactors<Real> factors = bending_.factors();
  if (factors.dimension == 1) {
    find_rates<1>(factors);
    add_up<1>(factors, matrix, softening);
  } else {
    find_rates<3>(factors);
    add_up<3>(factors, matrix, softening);
  }
  return {static_cast<int>(diagonal_.size()), row_ptr_.data(), col_.data(), off_diagonal_.data(),
          diagonal_.data()};
}

template <class Real, class Device>
template <int D>
void AssembledStiffness<Real, Device>::find_rates(const BendingFactors<Real>& factors) {
  const int *element = element_.data(), *vertex = vertex_.data();
  Real* rate = rate_.data();
  const std::size_t read = factors.hinges * (8 * sizeof(Real) + sizeof(Eigen::Vector4i)) +
                           factors.items * (D * sizeof(Real) + sizeof(int));
  for_each(
      device_, {"bending rates of vertices", read + total_bytes(element_, vertex_, rate_)},
      static_cast<int>(vertex_.size()), HYST_KERNEL(int k) {
        const int e = element[k], v = vertex[k];
        Eigen::Matrix<Real, D, 3> sum = Eigen::Matrix<Real, D, 3>::Zero();
        for (int j = factors.start[e]; j < factors.start[e + 1]; ++j) {
          const int h = factors.hinge[j];
          const Eigen::Vector4i corner = factors.corner[h];
          for (int c = 0; c < 4; ++c) {
            if (corner[c] != v) continue;
            const Vec3<Real> g = angle_gradient(factors.gradient + 8 * static_cast<std::size_t>(h), c);
            for (int d = 0; d < D; ++d) sum.row(d) += factors.coefficient[j * D + d] * g.transpose();
          }
        }
        for (int d = 0; d < D; ++d)
          for (int x = 0; x < 3; ++x) rate[(static_cast<std::size_t>(k) * D + d) * 3 + x] = sum(d, x);
      });
}

template <class Real, class Device>
template <int D>
void AssembledStiffness<Real, Device>::add_up(const BendingFactors<Real>& factors,
                                              const BlockRowsView<Real>& matrix,
                                              const ScalarRowsView<Real>& softening) {
  constexpr int kPacked = D * (D + 1) / 2;
  const UpperBlock* upper = upper_.data();
  const int *start = pair_start_.data(), *narrow = narrow_.data(), *element = element_.data();
  const Pair* pair = pair_.data();
  const Real *rate = rate_.data(), *tangent = factors.tangent;
  Mat3<Real>*off_diagonal = off_diagonal_.data(), *diagonal = diagonal_.data();
  const std::size_t read = factors.elements * kPacked * sizeof(Real) +
                           total_bytes(upper_, pair_start_, narrow_, element_, pair_, rate_);
  for_each(
      device_, {"assembled matrix", read + total_bytes(off_diagonal_, diagonal_)},
      static_cast<int>(upper_.size()), HYST_KERNEL(int u) {
        using Rate = Eigen::Matrix<Real, 3, D>;  // a vertex's rates, as columns
        const UpperBlock at = upper[u];
        const bool on_diagonal = at.slot < 0;
        Mat3<Real> block = Mat3<Real>::Zero();
        if (const int n = narrow[u]; n >= 0) {
          block = on_diagonal ? matrix.diagonal[n] : matrix.off_diagonal[n];
          if (softening.diagonal) {
            const Real soft = on_diagonal ? softening.diagonal[n] : softening.off_diagonal[n];
            for (int k = 0; k < 3; ++k) block(k, k) += soft;
          }
        }
        for (int p = start[u]; p < start[u + 1]; ++p) {
          const Pair items = pair[p];
          const Real* t = tangent + static_cast<std::size_t>(element[items.first]) * kPacked;
          const Eigen::Map<const Rate> a(rate + static_cast<std::size_t>(items.first) * 3 * D),
              b(rate + static_cast<std::size_t>(items.second) * 3 * D);
          Rate moment = Rate::Zero();  // b T
          for (int i = 0; i < D; ++i)
            for (int j = 0; j <= i; ++j, ++t) {
              moment.col(i) += *t * b.col(j);
              if (i != j) moment.col(j) += *t * b.col(i);
            }
          for (int i = 0; i < D; ++i) block += a.col(i) * moment.col(i).transpose();
        }
        if (on_diagonal) {
          diagonal[at.row] = block;
        } else {
          off_diagonal[at.slot] = block;
          off_diagonal[at.mirror] = block.transpose();
        }
      });
}

template <class Real, class Device>
std::size_t AssembledStiffness<Real, Device>::bytes() const {
  return matrix_bytes() + total_bytes(element_, vertex_, rate_, upper_, pair_start_, narrow_, pair_);
}

template class AssembledStiffness<double, ThisDevice>;
template class AssembledStiffness<float, ThisDevice>;

}  // namespace hysteron
