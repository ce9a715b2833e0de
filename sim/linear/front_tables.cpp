#include "sim/linear/front_tables.h"

#include <algorithm>

#include "sim/linear/compressed_rows.h"

namespace hysteron {

namespace {

// Returns the first row of numbers of the node that is the front's `row`-th.
int first_number(const TiledFront& tiles, const Front& front, int row) {
  return row < front.pivots ? 3 * row : tiles.pivot_rows() + 3 * (row - front.pivots);
}

class TableMaker {
 public:
  TableMaker(const TiledPlan& plan, const Adjacency& pattern) : plan_(plan), pattern_(pattern) {
    tables_.source.resize(plan.sources, -1);
  }

  FrontTables run() {
    list_columns();
    list_levels();
    list_blocks();
    for (std::size_t l = 0; l < plan_.level.size(); ++l) {
      list_rows_above(static_cast<int>(l));
      list_solved_rows(static_cast<int>(l));
    }
    return std::move(tables_);
  }

 private:
  const Front& front(int f) const { return plan_.elimination.front[f]; }
  int vertex(const Front& front, int row) const {
    return plan_.elimination.order[plan_.elimination.row[front.row_start + row]];
  }

  void list_columns() {
    for (std::size_t f = 0; f < plan_.front.size(); ++f) {
      const TiledFront& tiles = plan_.front[f];
      const Front& of = front(static_cast<int>(f));
      int* source = tables_.source.data() + tiles.source;
      for (int row = 0; row < of.rows; ++row)
        for (int c = 0; c < 3; ++c) source[first_number(tiles, of, row) + c] = 3 * vertex(of, row) + c;
      for (int j = 0; j < tiles.stride(); ++j)
        if (source[j] < 0)
          tables_.ones.push_back(tiles.number + static_cast<std::size_t>(j) * (tiles.stride() + 1));
    }
  }

  void list_levels() {
    std::vector<std::vector<int>> children(plan_.front.size());
    for (std::size_t f = 0; f < plan_.front.size(); ++f)
      if (const int parent = front(static_cast<int>(f)).parent; parent >= 0)
        children[parent].push_back(static_cast<int>(f));
    for (const std::vector<int>& level : plan_.level) {
      tables_.front.emplace_back();
      for (const int f : level) {
        const TiledFront& tiles = plan_.front[f];
        const int first = static_cast<int>(tables_.child.size());
        for (const int child : children[f]) add_child(f, child);
        tables_.front.back().push_back({tiles.number, tiles.stride(), tiles.pivot_rows(), tiles.source, first,
                                        static_cast<int>(tables_.child.size())});
      }
    }
  }

  void add_child(int f, int child) {
    const TiledFront& tiles = plan_.front[child];
    const int start = static_cast<int>(tables_.child_row.size());
    tables_.child.push_back({tiles.number, tiles.stride(), start});
    tables_.child_row.resize(start + plan_.front[f].stride(), -1);
    const int* parent_row = plan_.elimination.parent_row.data() + front(child).parent_row_start;
    for (int k = 0; k < front(child).updated(); ++k)
      for (int c = 0; c < 3; ++c)
        tables_.child_row[start + first_number(plan_.front[f], front(f), parent_row[k]) + c] =
            tiles.pivot_rows() + 3 * k + c;
  }

  void list_blocks() {
    const FrontPlaces places(plan_);
    const FrontFinder finder = places.finder();
    for (int i = 0; i + 1 < static_cast<int>(pattern_.start.size()); ++i) {
      tables_.block.push_back(finder.find(i, i));
      for (int j = pattern_.start[i]; j < pattern_.start[i + 1]; ++j) {
        if (pattern_.item[j] > i) continue;
        FrontBlock block = finder.find(i, pattern_.item[j]);
        block.slot = slot_in_row(pattern_, block.row, block.column);
        tables_.block.push_back(block);
      }
    }
  }

  // Lists from the first level every unknown of the fronts above, so that all are carried along.
  void list_rows_above(int level) {
    std::vector<std::vector<FrontTerm>> terms(3 * plan_.elimination.order.size());
    for (const int f : plan_.level[level]) {
      const TiledFront& tiles = plan_.front[f];
      for (int row = front(f).pivots; row < front(f).rows; ++row)
        for (int c = 0; c < 3; ++c) {
          const std::size_t at = first_number(tiles, front(f), row) + c;
          terms[3 * vertex(front(f), row) + c].push_back(
              {tiles.number + at * tiles.stride(), tiles.source, 3 * front(f).pivots});
        }
    }
    std::vector<RowAbove>& rows = tables_.above.emplace_back();
    for (std::size_t l = level + 1; l < plan_.level.size(); ++l)
      for (const int f : plan_.level[l])
        for (int k = 0; k < 3 * front(f).pivots; ++k) {
          const int unknown = 3 * vertex(front(f), k / 3) + k % 3;
          const int first = static_cast<int>(tables_.term.size());
          tables_.term.insert(tables_.term.end(), terms[unknown].begin(), terms[unknown].end());
          const int end = static_cast<int>(tables_.term.size());
          if (level == 0 || end > first) rows.push_back({unknown, first, end});
        }
  }

  // Lists the rows that a level solves; the first level has those of all unknowns.
  void list_solved_rows(int level) {
    std::vector<SolvedRow>& rows = tables_.solved.emplace_back();
    for (const int f : plan_.level[level]) {
      const TiledFront& tiles = plan_.front[f];
      for (int k = 0; k < 3 * front(f).pivots; ++k) {
        const std::size_t at = tiles.number + static_cast<std::size_t>(k) * tiles.stride();
        rows.push_back(
            {3 * vertex(front(f), k / 3) + k % 3,
             {at, tiles.source, 3 * front(f).pivots},
             {at + tiles.pivot_rows(), tiles.source + tiles.pivot_rows(), 3 * front(f).updated()}});
      }
    }
    for (std::size_t l = 1; level == 0 && l < plan_.level.size(); ++l)
      for (const int f : plan_.level[l])
        for (int k = 0; k < 3 * front(f).pivots; ++k)
          rows.push_back({3 * vertex(front(f), k / 3) + k % 3, {}, {}});
  }

  const TiledPlan& plan_;
  const Adjacency& pattern_;
  FrontTables tables_;
};

}  // namespace

FrontPlaces::FrontPlaces(const TiledPlan& plan)
    : rank(plan.elimination.order.size()), owner(rank.size()), row(plan.elimination.row) {
  const SymbolicFactorization& of = plan.elimination;
  for (std::size_t k = 0; k < of.order.size(); ++k) rank[of.order[k]] = static_cast<int>(k);
  for (std::size_t f = 0; f < of.front.size(); ++f) {
    const Front& nodes = of.front[f];
    const TiledFront& tiles = plan.front[f];
    for (int k = 0; k < nodes.pivots; ++k) owner[of.order[nodes.first + k]] = static_cast<int>(f);
    front.push_back({nodes.first, nodes.pivots, nodes.rows, nodes.row_start, tiles.number, tiles.stride(),
                     tiles.pivot_rows()});
  }
}

FrontTables make_front_tables(const TiledPlan& plan, const Adjacency& pattern) {
  return TableMaker(plan, pattern).run();
}

}  // namespace hysteron
