#include "sim/linear/front_pairs.h"

#include <algorithm>

#include "sim/device/archive_buffer.h"
#include "sim/device/rows.h"

namespace hysteron {

namespace {

// Adds the blocks in rows of one vertex, pair after pair.
template <class Real>
struct PairsOfVertex {
  PairProduct<Real> pairs;
  FrontFinder finder;
  const char* held;
  const double* scale;
  double* number;

  template <class Lanes>
  HYST_HD void operator()(int i, const Lanes& lanes) const {
    if (held[i]) return;
    for (int k = pairs.start[i]; k < pairs.start[i + 1]; ++k) {
      const PairStiffness<Real>& pair = pairs.pair[pairs.item[k] / 4];
      for (int b = 0; b < 4; ++b)
        if (!held[pair.v[b]]) add(finder.find(i, pair.v[b]), i, pair, pairs.item[k] % 4, b, lanes);
    }
  }
  template <class Lanes>
  HYST_HD void add(const FrontBlock& at, int i, const PairStiffness<Real>& pair, int a, int b,
                   const Lanes& lanes) const {
    if (at.row != i) return;  // the block is in a row of the other vertex
    const double weight = static_cast<double>(pair.weight[a]) * static_cast<double>(pair.weight[b]);
    for (int e = lanes.index(); e < 9; e += Lanes::kCount) {
      const int r = e / 3, c = e % 3;
      if (at.row == at.column && c > r) continue;
      number[at.number + static_cast<std::size_t>(r) * at.stride + c] +=
          weight * static_cast<double>(pair.block(r, c)) * scale[3 * at.row + r] * scale[3 * at.column + c];
    }
  }
};

}  // namespace

template <class Real, class Device>
FrontPairs<Real, Device>::FrontPairs(Device& device, int vertices)
    : device_(device),
      vertices_(vertices),
      pair_(device),
      start_(device, vertices + 1),
      item_(device),
      strangers_(device) {}

template <class Real, class Device>
void FrontPairs<Real, Device>::take(const PairProduct<Real>& pairs) {
  count_ = pairs.count;
  if (count_ == 0) return;
  const int starts = vertices_ + 1, items = 4 * count_;
  PairStiffness<Real>* pair = pair_.reserve(count_);
  int *start = start_.data(), *item = item_.reserve(items);
  for_each(
      device_, {"fronts: copy pairs"}, std::max(starts, items), HYST_KERNEL(int k) {
        if (k < pairs.count) pair[k] = pairs.pair[k];
        if (k < starts) start[k] = pairs.start[k];
        if (k < items) item[k] = pairs.item[k];
      });
}

template <class Real, class Device>
void FrontPairs<Real, Device>::take_plan(const TiledPlan& plan) {
  const FrontPlaces places(plan);
  rank_ = Buffer<int, Device>(device_, places.rank);
  owner_ = Buffer<int, Device>(device_, places.owner);
  row_ = Buffer<int, Device>(device_, places.row);
  front_ = Buffer<FrontRange, Device>(device_, places.front);
}

template <class Real, class Device>
bool FrontPairs<Real, Device>::fit() {
  if (count_ == 0) return true;
  const PairStiffness<Real>* pair = pair_.data();
  const FrontFinder finder = this->finder();
  double* strangers = strangers_.data();
  for_each_sum<1>(
      device_, {"fronts: pairs"}, count_,
      HYST_KERNEL(int p, Sums<1>& sums) { sums.term[0] += finder.couples(pair[p].v, 4) ? 0 : 1; },
      HYST_KERNEL(const Sums<1>& total) { *strangers = total.term[0]; });
  device_.synchronize();
  return *strangers_ == 0;
}

template <class Real, class Device>
SparsityPattern FrontPairs<Real, Device>::couplings_with(const Adjacency& pattern) const {
  CouplingList list(pattern);
  for (const PairStiffness<Real>& pair : downloaded(device_, pair_.data(), count_)) list.add(pair.v);
  return list.take();
}

template <class Real, class Device>
void FrontPairs<Real, Device>::add(const char* held, const double* scale, double* number) {
  if (count_ == 0) return;
  const PairProduct<Real> pairs{start_.data(), item_.data(), pair_.data(), count_};
  for_each_row(device_, {"fronts: add pairs"}, vertices_,
               PairsOfVertex<Real>{pairs, finder(), held, scale, number});
}

template <class Real, class Device>
void FrontPairs<Real, Device>::serialise(Archive& archive) {
  count_ = static_cast<int>(archive.size(count_));
  if (count_ == 0) return;
  hysteron::serialise(archive, device_, pair_.reserve(count_), count_);
  hysteron::serialise(archive, device_, start_.data(), start_.size());
  const std::size_t items = 4 * static_cast<std::size_t>(count_);
  hysteron::serialise(archive, device_, item_.reserve(items), items);
}

template <class Real, class Device>
std::size_t FrontPairs<Real, Device>::bytes() const {
  return pair_.bytes() + item_.bytes() + total_bytes(start_, rank_, owner_, row_, front_);
}

template class FrontPairs<double, ThisDevice>;
template class FrontPairs<float, ThisDevice>;

}  // namespace hysteron
