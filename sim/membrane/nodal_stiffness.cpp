#include "sim/membrane/nodal_stiffness.h"

namespace hysteron {

namespace {

// Lists for each block the pairs of items of the same ring that add to it, in the order of the nodes.
template <class Real, class Device>
void pairs_of_blocks(const Adjacency& ring, const BlockRows<Real, Device>& rows, std::vector<int>& start,
                     std::vector<Eigen::Vector2i>& pair) {
  const int off_diagonal = static_cast<int>(rows.col().size());
  const auto each = [&](auto&& visit) {
    for (std::size_t n = 0; n + 1 < ring.start.size(); ++n)
      for (int a = ring.start[n]; a < ring.start[n + 1]; ++a)
        for (int b = ring.start[n]; b < ring.start[n + 1]; ++b)
          visit(a == b ? off_diagonal + ring.item[a] : rows.slot(ring.item[a], ring.item[b]),
                Eigen::Vector2i(a, b));
  };
  start.assign(off_diagonal + rows.row_ptr().size(), 0);
  each([&](int block, const Eigen::Vector2i&) { ++start[block + 1]; });
  for (std::size_t b = 1; b < start.size(); ++b) start[b] += start[b - 1];
  pair.resize(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  each([&](int block, const Eigen::Vector2i& items) { pair[next[block]++] = items; });
}

std::vector<int> node_of_items(const Adjacency& ring) {
  std::vector<int> node;
  for (std::size_t n = 0; n + 1 < ring.start.size(); ++n) node.resize(ring.start[n + 1], static_cast<int>(n));
  return node;
}

}  // namespace

template <class Real, class Device>
NodalStiffness<Real, Device>::NodalStiffness(Device& device, const MembraneNodes& nodes,
                                             const BlockRows<Real, Device>& rows)
    : device_(device),
      node_(device, node_of_items(nodes.ring)),
      corner_start_(device, nodes.corners.start),
      corner_(device, nodes.corners.item),
      rate_(device, nodes.ring.item.size()) {
  std::vector<int> start;
  std::vector<Eigen::Vector2i> pair;
  pairs_of_blocks(nodes.ring, rows, start, pair);
  pair_start_ = Buffer<int, Device>(device, start);
  pair_ = Buffer<Eigen::Vector2i, Device>(device, pair);
}

template <class Real, class Device>
void NodalStiffness<Real, Device>::find_rates(const NodeStrains<Real>& strains) {
  const NodeStrains<Real> of = strains;
  const int *node = node_.data(), *start = corner_start_.data(), *corner = corner_.data();
  NodeRates<Real>* rate = rate_.data();
  for_each(
      device_, {"nodal rates", total_bytes(node_, corner_start_, corner_, rate_)},
      static_cast<int>(node_.size()), HYST_KERNEL(int p) {
        NodeRates<Real> sum{Vec3<Real>::Zero(), Vec3<Real>::Zero()};
        const Real fraction = 1 / (3 * of.area(node[p]));
        for (int j = start[p]; j < start[p + 1]; ++j) {
          const int face = corner[j] / 3, k = corner[j] % 3;
          const MembraneRest<Real>& rest = of.faces.rest[face];
          const Deformation<Real>& d = of.faces.deformed[face];
          sum.warp += fraction * rest.area * rest.b1[k] * d.f1;
          sum.weft += fraction * rest.area * rest.b2[k] * d.f2;
        }
        rate[p] = sum;
      });
}

template <class Real, class Device>
void NodalStiffness<Real, Device>::add(const MembraneSites<NodeStrains<Real>, Device>& nodes, Real factor,
                                       Real of_stops, BlockRowsView<Real> matrix) {
  find_rates(nodes.strains());
  const Real* area = nodes.strains().size;
  const MembraneStiffness<Real>& elastic = nodes.stiffness();
  const Vec3<Real>* tangents = nodes.friction_tangents();
  const MembraneStiffness<Real> c{factor * elastic.warp, factor * elastic.weft, factor * elastic.coupling, 0};
  const int *node = node_.data(), *start = pair_start_.data();
  const Eigen::Vector2i* pair = pair_.data();
  const NodeRates<Real>* rate = rate_.data();
  const int blocks = static_cast<int>(pair_start_.size()) - 1, off_diagonal = blocks - matrix.rows;
  // Three threads share a block, a column each.
  for_each(
      device_,
      {"nodal matrix", 2 * blocks * sizeof(Mat3<Real>) + total_bytes(node_, pair_start_, pair_, rate_)},
      3 * blocks, HYST_KERNEL(int e) {
        const int b = e / 3, col = e % 3;
        Vec3<Real> column = Vec3<Real>::Zero();
        for (int t = start[b]; t < start[b + 1]; ++t) {
          const NodeRates<Real>&row = rate[pair[t][0]], &other = rate[pair[t][1]];
          const int n = node[pair[t][0]];
          Real warp = c.warp, weft = c.weft;
          if (tangents) {
            warp += of_stops * tangents[n][0];
            weft += of_stops * tangents[n][1];
          }
          const Real p = other.warp[col], q = other.weft[col];
          column +=
              area[n] * ((warp * p + c.coupling * q) * row.warp + (c.coupling * p + weft * q) * row.weft);
        }
        Mat3<Real>& block = b < off_diagonal ? matrix.off_diagonal[b] : matrix.diagonal[b - off_diagonal];
        block.col(col) += column;
      });
}

template class NodalStiffness<double, ThisDevice>;
template class NodalStiffness<float, ThisDevice>;

}  // namespace hysteron
