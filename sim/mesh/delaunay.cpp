#include "sim/mesh/delaunay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace hysteron {
namespace {

// 28 bits keep the in-circle determinant (degree 4 in differences of 29 bits) within 128.
constexpr double kSteps = 1 << 28;
__extension__ using Wide = __int128;

struct GridPoint {
  std::int64_t x, y;
};

std::vector<GridPoint> snap(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d lo = points.front(), hi = lo;
  for (const auto& p : points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const double scale = kSteps / (hi - lo).maxCoeff();
  std::vector<GridPoint> snapped;
  snapped.reserve(points.size());
  for (const auto& p : points)
    snapped.push_back({std::llround((p.x() - lo.x()) * scale), std::llround((p.y() - lo.y()) * scale)});
  return snapped;
}

// Sweeps the points from left to right: each one is joined to the hull edges that it sees, and edges are
// flipped until all are locally Delaunay (Lawson 1977).  Half-edges: side h runs from vertex[h] to
// vertex[next(h)], twin[h] is the same side in the neighbour or -1.
class Sweep {
 public:
  explicit Sweep(const std::vector<Eigen::Vector2d>& points)
      : point_(snap(points)), after_(points.size(), -1), before_(after_), side_(after_) {}

  std::vector<Eigen::Vector3i> run() {
    std::vector<int> order(point_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      const GridPoint &p = point_[a], &q = point_[b];
      return p.x != q.x ? p.x < q.x : p.y < q.y;
    });
    std::size_t next = start(order);
    for (; next < order.size(); ++next) join(order[next], order[next - 1]);
    std::vector<Eigen::Vector3i> triangles;
    for (std::size_t h = 0; h < vertex_.size(); h += 3)
      triangles.emplace_back(vertex_[h], vertex_[h + 1], vertex_[h + 2]);
    return triangles;
  }

 private:
  static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }

  std::int64_t orientation(int a, int b, int c) const {
    const GridPoint &p = point_[a], &q = point_[b], &r = point_[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }

  // True if d lies strictly inside the circle through the counter-clockwise a, b, c.
  bool in_circle(int a, int b, int c, int d) const {
    const auto relative = [&](int i) {
      return GridPoint{point_[i].x - point_[d].x, point_[i].y - point_[d].y};
    };
    const GridPoint p = relative(a), q = relative(b), r = relative(c);
    const auto square = [](const GridPoint& u) { return Wide(u.x * u.x + u.y * u.y); };
    const auto cross = [](const GridPoint& u, const GridPoint& v) { return Wide(u.x * v.y - u.y * v.x); };
    return square(p) * cross(q, r) + square(q) * cross(r, p) + square(r) * cross(p, q) > 0;
  }

  void link(int h, int twin) {
    twin_[h] = twin;
    if (twin >= 0)
      twin_[twin] = h;
    else
      side_[vertex_[h]] = h;
  }

  int add_triangle(int a, int b, int c) {
    const int h = static_cast<int>(vertex_.size());
    vertex_.insert(vertex_.end(), {a, b, c});
    twin_.insert(twin_.end(), {-1, -1, -1});
    return h;
  }

  void hull_edge(int a, int b) { after_[a] = b, before_[b] = a; }

  // Joins the leading points, which may all be on one line, to the first one off that line.
  std::size_t start(const std::vector<int>& order) {
    std::size_t apex = 2;
    while (orientation(order[0], order[1], order[apex]) == 0) ++apex;
    const int p = order[apex];
    const bool left = orientation(order[0], order[1], p) > 0;
    int last = -1;
    for (std::size_t i = 0; i + 1 < apex; ++i) {
      const int a = order[left ? i : apex - 1 - i], b = order[left ? i + 1 : apex - 2 - i];
      const int h = add_triangle(a, b, p);
      link(h, -1);
      link(h + 2, last);
      link(h + 1, -1);
      last = h + 1;
      if (i == 0) hull_edge(p, a);
      hull_edge(a, b);
      hull_edge(b, p);
    }
    for (int h = 0; h < static_cast<int>(vertex_.size()); ++h) legalize(h);
    return apex + 1;
  }

  // Joins p to the hull; `neighbour`, the point before p in the sweep, is on the hull and sees p.
  void join(int p, int neighbour) {
    int first = neighbour, last = neighbour;
    while (orientation(before_[first], first, p) < 0) first = before_[first];
    while (orientation(last, after_[last], p) < 0) last = after_[last];
    std::vector<int> added;
    int open = -1;
    for (int a = first; a != last; a = after_[a]) {
      const int h = add_triangle(after_[a], a, p);
      link(h, side_[a]);
      link(h + 1, open);
      link(h + 2, -1);
      open = h + 2;
      added.push_back(h);
    }
    hull_edge(first, p);
    hull_edge(p, last);
    for (const int h : added) legalize(h);
  }

  // Flips the edge of h, if its neighbour's tip lies in the circle of its own triangle, and goes on with the
  // four edges around.
  void legalize(int h) {
    std::vector<int> open{h};
    while (!open.empty()) {
      const int a = open.back(), b = twin_[a];
      open.pop_back();
      if (b < 0 || !in_circle(vertex_[a], vertex_[next(a)], vertex_[previous(a)], vertex_[previous(b)]))
        continue;
      flip(a, b);
      open.insert(open.end(), {a, next(a), previous(a), b, next(b), previous(b)});
    }
  }

  //        r                      r          a: p -> q becomes s -> r in the triangle (s, r, p)
  //      / a \                  / | \        b: q -> p becomes r -> s in the triangle (r, s, q)
  //     p --- q      ->        p a|b q
  //      \ b /                  \ | /
  //        s                      s
  void flip(int a, int b) {
    const int p = vertex_[a], q = vertex_[next(a)], r = vertex_[previous(a)], s = vertex_[previous(b)];
    const int qr = twin_[next(a)], rp = twin_[previous(a)], ps = twin_[next(b)], sq = twin_[previous(b)];
    vertex_[a] = s, vertex_[next(a)] = r, vertex_[previous(a)] = p;
    vertex_[b] = r, vertex_[next(b)] = s, vertex_[previous(b)] = q;
    link(a, b);
    link(next(a), rp);
    link(previous(a), ps);
    link(next(b), sq);
    link(previous(b), qr);
  }

  std::vector<GridPoint> point_;
  std::vector<int> vertex_, twin_;
  std::vector<int> after_, before_;  // on the hull, counter-clockwise
  std::vector<int> side_;            // the half-edge of the hull edge that starts at a vertex
};

}  // namespace

std::vector<Eigen::Vector3i> delaunay(const std::vector<Eigen::Vector2d>& points) {
  return Sweep(points).run();
}

}  // namespace hysteron
