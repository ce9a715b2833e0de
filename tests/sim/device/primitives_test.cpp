// Loops, sums, scans, groups and buffers against serial references, on every device alike.
#include "tests/sim/device/primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "sim/device/cpu.h"
#include "tests/sim/device/on_each_device.h"

namespace hysteron {
namespace {

using test::Primitives;

// The sizes are none, one, both sides of a warp, of a GPU's block, of a CPU's partial sum, of its shortest
// parallel loop, and of the most blocks that a sum on a GPU has; each is followed by smaller ones, which find
// what the larger left behind.
constexpr int kSizes[] = {100003, 0,   1,    2,    3,     31,    33, 127, 129,
                          255,    257, 2047, 2049, 67583, 67585, 1,  0,   257};

std::vector<int> whole_numbers(int n, int low, int high) {
  std::mt19937 random(n + 1);
  std::vector<int> values(n);
  for (int& value : values) value = low + static_cast<int>(random() % (high - low + 1));
  return values;
}

std::vector<double> fractions(int n) {
  std::mt19937 random(n + 1);
  std::vector<double> values(n);
  for (double& value : values) value = std::ldexp(random(), -31) - 1;
  return values;
}

class DevicePrimitives : public test::OnEachDevice {
 protected:
  void SetUp() override {
    OnEachDevice::SetUp();
    if (IsSkipped()) return;
    const int threads = GetParam() == std::string("cpu_1") ? 1 : 3;
    primitives = on_gpu() ? test::gpu_primitives() : test::cpu_primitives(threads);
    ASSERT_TRUE(primitives);
  }
  std::unique_ptr<Primitives> primitives;
};
INSTANTIATE_TEST_SUITE_P(Devices, DevicePrimitives, testing::Values("cpu_1", "cpu_3", "gpu"),
                         test::CaseName());

TEST_P(DevicePrimitives, ALoopVisitsEveryElementOnceAndNoOther) {
  for (const int n : kSizes) {
    std::vector<int> expected(n + 1, 0);
    std::iota(expected.begin(), expected.end() - 1, 1);
    EXPECT_EQ(primitives->visits(n), expected) << n;
  }
}

// Whole numbers below 2^53 add up exactly in any order.
TEST_P(DevicePrimitives, SumsOfWholeNumbersAreExactAndFinishedOnce) {
  for (const int n : kSizes) {
    const auto whole = whole_numbers(n, -1000, 1000);
    const std::vector<double> values(whole.begin(), whole.end());
    const auto totals = primitives->totals(values);
    EXPECT_EQ(totals.sum, std::accumulate(values.begin(), values.end(), 0.0)) << n;
    EXPECT_EQ(totals.squares, std::inner_product(values.begin(), values.end(), values.begin(), 0.0)) << n;
    EXPECT_EQ(totals.count, n);
    EXPECT_EQ(totals.finished, 1);
  }
}

// In whatever order n numbers are added, rounding is below n · epsilon of the sum of their magnitudes.
TEST_P(DevicePrimitives, SumsOfFractionsAreNearAndTheSameBitsTwice) {
  for (const int n : kSizes) {
    const auto values = fractions(n);
    const auto totals = primitives->totals(values), again = primitives->totals(values);
    long double sum = 0, magnitude = 0;
    for (const double value : values) sum += value, magnitude += std::abs(value);
    const double kRounding = static_cast<double>(n * magnitude) * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(totals.sum, static_cast<double>(sum), kRounding) << n;
    EXPECT_EQ(totals.sum, again.sum) << n;
    EXPECT_EQ(totals.squares, again.squares) << n;
  }
}

test::Rows counted_rows(const std::vector<int>& counts) {
  test::Rows rows{{0}, {}};
  for (const int count : counts) {
    for (int k = 0; k < count; ++k) rows.item.push_back(static_cast<int>(rows.item.size()));
    rows.start.push_back(static_cast<int>(rows.item.size()));
  }
  return rows;
}

// Rows have no item, one, as many as both sides of a warp, or more.
TEST_P(DevicePrimitives, RowsOfAnyLengthAreSummedWholeByWhoeverTakesThem) {
  const std::vector<int> lengths = {0, 1, 31, 32, 33, 0, 7, 100, 64, 1};
  for (const int n : {0, 1, 3, 4, 5, 1000, 70000}) {
    std::vector<int> counts(n);
    for (int i = 0; i < n; ++i) counts[i] = lengths[i % lengths.size()];
    const test::Rows rows = counted_rows(counts);
    const auto whole = whole_numbers(static_cast<int>(rows.item.size()), -1000, 1000);
    const std::vector<double> values(whole.begin(), whole.end());
    std::vector<double> expected(n, 0.0);
    for (int i = 0; i < n; ++i)
      expected[i] = std::accumulate(values.begin() + rows.start[i], values.begin() + rows.start[i + 1], 0.0);
    EXPECT_EQ(primitives->row_sums(rows, values), expected) << n;
    const auto totals = primitives->row_totals(rows, values);
    EXPECT_EQ(totals.sum, std::accumulate(values.begin(), values.end(), 0.0)) << n;
    EXPECT_EQ(totals.count, n);
    EXPECT_EQ(totals.finished, 1);
  }
}

TEST_P(DevicePrimitives, RowsOfFractionsHaveTheSameBitsTwice) {
  const test::Rows rows = counted_rows(std::vector<int>(3000, 37));
  const auto values = fractions(static_cast<int>(rows.item.size()));
  EXPECT_EQ(primitives->row_sums(rows, values), primitives->row_sums(rows, values));
  EXPECT_EQ(primitives->row_totals(rows, values).sum, primitives->row_totals(rows, values).sum);
}

// After r rounds place i has the number of place i + r, r times one more or less.
TEST_P(DevicePrimitives, ARepeatedLoopEndsWhenItIsDoneAndCanBeRunAgain) {
  for (const int n : {1, 1000})
    for (const int goal : {1, 2, 37}) {
      constexpr int kTimes = 3;
      EXPECT_EQ(primitives->repeated(n, goal, kTimes), std::vector<int>(n, kTimes * goal)) << goal;
    }
}

TEST_P(DevicePrimitives, AScanStartsEveryRowWhereTheOnesBeforeItEnd) {
  for (const int n : kSizes) {
    const auto count = whole_numbers(n, 0, 9);
    std::vector<int> start(n + 1, 0);
    std::partial_sum(count.begin(), count.end(), start.begin() + 1);
    const auto scan = primitives->scan(count);
    EXPECT_EQ(scan.start, start) << n;
    EXPECT_EQ(scan.total, start.back()) << n;
  }
}

TEST_P(DevicePrimitives, TheSmallestIsTheLeastOfTheValuesAndTheOther) {
  constexpr double kBelow = -3, kAbove = 7;  // of fractions in [-1, 1)
  for (const int n : kSizes) {
    const auto values = fractions(n);
    const std::vector<float> singles(values.begin(), values.end());
    EXPECT_EQ(primitives->smallest(values, kBelow), kBelow) << n;
    if (n == 0) {
      EXPECT_EQ(primitives->smallest(values, kAbove), kAbove);
      EXPECT_EQ(primitives->smallest(singles, static_cast<float>(kAbove)), static_cast<float>(kAbove));
    } else {
      EXPECT_EQ(primitives->smallest(values, kAbove), *std::min_element(values.begin(), values.end())) << n;
      EXPECT_EQ(primitives->smallest(singles, static_cast<float>(kAbove)),
                *std::min_element(singles.begin(), singles.end()))
          << n;
    }
  }
}

void expect_grouped(Primitives& primitives, const std::vector<int>& key, int rows) {
  std::vector<std::vector<int>> row(rows);
  for (std::size_t i = 0; i < key.size(); ++i)
    if (key[i] >= 0) row[key[i]].push_back(static_cast<int>(i));
  std::vector<int> start = {0}, item;
  for (const auto& items : row) {
    item.insert(item.end(), items.begin(), items.end());
    start.push_back(static_cast<int>(item.size()));
  }
  const auto grouped = primitives.group(key, rows);
  EXPECT_EQ(grouped.start, start) << key.size() << " items in " << rows << " rows";
  EXPECT_EQ(grouped.item, item) << key.size() << " items in " << rows << " rows";
}

TEST_P(DevicePrimitives, GroupsKeepTheItemsOfARowInOrderAndLeaveOutNegativeKeys) {
  for (const int n : kSizes)
    for (const int rows : {1, 2, 7, 1024, 3001})
      expect_grouped(*primitives, whole_numbers(n, -2, rows - 1), rows);
}

TEST_P(DevicePrimitives, GroupsWithNothingInThemAreEmptyRows) {
  expect_grouped(*primitives, {}, 0);
  expect_grouped(*primitives, std::vector<int>(257, -1), 5);
  expect_grouped(*primitives, std::vector<int>(257, 4), 5);
}

TEST_P(DevicePrimitives, ABufferGivesBackWhatItWasGivenAndLeavesNoMemoryBehind) {
  const std::size_t before = primitives->bytes();
  for (const int n : kSizes) {
    const auto values = fractions(n);
    EXPECT_EQ(primitives->through_a_buffer(values), values) << n;
  }
  EXPECT_EQ(primitives->bytes(), before);
}

TEST_P(DevicePrimitives, AHostResultIsWhatTheLoopWrote) {
  for (const double value : {0.0, -1.5, 1e300}) EXPECT_EQ(primitives->written_to_host(value), value);
}

TEST_P(DevicePrimitives, AGrowingBufferGrowsByAQuarterMoreAndNeverShrinks) {
  EXPECT_EQ(primitives->grown({0, 8, 4, 10, 11, 0, 100}),
            (std::vector<std::size_t>{0, 10, 10, 10, 13, 13, 125}));
}

// The order is part of the CPU's contract: blocks of kSumBlock, each from its first element, then the blocks
// in order.
TEST(CpuSums, AreTheBitsOfSerialBlocksWhateverTheNumberOfThreads) {
  for (const int n : kSizes) {
    const auto values = fractions(n);
    double total = 0;
    for (int begin = 0; begin < n; begin += kSumBlock) {
      double block = 0;
      for (int i = begin; i < std::min(n, begin + kSumBlock); ++i) block += values[i];
      total += block;
    }
    for (const int threads : {1, 2, 3, 5})
      EXPECT_EQ(test::cpu_primitives(threads)->totals(values).sum, total)
          << n << ", " << threads << " threads";
  }
}

}  // namespace
}  // namespace hysteron
