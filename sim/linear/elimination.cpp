#include "sim/linear/elimination.h"

#include <amd.h>
#include <algorithm>

#include "sim/base/error.h"
#include "sim/linear/compressed_rows.h"

namespace hysteron {

CouplingList::CouplingList(const Adjacency& couplings) : below_(couplings.start.size() - 1) {
  for (int i = 0; i < static_cast<int>(below_.size()); ++i)
    for (int j = couplings.start[i]; j < couplings.start[i + 1]; ++j)
      if (couplings.item[j] < i) below_[i].push_back(couplings.item[j]);
}

void CouplingList::add(std::span<const int> nodes) {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i) below_[i].push_back(j);
}

SparsityPattern CouplingList::take() {
  SparsityPattern result = compressed(below_);
  below_.clear();
  return result;
}

SymmetricBlocks::SymmetricBlocks(SparsityPattern couplings)
    : diagonal(couplings.start.size() - 1), below(couplings.item.size()), couplings_(std::move(couplings)) {
  set_zero();
}

int SymmetricBlocks::slot(int i, int j) const {
  const int slot = slot_in_row(couplings_, i, j);
  return slot < couplings_.start[i + 1] && couplings_.item[slot] == j ? slot : -1;
}

bool SymmetricBlocks::couples(std::span<const int> nodes) const {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i && slot(i, j) < 0) return false;
  return true;
}

void SymmetricBlocks::find_slots(std::span<const int> nodes, std::vector<int>& slots) const {
  for (int i : nodes)
    for (int j : nodes)
      if (j < i) slots.push_back(slot(i, j));
}

void SymmetricBlocks::set_zero() {
  std::fill(diagonal.begin(), diagonal.end(), Eigen::Matrix3d::Zero());
  std::fill(below.begin(), below.end(), Eigen::Matrix3d::Zero());
}

const int* SymmetricBlocks::add(const ElementStiffness& stiffness, int e, const int* slots) {
  const std::span<const int> vertex = stiffness.vertices(e);
  const int n = static_cast<int>(vertex.size());
  Eigen::Matrix3d tangent;
  rates_.resize(3, 3 * n);
  stiffness.linearised(e, rates_, tangent);
  forces_ = tangent.lazyProduct(rates_);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      if (vertex[b] > vertex[a]) continue;
      Eigen::Matrix3d& block = vertex[a] == vertex[b] ? diagonal[vertex[a]] : below[*slots++];
      block += rates_.middleCols<3>(3 * a).transpose().lazyProduct(forces_.middleCols<3>(3 * b));
    }
  return slots;
}

void SymmetricBlocks::hold(const char* held) {
  for (int i = 0; i < nodes(); ++i) {
    if (held[i]) diagonal[i].setIdentity();
    for (int j = couplings_.start[i]; j < couplings_.start[i + 1]; ++j)
      if (held[i] || held[couplings_.item[j]]) below[j].setZero();
  }
}

Adjacency both_ways(const SparsityPattern& below) {
  std::vector<std::vector<int>> rows(below.start.size() - 1);
  for (int i = 0; i < static_cast<int>(rows.size()); ++i)
    for (int j = below.start[i]; j < below.start[i + 1]; ++j) {
      rows[i].push_back(below.item[j]);
      rows[below.item[j]].push_back(i);
    }
  return compressed(rows);
}

namespace {

std::vector<int> ranks(const std::vector<int>& order) {
  std::vector<int> rank(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = static_cast<int>(k);
  return rank;
}

std::vector<int> minimum_degree_order(const Adjacency& graph) {
  const int nodes = static_cast<int>(graph.start.size()) - 1;
  std::vector<int> order(nodes);
  if (amd_order(nodes, graph.start.data(), graph.item.data(), order.data(), nullptr, nullptr) < 0)
    throw Error::system("the linear system is too large to be factorised: linear-solver = multigrid");
  return order;
}

// Returns for each column of the factor the row of its first entry below the diagonal, -1 if there is none
// (Liu 1990, 4).
std::vector<int> elimination_tree(const Adjacency& graph, const std::vector<int>& order) {
  const std::vector<int> rank = ranks(order);
  std::vector<int> parent(order.size(), -1), ancestor(order.size(), -1);
  for (int k = 0; k < static_cast<int>(order.size()); ++k)
    for (int j = graph.start[order[k]]; j < graph.start[order[k] + 1]; ++j)
      for (int i = rank[graph.item[j]]; i >= 0 && i < k;) {
        const int next = ancestor[i];
        ancestor[i] = k;
        if (next < 0) parent[i] = k;
        i = next;
      }
  return parent;
}

// Reorders the elimination equivalently, with every subtree's nodes in sequence.
std::vector<int> in_postorder(const std::vector<int>& order, const std::vector<int>& parent) {
  const int n = static_cast<int>(order.size());
  std::vector<int> size(n, 1), next(n);  // of subtrees; the start of the next child's subtree
  for (int k = 0; k < n; ++k)
    if (parent[k] >= 0) size[parent[k]] += size[k];
  std::vector<int> start(n), result(n);
  int roots = 0;
  for (int k = n - 1; k >= 0; --k) {  // parents first
    int& free = parent[k] < 0 ? roots : next[parent[k]];
    next[k] = start[k] = free;
    free += size[k];
    result[start[k] + size[k] - 1] = order[k];
  }
  return result;
}

// Returns the rows of each column of the factor below its diagonal.
std::vector<std::vector<int>> factor_columns(const Adjacency& graph, const std::vector<int>& order) {
  const std::vector<int> rank = ranks(order), parent = elimination_tree(graph, order);
  std::vector<std::vector<int>> column(order.size());
  for (int k = 0; k < static_cast<int>(order.size()); ++k) {
    std::vector<int>& rows = column[k];  // the children's rows are there already
    for (int j = graph.start[order[k]]; j < graph.start[order[k] + 1]; ++j)
      rows.push_back(rank[graph.item[j]]);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows.erase(rows.begin(), std::upper_bound(rows.begin(), rows.end(), k));
    if (parent[k] >= 0) column[parent[k]].insert(column[parent[k]].end(), rows.begin(), rows.end());
  }
  return column;
}

struct ColumnRange {
  int first, count;
  double zeros;  // explicit zeros, in blocks
};

// Is this share of zeros acceptable in fronts of so many columns? Small fronts are not worth their overhead.
bool is_fill_acceptable(int columns, double zeros) {
  return zeros == 0 || zeros < (columns <= 4 ? 0.6 : columns <= 12 ? 0.3 : 0.08);
}

// Joins a column with the ranges right before it whose parent it is.
std::vector<ColumnRange> join_columns(const std::vector<std::vector<int>>& column) {
  std::vector<ColumnRange> range;
  for (int k = 0; k < static_cast<int>(column.size()); ++k) {
    ColumnRange joined{k, 1, 0};
    const double beyond = static_cast<double>(column[k].size());
    while (!range.empty()) {
      const ColumnRange& last = range.back();
      const std::vector<int>& rows = column[last.first + last.count - 1];
      if (rows.empty() || rows[0] != joined.first) break;
      const int count = last.count + joined.count;
      const double added = last.count * (joined.count + beyond - static_cast<double>(rows.size())),
                   zeros = last.zeros + joined.zeros + added;
      if (!is_fill_acceptable(count, zeros / (count * (count + beyond)))) break;
      joined = {last.first, count, zeros};
      range.pop_back();
    }
    range.push_back(joined);
  }
  return range;
}

void add_front(const ColumnRange& range, const std::vector<int>& beyond, SymbolicFactorization& plan) {
  Front front{};
  front.first = range.first;
  front.pivots = range.count;
  front.rows = range.count + static_cast<int>(beyond.size());
  front.row_start = static_cast<int>(plan.row.size());
  front.panel = plan.entries;
  for (int k = 0; k < range.count; ++k) plan.row.push_back(range.first + k);
  plan.row.insert(plan.row.end(), beyond.begin(), beyond.end());
  plan.entries += 9 * static_cast<std::size_t>(front.rows) * front.pivots;
  for (int k = 0; k < 3 * front.pivots; ++k) {
    const double rows = 3 * front.rows - k;
    plan.multiplications += rows * (rows + 1) / 2;
  }
  plan.front.push_back(front);
}

// Finds the rows of their parents that the fronts update.
void link_fronts(SymbolicFactorization& plan) {
  std::vector<int> owner(plan.order.size()), at(plan.order.size());
  for (std::size_t f = 0; f < plan.front.size(); ++f)
    for (int k = 0; k < plan.front[f].pivots; ++k) owner[plan.front[f].first + k] = static_cast<int>(f);
  for (Front& front : plan.front) {
    front.parent_row_start = static_cast<int>(plan.parent_row.size());
    front.parent = -1;
    if (front.updated() == 0) continue;
    front.parent = owner[plan.row[front.row_start + front.pivots]];
    Front& parent = plan.front[front.parent];
    ++parent.children;
    for (int r = 0; r < parent.rows; ++r) at[plan.row[parent.row_start + r]] = r;
    for (int r = front.pivots; r < front.rows; ++r)
      plan.parent_row.push_back(at[plan.row[front.row_start + r]]);
  }
}

void place_blocks(const Adjacency& graph, const SparsityPattern& below, SymbolicFactorization& plan) {
  const std::vector<int> rank = ranks(plan.order);
  std::vector<int> at(plan.order.size());
  for (Front& front : plan.front) {
    front.block_start = static_cast<int>(plan.block.size());
    for (int r = 0; r < front.rows; ++r) at[plan.row[front.row_start + r]] = r;
    for (int k = 0; k < front.pivots; ++k) {
      const int node = plan.order[front.first + k];
      plan.block.push_back({-1, k, k, false});
      for (int j = graph.start[node]; j < graph.start[node + 1]; ++j) {
        const auto [lower, higher] = std::minmax(node, graph.item[j]);
        const int other = rank[graph.item[j]], slot = slot_in_row(below, higher, lower);
        if (other > front.first + k) plan.block.push_back({slot, at[other], k, lower != node});
      }
    }
    front.block_end = static_cast<int>(plan.block.size());
  }
}

// Returns how many numbers an update takes.
std::size_t update_size(const Front& front) {
  const std::size_t rows = 3 * static_cast<std::size_t>(front.updated());
  return rows * rows;
}

// Returns the highest stack: an update is made above those of the children and then takes their place.
std::size_t highest_stack(const std::vector<Front>& fronts) {
  std::vector<std::size_t> waiting;
  std::size_t height = 0, highest = 0;
  for (const Front& front : fronts) {
    highest = std::max(highest, height + update_size(front));
    for (int k = 0; k < front.children; ++k) {
      height -= waiting.back();
      waiting.pop_back();
    }
    if (front.updated() == 0) continue;
    waiting.push_back(update_size(front));
    height += waiting.back();
  }
  return highest;
}

}  // namespace

SymbolicFactorization plan_elimination(const SparsityPattern& couplings) {
  const Adjacency graph = both_ways(couplings);
  SymbolicFactorization plan;
  plan.order = minimum_degree_order(graph);
  plan.order = in_postorder(plan.order, elimination_tree(graph, plan.order));
  const std::vector<std::vector<int>> column = factor_columns(graph, plan.order);
  for (const ColumnRange& range : join_columns(column))
    add_front(range, column[range.first + range.count - 1], plan);
  link_fronts(plan);
  place_blocks(graph, couplings, plan);
  plan.stack = highest_stack(plan.front);
  return plan;
}

SymbolicFactorization plan_elimination(const SparsityPattern& couplings, std::vector<int> order,
                                       const std::vector<int>& columns) {
  const Adjacency graph = both_ways(couplings);
  const std::vector<int> rank = ranks(order);
  std::vector<int> owner;
  for (std::size_t f = 0; f < columns.size(); ++f)
    owner.resize(owner.size() + columns[f], static_cast<int>(f));
  std::vector<std::vector<int>> beyond(columns.size());  // the children's rows are there already
  SymbolicFactorization plan;
  plan.order = std::move(order);
  int first = 0;
  for (std::size_t f = 0; f < columns.size(); first += columns[f++]) {
    const int end = first + columns[f];
    std::vector<int>& rows = beyond[f];
    for (int k = first; k < end; ++k)
      for (int j = graph.start[plan.order[k]]; j < graph.start[plan.order[k] + 1]; ++j)
        rows.push_back(rank[graph.item[j]]);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rows.erase(rows.begin(), std::lower_bound(rows.begin(), rows.end(), end));
    add_front({first, columns[f], 0}, rows, plan);
    if (rows.empty()) continue;
    std::vector<int>& parent = beyond[owner[rows[0]]];
    parent.insert(parent.end(), rows.begin(), rows.end());
  }
  link_fronts(plan);
  return plan;
}

}  // namespace hysteron
