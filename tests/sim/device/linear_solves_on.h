// The systems of linear_solves.h on one device: compiled for the CPU, and by nvcc for the GPU.
#pragma once

#include <cmath>

#include "sim/linear/dissected_factorisation.h"
#include "sim/linear/multigrid_solver.h"
#include "tests/sim/device/linear_solves.h"

namespace hysteron::test {

template <class Device>
class LinearSolvesOn : public LinearSolves {
 public:
  template <class... Arguments>
  explicit LinearSolvesOn(Arguments... arguments) : device_(arguments...) {}

  LinearSolve solve(const ClothMesh& mesh, LinearMethod method, double tolerance, bool by_batches,
                    int times) override {
    const int n = mesh.vertices();
    BlockRows<double, Device> rows(device_, mesh);
    fill(mesh, rows);
    std::vector<char> held(n, 0);
    held[0] = 1;
    const Buffer<char, Device> is_held(device_, held);
    const Buffer<Eigen::Vector3d, Device> rhs(device_, load(n));
    Buffer<Eigen::Vector3d, Device> x(device_, n);
    const auto solver = make_solver(mesh, method, held);
    LinearSystem<double, Device> system{rows.view()};
    const Buffer<int, Device> no_pairs(device_, std::vector<int>(n + 1, 0));
    if (by_batches) {  // as of a cloth with layers and a loop of bending's
      system.pairs.start = no_pairs.data();
      system.bending = [](const Vec3<double>*) { return GatheredForces<double>{}; };
    }
    PcgOutcome outcome;
    const long before = device_counts.loops;
    for (int k = 0; k < times; ++k)
      outcome = solver->solve(system, is_held.data(), rhs.data(), x.data(), tolerance);
    const long loops = device_counts.loops - before;
    const auto solution = x.download();
    return {solution, residual(rows, solution, 1), outcome.iterations, outcome.converged, loops};
  }

  LinearSolve invert(const ClothMesh& mesh, bool without_first) override {
    const int n = mesh.vertices();
    BlockRows<double, Device> rows(device_, mesh);
    fill(mesh, rows, without_first);
    std::vector<Eigen::Vector3d> forces = load(n);
    if (without_first) forces[0].setZero();
    const Buffer<Eigen::Vector3d, Device> b(device_, forces);
    Buffer<Eigen::Vector3d, Device> y(device_, n);
    DenseInverse<double, Device> inverse(device_, n);
    inverse.make(device_, rows.view());
    inverse.apply(device_, b.data(), y.data(), nullptr);
    const auto solution = y.download();
    return {solution, residual(rows, solution, without_first), 0, true, 0};
  }

 private:
  std::unique_ptr<LinearSolver<double, Device>> make_solver(const ClothMesh& mesh, LinearMethod method,
                                                            const std::vector<char>& held) {
    const int n = mesh.vertices();
    if (method == LinearMethod::multigrid)
      return std::make_unique<MultigridSolver<double, Device>>(
          device_, mesh, make_rest_hierarchy(mesh, neighbours_in(mesh), held), 0.0);
    if (method == LinearMethod::block_jacobi)
      return std::make_unique<BlockJacobiSolver<double, Device>>(device_, n);
    auto factor = std::make_unique<DissectedFactorisation<double, Device>>(
        device_, std::make_unique<RowsAlone<double>>(neighbours_in(mesh)));
    return std::make_unique<CholeskySolver<double, Device>>(device_, n, std::move(factor));
  }

  static constexpr double kMass = 0.01;  // beside springs of 1

  static std::vector<Eigen::Vector3d> load(int n) {
    std::vector<Eigen::Vector3d> f;
    for (int i = 0; i < n; ++i) f.push_back({std::sin(0.1 * i), 1, std::cos(0.7 * i)});
    return f;
  }

  void fill(const ClothMesh& mesh, BlockRows<double, Device>& rows, bool without_first = false) {
    std::vector<Eigen::Matrix3d> off_diagonal(rows.col().size(), Eigen::Matrix3d::Zero()), diagonal;
    for (int i = 0; i < mesh.vertices(); ++i) {
      diagonal.push_back((without_first && i == 0 ? 0 : kMass) * Eigen::Matrix3d::Identity());
      for (int j = rows.row_ptr()[i]; j < rows.row_ptr()[i + 1]; ++j) {
        const Eigen::Vector3d along = (mesh.rest[rows.col()[j]] - mesh.rest[i]).normalized();
        const Eigen::Matrix3d spring = along * along.transpose() + 0.1 * Eigen::Matrix3d::Identity();
        if (without_first && (i == 0 || rows.col()[j] == 0)) continue;
        off_diagonal[j] = -spring;
        diagonal[i] += spring;
      }
    }
    device_upload(device_, rows.view().off_diagonal, off_diagonal.data(),
                  off_diagonal.size() * sizeof(Eigen::Matrix3d));
    device_upload(device_, rows.view().diagonal, diagonal.data(), diagonal.size() * sizeof(Eigen::Matrix3d));
  }

  // Returns the largest residual of the rows from the first one on.
  static double residual(const BlockRows<double, Device>& rows, const std::vector<Eigen::Vector3d>& x,
                         int first) {
    auto off_diagonal = rows.off_diagonal(), diagonal = rows.diagonal();
    const auto f = load(static_cast<int>(x.size()));
    const BlockRowsView<double> matrix{static_cast<int>(x.size()), rows.row_ptr().data(), rows.col().data(),
                                       off_diagonal.data(), diagonal.data()};
    double error2 = 0, size2 = 0;
    for (int i = first; i < matrix.rows; ++i) {
      error2 += (f[i] - matrix.times(i, x.data())).squaredNorm();
      size2 += f[i].squaredNorm();
    }
    return std::sqrt(error2 / size2);
  }

  Device device_;
};

}  // namespace hysteron::test
