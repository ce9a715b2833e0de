// Nested dissections: what they divide, and where the matrix's blocks go.
#include "sim/linear/dissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "sim/linear/compressed_rows.h"
#include "sim/linear/front_tables.h"
#include "sim/mesh/builders.h"

namespace hysteron {
namespace {

// A strip so many squares wide and long, in which vertices see those of a neighbour's triangles, too, as
// bending's elements make them.
Adjacency strip(int wide, int length) {
  const ClothMesh mesh = make_rectangle(length, wide, 2 * wide * length, MeshFamily::aligned, 1);
  const Adjacency near = neighbours_in(mesh);
  std::vector<std::vector<int>> rows(mesh.vertices());
  for (int i = 0; i < mesh.vertices(); ++i)
    for (int j = near.start[i]; j < near.start[i + 1]; ++j)
      for (int k = near.start[near.item[j]]; k < near.start[near.item[j] + 1]; ++k)
        if (near.item[k] != i) rows[i].push_back(near.item[k]);
  return compressed(rows);
}

SparsityPattern couplings_of(const Adjacency& graph) { return CouplingList(graph).take(); }

TEST(Dissection, EliminatesEveryNodeOnce) {
  const Adjacency graph = strip(6, 60);
  for (int depth = 0; depth < 5; ++depth) {
    Dissection cut = dissect(graph, {depth, depth});
    EXPECT_EQ(std::accumulate(cut.columns.begin(), cut.columns.end(), 0), static_cast<int>(cut.order.size()));
    std::sort(cut.order.begin(), cut.order.end());
    std::vector<int> all(graph.start.size() - 1);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(cut.order, all) << depth;
  }
}

// Fronts that a level eliminates side by side must not meet: a front has all that its nodes see later.
TEST(Dissection, HasNoCouplingBetweenFrontsOfOneLevelAndAPlaceForEveryOther) {
  const Adjacency graph = strip(6, 60);
  for (const auto& [depth, joined] : {std::array{3, 3}, std::array{3, 1}, std::array{4, 2}}) {
    const TiledPlan plan = plan_dissection(couplings_of(graph), {depth, joined});
    EXPECT_EQ(static_cast<int>(plan.level.size()), depth - joined + 2);
    std::vector<int> owner(graph.start.size() - 1);
    const SymbolicFactorization& of = plan.elimination;
    for (std::size_t f = 0; f < of.front.size(); ++f)
      for (int k = 0; k < of.front[f].pivots; ++k)
        owner[of.order[of.front[f].first + k]] = static_cast<int>(f);
    const FrontPlaces places(plan);
    for (int i = 0; i + 1 < static_cast<int>(graph.start.size()); ++i)
      for (int j = graph.start[i]; j < graph.start[i + 1]; ++j) {
        const int other = graph.item[j];
        EXPECT_NE(places.finder().find(i, other).number, FrontFinder::kNowhere);
        if (owner[i] != owner[other]) {
          EXPECT_NE(plan.front[owner[i]].level, plan.front[owner[other]].level);
        }
      }
  }
}

// Separators are two columns of a strip whose vertices see two columns far, and the parts are even.
TEST(Dissection, CutsAStripAcross) {
  constexpr int kWide = 6, kLength = 60;
  const Dissection cut = dissect(strip(kWide, kLength), {1, 1});
  ASSERT_EQ(cut.columns.size(), 3u);
  EXPECT_LE(cut.columns[2], 3 * (kWide + 1));
  EXPECT_LE(std::max(cut.columns[0], cut.columns[1]), 0.6 * (kWide + 1) * (kLength + 1));
}

TEST(Dissection, OfPartsThatDoNotSeeOneAnotherNeedsNoSeparator) {
  Adjacency pieces{{0}, {}};  // two chains
  for (int i = 0; i < 20; ++i) {
    if (i % 10 > 0) pieces.item.push_back(i - 1);
    if (i % 10 < 9) pieces.item.push_back(i + 1);
    pieces.start.push_back(static_cast<int>(pieces.item.size()));
  }
  EXPECT_EQ(dissect(pieces, {1, 1}).columns, std::vector<int>({10, 10}));
}

// It divides once more, and has hardly more tiles in sequence.
TEST(Dissection, OfAStripCostsFarLessThanTwiceThatOfHalfItsLength) {
  const auto renewal = [](const Adjacency& graph) {
    const SparsityPattern couplings = couplings_of(graph);
    return plan_dissection(couplings, choose_shape(couplings)).cost.renewal;
  };
  const double once = renewal(strip(6, 120)), twice = renewal(strip(6, 240));
  EXPECT_LT(twice, 1.6 * once);
}

}  // namespace
}  // namespace hysteron
