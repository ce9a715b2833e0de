// Closest points, collision detection, barrier and the list of pairs are compared with slower or simpler
// answers.
#include "sim/contact/self_pairs.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "sim/contact/additive_ccd.h"
#include "sim/contact/barrier.h"

namespace hysteron {
namespace {

using Vector = Eigen::Vector3d;

Vector random_vector(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  const double x = number(random), y = number(random), z = number(random);
  return {x, y, z};
}

// Returns the least distance over a grid of points of both figures.
double sampled_distance(const Vector (&x)[4], bool edges, int parts) {
  double least = 1e30;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; j <= parts; ++j) {
      const double s = double(i) / parts, t = double(j) / parts;
      if (!edges && s + t > 1) continue;
      const Vector apart = edges ? Vector(x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2]))
                                 : Vector(x[0] - x[1] - s * (x[2] - x[1]) - t * (x[3] - x[1]));
      least = std::min(least, apart.norm());
    }
  return least;
}

class Figures : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Figures, testing::Values(false, true),
                         [](const auto& kind) { return kind.param ? "Edges" : "PointAndTriangle"; });

TEST_P(Figures, ClosestPointsAreThoseOfAFineSearch) {
  std::mt19937 random(1);
  for (int k = 0; k < 200; ++k) {
    Vector x[4];
    for (Vector& v : x) v = random_vector(random);
    const ClosestPoints<double> closest = GetParam() ? edge_edge(x) : point_triangle(x);
    const double sampled = sampled_distance(x, GetParam(), 200);
    EXPECT_LE(closest.offset.norm(), sampled + 1e-12);
    EXPECT_GE(closest.offset.norm(), sampled - 0.02);
    Vector offset = Vector::Zero();
    for (int i = 0; i < 4; ++i) offset += closest.weight[i] * x[i];
    EXPECT_LT((offset - closest.offset).norm(), 1e-12);
    EXPECT_NEAR(closest.weight.sum(), 0, 1e-12);
  }
}

// Collision detection stops short of contact, and not much earlier than it has to.
TEST_P(Figures, FeasibleStepsEndBeforeContact) {
  std::mt19937 random(2);
  constexpr double kMin = 0.05;
  int stopped = 0;
  for (int k = 0; k < 2000; ++k) {
    Vector x[4], direction[4];
    for (Vector& v : x) v = random_vector(random);
    for (Vector& v : direction) v = random_vector(random);
    if (pair_distance(x, GetParam()) < 2 * kMin) continue;
    Vector from[4], along[4];
    std::copy(x, x + 4, from);
    std::copy(direction, direction + 4, along);
    const double step_length =
        feasible_step(approach(from, along, GetParam()), from, along, GetParam(), kMin);
    const auto at = [&](double s) {
      Vector y[4];
      for (int i = 0; i < 4; ++i) y[i] = x[i] + s * direction[i];
      return pair_distance(y, GetParam());
    };
    for (int i = 0; i <= 100; ++i) EXPECT_GT(at(step_length * i / 100), kMin) << k;
    if (step_length == 1) continue;
    ++stopped;
    EXPECT_LT(at(step_length), kMin + 0.11 * (pair_distance(x, GetParam()) - kMin)) << k;
  }
  EXPECT_GT(stopped, 50);
}

TEST(Barrier, HasItsDerivatives) {
  constexpr double kRange = 2e-4, kStiff = 3e7, kTiny = 1e-9;
  for (double u : {0.05, 0.3, 0.6, 0.9, 0.99}) {
    const double gap = u * kRange;
    const auto low = barrier(kStiff, gap - kTiny, kRange), high = barrier(kStiff, gap + kTiny, kRange);
    const auto at = barrier(kStiff, gap, kRange);
    EXPECT_NEAR((high.energy - low.energy) / (2 * kTiny) / at.slope, 1, 1e-4) << u;
    EXPECT_NEAR((high.slope - low.slope) / (2 * kTiny) / at.stiffness, 1, 1e-4) << u;
    EXPECT_LT(at.slope, 0);
    EXPECT_GT(at.stiffness, 0);
  }
  EXPECT_EQ(barrier(kStiff, kRange, kRange).slope, 0);
}

TEST(ParallelEdges, FadeSmoothly) {
  for (double c : {0.1, 0.5, 0.9}) {
    const double tiny = 1e-6;
    EXPECT_NEAR((parallel_fade(c + tiny, 1.0).factor - parallel_fade(c - tiny, 1.0).factor) / (2 * tiny),
                parallel_fade(c, 1.0).slope, 1e-8);
  }
  EXPECT_EQ(parallel_fade(0.0, 1.0).factor, 0);
  EXPECT_EQ(parallel_fade(1.0, 1.0).factor, 1);
  EXPECT_EQ(parallel_fade(1.0, 1.0).slope, 0);
}

// A crumpled cloth that moves: every pair that is ever nearer than its activation distance is in the list.
TEST(SelfPairs, MissNoneThatComesNear) {
  ClothMesh mesh = make_rectangle(0.1, 0.1, 300, MeshFamily::random, 1);
  build_topology(mesh, "test");
  constexpr double kThickness = 2e-3, kReach = 1e-3;
  std::mt19937 random(3);
  std::vector<Vector> x, direction;
  for (const Vector& r : mesh.rest) {
    x.push_back(
        {0.02 * std::sin(70 * r.x()), 0.03 * std::sin(50 * r.y() + 20 * r.x()), 0.02 * std::cos(60 * r.x())});
    direction.push_back(Vector(0.3, 0.1, 0) + 2e-3 * random_vector(random));
  }
  const std::vector<char> held(mesh.vertices());
  Cpu cpu(1);
  SelfPairs<double, Cpu> pairs(cpu, mesh, kThickness);
  pairs.find(x.data(), direction.data(), 1, held.data(), kReach);
  std::set<std::tuple<bool, std::array<int, 4>>> listed;
  for (int p = 0; p < pairs.count(); ++p) {
    const SelfPair<double>& pair = pairs.pairs()[p];
    std::array<int, 4> v{pair.v[0], pair.v[1], pair.v[2], pair.v[3]};
    if (pair.is_edges()) {
      if (v[0] > v[1]) std::swap(v[0], v[1]);
      if (v[2] > v[3]) std::swap(v[2], v[3]);
      if (v[0] > v[2] || (v[0] == v[2] && v[1] > v[3])) v = {v[2], v[3], v[0], v[1]};
    } else {
      std::sort(v.begin() + 1, v.end());
    }
    EXPECT_TRUE(listed.insert({pair.is_edges(), v}).second) << "twice";
  }
  int near = 0;
  const auto check = [&](std::array<int, 4> v, bool edges) {
    Vector at_rest[4];
    for (int i = 0; i < 4; ++i) at_rest[i] = mesh.rest[v[i]];
    const double activation_distance = std::min(kThickness, pair_distance(at_rest, edges) / 2);
    bool comes_near = false;
    for (int step = 0; step <= 8; ++step) {
      Vector y[4];
      for (int i = 0; i < 4; ++i) y[i] = x[v[i]] + step / 8.0 * direction[v[i]];
      comes_near |= pair_distance(y, edges) < activation_distance;
    }
    if (!comes_near) return;
    ++near;
    EXPECT_TRUE(listed.count({edges, v}));
  };
  for (int vertex = 0; vertex < mesh.vertices(); ++vertex)
    for (const auto& f : mesh.face) {
      std::array<int, 4> v{vertex, f[0], f[1], f[2]};
      std::sort(v.begin() + 1, v.end());
      if (vertex != f[0] && vertex != f[1] && vertex != f[2]) check(v, false);
    }
  for (const Edge& a : mesh.edge)
    for (const Edge& b : mesh.edge) {
      const std::array<int, 4> v{std::min(a.p2, a.p3), std::max(a.p2, a.p3), std::min(b.p2, b.p3),
                                 std::max(b.p2, b.p3)};
      const bool apart = v[0] != v[2] && v[0] != v[3] && v[1] != v[2] && v[1] != v[3];
      if (apart && v[0] < v[2]) check(v, true);
    }
  EXPECT_GT(near, 100);
  EXPECT_LT(pairs.count(), 100 * mesh.vertices());
}

}  // namespace
}  // namespace hysteron
