#include "sim/linear/dissection.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hysteron {

namespace {

// A cut divides a part of the graph: nodes before and after the separator are not connected.
struct Cut {
  std::vector<int> before, separator, after;
};

class Dissector {
 public:
  Dissector(const Adjacency& graph, const DissectionShape& shape)
      : graph_(graph), shape_(shape), part_(graph.start.size() - 1, 0) {}

  Dissection run() {
    std::vector<int> all(part_.size());
    std::iota(all.begin(), all.end(), 0);
    divide(std::move(all), 0);
    add_front(std::move(root_));
    return std::move(result_);
  }

 private:
  using Levels = std::vector<std::vector<int>>;

  void divide(std::vector<int> nodes, int divisions) {
    Cut cut;
    if (divisions < shape_.depth) cut = cut_in_the_middle(nodes);
    if (cut.before.empty() || cut.after.empty()) return add_front(std::move(nodes));
    divide(std::move(cut.before), divisions + 1);
    divide(std::move(cut.after), divisions + 1);
    if (divisions < shape_.joined)
      root_.insert(root_.end(), cut.separator.begin(), cut.separator.end());
    else
      add_front(std::move(cut.separator));
  }

  void add_front(std::vector<int> nodes) {
    if (nodes.empty()) return;
    std::sort(nodes.begin(), nodes.end());
    result_.order.insert(result_.order.end(), nodes.begin(), nodes.end());
    result_.columns.push_back(static_cast<int>(nodes.size()));
  }

  // Returns the part's nodes by their distance from the first; where none is reachable it goes on from any
  // that is left.
  Levels levels_from(int first, const std::vector<int>& nodes) {
    const int unvisited = mark(nodes), visited = ++marks_;
    Levels levels;
    std::vector<int> next{first};
    part_[first] = visited;
    for (std::size_t left = 0; !next.empty();) {
      levels.push_back(std::move(next));
      next.clear();
      for (const int i : levels.back())
        for (int j = graph_.start[i]; j < graph_.start[i + 1]; ++j) {
          const int other = graph_.item[j];
          if (part_[other] != unvisited) continue;
          part_[other] = visited;
          next.push_back(other);
        }
      while (next.empty() && left < nodes.size()) {
        const int i = nodes[left++];
        if (part_[i] != unvisited) continue;
        part_[i] = visited;
        next.push_back(i);
      }
    }
    return levels;
  }

  // Returns the levels from an end of the part, where they are most (Gibbs, Poole & Stockmeyer 1976).
  Levels longest_levels(const std::vector<int>& nodes) {
    Levels longest = levels_from(nodes[0], nodes);
    for (;;) {
      const auto degree = [&](int i) { return graph_.start[i + 1] - graph_.start[i]; };
      const std::vector<int>& last = longest.back();
      const int end = *std::min_element(last.begin(), last.end(), [&](int a, int b) {
        return degree(a) != degree(b) ? degree(a) < degree(b) : a < b;
      });
      Levels levels = levels_from(end, nodes);
      if (levels.size() <= longest.size()) return levels.size() == longest.size() ? levels : longest;
      longest = std::move(levels);
    }
  }

  Cut cut_in_the_middle(const std::vector<int>& nodes) {
    constexpr double kLargest = 0.6;  // largest share of the nodes
    if (nodes.size() < 3) return {};
    const Levels levels = longest_levels(nodes);
    const int first = marks_ + 1;
    for (const std::vector<int>& level : levels) mark(level);
    const double largest = kLargest * static_cast<double>(nodes.size());
    std::size_t best = levels.size(), middle = levels.size(), least = nodes.size(), before = 0;
    for (std::size_t l = 0; l < levels.size(); before += levels[l++].size()) {
      const std::size_t after = nodes.size() - before - levels[l].size();
      if (middle == levels.size() && before + levels[l].size() > after) middle = l;
      if (static_cast<double>(std::max(before, after)) > largest) continue;
      const std::size_t size = std::count_if(levels[l].begin(), levels[l].end(),
                                             [&](int i) { return sees(i, first + static_cast<int>(l) + 1); });
      if (size >= least) continue;
      least = size;
      best = l;
    }
    return cut_at(levels, best < levels.size() ? best : middle, first);
  }

  // Nodes of the level that are not connected to the next one, whose nodes are all marked from `first` on,
  // need not be in the separator.
  Cut cut_at(const Levels& levels, std::size_t at, int first) const {
    Cut cut;
    for (std::size_t l = 0; l < levels.size(); ++l)
      for (const int i : levels[l])
        (l > at                                                 ? cut.after
         : l == at && sees(i, first + static_cast<int>(at) + 1) ? cut.separator
                                                                : cut.before)
            .push_back(i);
    return cut;
  }

  bool sees(int i, int marked) const {
    for (int j = graph_.start[i]; j < graph_.start[i + 1]; ++j)
      if (part_[graph_.item[j]] == marked) return true;
    return false;
  }
  int mark(const std::vector<int>& nodes) {
    ++marks_;
    for (const int i : nodes) part_[i] = marks_;
    return marks_;
  }

  const Adjacency& graph_;
  DissectionShape shape_;
  int marks_ = 0;
  std::vector<int> part_;  // the last set that marked each node
  std::vector<int> root_;
  Dissection result_;
};

int tiles_for(int nodes) { return (3 * nodes + kTile - 1) / kTile; }

// Estimates the cost: launches wait for one another; tiles of one launch share the processors.
TiledCost cost_of(const TiledPlan& plan) {
  constexpr double kLaunch = 3.5, kLoop = 2, kTiles = 120, kNumbers = 3e5;  // kTiles, kNumbers: each us
  constexpr int kLaunchesBefore = 10;  // these assemble the matrix and fill the fronts
  TiledCost cost{kLaunchesBefore * kLaunch, 0};
  double read = 0;
  for (const std::vector<int>& level : plan.level) {
    int pivots = 0;
    for (const int f : level) {
      const TiledFront& front = plan.front[f];
      const double tiles = front.tiles, own = front.pivot_rows();
      pivots = std::max(pivots, front.pivot_tiles);
      cost.renewal += front.pivot_tiles * tiles * (tiles + 1) / 2 / kTiles;
      read += own * own + 2 * own * (front.stride() - own);
    }
    cost.renewal += (3 + pivots) * kLaunch;
  }
  cost.application = kLoop * (2 * static_cast<double>(plan.level.size()) - 1) + read / kNumbers;
  return cost;
}

TiledPlan tiled(SymbolicFactorization elimination) {
  TiledPlan plan;
  plan.elimination = std::move(elimination);
  const std::vector<Front>& fronts = plan.elimination.front;
  for (const Front& front : fronts) {
    const int pivot_tiles = tiles_for(front.pivots);
    plan.front.push_back({0, pivot_tiles, pivot_tiles + tiles_for(front.updated())});
  }
  for (std::size_t f = 0; f < fronts.size(); ++f) {  // children before parents
    TiledFront& front = plan.front[f];
    plan.level.resize(std::max<std::size_t>(plan.level.size(), front.level + 1));
    plan.level[front.level].push_back(static_cast<int>(f));
    if (fronts[f].parent < 0) continue;
    int& above = plan.front[fronts[f].parent].level;
    above = std::max(above, front.level + 1);
  }
  for (const std::vector<int>& level : plan.level)
    for (const int f : level) {
      TiledFront& front = plan.front[f];
      front.number = plan.numbers;
      front.source = plan.sources;
      plan.numbers += static_cast<std::size_t>(front.stride()) * front.stride();
      plan.sources += front.stride();
    }
  plan.cost = cost_of(plan);
  return plan;
}

}  // namespace

Dissection dissect(const Adjacency& graph, const DissectionShape& shape) {
  return Dissector(graph, shape).run();
}

TiledPlan plan_dissection(const SparsityPattern& couplings, const DissectionShape& shape) {
  Dissection cut = dissect(both_ways(couplings), shape);
  return tiled(plan_elimination(couplings, std::move(cut.order), cut.columns));
}

DissectionShape choose_shape(const SparsityPattern& couplings) {
  constexpr int kMaxDepth = 6;
  constexpr double kApplications = 15;  // per renewal, as Newton's method needs
  DissectionShape best;
  double least = std::numeric_limits<double>::infinity();
  for (int depth = 0; depth <= kMaxDepth; ++depth)
    for (int joined = std::max(0, depth - kMaxFrontLevels + 2); joined <= depth; ++joined) {
      const TiledPlan plan = plan_dissection(couplings, {depth, joined});
      const double cost = plan.cost.renewal + kApplications * plan.cost.application;
      if (plan.level.size() > kMaxFrontLevels || !(cost < least)) continue;
      best = {depth, joined};
      least = cost;
    }
  return best;
}

}  // namespace hysteron
