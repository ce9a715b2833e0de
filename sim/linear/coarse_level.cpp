#include "sim/linear/coarse_level.h"

namespace hysteron {

namespace {

template <class Real>
std::vector<DeviceInterpolation<Real>> device_form(const std::vector<Interpolation>& finer) {
  std::vector<DeviceInterpolation<Real>> result;
  for (const Interpolation& from : finer) {
    DeviceInterpolation<Real> to;
    for (int k = 0; k < 3; ++k) {
      to.node[k] = from.node[k];
      to.weight[k] = static_cast<Real>(from.weight[k]);
    }
    result.push_back(to);
  }
  return result;
}

// Rows: coarse nodes; items: the finer nodes that see them, ascending.
Adjacency transposed(const RestLevel& level, std::vector<double>& weight) {
  Adjacency rows;
  rows.start.assign(level.nodes + 1, 0);
  const auto each = [&](auto&& visit) {
    for (std::size_t i = 0; i < level.finer.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (level.finer[i].weight[k] > 0)
          visit(static_cast<int>(i), level.finer[i].node[k], level.finer[i].weight[k]);
  };
  each([&](int, int coarse, double) { ++rows.start[coarse + 1]; });
  for (int c = 0; c < level.nodes; ++c) rows.start[c + 1] += rows.start[c];
  rows.item.resize(rows.start.back());
  weight.resize(rows.start.back());
  std::vector<int> next(rows.start.begin(), rows.start.end() - 1);
  each([&](int fine, int coarse, double w) {
    rows.item[next[coarse]] = fine;
    weight[next[coarse]++] = w;
  });
  return rows;
}

template <class Real>
std::vector<Real> rounded(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

template <class Real, class Device>
CoarseLevel<Real, Device>::CoarseLevel(Device& device, const RestLevel& level)
    : nodes(level.nodes),
      finer(device, device_form<Real>(level.finer)),
      row_ptr(device, level.pattern.start),
      col(device, level.pattern.item),
      upper(device, upper_blocks(level.pattern)),
      plate_off_diagonal(device, rounded<Real>(level.plate_off_diagonal)),
      plate_diagonal(device, rounded<Real>(level.plate_diagonal)),
      off_diagonal(device, level.pattern.item.size()),
      diagonal(device, nodes),
      inverse(device, nodes),
      inverse_eigenvalue(device, 1),
      b(device, nodes),
      x(device, nodes),
      y(device, nodes) {
  std::vector<double> weight;
  const Adjacency rows = transposed(level, weight);
  gather_start = Buffer<int, Device>(device, rows.start);
  gather_item = Buffer<int, Device>(device, rows.item);
  gather_weight = Buffer<Real, Device>(device, rounded<Real>(weight));
}

template <class Real, class Device>
CoarseLevelView<Real> CoarseLevel<Real, Device>::view() {
  return {nodes,
          finer.data(),
          gather_start.data(),
          gather_item.data(),
          gather_weight.data(),
          {nodes, row_ptr.data(), col.data(), off_diagonal.data(), diagonal.data()},
          inverse.data(),
          inverse_eigenvalue.data(),
          b.data(),
          x.data(),
          y.data()};
}

template <class Real, class Device>
std::size_t CoarseLevel<Real, Device>::bytes() const {
  return matrix_bytes() + gather_bytes() +
         total_bytes(finer, upper, plate_off_diagonal, plate_diagonal, inverse, inverse_eigenvalue, b, x, y);
}

template struct CoarseLevel<double, ThisDevice>;
template struct CoarseLevel<float, ThisDevice>;

}  // namespace hysteron
