#include "sim/contact/box_tree.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace hysteron {

namespace {

// Interleaves the lower 20 bits of three numbers (Morton 1966).
std::uint64_t morton(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  std::uint64_t code = 0;
  for (int bit = 0; bit < 20; ++bit)
    code |=
        ((x >> bit & 1) << (3 * bit)) | ((y >> bit & 1) << (3 * bit + 1)) | ((z >> bit & 1) << (3 * bit + 2));
  return code;
}

std::vector<int> along_curve(const std::vector<std::array<int, 3>>& corners,
                             const std::vector<Eigen::Vector3d>& rest) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e30), high = -low;
  for (const Eigen::Vector3d& x : rest) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double extent = std::max((high - low).maxCoeff(), 1e-30);
  std::vector<std::uint64_t> code;
  for (const auto& c : corners) {
    const Eigen::Vector3d cell =
        ((rest[c[0]] + rest[c[1]] + rest[c[2]]) / 3 - low) / extent * ((1 << 20) - 1);
    code.push_back(morton(static_cast<std::uint64_t>(cell.x()), static_cast<std::uint64_t>(cell.y()),
                          static_cast<std::uint64_t>(cell.z())));
  }
  std::vector<int> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return code[a] < code[b]; });
  return order;
}

// Tells for each node whether an item of the cloth is below it.
std::vector<char> nodes_with_cloth(const std::vector<int>& vertices, int leaves, int cloth) {
  std::vector<char> has(2 * static_cast<std::size_t>(leaves));
  for (std::size_t rank = 0; 3 * rank < vertices.size(); ++rank)
    has[leaves + rank] = vertices[3 * rank] < cloth;
  for (int node = leaves - 1; node > 0; --node) has[node] = has[2 * node] || has[2 * node + 1];
  return has;
}

}  // namespace

template <class Real, class Device>
BoxTree<Real, Device>::BoxTree(Device& device, const std::vector<std::array<int, 3>>& corners,
                               const std::vector<Eigen::Vector3d>& rest, int cloth)
    : device_(device), leaves_(1), count_(static_cast<int>(corners.size())) {
  while (leaves_ < count_) leaves_ *= 2;
  const std::vector<int> order = along_curve(corners, rest);
  std::vector<int> vertices;
  for (int item : order) vertices.insert(vertices.end(), corners[item].begin(), corners[item].end());
  item_ = Buffer<int, Device>(device, order);
  corner_ = Buffer<int, Device>(device, vertices);
  box_ = Buffer<Box<Real>, Device>(device, 2 * static_cast<std::size_t>(leaves_));
  has_cloth_ = Buffer<char, Device>(device, nodes_with_cloth(vertices, leaves_, cloth));
}

template <class Real, class Device>
void BoxTree<Real, Device>::fit(const Sweep<Real>& sweep) {
  const int leaves = leaves_, count = count_;
  const int* corner = corner_.data();
  Box<Real>* box = box_.data();
  for_each(
      device_, "boxes: leaves", leaves, HYST_KERNEL(int rank) {
        Box<Real> b = Box<Real>::nothing();
        if (rank < count) {
          for (int k = 0; k < 3; ++k) sweep.include(b, corner[3 * rank + k]);
          sweep.widen(b);
        }
        box[leaves + rank] = b;
      });
  for (int width = leaves / 2; width > 0; width /= 2)
    for_each(
        device_, "boxes: nodes", width, HYST_KERNEL(int i) {
          const Box<Real>&left = box[2 * (width + i)], &right = box[2 * (width + i) + 1];
          box[width + i] = {left.low.cwiseMin(right.low), left.high.cwiseMax(right.high)};
        });
}

template class BoxTree<double, ThisDevice>;
template class BoxTree<float, ThisDevice>;

}  // namespace hysteron
