// Adds the stiffness of touching layers' pairs to fronts: the pairs change, and their stiffnesses stay on the
// device.
#pragma once

#include "sim/base/archive.h"
#include "sim/device/algorithms.h"
#include "sim/device/host_result.h"
#include "sim/linear/front_tables.h"
#include "sim/linear/pair_product.h"

namespace hysteron {

template <class Real, class Device>
class FrontPairs {
 public:
  FrontPairs(Device& device, int vertices);

  // Copies the pairs of the next factorisation.
  void take(const PairProduct<Real>& pairs);
  void take_plan(const TiledPlan& plan);
  // Has the plan a front for any two vertices of each pair? The host waits for the device.
  bool fit();
  // Returns the couplings of the pattern and those of the pairs.
  SparsityPattern couplings_with(const Adjacency& pattern) const;
  // Adds the pairs to the fronts' numbers, whose rows and columns are scaled by `scale` (n x 3), except for
  // held vertices (n flags).
  void add(const char* held, const double* scale, double* number);
  void serialise(Archive& archive);
  std::size_t bytes() const;

 private:
  FrontFinder finder() const { return {rank_.data(), owner_.data(), front_.data(), row_.data()}; }

  Device& device_;
  int vertices_, count_ = 0;
  GrowingBuffer<PairStiffness<Real>, Device> pair_;
  Buffer<int, Device> start_;  // row starts, one row per vertex
  GrowingBuffer<int, Device> item_;
  Buffer<int, Device> rank_, owner_, row_;
  Buffer<FrontRange, Device> front_;
  HostResult<double, Device> strangers_;  // number of pairs that do not fit
};

}  // namespace hysteron
