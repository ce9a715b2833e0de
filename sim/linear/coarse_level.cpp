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

// Returns the finer nodes, ascending, that are interpolated from each coarse node (one row per coarse node).
Adjacency transposed(const RestLevel& level) {
  std::vector<std::vector<int>> rows(level.nodes);
  for (std::size_t i = 0; i < level.finer.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (level.finer[i].weight[k] > 0) rows[level.finer[i].node[k]].push_back(static_cast<int>(i));
  return compressed(rows);
}

template <class Real>
std::vector<Real> rounded(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

template <class Real, class Device>
CoarseLevel<Real, Device>::CoarseLevel(Device& device, const RestLevel& level)
    : nodes(level.nodes),
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
  const std::vector<DeviceInterpolation<Real>> seen = device_form<Real>(level.finer);
  const Adjacency rows = transposed(level);
  std::vector<Real> weight;
  for (int c = 0; c < nodes; ++c)
    for (int j = rows.start[c]; j < rows.start[c + 1]; ++j)
      weight.push_back(seen[rows.item[j]].interpolation_weight(c));
  finer = Buffer<DeviceInterpolation<Real>, Device>(device, seen);
  gather_start = Buffer<int, Device>(device, rows.start);
  gather_item = Buffer<int, Device>(device, rows.item);
  gather_weight = Buffer<Real, Device>(device, weight);
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
