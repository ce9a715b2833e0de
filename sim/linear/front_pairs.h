// What pairs of layers that touch add to fronts: they come and go, and their stiffnesses stay on the device.
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

  // Those of the next factorisation, which are copied.
  void take(const PairProduct<Real>& pairs);
  void take_plan(const TiledPlan& plan);
  // Whether a front of the plan has any two vertices of each; the host waits for the device.
  bool fit();
  // The pattern's couplings and those of the pairs.
  Couplings couplings_with(const Adjacency& pattern) const;
  // To the fronts' numbers, of rows and columns that are scaled, but for held vertices.
  void add(const char* held, const double* scale, double* number);
  void serialise(Archive& archive);
  std::size_t bytes() const;

 private:
  FrontFinder finder() const { return {rank_.data(), owner_.data(), front_.data(), row_.data()}; }

  Device& device_;
  int vertices_, count_ = 0;
  GrowingBuffer<PairStiffness<Real>, Device> pair_;
  Buffer<int, Device> start_;  // rows: vertices
  GrowingBuffer<int, Device> item_;
  Buffer<int, Device> rank_, owner_, row_;
  Buffer<FrontRange, Device> front_;
  HostResult<double, Device> strangers_;  // pairs that do not fit
};

}  // namespace hysteron
