#include "sim/linear/sparse_cholesky.h"

#include <algorithm>
#include <cmath>

namespace hysteron {

namespace {

constexpr double kVanished = 1e-14;  // smallest pivot over the matrix's diagonal number: less is rounding
constexpr int kTileRows = 12, kTileColumns = 4;
constexpr int kPanelColumns = 12;  // eliminated before the next ones are updated

// A dense matrix by columns, of which only the lower triangle is used.
struct Dense {
  double* at;
  std::ptrdiff_t stride;
  double* column(int j) const { return at + j * stride; }
};

// Subtracts a b^T from c, Rows x Columns numbers, with `depth` columns of a and b, which have the same
// stride.
template <int Rows, int Columns>
void subtract_tile(Dense c, const double* a, const double* b, int depth, std::ptrdiff_t stride) {
  using Column = Eigen::Matrix<double, Rows, 1>;
  Eigen::Matrix<double, Rows, Columns> sum = Eigen::Matrix<double, Rows, Columns>::Zero();
  for (int k = 0; k < depth; ++k) {
    const Column column = Eigen::Map<const Column>(a + k * stride);
    for (int j = 0; j < Columns; ++j) sum.col(j) += b[k * stride + j] * column;
  }
  for (int j = 0; j < Columns; ++j) Eigen::Map<Column>(c.column(j)) -= sum.col(j);
}

// Subtracts a a^T from the first `columns` columns of c's lower part, which is `rows` long; a has `depth`
// columns.
void subtract_square(Dense c, Dense a, int rows, int columns, int depth) {
  for (int j = 0; j < columns; j += kTileColumns) {
    const int width = std::min(kTileColumns, columns - j);
    int i = j;
    const auto part = [&](int from) { return Dense{c.column(j) + from, c.stride}; };
    if (width == kTileColumns) {
      for (; i + kTileRows <= rows; i += kTileRows)
        subtract_tile<kTileRows, kTileColumns>(part(i), a.at + i, a.at + j, depth, a.stride);
      for (; i + kTileColumns <= rows; i += kTileColumns)
        subtract_tile<kTileColumns, kTileColumns>(part(i), a.at + i, a.at + j, depth, a.stride);
    }
    for (; i < rows; ++i)
      for (int l = 0; l < width; ++l)
        subtract_tile<1, 1>({c.column(j + l) + i, 1}, a.at + i, a.at + j + l, depth, a.stride);
  }
}

// Eliminates the first `pivots` columns of a dense lower trapezoid; returns how many pivots were replaced.
int eliminate(Dense a, int rows, int pivots, const double* least_pivot) {
  int replaced = 0;
  for (int j = 0; j < pivots; j += kPanelColumns) {
    const int end = std::min(j + kPanelColumns, pivots);
    subtract_square({a.column(j) + j, a.stride}, {a.at + j, a.stride}, rows - j, end - j, j);
    for (int k = j; k < end; ++k) {
      double* column = a.column(k);
      if (!(column[k] > least_pivot[k])) {
        column[k] = least_pivot[k] / kVanished;
        ++replaced;
      }
      column[k] = std::sqrt(column[k]);
      const double inverse = 1 / column[k];
      for (int i = k + 1; i < rows; ++i) column[i] *= inverse;
      for (int l = k + 1; l < end; ++l) {
        double* later = a.column(l);
        const double factor = column[l];
        for (int i = l; i < rows; ++i) later[i] -= factor * column[i];
      }
    }
  }
  return replaced;
}

}  // namespace

SparseCholesky::SparseCholesky(const SparsityPattern& couplings)
    : plan_(plan_elimination(couplings)),
      factor_(plan_.entries),
      updates_(plan_.stack),
      least_pivot_(3 * plan_.order.size()),
      ordered_(3 * plan_.order.size()),
      front_(3 * plan_.order.size()) {}

std::size_t SparseCholesky::bytes() const {
  const std::size_t numbers =
      factor_.size() + updates_.size() + least_pivot_.size() + ordered_.size() + front_.size();
  return numbers * sizeof(double) + plan_.front.size() * sizeof(Front) +
         plan_.block.size() * sizeof(EnteringBlock) +
         (plan_.order.size() + plan_.row.size() + plan_.parent_row.size()) * sizeof(int);
}

void SparseCholesky::assemble(const Front& front, const SymmetricBlocks& matrix, double* panel) const {
  const std::ptrdiff_t stride = 3 * front.rows;
  for (int b = front.block_start; b < front.block_end; ++b) {
    const EnteringBlock& entering = plan_.block[b];
    const Eigen::Matrix3d& block = entering.source < 0
                                       ? matrix.diagonal[plan_.order[front.first + entering.column]]
                                       : matrix.below[entering.source];
    Eigen::Map<Eigen::Matrix3d, 0, Eigen::OuterStride<>> to(
        panel + 3 * entering.column * stride + 3 * entering.row, Eigen::OuterStride<>(stride));
    if (entering.transposed)
      to = block.transpose();
    else
      to = block;
  }
}

// Adds the child's update to the front's own columns and to the rest.
void SparseCholesky::extend_add(const Front& child, const Front& front, const double* update, double* panel,
                                double* remainder) const {
  const int* parent_row = plan_.parent_row.data() + child.parent_row_start;
  const std::ptrdiff_t own_stride = 3 * front.rows, rest_stride = 3 * front.updated(),
                       stride = 3 * child.updated();
  for (int j = 0; j < child.updated(); ++j) {
    const bool is_own = parent_row[j] < front.pivots;
    const int below = is_own ? 0 : front.pivots;
    for (int k = 0; k < 3; ++k) {
      const double* from = update + (3 * j + k) * stride;
      double* to = is_own ? panel + (3 * parent_row[j] + k) * own_stride
                          : remainder + (3 * (parent_row[j] - front.pivots) + k) * rest_stride;
      for (int i = j; i < child.updated(); ++i)
        for (int l = 0; l < 3; ++l) to[3 * (parent_row[i] - below) + l] += from[3 * i + l];
    }
  }
}

int SparseCholesky::factorise(const SymmetricBlocks& matrix) {
  for (std::size_t k = 0; k < plan_.order.size(); ++k)
    for (int c = 0; c < 3; ++c) least_pivot_[3 * k + c] = kVanished * matrix.diagonal[plan_.order[k]](c, c);
  struct Waiting {
    const Front* front;
    double* update;
  };
  std::vector<Waiting> waiting;
  double* free = updates_.data();
  int replaced = 0;
  std::fill(factor_.begin(), factor_.end(), 0.0);
  for (const Front& front : plan_.front) {
    const int rows = 3 * front.rows, pivots = 3 * front.pivots, updated = rows - pivots;
    const std::size_t size = static_cast<std::size_t>(updated) * updated;
    double *panel = factor_.data() + front.panel, *remainder = free;
    assemble(front, matrix, panel);
    std::fill(remainder, remainder + size, 0.0);
    const std::size_t others = waiting.size() - front.children;
    for (std::size_t w = others; w < waiting.size(); ++w)
      extend_add(*waiting[w].front, front, waiting[w].update, panel, remainder);
    replaced += eliminate({panel, rows}, rows, pivots, least_pivot_.data() + 3 * front.first);
    subtract_square({remainder, updated}, {panel + pivots, rows}, updated, updated, pivots);
    if (front.children > 0) {
      free = waiting[others].update;
      std::copy(remainder, remainder + size, free);
      waiting.resize(others);
    }
    if (updated == 0) continue;
    waiting.push_back({&front, free});
    free += size;
  }
  return replaced;
}

void SparseCholesky::solve(double* x) const {
  const int nodes = static_cast<int>(plan_.order.size());
  double *y = ordered_.data(), *later = front_.data();
  const auto node = [](double* values, int k) { return Eigen::Map<Eigen::Vector3d>(values + 3 * k); };
  for (int k = 0; k < nodes; ++k) node(y, k) = node(x, plan_.order[k]);
  for (const Front& front : plan_.front) {
    const int* row = plan_.row.data() + front.row_start + front.pivots;
    const int rows = 3 * front.rows, pivots = 3 * front.pivots;
    double* own = y + 3 * front.first;
    std::fill(later, later + rows - pivots, 0.0);
    for (int k = 0; k < pivots; ++k) {
      const double* column = factor_.data() + front.panel + static_cast<std::size_t>(k) * rows;
      const double value = own[k] /= column[k];
      for (int i = k + 1; i < pivots; ++i) own[i] -= value * column[i];
      for (int i = pivots; i < rows; ++i) later[i - pivots] += value * column[i];
    }
    for (int r = 0; r < front.updated(); ++r) node(y, row[r]) -= node(later, r);
  }
  for (auto front = plan_.front.rbegin(); front != plan_.front.rend(); ++front) {
    const int* row = plan_.row.data() + front->row_start + front->pivots;
    const int rows = 3 * front->rows, pivots = 3 * front->pivots;
    double* own = y + 3 * front->first;
    for (int r = 0; r < front->updated(); ++r) node(later, r) = node(y, row[r]);
    for (int k = pivots - 1; k >= 0; --k) {
      const double* column = factor_.data() + front->panel + static_cast<std::size_t>(k) * rows;
      using Values = Eigen::Map<const Eigen::VectorXd>;
      double sum = own[k] - Values(column + pivots, rows - pivots).dot(Values(later, rows - pivots));
      for (int i = k + 1; i < pivots; ++i) sum -= column[i] * own[i];
      own[k] = sum / column[k];
    }
  }
  for (int k = 0; k < nodes; ++k) node(x, plan_.order[k]) = node(y, k);
}

}  // namespace hysteron
