// Crossing triangles against whole numbers, in which every sign is exact.
#include "sim/mesh/intersections.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>
#include <set>

namespace hysteron {
namespace {

using Whole = Eigen::Matrix<long long, 3, 1>;
using Triangle = std::array<Whole, 3>;

int plane_side(const Whole& a, const Whole& b, const Whole& c, const Whole& d) {
  const long long volume = (b - a).cross(c - a).dot(d - a);
  return (volume > 0) - (volume < 0);
}

// Returns whether a segment and a triangle meet; nothing where the segment lies in the triangle's plane.
std::optional<bool> share_an_end(const Whole& p, const Whole& q, const Triangle& t) {
  const int sp = plane_side(t[0], t[1], t[2], p), sq = plane_side(t[0], t[1], t[2], q);
  if (sp == 0 && sq == 0) return std::nullopt;
  if (sp * sq > 0) return false;
  int low = 1, high = -1;
  for (int k = 0; k < 3; ++k) {
    const int s = plane_side(p, q, t[k], t[(k + 1) % 3]);
    low = std::min(low, s);
    high = std::max(high, s);
  }
  return low >= 0 || high <= 0;
}

struct Soup {
  std::vector<Whole> point;
  std::vector<Eigen::Vector3i> face;

  Triangle triangle(int f) const { return {point[face[f][0]], point[face[f][1]], point[face[f][2]]}; }
  std::vector<int> shared(int f, int g) const {  // corners of f that g has, too
    std::vector<int> corners;
    for (int k = 0; k < 3; ++k)
      if ((face[g].array() == face[f][k]).any()) corners.push_back(k);
    return corners;
  }
  // Returns whether sides of f meet g beyond a common corner; nothing where a coplanar side leaves it open.
  std::optional<bool> sides_meet(int f, int g) const {
    const Triangle t = triangle(f);
    const std::vector<int> common = shared(f, g);
    bool open = false;
    for (int k = 0; k < 3; ++k) {
      if (!common.empty() && common[0] != k) continue;  // the side opposite to the common corner
      const std::optional<bool> met = share_an_end(t[(k + 1) % 3], t[(k + 2) % 3], triangle(g));
      if (met && *met) return true;
      open = open || !met;
    }
    return open ? std::nullopt : std::optional(false);
  }
};

// Points of a small grid, so that many triangles touch; flat: of three layers, as cloth folded twice.
Soup random_soup(std::mt19937& random, bool flat) {
  constexpr int kPoints = 60, kFaces = 120;
  std::uniform_int_distribution<int> place(0, 9), layer(0, 2), any(0, kPoints - 1);
  Soup soup;
  std::set<std::array<int, 3>> taken;
  while (static_cast<int>(soup.point.size()) < kPoints) {
    const std::array<int, 3> at = {place(random), place(random), flat ? layer(random) : place(random)};
    if (taken.insert(at).second) soup.point.push_back({at[0], at[1], at[2]});
  }
  while (static_cast<int>(soup.face.size()) < kFaces) {
    const Eigen::Vector3i f(any(random), any(random), any(random));
    const Whole u = soup.point[f[1]] - soup.point[f[0]], v = soup.point[f[2]] - soup.point[f[0]];
    if (!u.cross(v).isZero()) soup.face.push_back(f);
  }
  return soup;
}

TEST(Intersections, AreThoseOfWholeNumbers) {
  std::mt19937 random(7);
  int crossing = 0, apart = 0;
  for (int round = 0; round < 40; ++round) {
    const Soup soup = random_soup(random, round % 2 == 1);
    std::vector<Eigen::Vector3d> position;
    for (const Whole& p : soup.point) position.push_back(p.cast<double>());
    const auto found = intersecting_triangles(soup.face, position);
    const std::set<std::pair<int, int>> pairs(found.begin(), found.end());
    for (int f = 0; f < static_cast<int>(soup.face.size()); ++f)
      for (int g = f + 1; g < static_cast<int>(soup.face.size()); ++g) {
        if (soup.shared(f, g).size() > 1) continue;
        const std::optional<bool> there = soup.sides_meet(f, g), back = soup.sides_meet(g, f);
        const bool meets = (there && *there) || (back && *back);
        if (!meets && !(there && back)) continue;
        ASSERT_EQ(pairs.count({f, g}), meets ? 1u : 0u) << "round " << round << ", " << f << " and " << g;
        ++(meets ? crossing : apart);
      }
  }
  EXPECT_GT(crossing, 10000);
  EXPECT_GT(apart, 10000);
}

// Each passes through itself as well, which is not asked for.
TEST(Intersections, BetweenTwoSurfacesAreThoseOfBothTogether) {
  std::mt19937 random(5);
  const Soup first = random_soup(random, false), second = random_soup(random, true);
  const auto points = [](const Soup& soup) {
    std::vector<Eigen::Vector3d> position;
    for (const Whole& p : soup.point) position.push_back(p.cast<double>());
    return position;
  };
  std::vector<Eigen::Vector3i> face = first.face;
  std::vector<Eigen::Vector3d> position = points(first);
  const int triangles = static_cast<int>(face.size()), vertices = static_cast<int>(position.size());
  for (const Eigen::Vector3i& f : second.face) face.emplace_back(f.array() + vertices);
  for (const Eigen::Vector3d& x : points(second)) position.push_back(x);
  std::vector<std::pair<int, int>> expected;
  for (const auto& [f, g] : intersecting_triangles(face, position))
    if (f < triangles && g >= triangles) expected.emplace_back(f, g - triangles);
  EXPECT_GT(expected.size(), 100u);
  EXPECT_EQ(crossing_triangles({first.face, points(first)}, {second.face, points(second)}), expected);
}

}  // namespace
}  // namespace hysteron
