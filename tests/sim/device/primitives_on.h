// Primitives on one device: compiled for the CPU, and by nvcc for the GPU.
#pragma once

#include <utility>

#include "sim/device/algorithms.h"
#include "sim/device/host_result.h"
#include "sim/device/rows.h"
#include "sim/device/while_loop.h"
#include "tests/sim/device/primitives.h"

namespace hysteron::test {

template <class Device>
std::vector<int> visits(Device& device, int n) {
  Buffer<int, Device> buffer(device, n + 1);
  int* visit = buffer.data();
  for_each(
      device, "visits", n, HYST_KERNEL(int i) { visit[i] += i + 1; });
  return buffer.download();
}

template <class Device>
Totals totals(Device& device, const std::vector<double>& values) {
  Buffer<double, Device> in(device, values), out(device, 4);
  const double* value = in.data();
  double* total = out.data();
  for_each_sum<3>(
      device, "totals", static_cast<int>(values.size()),
      HYST_KERNEL(int i, Sums<3>& sums) {
        sums.term[0] += value[i];
        sums.term[1] += value[i] * value[i];
        sums.term[2] += 1;
      },
      HYST_KERNEL(const Sums<3>& sums) {
        for (int k = 0; k < 3; ++k) total[k] = sums.term[k];
        total[3] += 1;
      });
  const auto result = out.download();
  return {result[0], result[1], result[2], result[3]};
}

// Returns a lane's part of a row's sum.
template <class LanesOfRow>
HYST_HD Vec<double, 1> part_of_row(const LanesOfRow& lanes, const int* start, const int* item,
                                   const double* value, int row) {
  Vec<double, 1> part = Vec<double, 1>::Zero();
  for (int j = start[row] + lanes.index(); j < start[row + 1]; j += LanesOfRow::kCount)
    part[0] += value[item[j]];
  return part;
}

template <class Device>
std::vector<double> row_sums(Device& device, const Rows& rows, const std::vector<double>& values) {
  const Buffer<int, Device> starts(device, rows.start), items(device, rows.item);
  const Buffer<double, Device> in(device, values);
  Buffer<double, Device> out(device, rows.start.size() - 1);
  const int *start = starts.data(), *item = items.data();
  const double* value = in.data();
  double* sum = out.data();
  for_each_row(
      device, "row sums", static_cast<int>(out.size()), HYST_KERNEL(int i, const LanesOn<Device>& lanes) {
        const Vec<double, 1> total = lanes.lane_sum(part_of_row(lanes, start, item, value, i));
        if (lanes.leads()) sum[i] = total[0];
      });
  return out.download();
}

template <class Device>
Totals row_totals(Device& device, const Rows& rows, const std::vector<double>& values) {
  const Buffer<int, Device> starts(device, rows.start), items(device, rows.item);
  const Buffer<double, Device> in(device, values);
  Buffer<double, Device> out(device, 3);
  const int *start = starts.data(), *item = items.data();
  const double* value = in.data();
  double* total = out.data();
  for_each_row_sum<2>(
      device, "row totals", static_cast<int>(rows.start.size()) - 1,
      HYST_KERNEL(int i, const LanesOn<Device>& lanes, Sums<2>& sums) {
        const Vec<double, 1> sum = lanes.lane_sum(part_of_row(lanes, start, item, value, i));
        if (!lanes.leads()) return;
        sums.term[0] += sum[0];
        sums.term[1] += 1;
      },
      HYST_KERNEL(const Sums<2>& sums) {
        total[0] = sums.term[0];
        total[1] = sums.term[1];
        total[2] += 1;
      });
  const auto result = out.download();
  return {result[0], 0, result[1], result[2]};
}

template <class Device>
double written_to_host(Device& device, double value) {
  HostResult<double, Device> result(device);
  double* to = result.data();
  for_each(
      device, "to host", 1, HYST_KERNEL(int) { *to = value; });
  device.synchronize();
  return *result;
}

template <class Device>
class PrimitivesOn : public Primitives {
 public:
  template <class... Arguments>
  explicit PrimitivesOn(Arguments... arguments) : device_(arguments...), scratch_(device_) {}

  std::vector<int> visits(int n) override { return test::visits(device_, n); }
  Totals totals(const std::vector<double>& values) override { return test::totals(device_, values); }

  std::vector<double> row_sums(const Rows& rows, const std::vector<double>& values) override {
    return test::row_sums(device_, rows, values);
  }
  Totals row_totals(const Rows& rows, const std::vector<double>& values) override {
    return test::row_totals(device_, rows, values);
  }

  std::vector<int> repeated(int n, int goal, int times) override;

  Scan scan(const std::vector<int>& count) override {
    Buffer<int, Device> in(device_, count), start(device_, count.size() + 1);
    const int total = exclusive_scan(device_, scratch_, in.data(), value_count(count), start.data());
    return {start.download(), total};
  }

  double smallest(const std::vector<double>& values, double otherwise) override {
    return smallest_value(values, otherwise);
  }
  float smallest(const std::vector<float>& values, float otherwise) override {
    return smallest_value(values, otherwise);
  }

  Rows group(const std::vector<int>& key, int rows) override {
    Buffer<int, Device> in(device_, key), start(device_, rows + 1), item(device_, key.size());
    hysteron::group(device_, scratch_, in.data(), value_count(key), rows, start.data(), item.data());
    Rows result{start.download(), item.download()};
    result.item.resize(result.start.back());
    return result;
  }

  double written_to_host(double value) override { return test::written_to_host(device_, value); }

  std::vector<double> through_a_buffer(const std::vector<double>& values) override {
    Buffer<double, Device> first(device_, values.size());
    first.upload(values);
    Buffer<double, Device> second(std::move(first)), third;
    third = std::move(second);
    return third.download();
  }

  std::vector<std::size_t> grown(const std::vector<std::size_t>& wishes) override {
    GrowingBuffer<int, Device> buffer(device_);
    std::vector<std::size_t> sizes;
    for (const std::size_t wish : wishes) {
      buffer.reserve(wish);
      sizes.push_back(buffer.bytes() / sizeof(int));
    }
    return sizes;
  }

  std::size_t bytes() override { return device_.bytes - scratch_.bytes(); }

 private:
  template <class T>
  static int value_count(const std::vector<T>& values) {
    return static_cast<int>(values.size());
  }
  template <class Real>
  Real smallest_value(const std::vector<Real>& values, Real otherwise) {
    Buffer<Real, Device> in(device_, values);
    return hysteron::smallest(device_, scratch_, in.data(), value_count(values), otherwise);
  }

  Device device_;
  Scratch<Device> scratch_;
};

template <class Device>
void count_up(Device& device, int n, int goal, int* count, int* done) {
  for_each(
      device, "count", n, HYST_KERNEL(int i) {
        if (!*done) count[i] += 1;
      });
  for_each(
      device, "decide", 1, HYST_KERNEL(int) { *done = count[n - 1] % goal == 0; });
}

template <class Device>
std::vector<int> PrimitivesOn<Device>::repeated(int n, int goal, int times) {
  Buffer<int, Device> counts(device_, n), flag(device_, 1);
  int *count = counts.data(), *done = flag.data();
  WhileLoop<Device> loop;
  const auto order = [&] { count_up(device_, n, goal, count, done); };
  for (int k = 0; k < times; ++k) {
    flag.upload({0});
    if (loop.run(device_, {count, done}, done, order)) continue;
    do {
      order();
    } while (!flag.download()[0]);
  }
  return counts.download();
}

}  // namespace hysteron::test
