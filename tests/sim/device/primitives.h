// These calls use the device layer with values of the host: the tests are compiled by the C++ compiler alone,
// the loops that they try on a GPU by nvcc.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace hysteron::test {

struct Scan {
  std::vector<int> start;
  int total;
};
struct Rows {
  std::vector<int> start, item;
};
struct Totals {
  double sum, squares, count, finished;
};

class Primitives {
 public:
  virtual ~Primitives() = default;

  // Runs a loop of n that adds i + 1 to element i of a new buffer with one element more; returns the buffer
  // after it.
  virtual std::vector<int> visits(int n) = 0;
  // Sums of values, their squares and ones; how often the sums were finished.
  virtual Totals totals(const std::vector<double>& values) = 0;
  // Returns for each row of items the sum of their values; row_totals adds the sum of those and the number of
  // rows.
  virtual std::vector<double> row_sums(const Rows& rows, const std::vector<double>& values) = 0;
  virtual Totals row_totals(const Rows& rows, const std::vector<double>& values) = 0;
  // A loop that counts rounds until `goal` is reached, ordered `times` times over; how far n elements have
  // come.
  virtual std::vector<int> repeated(int n, int goal, int times) = 0;
  virtual Scan scan(const std::vector<int>& count) = 0;
  virtual double smallest(const std::vector<double>& values, double otherwise) = 0;
  virtual float smallest(const std::vector<float>& values, float otherwise) = 0;
  virtual Rows group(const std::vector<int>& key, int rows) = 0;

  // Returns a value that a loop has written where the host reads it, without a download.
  virtual double written_to_host(double value) = 0;
  // Returns values that were uploaded to a buffer, moved twice with it, and downloaded.
  virtual std::vector<double> through_a_buffer(const std::vector<double>& values) = 0;
  // Elements that a growing buffer holds after each of these wishes.
  virtual std::vector<std::size_t> grown(const std::vector<std::size_t>& wishes) = 0;
  // Memory of buffers that exist: none between calls but what a scratch keeps.
  virtual std::size_t bytes() = 0;
};

std::unique_ptr<Primitives> cpu_primitives(int threads);
std::unique_ptr<Primitives> gpu_primitives();  // nullptr in a build without CUDA

}  // namespace hysteron::test
