// A hierarchy of boxes around the triangles, or the edges, of a cloth.  Its structure is made once, from the
// rest shape: neighbours on the cloth stay near in space, however it folds.  Only the boxes follow the
// motion.
#pragma once

#include <array>
#include <vector>

#include "sim/device/device.h"

namespace hysteron {

template <class Real>
struct Box {
  Vec3<Real> low, high;

  HYST_HD bool overlaps(const Box& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  HYST_HD void include(const Vec3<Real>& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  static HYST_HD Box nothing() {
    constexpr Real kFar = Real(1e30);
    return {Vec3<Real>::Constant(kFar), Vec3<Real>::Constant(-kFar)};
  }
};

// The motion of vertices within a step: from `from` [m] to from + step_length (direction - mean); the mean is
// their common displacement.
template <class Real>
struct Sweep {
  const Vec3<Real>*from, *direction;
  Vec3<Real> mean;
  Real step_length;
  Real margin;  // boxes reach farther by this [m]

  HYST_HD void include(Box<Real>& box, int vertex) const {
    box.include(from[vertex]);
    box.include(from[vertex] + step_length * (direction[vertex] - mean));
  }
  HYST_HD void widen(Box<Real>& box) const {
    box.low.array() -= margin;
    box.high.array() += margin;
  }
};

// A complete binary tree: the children of node i are 2i and 2i + 1, node 1 is the root, the leaf of rank r is
// node leaves + r.  Ranks follow a space-filling curve; those beyond the last have empty boxes.
template <class Real>
struct BoxTreeView {
  int leaves, count;
  const int* item;  // by rank
  const Box<Real>* box;
  const char* has_cloth;  // true for nodes with cloth below

  // Calls visit(rank) for each leaf of rank `from` or more whose box overlaps, or only for those of the
  // cloth.
  template <class Visit>
  HYST_HD void find(const Box<Real>& query, int from, bool cloth_alone, const Visit& visit) const {
    constexpr int kDeepest = 32;
    int stack[kDeepest], level[kDeepest];  // level: leaves below a node
    int top = 0;
    stack[0] = 1;
    level[0] = leaves;
    while (top >= 0) {
      const int node = stack[top], below = level[top];
      --top;
      if ((node + 1) * below - leaves <= from || (cloth_alone && !has_cloth[node]) ||
          !box[node].overlaps(query))
        continue;
      if (below == 1) {
        visit(node - leaves);
        continue;
      }
      for (int child = 1; child >= 0; --child) {  // the left one is visited first
        ++top;
        stack[top] = 2 * node + child;
        level[top] = below / 2;
      }
    }
  }
};

template <class Real, class Device>
class BoxTree {
 public:
  // `corners` of each item are three vertices, or two with the last one repeated; vertices from `cloth` on
  // are bodies'.
  BoxTree(Device& device, const std::vector<std::array<int, 3>>& corners,
          const std::vector<Eigen::Vector3d>& rest, int cloth);

  // Fits boxes around all that the items touch within a sweep.
  void fit(const Sweep<Real>& sweep);
  BoxTreeView<Real> view() const { return {leaves_, count_, item_.data(), box_.data(), has_cloth_.data()}; }
  std::size_t bytes() const { return item_.bytes() + corner_.bytes() + box_.bytes() + has_cloth_.bytes(); }

 private:
  Device& device_;
  int leaves_, count_;
  Buffer<int, Device> item_, corner_;  // by rank; 3 vertices each
  Buffer<Box<Real>, Device> box_;
  Buffer<char, Device> has_cloth_;  // by node
};

}  // namespace hysteron
