// What reading half of a symmetric matrix would save a product on a GPU:
//
//   nvcc -O3 -std=c++17 -arch=sm_90 half-matrix.cu && ./a.out
//
// Rows of a grid's vertices with six neighbours, 3x3 blocks and softening in single precision and the forces
// of three hinges a vertex, nine threads a row, as the solver's product of fine cloth has them
// (sim/linear/row_products.h).  A row reads all its blocks; or those of later columns, and the others,
// transposed, from the rows that own them.  Prints microseconds of a product, the median of 21 times ten and
// the fastest and slowest.
#include <cuda_runtime.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

struct Vector {
  float x[3];
};
struct Block {
  float x[9];  // by columns
};

struct Matrix {
  int rows;
  const int *start, *column;            // neighbours of a row, ascending
  const Block *all, *diagonal, *upper;  // upper: of neighbours that follow
  const float *soft, *soft_diagonal, *soft_upper;
  const int *upper_start, *lower;  // lower: where the others stand among the upper ones
  const int *force_start, *force_item;
  const Vector *force, *p;
  Vector* q;
  double* partial;
};

constexpr int kThreads = 128;
enum Variant { kAll, kHalf, kNone };

template <Variant kVariant>
__global__ void product(Matrix m, int warps) {
  double sum = 0;
  for (int e = blockIdx.x * kThreads + threadIdx.x; e < 32 * warps; e += gridDim.x * kThreads) {
    const int lane = threadIdx.x % 32, slot = lane / 9, k = lane % 9, i = 3 * (e / 32) + slot;
    if (slot == 3 || i >= m.rows) continue;
    const int c = k / 3, r = k % 3, transposed = 3 * r + c;
    const int first = m.start[i], last = m.start[i + 1];
    float part = m.diagonal[i].x[k] * m.p[i].x[c];
    if (kVariant == kAll) {
      for (int j = first; j < last; ++j) part += m.all[j].x[k] * m.p[m.column[j]].x[c];
      for (int j = first + c; j < last; j += 3) part += m.soft[j] * m.p[m.column[j]].x[r];
    }
    if (kVariant == kHalf) {
      const int from = m.upper_start[i], lowers = last - first - (m.upper_start[i + 1] - from);
      const int* lower = m.lower + first - from;
      for (int j = 0; j < lowers; ++j)
        part += m.upper[lower[j]].x[transposed] * m.p[m.column[first + j]].x[c];
      for (int j = lowers; j < last - first; ++j)
        part += m.upper[from + j - lowers].x[k] * m.p[m.column[first + j]].x[c];
      for (int j = c; j < lowers; j += 3) part += m.soft_upper[lower[j]] * m.p[m.column[first + j]].x[r];
      for (int j = lowers + c; j < last - first; j += 3)
        part += m.soft_upper[from + j - lowers] * m.p[m.column[first + j]].x[r];
    }
    for (int j = m.force_start[i] + c; j < m.force_start[i + 1]; j += 3)
      part += m.force[m.force_item[j]].x[r];
    const unsigned row = 0x1ffu << (9 * slot);
    part = part + __shfl_down_sync(row, part, 3) + __shfl_down_sync(row, part, 6);
    if (k < 3) {
      m.q[i].x[k] = part + m.soft_diagonal[i] * m.p[i].x[k];
      sum += static_cast<double>(m.q[i].x[k]) * m.p[i].x[k];
    }
  }
  __shared__ double shared[kThreads];
  shared[threadIdx.x] = sum;
  for (int half = kThreads / 2; half > 0; half /= 2) {
    __syncthreads();
    if (threadIdx.x < half) shared[threadIdx.x] += shared[threadIdx.x + half];
  }
  if (threadIdx.x == 0) m.partial[blockIdx.x] = shared[0];
}

template <class T>
T* on_device(const std::vector<T>& values) {
  T* to = nullptr;
  cudaMalloc(&to, values.size() * sizeof(T));
  cudaMemcpy(to, values.data(), values.size() * sizeof(T), cudaMemcpyHostToDevice);
  return to;
}

struct Rows {
  explicit Rows(int n) : rows(n * n), neighbours(rows), start{0}, upper_start{0}, force_start{0} {
    const int step[6][2] = {{-1, -1}, {0, -1}, {-1, 0}, {1, 0}, {0, 1}, {1, 1}};
    for (int i = 0; i < rows; ++i)
      for (const auto& s : step)
        if (const int x = i % n + s[0], y = i / n + s[1]; x >= 0 && y >= 0 && x < n && y < n)
          neighbours[i].push_back(y * n + x);
    fill_blocks();
    for (int i = 0; i < rows; ++i) {
      for (int k = 0; k < 12; ++k)
        force_item.push_back(4 * std::clamp(3 * i + k % 3 - k / 3 * (k < 6 ? 3 : 3 * n), 0, 3 * rows - 1) +
                             k % 4);
      force_start.push_back(static_cast<int>(force_item.size()));
    }
    p.resize(rows);
    force.resize(12 * rows);
    for (auto* list : {&p, &force})
      for (Vector& v : *list)
        for (float& x : v.x) x = any();
  }
  void fill_blocks() {
    std::vector<std::vector<int>> owned(rows);  // by others
    for (int i = 0; i < rows; ++i) {
      for (int j : neighbours[i])
        if (j > i) {
          owned[j].push_back(static_cast<int>(upper.size()));
          upper.push_back(block());
          soft_upper.push_back(any());
        }
      upper_start.push_back(static_cast<int>(upper.size()));
    }
    for (int i = 0; i < rows; ++i) {
      auto before = owned[i].begin();
      int after = upper_start[i];
      for (int j : neighbours[i]) {
        const bool is_lower = j < i;
        const int at = is_lower ? *before++ : after++;
        if (is_lower) lower.push_back(at);
        Block b = upper[at];
        if (is_lower)
          for (int k = 0; k < 9; ++k) b.x[k] = upper[at].x[k % 3 * 3 + k / 3];
        all.push_back(b);
        soft.push_back(soft_upper[at]);
        column.push_back(j);
      }
      start.push_back(static_cast<int>(column.size()));
      diagonal.push_back(block());
      soft_diagonal.push_back(any());
    }
  }
  Matrix view() const {
    Vector* q = on_device(p);
    return {rows,
            on_device(start),
            on_device(column),
            on_device(all),
            on_device(diagonal),
            on_device(upper),
            on_device(soft),
            on_device(soft_diagonal),
            on_device(soft_upper),
            on_device(upper_start),
            on_device(lower),
            on_device(force_start),
            on_device(force_item),
            on_device(force),
            on_device(p),
            q,
            on_device(std::vector<double>(1 << 16))};
  }
  float any() { return std::uniform_real_distribution<float>(-1, 1)(random); }
  Block block() {
    Block b;
    for (float& x : b.x) x = any();
    return b;
  }

  std::mt19937 random{1};
  int rows;
  std::vector<std::vector<int>> neighbours;
  std::vector<int> start, column, upper_start, lower, force_start, force_item;
  std::vector<Block> all, diagonal, upper;
  std::vector<float> soft, soft_diagonal, soft_upper;
  std::vector<Vector> force, p;
};

template <Variant kVariant>
std::vector<Vector> measure(const char* what, const Matrix& m, int blocks) {
  const int warps = (m.rows + 2) / 3;
  cudaEvent_t begin, end;
  cudaEventCreate(&begin);
  cudaEventCreate(&end);
  std::vector<float> microseconds;
  for (int k = 0; k < 21; ++k) {
    cudaEventRecord(begin);
    for (int j = 0; j < 10; ++j) product<kVariant><<<blocks, kThreads>>>(m, warps);
    cudaEventRecord(end);
    cudaEventSynchronize(end);
    float milliseconds = 0;
    cudaEventElapsedTime(&milliseconds, begin, end);
    microseconds.push_back(100 * milliseconds);
  }
  std::sort(microseconds.begin(), microseconds.end());
  std::printf("%7d rows, %5d blocks, %-20s %6.1f us (%.1f to %.1f)\n", m.rows, blocks, what, microseconds[10],
              microseconds.front(), microseconds.back());
  std::vector<Vector> q(m.rows);
  cudaMemcpy(q.data(), m.q, q.size() * sizeof(Vector), cudaMemcpyDeviceToHost);
  return q;
}

int main() {
  cudaDeviceProp device;
  cudaGetDeviceProperties(&device, 0);
  std::printf("%s\n", device.name);
  for (int n : {257, 708}) {
    const Matrix m = Rows(n).view();
    for (int blocks : {1056, 1584, 2112, 3168, 4224}) {
      const std::vector<Vector> all = measure<kAll>("all blocks", m, blocks),
                                half = measure<kHalf>("half", m, blocks);
      measure<kNone>("the diagonal alone", m, blocks);
      float difference = 0;
      for (int i = 0; i < m.rows; ++i)
        for (int k = 0; k < 3; ++k) difference = std::max(difference, std::abs(all[i].x[k] - half[i].x[k]));
      if (!(difference < 1e-5F)) std::printf("the products differ by %g\n", difference);
    }
  }
  if (cudaGetLastError() != cudaSuccess) std::printf("a call of CUDA's failed\n");
}
